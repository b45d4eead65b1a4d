// SPDX-License-Identifier: Apache-2.0
// Meshes that are easy and meshes that break unwrappers: every atlas is judged, exactly.
#include "baker/unwrap/unwrap.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "runtime/base/parallel.h"
#include "tests/support/atlas_judge.h"
#include "tests/support/meshes.h"

namespace surimi {
namespace {

using test::Mesh;
using test::scene_of;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool is_slow_build = true;
#else
constexpr bool is_slow_build = false;
#endif
constexpr int map_size = is_slow_build ? 128 : 256;

/// What compares whole unwraps shows the sanitizers nothing that one unwrap does not.
#define SKIP_IN_SLOW_BUILD() \
    if (is_slow_build) GTEST_SKIP() << "compared without sanitizers"

UnwrapSettings settings_of(int width, int height, int gutter = 2) {
    UnwrapSettings settings;
    settings.width = width;
    settings.height = height;
    settings.gutter = gutter;
    return settings;
}

Atlas expect_fit(const Scene& scene, const UnwrapSettings& settings) {
    Atlas atlas = unwrap(scene, settings, {});
    EXPECT_EQ(atlas.width, settings.width);
    EXPECT_EQ(atlas.height, settings.height);
    EXPECT_EQ(atlas.gutter, settings.gutter);
    for (const std::string& fault : test::faults_of(scene, atlas)) ADD_FAILURE() << fault;
    return atlas;
}

/// The first triangle of every chart, in the order of the triangles, stands for the chart: numbers that two atlases
/// with the same charts have in common, however they number these.
std::vector<size_t> charts_by_first_triangle(const std::vector<uint32_t>& charts) {
    std::map<uint32_t, size_t> first;
    std::vector<size_t> named;
    for (size_t t = 0; t < charts.size(); ++t) named.push_back(first.emplace(charts[t], t).first->second);
    return named;
}

/// Of the same triangles, in one order. `most` texels of a square map may lie between two uv.
void expect_same(const SurfaceUv& a, const SurfaceUv& b, double most) {
    ASSERT_EQ(a.uv.size(), b.uv.size());
    EXPECT_EQ(charts_by_first_triangle(a.chart), charts_by_first_triangle(b.chart));
    double furthest = 0;
    for (size_t t = 0; t < a.uv.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const Vec2 texels = static_cast<double>(map_size) * Vec2(a.uv[t][k] - b.uv[t][k]);
            furthest = std::max({furthest, std::abs(texels.x), std::abs(texels.y)});
        }
    EXPECT_LE(furthest, most) << "texels";
}

/// The triangles of surface 0 in an order that depends on nothing but where they are. Nothing tells copies of one
/// triangle apart but what they are mapped to, so that comes next.
SurfaceUv sorted_by_place(const Scene& scene, const Atlas& atlas) {
    const Surface& surface = scene.surfaces[0];
    std::vector<std::tuple<std::array<double, 9>, std::array<float, 6>, uint32_t>> sorted;
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        std::array<double, 9> place;
        std::array<float, 6> uv;
        for (size_t k = 0; k < 3; ++k) {
            for (int i = 0; i < 3; ++i)
                place[3 * k + static_cast<size_t>(i)] = surface.positions[surface.triangles[t][k]][i];
            uv[2 * k] = atlas.surfaces[0].uv[t][k].x;
            uv[2 * k + 1] = atlas.surfaces[0].uv[t][k].y;
        }
        sorted.emplace_back(place, uv, atlas.surfaces[0].chart[t]);
    }
    std::sort(sorted.begin(), sorted.end());
    SurfaceUv result;
    for (const auto& [place, uv, chart] : sorted) {
        result.uv.push_back({Vec2f(uv[0], uv[1]), Vec2f(uv[2], uv[3]), Vec2f(uv[4], uv[5])});
        result.chart.push_back(chart);
    }
    return result;
}

class UnwrapMeshes : public testing::TestWithParam<test::NamedMesh> {
  protected:
    Scene scene() const { return scene_of({GetParam().make()}); }
};

TEST_P(UnwrapMeshes, AreMappedOneToOneWithGutters) {
    expect_fit(scene(), settings_of(map_size, map_size));
    expect_fit(scene(), settings_of(map_size + 44, map_size / 2, 3));
}

TEST_P(UnwrapMeshes, DoNotDependOnTheOrderOfTheirFaces) {
    SKIP_IN_SLOW_BUILD();
    const Mesh mesh = GetParam().make();
    const std::vector<size_t> order = test::shuffled_order(mesh.triangles.size(), 1);
    const Scene plain = scene_of({mesh}), shuffled = scene_of({test::reordered(mesh, order)});
    const Atlas a = expect_fit(plain, settings_of(map_size, map_size));
    const Atlas b = expect_fit(shuffled, settings_of(map_size, map_size));
    expect_same(sorted_by_place(plain, a), sorted_by_place(shuffled, b), 0);
}

TEST_P(UnwrapMeshes, DoNotDependOnTheirScale) {
    SKIP_IN_SLOW_BUILD();
    const Mesh mesh = GetParam().make();
    const Atlas atlas = unwrap(scene_of({mesh}), settings_of(map_size, map_size), {});
    for (const double factor : {1e-3, 1e3, 1024.0}) {
        SCOPED_TRACE(factor);
        const bool is_exact = factor == 1024.0;
        const Scene scene = scene_of({scaled(mesh, factor)});
        const Atlas other = expect_fit(scene, settings_of(map_size, map_size));
        // A power of two changes no digit of any position; 1000 rounds them.
        expect_same(atlas.surfaces[0], other.surfaces[0], is_exact ? 0 : 0.01);
        EXPECT_NEAR(other.texels_per_metre * factor / atlas.texels_per_metre, 1, 1e-6);
    }
}

TEST_P(UnwrapMeshes, DoNotDependOnTheNumberOfThreads) {
    SKIP_IN_SLOW_BUILD();
    // Of several surfaces, so that there is something to share out.
    const Mesh mesh = GetParam().make();
    const Scene scene = scene_of({mesh, test::box(Vec3(0), Vec3(1, 2, 3)), mesh, test::arch(2, 20)});
    set_thread_count(1);
    const Atlas one = unwrap(scene, settings_of(map_size, map_size), {});
    set_thread_count(4);
    const Atlas four = unwrap(scene, settings_of(map_size, map_size), {});
    set_thread_count(0);
    ASSERT_EQ(one.surfaces.size(), four.surfaces.size());
    for (size_t s = 0; s < one.surfaces.size(); ++s) {
        EXPECT_EQ(one.surfaces[s].uv, four.surfaces[s].uv);
        EXPECT_EQ(one.surfaces[s].chart, four.surfaces[s].chart);
    }
}

TEST_P(UnwrapMeshes, KeepTheStretchAskedFor) {
    for (const double stretch : {1.5, 1.2}) {
        if (is_slow_build && stretch != 1.5) continue;
        SCOPED_TRACE(stretch);
        UnwrapSettings settings = settings_of(2 * map_size, 2 * map_size);
        settings.stretch = stretch;
        const Atlas atlas = unwrap(scene(), settings, {});
        double most_energy = 4, lowest_density = 1;
        for (const test::Stretch& chart : test::stretches_of(scene(), atlas)) {
            most_energy = std::max(most_energy, chart.dirichlet);
            lowest_density = std::min(lowest_density, chart.lowest_density);
        }
        // 0.1 % for what rounding does to triangles that are 1/32 texel high.
        EXPECT_LE(most_energy, (4 + 0.4 * (stretch - 1) * (stretch - 1)) * 1.001);
        EXPECT_GE(lowest_density, 1 / stretch * 0.999);
    }
}

INSTANTIATE_TEST_SUITE_P(All, UnwrapMeshes, testing::ValuesIn(test::all_meshes()),
                         [](const testing::TestParamInfo<test::NamedMesh>& some) { return some.param.name; });

void expect_one_chart(const Mesh& mesh) {
    const Scene scene = scene_of({mesh});
    const Atlas atlas = expect_fit(scene, settings_of(map_size, map_size));
    EXPECT_EQ(atlas.charts.size(), 1u);
}

TEST(UnwrapDiscs, ATerrainIsOneChart) {
    expect_one_chart(test::terrain(128));
}

TEST(UnwrapDiscs, AnArchIsOneChartWithoutStretch) {
    const Scene scene = scene_of({test::arch(4, 400)});
    const Atlas atlas = expect_fit(scene, settings_of(map_size, map_size));
    ASSERT_EQ(atlas.charts.size(), 1u);
    EXPECT_NEAR(test::stretches_of(scene, atlas)[0].dirichlet, 4, 1e-3);
}

TEST(UnwrapDiscs, ADomeIsOneChart) {
    expect_one_chart(is_slow_build ? test::dome(12, 48) : test::dome(50, 160));
}

TEST(UnwrapDiscs, SignedZerosAreOneZero) {
    // The sheet is twice as long as it is wide: on a square map it would be two halves.
    EXPECT_EQ(expect_fit(scene_of({test::signed_zeros()}), settings_of(map_size, map_size / 2)).charts.size(), 1u);
}

TEST(UnwrapCharts, AreNoMoreThanXatlasMakes) {
    // Of meshes like these (research/unwrap.md, section 3); long strips and rings are divided for the map's sake.
    const std::map<std::string, size_t> most{{"uv_sphere", 6}, {"torus", 14}, {"capped_cylinder", 6},
                                             {"box", 6},       {"cloth", 65}, {"touching_cubes", 21},
                                             {"foliage", 150}};
    size_t counted = 0;
    for (const test::NamedMesh& mesh : test::all_meshes()) {
        const auto known = most.find(mesh.name);
        if (known == most.end()) continue;
        const Atlas atlas = unwrap(scene_of({mesh.make()}), settings_of(map_size, map_size), {});
        EXPECT_LE(atlas.charts.size(), known->second) << mesh.name;
        ++counted;
    }
    EXPECT_EQ(counted, most.size());
}

TEST(UnwrapScales, AMillimetreAndAKilometreInOneScene) {
    const Mesh small = scaled(test::ico_sphere(2), 0.001), large = scaled(test::torus(24, 12), 1000);
    expect_fit(scene_of({small, large}), settings_of(map_size, map_size));
}

}  // namespace
}  // namespace surimi
