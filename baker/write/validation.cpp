// SPDX-License-Identifier: Apache-2.0
#include "baker/write/validation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "baker/post/channel.h"
#include "baker/write/bake_files.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"
#include "runtime/scene/gltf.h"
#include "runtime/scene/uri.h"

namespace surimi {
namespace {

using Json = nlohmann::json;
using Path = std::filesystem::path;

constexpr std::array states{std::pair{"covered", TexelState::covered}, std::pair{"unlit", TexelState::unlit},
                            std::pair{"inside", TexelState::inside}, std::pair{"filled", TexelState::filled},
                            std::pair{"empty", TexelState::empty}};

Json read_manifest(const Path& path) {
    const auto bytes = read_file(path);
    if (!bytes) throw Error(ErrorKind::scene, path.string() + ": cannot be read; give the folder that bake wrote to");
    Json manifest = Json::parse(*bytes, nullptr, false);
    if (manifest.is_discarded() || !manifest.contains("outputs") || !manifest["outputs"].is_array())
        throw Error(ErrorKind::scene, path.string() + ": is no manifest of a bake");
    return manifest;
}

/// What is checked, and what was found so far.
struct Inspection {
    const Json& manifest;
    Path folder;
    Validation result;
    std::map<std::string, std::map<std::string, size_t>> texels;  ///< by channel and state, as the lightmaps have them

    void fault(const std::string& file, const std::string& what) { result.faults.push_back(file + ": " + what); }
};

/// Whether the file is as the bake left it.
bool is_whole(Inspection& inspection, const Json& output) {
    // Only names, as everywhere: a manifest does not make the program read elsewhere.
    const std::string name = Path(output.at("file").get<std::string>()).filename().string();
    const Path path = inspection.folder / name;
    inspection.result.files.push_back(path);
    const OutputState state = state_of_output(path, output.at("hash").get<std::string>());
    if (state == OutputState::missing) {
        inspection.fault(name, "is missing; bake again");
        return false;
    }
    std::error_code ignored;
    if (state == OutputState::changed ||
        std::filesystem::file_size(path, ignored) != output.at("bytes").get<size_t>()) {
        inspection.fault(name, "is not what the bake wrote (other bytes)");
        return false;
    }
    return true;
}

bool has_size(Inspection& inspection, const std::string& name, int width, int height) {
    const Json& map = inspection.manifest.at("map");
    if (map.at("width") == width && map.at("height") == height) return true;
    inspection.fault(name, fmt::format("is {} x {}, the manifest says {} x {}", width, height,
                                       map.at("width").get<int>(), map.at("height").get<int>()));
    return false;
}

/// Both files of a map, its EXR first.
void check_map(Inspection& inspection, const std::string& exr, const std::string& png) {
    const VisibilityMap map = read_map_exr(inspection.folder / exr);
    const auto png_bytes = read_file(inspection.folder / png);
    const Image<glm::u8vec4> codes = decode_image(*png_bytes, png);
    if (!has_size(inspection, exr, map.visibility.width, map.visibility.height) ||
        !has_size(inspection, png, codes.width, codes.height))
        return;
    const std::vector<uint8_t> expected = encode_map_png(map);
    const Image<glm::u8vec4> of_exr = decode_image(expected, exr);
    int farthest = 0;
    std::array<bool, 3> is_used{};
    for (const Json& monitor : inspection.manifest.at("monitors"))
        is_used[std::string("RGB").find(monitor.at("channel").get<std::string>())] = true;
    bool is_one = true;
    for (size_t i = 0; i < codes.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            farthest = std::max(farthest, std::abs(codes.pixels[i][c] - of_exr.pixels[i][c]));
            is_one &= is_used[static_cast<size_t>(c)] || map.visibility.pixels[i][c] == 1;
        }
    // The PNG was made of floats, the EXR holds halves of them: a code may fall on the other side.
    if (farthest > 1) inspection.fault(png, fmt::format("is up to {} codes off {}", farthest, exr));
    if (!is_one) inspection.fault(exr, "is not 1 in a channel without a monitor");
}

void count_states(Inspection& inspection, const std::string& name) {
    const Channels channels = read_channels(inspection.folder / name);
    if (!has_size(inspection, name, channels.width, channels.height)) return;
    const Json& monitors = inspection.manifest.at("monitors");
    for (const Json& monitor : monitors) {
        const std::string channel = monitor.at("channel");
        const auto ends_so = [&](const std::string& layer) {
            return layer == monitor.at("name").get<std::string>() + ".state" ||
                   layer == monitor.at("name").get<std::string>() + "_" + channel + ".state";
        };
        const auto found = std::find_if(channels.names.begin(), channels.names.end(), ends_so);
        if (found == channels.names.end()) {
            inspection.fault(name, "has no layer for monitor " + monitor.at("name").get<std::string>());
            continue;
        }
        const auto place = static_cast<size_t>(found - channels.names.begin());
        for (size_t i = place; i < channels.values.size(); i += channels.names.size())
            for (const auto& [state, value] : states)
                if (channels.values[i] == static_cast<float>(value)) ++inspection.texels[channel][state];
    }
}

void compare_states(Inspection& inspection) {
    for (const auto& [channel, counted] : inspection.texels)
        for (const auto& [state, value] : states) {
            const size_t said = inspection.manifest.at("texels").at(channel).at(state);
            const auto found = counted.find(state);
            const size_t count = found == counted.end() ? 0 : found->second;
            if (count != said)
                inspection.fault("lightmaps", fmt::format("{} has {} texels that are {}, the manifest says {}", channel,
                                                          count, state, said));
        }
}

void check_scene(Inspection& inspection, const std::string& name) {
    const Scene scene = read_gltf(inspection.folder / name);
    std::array<std::string, 3> monitors;
    for (const Json& monitor : inspection.manifest.at("monitors"))
        monitors[std::string("RGB").find(monitor.at("channel").get<std::string>())] = monitor.at("name");
    size_t carriers = 0;
    for (const Material& material : scene.materials) {
        if (material.visibility_map.image < 0) continue;
        ++carriers;
        if (material.visibility_channels != monitors)
            inspection.fault(name, "material " + material.name + " carries a map of other monitors");
    }
    if (carriers == 0) inspection.fault(name, "no material carries the map");
}

/// The files of one role, in the order of pages.
std::vector<std::string> files_of(const Inspection& inspection, const std::string& role) {
    std::vector<std::string> names;
    for (const Json& output : inspection.manifest.at("outputs"))
        if (output.at("role") == role) names.push_back(Path(output.at("file").get<std::string>()).filename().string());
    return names;
}

void check_contents(Inspection& inspection) {
    const auto maps = files_of(inspection, "visibility");
    for (size_t i = 0; i + 1 < maps.size(); i += 2) check_map(inspection, maps[i], maps[i + 1]);
    for (const std::string& name : files_of(inspection, "lightmaps")) count_states(inspection, name);
    compare_states(inspection);
    for (const std::string& name : files_of(inspection, "bakedGlb")) check_scene(inspection, name);
}

}  // namespace

Path find_manifest(const Path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(path, ignored)) return path;
    const std::vector<Path> found = manifests_in(path);
    if (found.size() == 1) return found.front();
    throw Error(ErrorKind::usage,
                found.empty() ? path.string() + ": no NAME.visibility.json there; give the folder that bake wrote to"
                              : fmt::format("{}: {} bakes there; name the manifest of one, such as {}", path.string(),
                                            found.size(), found.front().string()));
}

Validation validate_bake(const Path& path) {
    const Json manifest = read_manifest(path);
    Inspection inspection{manifest, path.parent_path(), {}, {}};
    try {
        bool all_whole = true;
        for (const Json& output : manifest.at("outputs")) all_whole &= is_whole(inspection, output);
        if (all_whole) check_contents(inspection);
    } catch (const Json::exception& error) {
        throw Error(ErrorKind::scene, path.string() + ": is no manifest of a bake: " + error.what());
    } catch (const Error& error) {  // of a file that is as it was written and still cannot be read
        inspection.result.faults.emplace_back(error.what());
    }
    return inspection.result;
}

}  // namespace surimi
