// SPDX-License-Identifier: Apache-2.0
// A bake on disk with maps that a test chooses, for exports to take it from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "baker/export/export.h"
#include "baker/write/output.h"
#include "glb_builder.h"
#include "runtime/base/error.h"
#include "runtime/scene/gltf.h"

namespace surimi::test {

/// One mesh of two triangles (two primitives) under a monitor in channel G. `bake` is for tests to bend before write().
struct ExportedRoom {
    std::filesystem::path folder = test_folder();
    std::filesystem::path out = folder / "out";
    Scene scene;
    Bake bake;

    explicit ExportedRoom(const std::string& node = "Wall", const std::string& file_name = "room") {
        GlbBuilder file;
        Json primitives = Json::array();
        for (const float y : {0.0f, 2.0f}) {
            const int positions = file.add_floats({0, y, 0, 1, y, 0, 0, y + 1, 0}, "VEC3");
            primitives.push_back({{"attributes", {{"POSITION", positions}}}});
        }
        file.json["meshes"] = {{{"primitives", primitives}}};
        file.json["nodes"] = {{{"name", node}, {"mesh", 0}}};
        file.json["scenes"] = {{{"nodes", {0}}}};
        scene = read_gltf(file.write(folder / (file_name + ".glb")));
        add_monitor("Screen", 1);
        const SurfaceUv uv{{{Vec2f(0.1f, 0.1f), Vec2f(0.9f, 0.1f), Vec2f(0.1f, 0.9f)}}, {0}};
        bake.atlas.surfaces = {uv, uv};
        bake.evidence.resize(1);
        bake.costs = {{"unwrap", 0.1, 0, 1}};
        add_page(Image<Vec3f>(4, 4, Vec3f(1)));
    }
    void add_monitor(const std::string& name, int channel, size_t panels = 1) {
        Monitor monitor;
        monitor.name = name;
        monitor.channel = channel;
        monitor.radiance = Vec3(3, 2, 1);
        for (size_t p = 0; p < panels; ++p)
            monitor.panels.push_back({{Vec3(0.5, 0, 3), Vec3(0.5, 1, 3), Vec3(2, 1, 3), Vec3(2, 0, 3)}});
        scene.monitors.push_back(monitor);
    }
    void add_page(const Image<Vec3f>& visibility) {
        BakedPage& page = bake.pages.emplace_back();
        page.map.visibility = visibility;
        page.map.monitors[1] = "Screen";
        for (size_t c = 0; c < 3; ++c) {
            page.state[c] = Image<TexelState>(visibility.width, visibility.height, TexelState::covered);
            page.irradiance[c] = Image<IrradianceEstimate>(visibility.width, visibility.height);
        }
        bake.atlas.width = visibility.width;
        bake.atlas.height = visibility.height;
        bake.atlas.pages = static_cast<int>(bake.pages.size());
    }
    void show(const Image<Vec3f>& visibility) {
        bake.pages.clear();
        add_page(visibility);
    }
    std::vector<std::filesystem::path> write(const std::vector<std::string>& targets) const {
        write_bake(out, scene, bake, "{}");
        std::vector<std::string> warnings;
        const auto paths = export_bake(out, targets, warnings);
        EXPECT_TRUE(warnings.empty());
        return paths;
    }
    std::filesystem::path place(const std::string& name) const { return out / "export" / name; }
    std::string text(const std::string& name) const {
        std::ifstream stream(place(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    /// What lies in the export's folder, sorted; folders are not counted.
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        if (std::filesystem::exists(out / "export"))
            for (const auto& entry : std::filesystem::recursive_directory_iterator(out / "export"))
                if (!entry.is_directory()) names.push_back(relative(entry.path(), out / "export").string());
        std::sort(names.begin(), names.end());
        return names;
    }
};

}  // namespace surimi::test
