// SPDX-License-Identifier: Apache-2.0
// Meshes that are easy and meshes that break unwrappers: every atlas is judged, exactly.
#include "baker/unwrap/unwrap.h"

#include <algorithm>
#include <map>
#include <string>

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

/// Both of one surface of the same triangles. `most` texels may lie between two uv.
void expect_same(const Atlas& a, const Atlas& b, double most) {
    ASSERT_EQ(a.surfaces[0].uv.size(), b.surfaces[0].uv.size());
    EXPECT_EQ(a.charts.size(), b.charts.size());
    EXPECT_EQ(charts_by_first_triangle(a.surfaces[0].chart), charts_by_first_triangle(b.surfaces[0].chart));
    double furthest = 0;
    for (size_t t = 0; t < a.surfaces[0].uv.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const Vec2 texels = Vec2(a.surfaces[0].uv[t][k] - b.surfaces[0].uv[t][k]) * Vec2(a.width, a.height);
            furthest = std::max({furthest, std::abs(texels.x), std::abs(texels.y)});
        }
    EXPECT_LE(furthest, most) << "texels";
}

class UnwrapMeshes : public testing::TestWithParam<test::NamedMesh> {
  protected:
    Scene scene() const { return scene_of({GetParam().make()}); }
};

TEST_P(UnwrapMeshes, AreMappedOneToOneWithGutters) {
    expect_fit(scene(), settings_of(256, 256));
    expect_fit(scene(), settings_of(500, 300, 3));
}

TEST_P(UnwrapMeshes, DoNotDependOnTheOrderOfTheirFaces) {
    const Mesh mesh = GetParam().make();
    const std::vector<size_t> order = test::shuffled_order(mesh.triangles.size(), 1);
    const Scene plain = scene_of({mesh}), shuffled = scene_of({test::reordered(mesh, order)});
    const Atlas a = expect_fit(plain, settings_of(256, 256));
    const Atlas b = expect_fit(shuffled, settings_of(256, 256));
    // Back into the plain order; zero-area triangles are in neither.
    const std::vector<uint32_t>& kept = plain.surfaces[0].source_triangle;
    Atlas back = b;
    for (size_t t = 0; t < shuffled.surfaces[0].triangles.size(); ++t) {
        const size_t source = order[shuffled.surfaces[0].source_triangle[t]];
        const auto at = static_cast<size_t>(std::lower_bound(kept.begin(), kept.end(), source) - kept.begin());
        back.surfaces[0].uv[at] = b.surfaces[0].uv[t];
        back.surfaces[0].chart[at] = b.surfaces[0].chart[t];
    }
    expect_same(a, back, 0);
}

TEST_P(UnwrapMeshes, DoNotDependOnTheirScale) {
    const Mesh mesh = GetParam().make();
    const Atlas atlas = unwrap(scene_of({mesh}), settings_of(256, 256), {});
    for (const double factor : {1024.0, 1e-3, 1e3}) {
        SCOPED_TRACE(factor);
        const bool is_exact = factor == 1024.0;
        const Scene scene = scene_of({scaled(mesh, factor)});
        const Atlas other = expect_fit(scene, settings_of(256, 256));
        // A power of two changes no digit of any position; 1000 rounds them.
        expect_same(atlas, other, is_exact ? 0 : 0.01);
        EXPECT_NEAR(other.texels_per_metre * factor / atlas.texels_per_metre, 1, 1e-6);
    }
}

TEST_P(UnwrapMeshes, DoNotDependOnTheNumberOfThreads) {
    // Of several surfaces, so that there is something to share out.
    const Mesh mesh = GetParam().make();
    const Scene scene = scene_of({mesh, test::box(Vec3(0), Vec3(1, 2, 3)), mesh, test::arch(2, 20)});
    set_thread_count(1);
    const Atlas one = unwrap(scene, settings_of(256, 256), {});
    set_thread_count(4);
    const Atlas four = unwrap(scene, settings_of(256, 256), {});
    set_thread_count(0);
    ASSERT_EQ(one.surfaces.size(), four.surfaces.size());
    for (size_t s = 0; s < one.surfaces.size(); ++s) {
        EXPECT_EQ(one.surfaces[s].uv, four.surfaces[s].uv);
        EXPECT_EQ(one.surfaces[s].chart, four.surfaces[s].chart);
    }
}

TEST_P(UnwrapMeshes, KeepTheStretchAskedFor) {
    for (const double stretch : {1.2, 1.5}) {
        SCOPED_TRACE(stretch);
        UnwrapSettings settings = settings_of(512, 512);
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
    const Atlas atlas = expect_fit(scene, settings_of(256, 256));
    EXPECT_EQ(atlas.charts.size(), 1u);
}

TEST(UnwrapDiscs, ATerrainIsOneChart) {
    expect_one_chart(test::terrain(is_slow_build ? 32 : 128));
}

TEST(UnwrapDiscs, AnArchIsOneChartWithoutStretch) {
    const Scene scene = scene_of({test::arch(4, 400)});
    const Atlas atlas = expect_fit(scene, settings_of(256, 256));
    ASSERT_EQ(atlas.charts.size(), 1u);
    EXPECT_NEAR(test::stretches_of(scene, atlas)[0].dirichlet, 4, 1e-3);
}

TEST(UnwrapDiscs, ADomeIsOneChart) {
    expect_one_chart(is_slow_build ? test::dome(12, 48) : test::dome(50, 160));
}

TEST(UnwrapDiscs, SignedZerosAreOneZero) {
    expect_one_chart(test::signed_zeros());
}

TEST(UnwrapCharts, AreNoMoreThanXatlasMakes) {
    // Of meshes like these (research/unwrap.md, section 3).
    const std::map<std::string, size_t> most{{"uv_sphere", 6}, {"torus", 14}, {"capped_cylinder", 6}, {"box", 6},
                                             {"helix", 12},    {"cloth", 65}, {"touching_cubes", 21}, {"moebius", 3},
                                             {"foliage", 150}};
    size_t counted = 0;
    for (const test::NamedMesh& mesh : test::all_meshes()) {
        const auto known = most.find(mesh.name);
        if (known == most.end()) continue;
        const Atlas atlas = unwrap(scene_of({mesh.make()}), settings_of(256, 256), {});
        EXPECT_LE(atlas.charts.size(), known->second) << mesh.name;
        ++counted;
    }
    EXPECT_EQ(counted, most.size());
}

TEST(UnwrapScales, AMillimetreAndAKilometreInOneScene) {
    const Mesh small = scaled(test::ico_sphere(2), 0.001), large = scaled(test::torus(24, 12), 1000);
    expect_fit(scene_of({small, large}), settings_of(256, 256));
}

}  // namespace
}  // namespace surimi
