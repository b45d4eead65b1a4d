// SPDX-License-Identifier: Apache-2.0
#include "baker/write/manifest.h"

#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

namespace surimi {
namespace {

using Json = nlohmann::json;

/// A floor and a monitor on channel G; a map of 2 x 2 texels, each in another state.
struct SmallBake {
    Scene scene;
    Bake bake;
    std::vector<ManifestFile> files{{"visibility", "room.visibility.exr", 12, "fnv1a64:0000000000000001"},
                                    {"bakedGlb", "room.baked.glb", 34, "fnv1a64:0000000000000002"}};

    SmallBake() {
        scene.path = "folder/room.glb";
        scene.nodes.resize(2);
        scene.nodes[0].name = "Floor";
        scene.nodes[1].name = "Screen";
        Surface floor;
        floor.name = "Floor";
        scene.surfaces.push_back(floor);
        Monitor monitor;
        monitor.name = "Screen";
        monitor.node = 1;
        monitor.channel = 1;
        monitor.radiance = Vec3(1, 2, 3);
        monitor.reason = "node name Screen";
        monitor.panels = {Polygon{{Vec3(0), Vec3(2, 0, 0), Vec3(2, 3, 0), Vec3(0, 3, 0)}}};
        scene.monitors.push_back(monitor);
        scene.notes.push_back({"zero-area triangles dropped", 3, "Floor"});

        bake.atlas.width = bake.atlas.height = 2;
        bake.atlas.texels_per_metre = 8;
        bake.atlas.surfaces = {{{{Vec2f(0.25f, 0.5f), Vec2f(0.75f, 0.5f), Vec2f(0.25f, 0.625f)}}, {0}}};
        bake.atlas.weights = {{0, DensityCause::far, 3, 8, 0.5, 0.25, 0.125, 0.75}};
        BakedPage& page = bake.pages.emplace_back();
        page.state[1] = Image<TexelState>(2, 2, TexelState::covered);
        page.state[1].pixels[2] = TexelState::unlit;
        page.state[1].pixels[3] = TexelState::filled;
        page.irradiance[1] = Image<IrradianceEstimate>(2, 2);
        page.irradiance[1].pixels[0].error = 0.25f;
        page.irradiance[1].pixels[1].error = 0.5f;
        page.irradiance[1].pixels[2].error = 9;  // not a measured texel
        GatherStatistics& statistics = bake.evidence.emplace_back().statistics;
        statistics.methods[static_cast<size_t>(TexelMethod::none)] = {1, 0, 0, 0};
        statistics.methods[static_cast<size_t>(TexelMethod::split)] = {1, 4, 9, 0.5};
        statistics.methods[static_cast<size_t>(TexelMethod::monte_carlo)] = {1, 2, 68, 1.5};
        statistics.blocks = 5;
        statistics.shadowed_blocks = 1;
        statistics.candidates = 10;
        statistics.segments = 6;
        statistics.query_seconds = 0.25;
        statistics.error_histogram = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0};
        statistics.above_error = 1;
        bake.error = 0.3;
        bake.costs = {{"unwrap", 0.5, 0, 1000}, {"light from Screen", 2, 77, 2000}};
        bake.warnings = {"Screen faces a wall"};
    }
    std::string text() const {
        return make_manifest(scene, bake, R"({"samples":64})", "fnv1a64:00000000000000ff", files);
    }
};

TEST(Manifest, TellsWhatWasMadeFromWhat) {
    const Json json = Json::parse(SmallBake().text());
    EXPECT_EQ(json["version"], 1);
    EXPECT_EQ(json["scene"], Json({{"file", "room.glb"}, {"hash", "fnv1a64:00000000000000ff"}}));
    EXPECT_EQ(json["settings"]["samples"], 64);
    EXPECT_EQ(json["map"]["files"], Json({"room.visibility.exr"}));
    EXPECT_EQ(json["map"]["width"], 2);
    EXPECT_EQ(json["map"]["origin"], "top-left");
    EXPECT_EQ(json["map"]["texelsPerMetre"], 8);
    EXPECT_EQ(json["densityWeights"], Json({{{"surface", "Floor"},
                                             {"cause", "far"},
                                             {"charts", 3},
                                             {"areaSquareMetres", 8.0},
                                             {"shareOfSurface", 0.5},
                                             {"shareOfTexels", 0.25},
                                             {"factor", {0.125, 0.75}}}}));
    EXPECT_EQ(json["warnings"], Json({"Screen faces a wall"}));
    EXPECT_EQ(json["notes"][0]["count"], 3);
    EXPECT_EQ(json["outputs"][1]["file"], "room.baked.glb");
}

TEST(Manifest, RectangleOfANodeEnclosesItsCharts) {
    const Json json = Json::parse(SmallBake().text());
    ASSERT_EQ(json["nodes"].size(), 1);
    EXPECT_EQ(json["nodes"][0]["name"], "Floor");
    EXPECT_EQ(json["nodes"][0]["st"], Json({0.5, 0.125, 0.25, 0.5}));
}

TEST(Manifest, NodesWithoutChartsAreNotListed) {
    SmallBake small;
    small.bake.atlas.surfaces[0] = {};
    EXPECT_EQ(Json::parse(small.text())["nodes"], Json::array());
}

TEST(Manifest, MonitorsAreInWorldSpace) {
    const Json monitor = Json::parse(SmallBake().text())["monitors"][0];
    EXPECT_EQ(monitor["channel"], "G");
    EXPECT_EQ(monitor["corners"][0][2], Json({2.0, 3.0, 0.0}));
    EXPECT_EQ(monitor["areaSquareMetres"], 6);
    EXPECT_EQ(monitor["radiance"], Json({1.0, 2.0, 3.0}));
}

TEST(Manifest, ErrorAndStatesAreOfTheMeasuredTexels) {
    const Json json = Json::parse(SmallBake().text());
    EXPECT_EQ(json["texels"]["G"], Json({{"covered", 2}, {"unlit", 1}, {"inside", 0}, {"filled", 1}, {"empty", 0}}));
    EXPECT_EQ(json["error"]["G"]["mean"], 0.375);
    EXPECT_DOUBLE_EQ(json["error"]["G"]["rms"], std::sqrt((0.0625 + 0.25) / 2));
    EXPECT_EQ(json["error"]["G"]["max"], 0.5);
}

TEST(Manifest, EvidenceCountsWhatWasDone) {
    const Json evidence = Json::parse(SmallBake().text())["evidence"]["G"];
    EXPECT_EQ(evidence["methods"]["none"], Json({{"texels", 1}, {"points", 0}, {"rays", 0}}));
    EXPECT_EQ(evidence["methods"]["split"], Json({{"texels", 1}, {"points", 4}, {"rays", 9}}));
    EXPECT_EQ(evidence["methods"]["monteCarlo"]["rays"], 68);
    EXPECT_EQ(evidence["methods"].size(), texel_method_count);
    EXPECT_EQ(evidence["candidatesPerBlock"], 2.5) << "of the blocks that no facet hides";
    EXPECT_EQ(evidence["segmentsPerPoint"], 1.5) << "of the points that split or scan";
    EXPECT_FALSE(evidence.contains("audit")) << "none was asked for";
}

TEST(Manifest, AFitStandsInItWhereOneWasMade) {
    SmallBake small;
    EXPECT_FALSE(Json::parse(small.text())["evidence"]["G"].contains("fit"));
    small.bake.evidence[0].fit = {
        .texels = 7, .largest_move = 0.25, .rms_before = 0.5, .rms_after = 0.125, .rounds = 30, .area = 9};
    EXPECT_EQ(
        Json::parse(small.text())["evidence"]["G"]["fit"],
        Json::parse(R"({"texelsMoved": 7, "largestMove": 0.25, "rmsBefore": 0.5, "rmsAfter": 0.125, "rounds": 30})"));
}

TEST(Manifest, HistogramNamesTheUpperEndsOfItsBins) {
    const Json histogram = Json::parse(SmallBake().text())["evidence"]["G"]["errorHistogram"];
    ASSERT_EQ(histogram["below"].size(), GatherStatistics::bins);
    ASSERT_EQ(histogram["texels"].size(), GatherStatistics::bins);
    EXPECT_EQ(histogram["below"][0], 0);
    EXPECT_EQ(histogram["below"][1], 0x1p-14);
    EXPECT_EQ(histogram["below"][15], 1);
    EXPECT_EQ(histogram["texels"][0], 1) << "exact";
    EXPECT_EQ(histogram["texels"][14], 1) << "below 0.5";
}

TEST(Manifest, ABrokenPromiseStandsInIt) {
    SmallBake small;
    const Json broken = Json::parse(small.text())["evidence"]["G"]["promise"];
    EXPECT_EQ(broken["error"], 0.3);
    EXPECT_EQ(broken["shareAbove"], 0.5);
    EXPECT_EQ(broken["kept"], false);
    EXPECT_EQ(broken["breaches"].size(), 1);
    small.bake.evidence[0].statistics.above_error = 0;
    const Json kept = Json::parse(small.text())["evidence"]["G"]["promise"];
    EXPECT_EQ(kept["kept"], true);
    EXPECT_EQ(kept["breaches"], Json::array());
}

TEST(Manifest, AuditsOfPagesAreGivenTogetherAndApart) {
    SmallBake small;
    small.bake.evidence[0].audits = {{40, 0.25, 0.125, 0.5, 0.01, 0.75, 3, 0.2}};
    const Json one = Json::parse(small.text())["evidence"]["G"]["audit"];
    EXPECT_EQ(one["texels"], 40);
    EXPECT_EQ(one["rmse"], 0.25);
    EXPECT_EQ(one["rmseInterval"], Json({0.125, 0.5}));
    EXPECT_EQ(one["beyond"], 3);
    EXPECT_EQ(one["shareBeyondAtMost"], 0.2);
    EXPECT_EQ(one["largest"], 0.75);
    EXPECT_EQ(one["referenceError"], 0.01);
    EXPECT_FALSE(one.contains("pages"));
    small.bake.evidence[0].audits.push_back({60, 0.1, 0.1, 0.1, 0.01, 0.2, 1, 0.1});
    const Json two = Json::parse(small.text())["evidence"]["G"]["audit"];
    EXPECT_EQ(two["texels"], 100);
    EXPECT_EQ(two["beyond"], 4);
    ASSERT_EQ(two["pages"].size(), 2);
    EXPECT_EQ(two["pages"][1]["page"], 1);
    EXPECT_EQ(two["pages"][1]["texels"], 60);
}

TEST(Manifest, SecondsOfMethodsAreOfTheRun) {
    const Json run = Json::parse(SmallBake().text())["run"]["monitors"]["G"];
    EXPECT_EQ(run["querySeconds"], 0.25);
    EXPECT_EQ(run["methods"]["split"], Json({{"seconds", 0.5}, {"microsecondsPerPoint", 125000.0}}));
    EXPECT_FALSE(run["methods"].contains("scanline")) << "no point was scanned";
}

TEST(Manifest, OnlyTheLastMemberVariesFromRunToRun) {
    SmallBake small;
    const std::string first = small.text();
    small.bake.costs[0].seconds = 99;
    small.bake.costs[1].peak_bytes = 99;
    small.bake.evidence[0].statistics.query_seconds = 99;
    small.bake.evidence[0].statistics.methods[3].seconds = 99;
    const std::string second = small.text();
    EXPECT_NE(first, second);
    const size_t run = first.find("\"run\"");
    ASSERT_NE(run, std::string::npos);
    EXPECT_EQ(first.substr(0, run), second.substr(0, run));
    EXPECT_EQ(nlohmann::ordered_json::parse(first).back()["stages"].size(), 2);
}

TEST(Manifest, HashIsFowlerNollVo) {
    // From the authors' list of test vectors.
    EXPECT_EQ(content_hash({}), "fnv1a64:cbf29ce484222325");
    const std::string text = "foobar";
    EXPECT_EQ(content_hash({reinterpret_cast<const uint8_t*>(text.data()), text.size()}), "fnv1a64:85944171f73967e8");
}

}  // namespace
}  // namespace surimi
