// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/gather.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "runtime/batch/batch.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr int size = 32;

/// A floor of 4 m on the whole map; what stands on it comes after.
Scene floor_under_monitor() {
    Scene scene;
    test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    test::add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0.02, 0}, {0, 0.01, 0.45});
    return scene;
}

Scene furnished() {
    Scene scene = floor_under_monitor();
    test::add_box(scene, "Box", {-0.63, 0.4, 0.41}, {0.7, 0.8, 0.5});
    test::add_quad(scene, "Sheet", {0.1, 1.1, -0.2}, {0.9, 1.2, -0.3}, {0.8, 1.1, -1.1}, {0.2, 1.0, -1.2});
    return scene;
}

/// Texels of surface 0 alone.
struct Map {
    Scene scene;
    RayScene rays{scene};
    Silhouettes silhouettes = find_silhouettes(scene, rays);
    Atlas atlas = test::whole_map_atlas(scene, 0, size);

    Texels texels() const {
        Scene alone = scene;
        for (size_t s = 1; s < alone.surfaces.size(); ++s) alone.surfaces[s].triangles.clear();
        return find_texels(alone, atlas);
    }
    Gathered gathered(const GatherSettings& settings = {}) const {
        return gather(scene, atlas, texels(), rays, silhouettes, 0, settings, {});
    }
};

size_t texels_by(const Gathered& gathered, TexelMethod method) {
    return gathered.statistics.methods[static_cast<size_t>(method)].texels;
}

double visibility_of(const IrradianceEstimate& e) {
    return e.unshadowed > 0 ? static_cast<double>(e.shadowed) / static_cast<double>(e.unshadowed) : 0;
}

double largest_difference(const Gathered& a, const Gathered& b) {
    double largest = 0;
    for (size_t i = 0; i < a.estimates.size(); ++i)
        largest = std::max(largest, std::abs(visibility_of(a.estimates[i]) - visibility_of(b.estimates[i])));
    return largest;
}

TEST(Gather, StatisticsAddUp) {
    const Map map{furnished()};
    for (const GatherSettings& settings :
         {GatherSettings{}, GatherSettings{.is_exact = true}, GatherSettings{.method = Method::monte_carlo}}) {
        const Gathered gathered = map.gathered(settings);
        const GatherStatistics& s = gathered.statistics;
        std::array<size_t, texel_method_count> by_method{};
        size_t above = 0, exact = 0, lit = 0;
        for (const IrradianceEstimate& e : gathered.estimates) {
            ++by_method[static_cast<size_t>(e.method)];
            EXPECT_GE(e.shadowed, 0);
            EXPECT_LE(e.shadowed, e.unshadowed);
            EXPECT_EQ(e.unshadowed > 0, e.method != TexelMethod::none);
            lit += e.unshadowed > 0;
            above += static_cast<double>(e.error) > settings.error;
            exact += e.unshadowed > 0 && e.error == 0;
        }
        size_t histogram = 0, texels = 0, rays = 0;
        for (const size_t count : s.error_histogram) histogram += count;
        for (size_t m = 0; m < by_method.size(); ++m) {
            EXPECT_EQ(s.methods[m].texels, by_method[m]) << m;
            EXPECT_GE(s.methods[m].points, m == 0 ? 0 : by_method[m]) << m;
            texels += s.methods[m].texels;
            rays += s.methods[m].rays;
        }
        EXPECT_EQ(texels, gathered.estimates.size());
        EXPECT_EQ(rays, s.rays());
        EXPECT_EQ(histogram, lit);
        EXPECT_EQ(s.error_histogram[0], exact);
        EXPECT_EQ(s.above_error, above);
        EXPECT_EQ(s.blocks, size_t{size} * size / 64);
        EXPECT_LE(s.shadowed_blocks + s.open_blocks, s.blocks);
        EXPECT_GT(s.candidates, 0u);
    }
}

TEST(Gather, StatisticsOfPartsAddUp) {
    GatherStatistics sum, part;
    part.count({1, 0.5f, 0, TexelMethod::split}, 0.01);
    part.count({1, 0.5f, 0.3f, TexelMethod::scanline}, 0.01);
    part.count({1, 0.5f, 1e-7f, TexelMethod::scanline}, 0.01);
    part.count({0, 0, 0, TexelMethod::none}, 0.01);
    part.methods[3].rays = 7;
    part.blocks = 2, part.shadowed_blocks = 1, part.open_blocks = 3, part.candidates = 4, part.segments = 5;
    part.failed_checks = 6, part.refined_texels = 8, part.query_seconds = 0.5;
    EXPECT_EQ(part.error_histogram[0], 1u) << "exact";
    EXPECT_EQ(part.error_histogram[1], 1u) << "below 2^-14";
    EXPECT_EQ(part.error_histogram[14], 1u) << "0.3 is below 2^-1";
    EXPECT_EQ(part.above_error, 1u);
    sum.add(part);
    sum.add(part);
    EXPECT_EQ(sum.methods[0].texels, 2u);
    EXPECT_EQ(sum.methods[4].texels, 4u);
    EXPECT_EQ(sum.rays(), 14u);
    EXPECT_EQ(sum.blocks, 4u);
    EXPECT_EQ(sum.shadowed_blocks, 2u);
    EXPECT_EQ(sum.open_blocks, 6u);
    EXPECT_EQ(sum.candidates, 8u);
    EXPECT_EQ(sum.segments, 10u);
    EXPECT_EQ(sum.failed_checks, 12u);
    EXPECT_EQ(sum.refined_texels, 16u);
    EXPECT_EQ(sum.query_seconds, 1);
    EXPECT_EQ(sum.error_histogram[14], 2u);
    EXPECT_EQ(sum.above_error, 2u);
}

TEST(Gather, SettingsForceTheMethod) {
    const Map map{furnished()};
    const Gathered split = map.gathered({.method = Method::split}), exact = map.gathered({.is_exact = true});
    for (const Gathered* gathered : {&split, &exact}) {
        EXPECT_GT(texels_by(*gathered, TexelMethod::split), 300u);
        EXPECT_EQ(texels_by(*gathered, TexelMethod::scanline), 0u);
    }
    EXPECT_EQ(texels_by(split, TexelMethod::monte_carlo), 0u);
    const Gathered lines = map.gathered({.method = Method::scanline});
    EXPECT_GT(texels_by(lines, TexelMethod::scanline), 300u);
    EXPECT_EQ(texels_by(lines, TexelMethod::split), 0u);
    const Gathered rays = map.gathered({.method = Method::monte_carlo, .samples = 256});
    EXPECT_GT(texels_by(rays, TexelMethod::monte_carlo), 900u);
    EXPECT_EQ(texels_by(rays, TexelMethod::split) + texels_by(rays, TexelMethod::scanline), 0u);
    EXPECT_LE(rays.statistics.rays(), size_t{256} * size * size + rays.statistics.blocks);
    EXPECT_LT(largest_difference(split, lines), 0.03);
    EXPECT_LT(largest_difference(split, rays), 0.1);
}

/// Makes a surface alpha-masked, a hole altogether or none.
void mask(Scene& scene, size_t surface, double alpha) {
    scene.surfaces[surface].material = static_cast<int>(scene.materials.size());
    scene.materials.emplace_back();
    scene.materials.back().alpha_mode = AlphaMode::mask;
    scene.materials.back().base_color.a = alpha;
    scene.materials.back().alpha_cutoff = 0.5;
}

TEST(Gather, CutoutsGoToRaysOnlyWhereTheyAreInTheWay) {
    Scene solid = floor_under_monitor();
    // Close above the floor's left, so that most of the floor is free of it.
    test::add_quad(solid, "Leaf", {-1.7, 0.1, 1.7}, {-1.3, 0.1, 1.7}, {-1.3, 0.1, 1.3}, {-1.7, 0.1, 1.3});
    Scene masked = solid, hole = solid;
    mask(masked, 2, 1);
    mask(hole, 2, 0.2);
    const Gathered opaque = Map{solid}.gathered(), as_masked = Map{masked}.gathered(), open = Map{hole}.gathered();
    EXPECT_EQ(texels_by(open, TexelMethod::certificate), 0u);
    for (const Gathered* gathered : {&as_masked, &open}) {
        EXPECT_GE(texels_by(*gathered, TexelMethod::monte_carlo), 64u);
        EXPECT_LE(texels_by(*gathered, TexelMethod::monte_carlo), 4 * 64u) << "a few blocks of sixteen";
        EXPECT_GT(texels_by(*gathered, TexelMethod::ray), 700u);
    }
    EXPECT_LT(largest_difference(opaque, as_masked), 0.05);
    EXPECT_GT(largest_difference(opaque, open), 0.5);
    for (const IrradianceEstimate& e : open.estimates) EXPECT_EQ(e.shadowed, e.unshadowed);
}

/// A leaf of 40 cm close above the floor: its shadow's edges are half a texel wide.
double worst_under_leaf(double x, double z) {
    Scene scene = floor_under_monitor();
    test::add_quad(scene, "Leaf", {x, 0.1, z}, {x + 0.4, 0.1, z}, {x + 0.4, 0.1, z - 0.4}, {x, 0.1, z - 0.4});
    const Map map{scene};
    return largest_difference(map.gathered(), map.gathered({.method = Method::monte_carlo, .samples = 1 << 12}));
}

TEST(Gather, ShadowsThatEndBetweenTheLastCentreAndTheBorderOfAChartAreSeen) {
    EXPECT_LT(worst_under_leaf(-1.9, 1.9), 0.01);  // the corner's centres are dark, the corner is not
}

TEST(Gather, CornersOfShadowsBetweenCentresAreSeen) {
    EXPECT_LT(worst_under_leaf(-1.7, 1.7), 0.01);  // dark is only the centre of the texel across the corner
}

TEST(Gather, TwoSidedMonitorsLightBothSides) {
    // The floor is behind the monitor: turned away, it is dark; two-sided, it is as if turned around.
    Scene front = furnished(), back = furnished(), both = furnished();
    auto& corners = back.monitors[0].panels[0].corners;
    std::swap(corners[1], corners[3]);
    both.monitors[0].panels = back.monitors[0].panels;
    both.monitors[0].two_sided = true;
    const GatherSettings settings{.error = 0.002};
    const Gathered lit = Map{front}.gathered(settings), dark = Map{back}.gathered(settings);
    for (const IrradianceEstimate& e : dark.estimates) {
        EXPECT_EQ(e.unshadowed, 0);
        EXPECT_EQ(e.method, TexelMethod::none);
    }
    EXPECT_EQ(dark.statistics.rays(), 0u);
    const Gathered two_sided = Map{both}.gathered(settings);
    EXPECT_LT(largest_difference(lit, two_sided), 0.01);
    // A block on both sides has more silhouettes, so a texel may be given by its centre here and by its cells there.
    for (size_t i = 0; i < lit.estimates.size(); ++i)
        EXPECT_NEAR(lit.estimates[i].unshadowed, two_sided.estimates[i].unshadowed, 1e-5);
}

TEST(Gather, TexelsInTheMonitorsOwnPlaneAreUnlit) {
    Scene scene;
    test::add_quad(scene, "Wall", {-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
    test::add_monitor(scene, "Monitor_R", 0, {0.1, 0.2, 0}, {0.8, 0, 0}, {0, 0.45, 0});
    const Map map{scene};
    for (const Method method : {Method::automatic, Method::split, Method::scanline, Method::monte_carlo}) {
        const Gathered gathered = map.gathered({.method = method});
        EXPECT_EQ(texels_by(gathered, TexelMethod::none), gathered.estimates.size());
        for (const IrradianceEstimate& e : gathered.estimates) EXPECT_EQ(e.unshadowed, 0);
        EXPECT_LE(gathered.statistics.rays(), gathered.statistics.blocks) << "one each, from just above the plane";
    }
}

TEST(Gather, EveryInstructionSetKeepsTheError) {
    const Map map{furnished()};
    std::unique_ptr<Gathered> first;
    for (const std::string& set : instruction_sets()) {
        use_instruction_set(set);
        Gathered gathered = map.gathered({.error = 0.002});
        if (!first) first = std::make_unique<Gathered>(gathered);
        EXPECT_LT(largest_difference(*first, gathered), 0.004) << set;
    }
    use_instruction_set("");
}

TEST(Gather, SeedsChangeNoiseAndNothingElse) {
    const Map map{furnished()};
    const GatherSettings rays{.method = Method::monte_carlo, .samples = 64, .seed = 1};
    GatherSettings other = rays;
    other.seed = 2;
    EXPECT_EQ(largest_difference(map.gathered(rays), map.gathered(rays)), 0);
    const double difference = largest_difference(map.gathered(rays), map.gathered(other));
    EXPECT_GT(difference, 0);
    EXPECT_LT(difference, 0.3);
    EXPECT_LT(
        largest_difference(map.gathered({.is_exact = true, .seed = 1}), map.gathered({.is_exact = true, .seed = 2})),
        0.004);
}

}  // namespace
}  // namespace surimi
