// SPDX-License-Identifier: Apache-2.0
#include "baker/write/manifest.h"

#include <gtest/gtest.h>

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

TEST(Manifest, NodesWithoutChartsHaveAnEmptyRectangle) {
    SmallBake small;
    small.bake.atlas.surfaces[0] = {};
    EXPECT_EQ(Json::parse(small.text())["nodes"][0]["st"], Json({0, 0, 0, 0}));
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
    EXPECT_EQ(json["texels"]["G"], Json({{"covered", 2}, {"unlit", 1}, {"filled", 1}, {"empty", 0}}));
    EXPECT_EQ(json["error"]["G"], Json({{"mean", 0.375}, {"max", 0.5}}));
}

TEST(Manifest, OnlyTheLastMemberVariesFromRunToRun) {
    SmallBake small;
    const std::string first = small.text();
    small.bake.costs[0].seconds = 99;
    small.bake.costs[1].peak_bytes = 99;
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
