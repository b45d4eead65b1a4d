// SPDX-License-Identifier: Apache-2.0
#include "baker/export/export.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "baker/export/target_files.h"
#include "baker/write/bake_files.h"
#include "baker/write/file.h"
#include "runtime/base/error.h"
#include "runtime/map/map_file.h"

namespace surimi {
namespace {

using MakeFiles = ExportFiles (*)(const ExportedBake&);
constexpr std::array<MakeFiles, 5> makers{kanikama_files, ltcgi_files, arealit_files, godot_files, three_files};

size_t number_of(const std::string& target) {
    const auto& all = export_targets();
    const auto found = std::find_if(all.begin(), all.end(), [&](const ExportTarget& t) { return t.name == target; });
    assert(found != all.end());
    return static_cast<size_t>(found - all.begin());
}

ExportedBake read_bake(const std::filesystem::path& folder_or_manifest, std::vector<std::string>& warnings) {
    ExportedBake bake{find_bake(folder_or_manifest), {}};
    const auto require = [&](const std::filesystem::path& path, const char* what) {
        if (path.empty())
            throw Error(ErrorKind::scene, bake.files.manifest_path.string() + ": " + what +
                                              " of this bake is not beside it; bring it back, or bake again");
    };
    require(bake.files.baked_glb, "the baked glb");
    for (const PageOfBake& page : bake.files.pages) {
        require(page.visibility_exr, "the map (EXR)");
        require(page.visibility_png, "the map (PNG)");
        bake.pages.push_back(read_map_exr(page.visibility_exr));
    }
    // Of the evidence nothing is exported, so nothing of it is missed.
    for (const std::string& complaint : bake.files.complaints)
        if (!complaint.starts_with(bake.files.name + ".lightmaps.")) warnings.push_back(complaint);
    return bake;
}

}  // namespace

const std::vector<ExportTarget>& export_targets() {
    static const std::vector<ExportTarget> targets{
        {"kanikama", "Unity with Kanikama's shaders"},
        {"ltcgi", "Unity with LTCGI"},
        {"arealit", "Unity with Mochie's AreaLit slot"},
        {"godot", "Godot 4"},
        {"three", "three.js"},
    };
    return targets;
}

std::vector<std::filesystem::path> export_bake(const std::filesystem::path& folder_or_manifest,
                                               const std::vector<std::string>& targets,
                                               std::vector<std::string>& warnings) {
    const ExportedBake bake = read_bake(folder_or_manifest, warnings);
    const std::filesystem::path folder = bake.files.manifest_path.parent_path() / "export";
    PendingFiles pending;
    std::vector<std::filesystem::path> paths;
    for (const std::string& target : targets)
        for (const ExportFile& file : makers[number_of(target)](bake)) {
            const std::filesystem::path path = folder / target / file.name;
            std::error_code ignored;
            // Renaming onto a folder fails, and only after other files have their names already.
            if (std::filesystem::is_directory(path, ignored))
                throw Error(ErrorKind::cannot_write, path.string() + ": cannot be written: it is a folder; remove it");
            make_folder(path.parent_path());
            file.write(pending.add(path));
            paths.push_back(path);
        }
    pending.commit();
    return paths;
}

}  // namespace surimi
