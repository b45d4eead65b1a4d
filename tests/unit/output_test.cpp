// SPDX-License-Identifier: Apache-2.0
#include "baker/write/output.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "baker/write/lightmaps.h"
#include "baker/write/manifest.h"
#include "glb_builder.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"
#include "runtime/scene/gltf.h"
#include "tests/support/counted_memory.h"

namespace surimi::test {
namespace {

/// A triangle in front of a monitor, "baked" to a map of 4 x 4 texels with known values.
struct FinishedBake {
    std::filesystem::path folder = test_folder();
    std::filesystem::path out = folder / "out";
    Scene scene;
    Bake bake;

    FinishedBake() {
        GlbBuilder file;
        file.json["meshes"] = {
            {{"primitives", {{{"attributes", {{"POSITION", file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}}}}}}}};
        file.json["nodes"] = {{{"name", "Wall"}, {"mesh", 0}}};
        file.json["scenes"] = {{{"nodes", {0}}}};
        scene = read_gltf(file.write(folder / "room.glb"));
        Monitor monitor;
        monitor.name = "Screen";
        monitor.channel = 1;
        monitor.panels = {Polygon{{Vec3(0, 0, 3), Vec3(0, 1, 3), Vec3(1, 1, 3), Vec3(1, 0, 3)}}};
        scene.monitors.push_back(monitor);

        bake.atlas.width = bake.atlas.height = 4;
        bake.atlas.surfaces = {{{{Vec2f(0.1f, 0.1f), Vec2f(0.9f, 0.1f), Vec2f(0.1f, 0.9f)}}, {0}}};
        BakedPage& page = bake.pages.emplace_back();
        page.map.visibility = Image<Vec3f>(4, 4, Vec3f(1));
        page.map.monitors[1] = "Screen";
        page.state[1] = Image<TexelState>(4, 4, TexelState::covered);
        page.irradiance[1] = Image<IrradianceEstimate>(4, 4);
        for (size_t i = 0; i < 16; ++i) {
            page.map.visibility.pixels[i].y = static_cast<float>(i) / 15;
            page.irradiance[1].pixels[i] = {0.3f, 0.01f * static_cast<float>(i), 0.001f, TexelMethod::scanline};
        }
        bake.evidence.resize(1);
        bake.costs = {{"unwrap", 0.1, 0, 1}};
    }
    OutputPaths write() const { return write_bake(out, scene, bake, "{}"); }
    size_t file_count() const {
        if (!std::filesystem::exists(out)) return 0;
        return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(out), {}));
    }
};

std::vector<uint8_t> content(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The kind of the error that `action` throws.
template <class Action>
ErrorKind error_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.kind();
    }
    ADD_FAILURE() << "nothing was thrown";
    return ErrorKind::internal;
}

TEST(Output, NamesFollowTheScene) {
    const OutputPaths paths = output_paths("out", "scenes/my.room.gltf", 1);
    ASSERT_EQ(paths.pages.size(), 1u);
    EXPECT_EQ(paths.pages[0].visibility_exr, "out/my.room.visibility.exr");
    EXPECT_EQ(paths.pages[0].visibility_png, "out/my.room.visibility.png");
    EXPECT_EQ(paths.pages[0].lightmaps_exr, "out/my.room.lightmaps.exr");
    EXPECT_EQ(paths.baked_glb, "out/my.room.baked.glb");
    EXPECT_EQ(paths.manifest_json, "out/my.room.visibility.json");
}

TEST(Output, AllFilesAreThereAndNothingElse) {
    const FinishedBake finished;
    const OutputPaths paths = finished.write();
    EXPECT_EQ(finished.file_count(), 5u);
    const VisibilityMap map = read_map_exr(paths.pages[0].visibility_exr);
    EXPECT_EQ(map.visibility.pixels[0], Vec3f(1, 0, 1)) << "0 and 1 are exact";
    EXPECT_EQ(map.visibility.pixels[15], Vec3f(1, 1, 1));
    EXPECT_EQ(decode_image(content(paths.pages[0].visibility_png), "x.png").width, 4);
    EXPECT_EQ(triangle_count(read_gltf(paths.baked_glb)), 1u + 2u) << "the wall, and the monitor of the configuration";
    EXPECT_TRUE(Json::parse(content(paths.manifest_json)).contains("run"));
}

TEST(Output, EvidenceHasALayerForEachMonitor) {
    const FinishedBake finished;
    const Channels channels = read_channels(finished.write().pages[0].lightmaps_exr);
    ASSERT_EQ(channels.names.size(), 5u);
    const auto value = [&](const std::string& name, size_t texel) {
        const auto found = std::find(channels.names.begin(), channels.names.end(), name);
        EXPECT_NE(found, channels.names.end()) << name;
        return channels.values.at(texel * 5 + static_cast<size_t>(found - channels.names.begin()));
    };
    EXPECT_EQ(value("Screen.unshadowed", 5), 0.3f);
    EXPECT_EQ(value("Screen.shadowed", 5), 0.01f * 5);
    EXPECT_EQ(value("Screen.error", 5), 0.001f);
    EXPECT_EQ(value("Screen.method", 5), 4.0f) << "the number of TexelMethod::scanline";
    EXPECT_EQ(value("Screen.state", 5), 1.0f);
}

TEST(Output, MonitorsOfOneNameHaveLayersOfTheirOwn) {
    FinishedBake finished;
    finished.scene.monitors.push_back(finished.scene.monitors[0]);
    finished.scene.monitors[1].channel = 2;
    finished.bake.pages[0].state[2] = finished.bake.pages[0].state[1];
    finished.bake.pages[0].irradiance[2] = finished.bake.pages[0].irradiance[1];
    const ChannelLayout layout = lightmap_layout(finished.scene, finished.bake.pages[0]);
    EXPECT_EQ(layout.names[0], "Screen_G.shadowed");
    EXPECT_EQ(layout.names[5], "Screen_B.shadowed");
}

/// The most that is held beside a bake of this size while its files are written.
double bytes_to_write(int side) {
    FinishedBake finished;
    BakedPage& page = finished.bake.pages[0];
    finished.bake.atlas.width = finished.bake.atlas.height = side;
    page.map.visibility = Image<Vec3f>(side, side, Vec3f(1));
    page.state[1] = Image<TexelState>(side, side, TexelState::covered);
    page.irradiance[1] = Image<IrradianceEstimate>(side, side);
    restart_count();
    finished.write();
    return static_cast<double>(most_counted_bytes());
}

TEST(Output, NoSecondCopyOfTheEvidenceIsMade) {
    constexpr double decoded = 4 + 3;         // bytes of a texel: the picture in the baked glb is read back
    constexpr double rows = 64 * 20 * 4;      // of the evidence, as read, as written, and twice in the library
    const double small = bytes_to_write(64);  // what the libraries hold whatever the size
    EXPECT_LT(bytes_to_write(1024) - small, 1024 * (1024 * decoded + rows)) << "the evidence has 20 bytes a texel";
}

TEST(Output, ManifestHashesWhatIsOnTheDisk) {
    const FinishedBake finished;
    const OutputPaths paths = finished.write();
    const Json manifest = Json::parse(content(paths.manifest_json));
    ASSERT_EQ(manifest["outputs"].size(), 4);
    for (const Json& file : manifest["outputs"])
        EXPECT_EQ(file["hash"], content_hash(content(finished.out / file["file"].get<std::string>())));
    EXPECT_EQ(manifest["scene"]["hash"], content_hash(content(finished.scene.path)));
}

TEST(Output, SameBakeSameBytes) {
    const FinishedBake finished;
    const OutputPaths paths = finished.write();
    const std::vector<std::filesystem::path> all = paths.all();
    ASSERT_EQ(all.size(), 5u);
    std::vector<std::vector<uint8_t>> first;
    for (const auto& path : all) first.push_back(content(path));
    // Libraries like to write the time into files; it has to differ for that to show.
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    finished.write();
    for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(content(all[i]), first[i]) << all[i];
}

TEST(Output, NeverOverwritesTheInput) {
    FinishedBake finished;
    std::filesystem::create_directories(finished.out);
    std::filesystem::create_hard_link(finished.scene.path, finished.out / "room.baked.glb");
    const auto before = content(finished.scene.path);
    EXPECT_EQ(error_of([&] { finished.write(); }), ErrorKind::cannot_write);
    EXPECT_EQ(content(finished.scene.path), before);
    EXPECT_EQ(finished.file_count(), 1u);
}

TEST(Output, AFolderInTheWayStopsBeforeAnythingIsWritten) {
    const FinishedBake finished;
    std::filesystem::create_directories(finished.out / "room.visibility.json");
    EXPECT_EQ(error_of([&] { finished.write(); }), ErrorKind::cannot_write);
    EXPECT_EQ(finished.file_count(), 1u);
}

TEST(Output, AFileWhereTheFolderShouldBeIsAnError) {
    const FinishedBake finished;
    std::ofstream(finished.out) << "in the way";
    EXPECT_EQ(error_of([&] { finished.write(); }), ErrorKind::cannot_write);
}

TEST(Output, AFailureHalfwayLeavesTheOldFilesAndNoTemporaries) {
    FinishedBake finished;
    const OutputPaths paths = finished.write();
    const auto before = content(paths.pages[0].visibility_exr);
    finished.bake.pages[0].map.visibility.pixels[3] = Vec3f(0.5f);
    std::filesystem::remove(finished.scene.path);  // the glb cannot be made any more
    EXPECT_EQ(error_of([&] { finished.write(); }), ErrorKind::scene);
    EXPECT_EQ(content(paths.pages[0].visibility_exr), before);
    EXPECT_EQ(finished.file_count(), 5u);
}

TEST(Output, ValuesThatTheFileCannotHoldAreFound) {
    FinishedBake finished;
    finished.bake.pages[0].map.visibility.pixels[3].x = NAN;
    EXPECT_THROW(finished.write(), Error);
    EXPECT_EQ(finished.file_count(), 0u);
}

}  // namespace
}  // namespace surimi::test
