// SPDX-License-Identifier: Apache-2.0
// The techniques of a study against exact penumbrae, and their known biases.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "baker/study/closest_point.h"
#include "baker/study/hard_shadows.h"
#include "baker/study/measurement.h"
#include "baker/study/point_sampling.h"
#include "baker/study/shadow_map.h"
#include "baker/study/solid_angle.h"
#include "runtime/base/random.h"
#include "tests/support/closed_form.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr int size = 24;  // texels a side, over a floor of 4 m

std::vector<std::array<uint32_t, 4>> sobol_table(uint32_t count) {
    std::vector<std::array<uint32_t, 4>> table;
    for (uint32_t i = 0; i < count; ++i) table.push_back(sobol::point(i));
    return table;
}

/// A floor under a parallel monitor of 1.6 x 0.9 m on the ceiling, 2.5 m above it, and sheets in between.
struct Stage {
    Scene scene;
    uint32_t floor = 0;
    std::vector<test::Occluder> sheets;
    Atlas atlas;
    Texels texels;

    Stage() {
        floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        test::add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0, 0}, {0, 0, 0.45});
        atlas = test::whole_map_atlas(scene, floor, size);
        texels = find_texels(scene, atlas);
    }
    void add_sheet(double height, double left, double right) {
        const Vec3 a(left, height, 4), b(right, height, 4), c(right, height, -4), d(left, height, -4);
        test::add_quad(scene, "Sheet", a, b, c, d);
        sheets.push_back({{a, b, c, d}});
    }

    /// Exact V (M3) by 6 x 6 midpoints.
    double exact(const Texel& texel) const {
        const uint32_t x = texel.index % size, y = texel.index / size;
        const Polygon& light = scene.monitors[0].panels[0];
        double seen = 0, all = 0;
        for (int i = 0; i < 36; ++i) {
            const Vec3 p(-2 + 4 * (x + (i % 6 + 0.5) / 6) / size, 0, 2 - 4 * (y + (i / 6 + 0.5) / 6) / size);
            const double e = test::irradiance_by_quadrature(light, p, {0, 1, 0}, 8);
            seen += e * test::exact_visibility(light, p, {0, 1, 0}, sheets);
            all += e;
        }
        return seen / all;
    }
};

struct Outcome {
    double rmse = 0, largest = 0, least = 1, most = 0;
    size_t rays = 0, penumbra = 0;
};

/// Errors of a technique over every third texel of the floor.
Outcome judge(const Stage& stage, const std::function<StudyEstimate(const Receiver&)>& technique,
              const RayScene& rays) {
    const StudiedMonitor light(stage.scene, rays, 0);
    Outcome outcome;
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < stage.texels.texels.size(); i += 3, ++count) {
        const Texel& texel = stage.texels.texels[i];
        const TexelSurface surface(stage.scene, stage.atlas, stage.texels, texel);
        const StudyEstimate e = technique({light, surface, hash(7, i)});
        const double exact = stage.exact(texel), error = std::abs(e.visibility - exact);
        EXPECT_TRUE(e.is_lit);
        if (exact > 0.01 && exact < 0.99) ++outcome.penumbra;
        sum += error * error;
        outcome.largest = std::max(outcome.largest, error);
        outcome.least = std::min(outcome.least, e.visibility);
        outcome.most = std::max(outcome.most, e.visibility);
        outcome.rays += e.rays;
    }
    outcome.rmse = std::sqrt(sum / static_cast<double>(count));
    EXPECT_GT(count, 100u);
    return outcome;
}

struct Techniques {
    Stage stage;
    RayScene rays;
    std::vector<std::array<uint32_t, 4>> points = sobol_table(4096);

    explicit Techniques(Stage s) : stage(std::move(s)), rays(stage.scene) {}
    Outcome random(int count) const {
        return judge(
            stage, [=](const Receiver& r) { return random_points(r, count); }, rays);
    }
    Outcome stratified(int count) const {
        return judge(
            stage, [=](const Receiver& r) { return stratified_points(r, count); }, rays);
    }
    Outcome sobol(size_t count) const {
        return judge(
            stage, [&](const Receiver& r) { return sobol_points(r, SobolPoints(points).first(count)); }, rays);
    }
    Outcome probe(size_t count) const {
        return judge(
            stage, [&](const Receiver& r) { return probe_and_refine(r, SobolPoints(points).first(count)); }, rays);
    }
    Outcome grid(int n) const {
        return judge(
            stage, [=](const Receiver& r) { return hard_shadow_grid(r, n); }, rays);
    }
    Outcome closest(int n) const {
        return judge(
            stage, [=](const Receiver& r) { return closest_point(r, n); }, rays);
    }
    DepthMaps maps() const { return make_depth_maps(StudiedMonitor(stage.scene, rays, 0), 512); }
    Outcome pcf(int n) const {
        const DepthMaps depth = maps();
        return judge(
            stage, [&](const Receiver& r) { return percentage_closer_filter(r, depth, n); }, rays);
    }
    Outcome pcss(int n) const {
        const DepthMaps depth = maps();
        return judge(
            stage, [&](const Receiver& r) { return percentage_closer_soft_shadow(r, depth, n); }, rays);
    }
};

Stage half_plane() {
    Stage stage;
    stage.add_sheet(1.25, 0.1, 4);
    return stage;
}

// Midpoints of texels of 17 cm are off by up to 2e-3 where a shadow's edge crosses them.
constexpr double midpoints = 2e-3;

TEST(Study, SamplingConvergesToTheExactPenumbra_M6) {
    const Techniques techniques(half_plane());
    const Outcome random = techniques.random(1024);
    ASSERT_GT(random.penumbra, 40u);
    // The standard deviation of N hits or misses is at most 1 / (2 sqrt N).
    EXPECT_LT(random.rmse, 0.5 / std::sqrt(1024.0) + midpoints);
    EXPECT_LT(techniques.random(4096).rmse, 0.5 / std::sqrt(4096.0) + midpoints);
    // Jittered: 0.46 N^-3/4 for one edge through the monitor (research: samplers), and as much for that of the texel.
    EXPECT_LT(techniques.stratified(1024).rmse, 2 * 0.46 * std::pow(1024, -0.75) + midpoints);
    EXPECT_LT(techniques.sobol(1024).rmse, 2 * 0.46 * std::pow(1024, -0.75) + midpoints);
    EXPECT_LT(techniques.sobol(4096).rmse, techniques.sobol(64).rmse / 4);
}

TEST(Study, EveryTechniqueIsExactWhereNothingIsInTheWay) {
    const Techniques furnace{Stage()};
    for (const Outcome& outcome : {furnace.random(16), furnace.stratified(64), furnace.sobol(64), furnace.probe(64),
                                   furnace.grid(1), furnace.grid(5), furnace.closest(16), furnace.closest(128),
                                   furnace.pcf(1), furnace.pcf(7), furnace.pcss(64)}) {
        EXPECT_EQ(outcome.least, 1);
        EXPECT_EQ(outcome.most, 1);
    }
    EXPECT_EQ(furnace.pcss(16).rays, 0u);
    EXPECT_EQ(furnace.probe(4096).rays, furnace.sobol(16).rays);
}

TEST(Study, ProbesOverlookWhatHidesLessThanOneInSixteen) {
    Stage stage;
    stage.add_sheet(2.0, 0.2, 0.26);  // a bar that hides about 2 % of the monitor, and nothing else
    const Techniques techniques(stage);
    const Outcome probe = techniques.probe(4096);
    EXPECT_GT(probe.rmse, 4 * techniques.sobol(4096).rmse);
    EXPECT_LT(probe.rays, techniques.sobol(4096).rays);
}

TEST(Study, HardShadowGridsBandAndConverge) {
    const Techniques techniques(half_plane());
    // The sheet's edge runs along the grid: a row of 1 / n of the lights crosses it at once.
    EXPECT_GT(techniques.grid(4).rmse, 0.01);
    EXPECT_LT(techniques.grid(4).largest, 1.0 / 4);
    EXPECT_LT(techniques.grid(64).rmse, 0.5 / 64 + midpoints);
}

TEST(Study, TheClosestPointKnowsNoPenumbraOfTheMonitor) {
    const Techniques techniques(half_plane());
    EXPECT_GT(techniques.closest(16).largest, 0.3);
    EXPECT_GT(techniques.closest(2048).rmse, 0.02);  // whatever the rays
    EXPECT_EQ(techniques.closest(16).least, 0);
    EXPECT_EQ(techniques.closest(16).most, 1);
}

TEST(Study, TheClosestPointOfAPanelIsItsFootOrOnItsRim) {
    const Stage stage;
    const Monitor& monitor = stage.scene.monitors[0];
    EXPECT_LT(glm::length(closest_point_of(monitor, {0.5, 0, 0}).position - Vec3(0.5, 2.5, 0)), 1e-12);
    EXPECT_LT(glm::length(closest_point_of(monitor, {3, 0, 0.1}).position - Vec3(1.0, 2.5, 0.1)), 1e-12);
    EXPECT_LT(glm::length(closest_point_of(monitor, {-3, 1, -4}).position - Vec3(-0.6, 2.5, -0.55)), 1e-12);
}

TEST(Study, SoftShadowsFromAMapHoldForOneParallelBlockerOnly_M59) {
    // Weights cos cos / r^2 that grow by a factor w from one end of the monitor to the other move the share of its half
    // by (w - 1) / (w + 1) / 4: w is 1.2 from below and 3.3 from the floor's rim, so 0.02 to 0.13.
    const Outcome one = Techniques(half_plane()).pcss(1024);
    EXPECT_LT(one.rmse, 0.03);
    EXPECT_LT(one.largest, 0.13);
    Stage stage;
    stage.add_sheet(0.9, 0.1, 4);      // hides part of the monitor
    stage.add_sheet(2.2, -0.5, -0.1);  // hides another part, from near the monitor
    const Techniques two(stage);
    EXPECT_GT(two.pcss(1024).largest, 0.2);
    EXPECT_GT(two.pcss(1024).rmse, 4 * one.rmse);
}

TEST(Study, PercentageCloserFilteringBlursByTheMapNotByThePenumbra) {
    const Techniques techniques(half_plane());
    const Outcome plain = techniques.pcf(1);
    EXPECT_GT(plain.largest, 0.4);  // a hard edge in the middle of the penumbra
    EXPECT_GT(techniques.pcf(3).largest, 0.35);
    EXPECT_EQ(plain.rays, 0u);
}

TEST(Study, ADepthMapSeesTheSheetAndTheFloor) {
    const Techniques techniques(half_plane());
    const DepthMap map = techniques.maps()[0];
    const auto depth_towards = [&](const Vec3& place) {
        const Vec2 texel = map.place(map.frame.local(place));
        return static_cast<double>(map.at(static_cast<int>(texel.x), static_cast<int>(texel.y)));
    };
    EXPECT_NEAR(depth_towards({0.6, 1.25, 0}), 1.25, 1e-5);
    EXPECT_NEAR(depth_towards({-1, 0, 0.3}), 2.5, 1e-5);
    EXPECT_TRUE(std::isinf(depth_towards({-9, 1.5, 0})));
    for (const int i : {0, 17, 255, 511}) {  // texels and directions are inverse to each other
        const Vec2 back = map.place(map.direction(i, 511 - i));
        EXPECT_NEAR(back.x, i + 0.5, 1e-9);
        EXPECT_NEAR(back.y, 511 - i + 0.5, 1e-9);
    }
}

TEST(Study, PointsOnAMonitorAreEvenInSolidAngle) {
    const Stage stage;
    const Monitor& monitor = stage.scene.monitors[0];
    const Vec3 from(1.9, 2.3, 0.4);  // close to its plane, where points even by area are far from it
    const SeenMonitor seen(monitor, from);
    // The part of the monitor beyond a line: its solid angle over all, against the share of the samples.
    Monitor part = monitor;
    for (Vec3& corner : part.panels[0].corners) corner.x = std::max(corner.x, 0.7);
    const double share = SeenMonitor(part, from).solid_angle() / seen.solid_angle();
    int inside = 0;
    constexpr int n = 128;
    for (int i = 0; i < n * n; ++i) {
        double weight = 0;
        const LightPoint point = seen.sample((i % n + 0.5) / n, (i / n + 0.5) / n, weight);
        EXPECT_EQ(weight, seen.solid_angle());
        ASSERT_NEAR(point.position.y, 2.5, 1e-9);
        if (point.position.x > 0.7) ++inside;
    }
    EXPECT_NEAR(static_cast<double>(inside) / (n * n), share, 2.0 / n);  // cells that the line crosses
    EXPECT_GT(share, 0.3);
    EXPECT_EQ(SeenMonitor(monitor, {0, 3, 0}).solid_angle(), 0);
}

TEST(Study, AReferenceStatesItsErrorWithoutBias_M58) {
    const Stage stage = half_plane();
    const RayScene rays(stage.scene);
    const StudiedMonitor light(stage.scene, rays, 0);
    double squares = 0, stated = 0;
    int penumbra = 0;
    for (size_t i = 0; i < stage.texels.texels.size(); ++i) {
        const Texel& texel = stage.texels.texels[i];
        const double exact = stage.exact(texel);
        const TexelSurface surface(stage.scene, stage.atlas, stage.texels, texel);
        const Reference reference = reference_visibility({light, surface, hash(3, i)}, 256);
        EXPECT_TRUE(reference.is_lit);
        if (exact < 0.05 || exact > 0.95) continue;
        squares += std::pow(reference.visibility - exact, 2);
        stated += std::pow(reference.error, 2);
        ++penumbra;
    }
    ASSERT_GT(penumbra, 150);
    // The ratio of two estimates of a variance, of n and 3 n degrees of freedom: a relative deviation of sqrt(2/n +
    // 2/3n), four of which are allowed; stated^2 is some 1e-4, so midpoints do not matter.
    const double tolerance = 4 * std::sqrt((2 + 2 / 3.0) / penumbra);
    EXPECT_NEAR(squares / stated, 1, tolerance);
}

TEST(Study, ErrorsAreFreeOfTheReferencesOwn_M58) {
    std::vector<double> values;
    std::vector<Reference> references;
    constexpr double own = 0.01, wrong = 0.003;
    for (uint64_t i = 0; i < 100000; ++i) {  // errors of +-0.01 in the reference, +-0.003 in the value
        values.push_back(0.5 + (hash(1, i) & 1u ? wrong : -wrong));
        references.push_back({0.5 + (hash(2, i) & 1u ? own : -own), own, true});
    }
    Measurement m;
    set_errors(m, values, references);
    EXPECT_NEAR(m.rmse, wrong, 0.1 * wrong);
    EXPECT_NEAR(m.largest, own + wrong, 1e-9);
    EXPECT_EQ(m.p999, 0);  // nothing beyond what three standard errors explain
    EXPECT_NEAR(reference_error(references), own, 1e-12);

    EXPECT_EQ(allowed_outliers(499), 0u);
    EXPECT_EQ(allowed_outliers(500), 1u);
    EXPECT_EQ(allowed_outliers(100000), 100u);
    for (size_t i = 0; i < 100; ++i) values[i] += 0.5;
    set_errors(m, values, references);
    EXPECT_EQ(m.p999, 0);
    values[100] += 0.5;
    set_errors(m, values, references);
    EXPECT_GT(m.p999, 0.4);
    for (size_t i = 0; i <= 100; ++i) values[i] -= 0.5;

    for (Reference& reference : references) reference.error = 0;
    set_errors(m, values, references);
    EXPECT_NEAR(m.rmse, std::hypot(own, wrong), 1e-4);
    EXPECT_NEAR(m.p999, own + wrong, 1e-9);
}

}  // namespace
}  // namespace surimi
