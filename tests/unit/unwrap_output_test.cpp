// SPDX-License-Identifier: Apache-2.0
#include "baker/write/unwrap_output.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "baker/write/unwrap_pictures.h"
#include "runtime/base/error.h"
#include "runtime/compare/compare.h"
#include "tests/unit/square_glb.h"
#include "tests/unit/uv_scenes.h"

namespace surimi::test {
namespace {

using Color = glm::u8vec3;

/// Colour of the pixel over a place in texels.
Color at(const Picture8& picture, double x, double y) {
    const double scale = static_cast<double>(picture.width) / uv_map;
    return picture.at(static_cast<int>(x * scale), static_cast<int>(y * scale));
}

Color heat(double value, double low, double high) {
    return heat_map(Image<float>(1, 1, static_cast<float>(value)), low, high).pixels[0];
}

TEST(UnwrapPictures, ChartsThatMeetHaveDifferentColours) {
    Scene scene;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            scene.surfaces.push_back(uv_quad("quad", unit_square(2.0 * static_cast<double>(scene.surfaces.size())),
                                             {8.0 * x + 1, 8.0 * y + 1, 8.0 * x + 7, 8.0 * y + 7}));
    const Picture8 picture = draw_charts(scene, atlas_of(scene), 0);
    std::set<std::array<int, 3>> colors;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const Color here = at(picture, 8 * x + 4.3, 8 * y + 4.3);
            colors.insert({here.x, here.y, here.z});
            for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
                if (x + dx == 8 || y + dy == 8) continue;
                EXPECT_NE(here, at(picture, 8 * (x + dx) + 4.3, 8 * (y + dy) + 4.3)) << x << " " << y;
            }
        }
    EXPECT_LE(colors.size(), 14u);
    EXPECT_EQ(at(picture, 0.5, 0.5), at(picture, 8.0, 8.0));  // gutters
}

TEST(UnwrapPictures, SeamsThatShowAreWhite) {
    Scene scene = two_quads(4);
    const Picture8 apart = draw_charts(scene, atlas_of(scene), 0);
    EXPECT_EQ(at(apart, 24.001, 16), Color(0, 0, 0));
    for (Vec3& p : scene.surfaces[1].positions) p.x -= 4;  // now side by side in space
    const Picture8 beside = draw_charts(scene, atlas_of(scene), 0);
    EXPECT_EQ(at(beside, 24.001, 16), Color(255, 255, 255));
    EXPECT_EQ(at(beside, 28.001, 16), Color(255, 255, 255));
    EXPECT_EQ(at(beside, 8.001, 16), Color(0, 0, 0));
}

TEST(UnwrapPictures, HeatMapsHoldDensityAndStretch) {
    Scene scene;
    scene.surfaces.push_back(uv_quad("even", unit_square(0), {8, 8, 24, 24}));
    scene.surfaces.push_back(uv_quad("squashed", unit_square(5), {30, 8, 62, 16}));
    const Atlas atlas = atlas_of(scene);  // charts of 16 texels a metre
    const Picture8 density = draw_density(scene, atlas, 0, 20);
    EXPECT_EQ(at(density, 16, 12), heat(16, 0, 20));
    EXPECT_EQ(at(density, 40, 12), heat(8, 0, 20));
    const Picture8 stretch = draw_stretch(scene, atlas, 0, 3);
    EXPECT_EQ(at(stretch, 16, 12), heat(1, 1, 3));
    EXPECT_EQ(at(stretch, 40, 12), heat(2, 1, 3));
    EXPECT_EQ(at(stretch, 4, 60), at(density, 4, 60));
    EXPECT_NE(at(stretch, 4, 60), heat(1, 1, 3));
}

TEST(UnwrapPictures, FaultsStandOut) {
    UnwrapSettings settings;
    settings.uv = UvSource::existing;
    settings.width = settings.height = uv_map;
    const Picture8 shared = draw_faults(judge_existing(two_quads(1), settings));
    EXPECT_EQ(at(shared, 24.5, 16.5), Color(255, 0, 0));
    EXPECT_NE(at(shared, 22.5, 16.5), Color(255, 0, 0));
    const Picture8 overlap = draw_faults(judge_existing(two_quads(-4), settings));
    EXPECT_EQ(at(overlap, 22.5, 16.5), Color(255, 0, 255));
    Scene scene = two_quads(2);
    for (Vec2& uv : scene.surfaces[1].uv_sets[1]) uv.x += 0.5;
    const Picture8 outside = draw_faults(judge_existing(scene, settings));
    const int side = overlap.width;
    ASSERT_EQ(outside.width, side * 3 / 2);
    EXPECT_EQ(outside.at(side / 4 + side * 59 / 64, side / 4 + side * 16 / 64), Color(255, 0, 255));
    EXPECT_EQ(outside.at(side / 4, side / 2), Color(255, 255, 255));  // the frame
}

/// A square read from a file, unwrapped.
struct UnwrappedSquare {
    std::filesystem::path folder;
    Scene scene;
    Unwrapped unwrapped;

    UnwrappedSquare() {
        Square square;
        folder = test_folder();
        scene = read_gltf(square.write(folder / "room.glb"));
        UnwrapSettings settings;
        settings.width = settings.height = uv_map;
        unwrapped.atlas = unwrap(scene, settings, {});
        unwrapped.numbers = measure(scene, unwrapped.atlas);
        unwrapped.settings_json = "{}";
    }
};

TEST(UnwrapOutput, WritesTheSceneThePicturesAndTheNumbers) {
    const UnwrappedSquare square;
    const UnwrapOutput output = write_unwrap(square.folder / "uv", square.scene, square.unwrapped, {});
    std::vector<std::string> names;
    for (const auto& path : output.paths) {
        names.push_back(path.filename().string());
        EXPECT_GT(std::filesystem::file_size(path), 0u) << path;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"room.unwrapped.glb", "room.charts.png", "room.density.png",
                                               "room.stretch.png", "room.unwrap.json"}));
    EXPECT_EQ(read_gltf(output.paths[0]).surfaces[0].uv_sets.size(), 2u);
    const auto report = nlohmann::json::parse(output.report);
    EXPECT_EQ(report["charts"]["count"], 1);
    EXPECT_EQ(report["map"]["uv"]["source"], "unwrap");
    EXPECT_EQ(report["outputs"].size(), 4u);
    EXPECT_EQ(report["outputs"][3]["scale"]["black"], 1.0);
    EXPECT_NEAR(report["quality"]["symmetricDirichlet"].get<double>(), 4, 1e-4);
}

TEST(UnwrapOutput, APageHasPicturesOfItsOwn) {
    UnwrappedSquare square;
    square.unwrapped.atlas.pages = 2;
    const UnwrapOutput output = write_unwrap(square.folder / "uv", square.scene, square.unwrapped, {});
    EXPECT_EQ(output.paths.size(), 8u);
    EXPECT_EQ(output.paths[4].filename(), "room.charts.1.png");
    EXPECT_EQ(nlohmann::json::parse(output.report)["outputs"][4]["page"], 1);
}

TEST(UnwrapOutput, WhatIsCancelledLeavesNothing) {
    const UnwrappedSquare square;
    Progress progress;
    progress.is_cancelled = [] { return true; };
    try {
        write_unwrap(square.folder / "uv", square.scene, square.unwrapped, progress);
        ADD_FAILURE() << "not cancelled";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::interrupted);
    }
    EXPECT_FALSE(std::filesystem::exists(square.folder / "uv"));
}

TEST(UnwrapOutput, TheInputIsNotOverwritten) {
    const UnwrappedSquare square;
    EXPECT_THROW(write_unwrapped_glb(square.scene.path, square.scene, square.unwrapped), Error);
    EXPECT_EQ(read_gltf(square.scene.path).surfaces[0].uv_sets.size(), 0u);
}

}  // namespace
}  // namespace surimi::test
