// SPDX-License-Identifier: Apache-2.0
// Plans of rooms in which the answer is known, and the choice of an error for a time.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "baker/cli/plan_report.h"
#include "baker/cli/time_budget.h"
#include "baker/plan.h"
#include "runtime/base/error.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

BakeSettings small_settings() {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = 64;
    settings.gather.error = 0.02;
    return settings;
}

/// A floor of 4 m under a monitor at the ceiling that shines down.
Scene floor_and_monitor() {
    Scene scene;
    scene.path = "room.glb";
    test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    test::add_monitor(scene, "Monitor_R", 0, {0, 2.5, 0}, {0.8, 0, 0}, {0, 0, 0.45});
    return scene;
}

void add_sheet(Scene& scene, const std::string& name, double height, double half) {
    test::add_quad(scene, name, {-half, height, half}, {half, height, half}, {half, height, -half},
                   {-half, height, -half});
}

const PlannedStage& stage(const Plan& plan, const std::string& name) {
    const auto found = std::ranges::find(plan.stages, name, &PlannedStage::stage);
    if (found == plan.stages.end()) throw std::runtime_error("no stage " + name);
    return *found;
}

TEST(Plan, EmptyRoomIsOpenAndNeedsNoSilhouettes) {
    const Scene scene = floor_and_monitor();
    const Plan result = plan(scene, small_settings(), {});
    const Reach& floor = result.monitors[0].reach[0];
    EXPECT_NEAR(floor.facing, 1, 1e-9);
    EXPECT_NEAR(floor.nearest, 2.5, 1e-6);
    EXPECT_NEAR(floor.farthest, std::sqrt(2.5 * 2.5 + 8), 1e-6);
    EXPECT_GT(floor.blocks.seen, 3u);
    EXPECT_EQ(floor.blocks.open, floor.blocks.seen);
    EXPECT_NE(stage(result, "light from Monitor_R").why.find("never blocked"), std::string::npos);
    for (const char* off : {"exact splitting", "scanlines", "Monte Carlo", "alpha filter", "audit of Monitor_R"})
        EXPECT_FALSE(stage(result, off).runs) << off;
}

TEST(Plan, WallBetweenHidesEveryBlock) {
    Scene scene = floor_and_monitor();
    add_sheet(scene, "Wall", 1, 50);
    const Plan result = plan(scene, small_settings(), {});
    const BlockCounts& floor = result.monitors[0].reach[0].blocks;
    EXPECT_GT(floor.seen, 3u);
    EXPECT_EQ(floor.hidden, floor.seen);
    EXPECT_NEAR(result.monitors[0].reach[0].facing, 1, 1e-9) << "it faces the monitor, if in vain";
    EXPECT_NE(stage(result, "light from Monitor_R").why.find("hidden by one facet"), std::string::npos);
}

TEST(Plan, SheetBetweenCallsForSilhouettes) {
    Scene scene = floor_and_monitor();
    add_sheet(scene, "Table", 1, 0.5);
    const Plan result = plan(scene, small_settings(), {});
    EXPECT_GT(result.monitors[0].reach[0].blocks.silhouettes, 0u);
    EXPECT_EQ(result.monitors[0].reach[0].blocks.cutouts, 0u);
    EXPECT_TRUE(stage(result, "exact splitting").runs || stage(result, "scanlines").runs);
}

TEST(Plan, CutoutsLeaveOnlyRays) {
    Scene scene = floor_and_monitor();
    add_sheet(scene, "Leaf", 1, 50);
    scene.materials.emplace_back().alpha_mode = AlphaMode::mask;
    scene.surfaces.back().material = 0;
    const Plan result = plan(scene, small_settings(), {});
    const BlockCounts& floor = result.monitors[0].reach[0].blocks;
    EXPECT_GT(floor.seen, 3u);
    EXPECT_EQ(floor.cutouts, floor.seen);
    EXPECT_TRUE(stage(result, "alpha filter").runs);
    EXPECT_TRUE(stage(result, "Monte Carlo").runs);
    EXPECT_NE(stage(result, "Monte Carlo").why.find("cutouts"), std::string::npos);
}

TEST(Plan, SurfacesThatFaceAwayAreUnlitAndTheirMonitorIsNotTraced) {
    Scene scene;
    scene.path = "room.glb";
    test::add_quad(scene, "Roof", {-2, 3, 2}, {2, 3, 2}, {2, 3, -2}, {-2, 3, -2});
    test::add_monitor(scene, "Monitor_R", 0, {0, 2.5, 0}, {0.8, 0, 0}, {0, 0, 0.45});
    const Plan result = plan(scene, small_settings(), {});
    const Reach& roof = result.monitors[0].reach[0];
    EXPECT_EQ(roof.facing, 0);
    EXPECT_EQ(roof.nearest, 0);
    EXPECT_GT(roof.blocks.seen, 0u);
    EXPECT_EQ(roof.blocks.unlit, roof.blocks.seen);
    EXPECT_FALSE(stage(result, "light from Monitor_R").runs);
    EXPECT_EQ(result.monitors[0].calibration.lit, 0);
    EXPECT_LT(result.rays(), 64) << "no more than a question for each block of the monitor's own surface";
}

TEST(Plan, FitRunsWhereItIsAskedForAsInTheBake) {
    Scene scene = floor_and_monitor();
    add_sheet(scene, "Table", 1, 0.5);
    BakeSettings settings = small_settings();
    const Plan without = plan(scene, settings, {});
    EXPECT_FALSE(stage(without, "fit Monitor_R").runs);
    EXPECT_NE(stage(without, "fit Monitor_R").why.find("--fit bilinear"), std::string::npos);
    settings.post.fit = Fit::bilinear;
    const Plan with = plan(scene, settings, {});
    EXPECT_TRUE(stage(with, "fit Monitor_R").runs);
    EXPECT_GT(stage(with, "fit Monitor_R").seconds, 0);
    const Bake baked = bake(scene, settings, {});
    EXPECT_GT(seconds_of(baked.costs, "fit Monitor_R"), 0);
    EXPECT_GT(baked.evidence[0].fit.texels, 0u);
}

TEST(Plan, FacingIsTheShareOfTheAreaInFront) {
    Scene scene;
    scene.path = "room.glb";
    // A wall of 4 x 4 m; the monitor shines along it from a quarter of its width on.
    test::add_quad(scene, "Wall", {-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
    test::add_monitor(scene, "Monitor_R", 0, {-1, 0, 1}, {0, 0.5, 0}, {0, 0, 0.5});
    const Plan result = plan(scene, small_settings(), {});
    EXPECT_NEAR(result.monitors[0].reach[0].facing, 0.75, 1e-6);
}

TEST(Plan, RaysOfAWholeSampleAreThoseOfTheBake) {
    Scene scene = floor_and_monitor();
    add_sheet(scene, "Table", 1, 0.5);
    const BakeSettings settings = small_settings();  // so few patches that all are in the sample
    const Plan result = plan(scene, settings, {});
    const Bake truth = bake(scene, settings, {});
    EXPECT_EQ(result.monitors[0].calibration.sampled, result.texels);
    EXPECT_DOUBLE_EQ(result.rays(), static_cast<double>(truth.evidence[0].statistics.rays()));
}

TEST(Plan, SampleIsSpreadEvenlyAndKeepsTriangles) {
    Scene scene;
    const uint32_t floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    const Texels texels = find_texels(scene, test::whole_map_atlas(scene, floor, 1024));
    const Texels sample = sample_patches(texels, 1);
    ASSERT_EQ(sample.texels.size(), size_t{4096 / 40} * 256);
    std::array<size_t, 4> of_quarter{};
    uint32_t last = 0;
    for (const Texel& texel : sample.texels) {
        ASSERT_GE(texel.index, last);
        last = texel.index;
        ++of_quarter[texel.index % 1024 / 512 + 2 * (texel.index / 1024 / 512)];
        const auto same = std::ranges::lower_bound(texels.texels, texel.index, {}, &Texel::index);
        ASSERT_EQ(sample.triangles_of(texel).size(), texels.triangles_of(*same).size());
        ASSERT_EQ(sample.triangles_of(texel)[0].triangle, texels.triangles_of(*same)[0].triangle);
    }
    for (const size_t count : of_quarter) EXPECT_NEAR(static_cast<double>(count), 102 * 64, 256) << "one patch";
    EXPECT_NE(sample_patches(texels, 2).texels[0].index, sample.texels[0].index) << "the seed counts";
}

/// What must not differ from run to run.
nlohmann::json without_run(const Scene& scene, const Plan& plan) {
    nlohmann::json json = nlohmann::json::parse(plan_json(scene, plan, "{}", nullptr));
    EXPECT_EQ(json.erase("run"), 1u);
    return json;
}

TEST(Plan, AllButTheRunIsTheSameWhateverTheThreads) {
    Scene scene = floor_and_monitor();
    add_sheet(scene, "Table", 1, 0.5);
    set_thread_count(1);
    const nlohmann::json one = without_run(scene, plan(scene, small_settings(), {}));
    set_thread_count(3);
    const nlohmann::json three = without_run(scene, plan(scene, small_settings(), {}));
    set_thread_count(0);
    EXPECT_EQ(one, three);
    EXPECT_EQ(one["monitors"][0]["reach"].size(), scene.surfaces.size());
    EXPECT_GT(one["rays"].get<double>(), 0);
}

TEST(Plan, ComparisonPutsStagesOfTheSameNameSideBySide) {
    Plan plan;
    plan.stages = {{"unwrap", true, "", 2, 0, false},
                   {"scanlines", true, "", 0, 50, true},
                   {"light from A", true, "", 6, 100, false}};
    plan.memory.peak = 300;
    const BakeTruth truth{{{"unwrap", 1}, {"light from A", 12}, {"polish", 3}}, 80, 200, "{}"};
    const Comparison comparison = compare(plan, truth);
    ASSERT_EQ(comparison.stages.size(), 2u);
    EXPECT_EQ(comparison.stages[0].ratio(), 2);
    EXPECT_EQ(comparison.stages[1].ratio(), 0.5);
    EXPECT_EQ(comparison.seconds.ratio(), 0.5) << "8 s against 16 s: what only the bake has counts";
    EXPECT_EQ(comparison.rays.ratio(), 1.25) << "parts are not counted twice";
    EXPECT_EQ(comparison.peak.ratio(), 1.5);
}

TEST(Plan, WhatIsNoManifestIsTheUsersError) {
    const auto path = std::filesystem::temp_directory_path() / "surimi_plan_test.json";
    for (const char* text : {"", "[]", "{\"settings\": {}}", "{\"settings\": {}, \"rays\": {}, \"run\": {}}"}) {
        std::ofstream(path) << text;
        try {
            read_truth(path);
            ADD_FAILURE() << "nothing was thrown for " << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::scene);
        }
    }
    std::filesystem::remove(path);
    EXPECT_THROW(read_truth(path), Error);
}

/// A machine on which the seconds are the inverse of the error to this power.
std::function<double(double)> machine(double scale, double power) {
    return [=](double error) { return scale * std::pow(error, -power); };
}

TEST(TimeBudget, ErrorIsTheOneWhoseSecondsAreAsked) {
    const auto seconds_at = machine(0.1, 0.7);
    for (const double seconds : {1.0, 3.0, 10.0, 19.0}) {
        const ErrorChoice choice = choose_error(measure_costs(seconds_at, seconds), seconds);
        EXPECT_TRUE(choice.fits);
        const double exact = std::pow(0.1 / seconds, 1 / 0.7);
        EXPECT_GE(choice.chosen.error, exact * (1 - 1e-9));
        EXPECT_LE(choice.chosen.error, exact * 1.11) << "two digits";
        EXPECT_LE(choice.chosen.seconds, seconds);
        EXPECT_NEAR(choice.chosen.seconds, seconds_at(choice.chosen.error), 1e-9 * seconds);
    }
}

TEST(TimeBudget, LessTimeIsALooserError) {
    const auto seconds_at = machine(0.2, 0.6);
    double last = 0;
    for (const double seconds : {15.0, 10.0, 5.0, 2.0, 1.3}) {
        const double error = choose_error(measure_costs(seconds_at, seconds), seconds).chosen.error;
        EXPECT_GT(error, last) << seconds;
        last = error;
    }
}

TEST(TimeBudget, LimitsHold) {
    const ErrorChoice rich = choose_error(measure_costs(machine(0.1, 0.7), 1e6), 1e6);
    EXPECT_TRUE(rich.fits);
    EXPECT_EQ(rich.chosen.error, tightest_error);
    const ErrorChoice poor = choose_error(measure_costs(machine(0.1, 0.7), 0.1), 0.1);
    EXPECT_FALSE(poor.fits);
    EXPECT_EQ(poor.chosen.error, loosest_error);
    EXPECT_FALSE(choose_error(measure_costs(machine(0.1, 0.7), -3), -3).fits) << "the rest takes more already";
}

TEST(TimeBudget, NothingTighterThanNeededIsMeasured) {
    EXPECT_EQ(measure_costs(machine(0.1, 0.7), 0.1).size(), 1u);
    EXPECT_EQ(measure_costs(machine(0.1, 0.7), 1e6).size(), 5u);
}

TEST(TimeBudget, NoiseCannotMakeATighterErrorCheaper) {
    const std::vector<ErrorCost> costs{{0.05, 2}, {0.02, 1}, {0.004, 4}};
    const ErrorChoice choice = choose_error(costs, 3);
    EXPECT_LT(choice.chosen.error, 0.02);
    EXPECT_GT(choice.chosen.error, 0.004);
    EXPECT_FALSE(choose_error(costs, 1.5).fits);
    EXPECT_EQ(choose_error(std::vector<ErrorCost>{{0.05, 0}, {0.02, 0}}, 1).chosen.error, 0.02) << "nothing is lit";
}

}  // namespace
}  // namespace surimi
