// SPDX-License-Identifier: Apache-2.0
#include "baker/write/bake_files.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "baker/write/manifest.h"
#include "runtime/base/error.h"
#include "runtime/scene/uri.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view manifest_ending = ".visibility.json";
constexpr int known_version = 1;

std::filesystem::path find_manifest(const std::filesystem::path& place) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(place, ignored)) return place;
    const std::vector<std::filesystem::path> found = manifests_in(place);
    if (found.empty())
        throw Error(ErrorKind::scene, place.string() + ": no bake is in this folder (no NAME" +
                                          std::string(manifest_ending) + "); make one with: surimi bake SCENE -o " +
                                          place.string());
    if (found.size() == 1) return found.front();
    std::string names;
    for (const auto& path : found) names += " " + path.string();
    throw Error(ErrorKind::usage, place.string() + ": holds several bakes; name one of" + names);
}

/// Sizes and names that the rest of the program relies on. Throws Json::exception for what is not there.
void read_members(BakeFiles& bake) {
    const Json& manifest = bake.manifest;
    bake.name = std::filesystem::path(manifest.at("scene").at("file").get<std::string>()).stem().string();
    bake.width = manifest.at("map").at("width").get<int>();
    bake.height = manifest.at("map").at("height").get<int>();
    for (const Json& monitor : manifest.at("monitors")) {
        const auto channel = std::string("RGB").find(monitor.at("channel").get<std::string>());
        if (channel > 2) continue;
        bake.monitors.push_back({static_cast<int>(channel), monitor.at("name").get<std::string>()});
    }
    size_t page_count = 1;
    for (const Json& output : manifest.at("outputs"))
        page_count = std::max(page_count, output.value("page", size_t{0}) + 1);
    bake.pages.resize(page_count);
}

/// Where the bake keeps an output, and what its role on its page is.
std::filesystem::path* place_of(BakeFiles& bake, const Json& output) {
    const auto role = output.at("role").get<std::string>();
    PageOfBake& page = bake.pages.at(output.value("page", size_t{0}));
    if (role == "bakedGlb") return &bake.baked_glb;
    if (role == "lightmaps") return &page.lightmaps_exr;
    if (role != "visibility") return nullptr;
    const auto extension = std::filesystem::path(output.at("file").get<std::string>()).extension();
    return extension == ".png" ? &page.visibility_png : &page.visibility_exr;
}

void find_outputs(BakeFiles& bake) {
    for (const Json& output : bake.manifest.at("outputs")) {
        std::filesystem::path* place = place_of(bake, output);
        if (place == nullptr) continue;
        // Only names: a manifest does not make the program read elsewhere.
        const auto file = std::filesystem::path(output.at("file").get<std::string>()).filename();
        const auto path = bake.manifest_path.parent_path() / file;
        const OutputState state = state_of_output(path, output.at("hash").get<std::string>());
        if (state == OutputState::missing) {
            bake.complaints.push_back(file.string() + " is not beside the manifest; what it shows is left out");
            continue;
        }
        if (state == OutputState::changed)
            bake.complaints.push_back(file.string() +
                                      " is not the file that the bake wrote: it was changed afterwards, or belongs to "
                                      "another bake");
        *place = path;
    }
}

}  // namespace

std::vector<std::filesystem::path> manifests_in(const std::filesystem::path& folder) {
    std::error_code ignored;
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (entry.path().filename().string().ends_with(manifest_ending)) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
}

OutputState state_of_output(const std::filesystem::path& path, const std::string& hash) {
    const auto bytes = read_file(path);
    if (!bytes) return OutputState::missing;
    return content_hash(*bytes) == hash ? OutputState::whole : OutputState::changed;
}

BakeFiles find_bake(const std::filesystem::path& folder_or_manifest) {
    BakeFiles bake;
    bake.manifest_path = find_manifest(folder_or_manifest);
    const auto bytes = read_file(bake.manifest_path);
    if (!bytes)
        throw Error(ErrorKind::scene,
                    bake.manifest_path.string() + ": cannot be read; give the folder of a bake, or its manifest");
    try {
        bake.manifest = Json::parse(bytes->begin(), bytes->end());
        if (bake.manifest.at("version").get<int>() != known_version)
            throw Error(ErrorKind::scene, bake.manifest_path.string() +
                                              ": is of another version of Surimi; bake again, or report with that one");
        read_members(bake);
        find_outputs(bake);
    } catch (const Json::exception& error) {
        throw Error(ErrorKind::scene, bake.manifest_path.string() + ": is no manifest of a bake (" + error.what() +
                                          "); give the NAME.visibility.json that surimi bake wrote");
    } catch (const std::out_of_range&) {
        throw Error(ErrorKind::scene, bake.manifest_path.string() + ": lists a page that there is not; bake again");
    }
    return bake;
}

}  // namespace surimi
