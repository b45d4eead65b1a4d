// SPDX-License-Identifier: Apache-2.0
// A small room that was baked to disk, for tests of what reads a finished bake.
#pragma once

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "baker/bake.h"
#include "baker/write/output.h"
#include "runtime/scene/gltf.h"
#include "runtime/scene/monitors.h"
#include "tests/unit/glb_builder.h"

namespace surimi::test {

/// A floor under a plate under monitors that look down. Names and materials are for tests to bend.
struct RoomFile : GlbBuilder {
    explicit RoomFile(int monitor_count = 1, const std::string& plate = "Plate") {
        json["materials"] = {{{"name", "Grey"}}};
        json["nodes"] = Json::array();
        add_floor("Floor", 2, 0, true);
        add_floor(plate, 0.4f, 1, true);
        for (int m = 0; m < monitor_count; ++m)
            add_floor(std::string("Monitor_") + "RGB"[m], 0.3f, 2 + 0.2f * static_cast<float>(m), false);
        json["scene"] = 0;
    }

    /// A square of half the side `half` at a height, whose front looks up or down.
    void add_floor(const std::string& name, float half, float height, bool up) {
        const std::vector<float> corners{-half, height, half,  half,  height, half,
                                         half,  height, -half, -half, height, -half};
        const int positions = add_floats(corners, "VEC3");
        json["accessors"].back()["min"] = {-half, height, -half};
        json["accessors"].back()["max"] = {half, height, half};
        const int indices = up ? add_indices({0, 1, 2, 0, 2, 3}) : add_indices({0, 2, 1, 0, 3, 2});
        json["meshes"].push_back(
            {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", 0}}}}});
        json["nodes"].push_back({{"name", name}, {"mesh", json["meshes"].size() - 1}});
        json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
    }
};

inline BakeSettings quick_settings(int size = 48) {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = size;
    settings.unwrap.quality = UvQuality::draft;
    settings.gather.error = 0.02;
    return settings;
}

/// What `surimi bake` would say of these settings.
inline std::string quick_settings_json(const BakeSettings& settings) {
    return nlohmann::ordered_json{{"uv", "unwrap"},
                                  {"size", {settings.unwrap.width, settings.unwrap.height}},
                                  {"atlases", settings.unwrap.atlases},
                                  {"error", settings.gather.error},
                                  {"exact", false},
                                  {"seed", 0}}
        .dump();
}

/// Bakes the file into `folder`/out; returns the paths of what was written.
inline OutputPaths bake_to_disk(RoomFile& file, const BakeSettings& settings = quick_settings()) {
    const auto folder = test_folder();
    Scene scene = read_gltf(file.write(folder / "room.glb"));
    find_monitors(scene, {});
    return write_bake(folder / "out", scene, bake(scene, settings, {}), quick_settings_json(settings));
}

inline std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

}  // namespace surimi::test
