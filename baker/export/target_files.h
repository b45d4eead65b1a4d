// SPDX-License-Identifier: Apache-2.0
// What each target gets.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "baker/write/bake_files.h"
#include "runtime/map/visibility_map.h"

namespace surimi {

/// A file of an export: its place in the target's folder, and how it is written to the path that it is given.
struct ExportFile {
    std::filesystem::path name;
    std::function<void(const std::filesystem::path&)> write;
};
using ExportFiles = std::vector<ExportFile>;

/// A bake with its maps read.
struct ExportedBake {
    BakeFiles files;
    std::vector<VisibilityMap> pages;
};

/// Kanikama: half EXR, linear, R G B = monitors in order; a component for Unity and the list that it reads.
ExportFiles kanikama_files(const ExportedBake& bake);
/// LTCGI: the same with values that its curve undoes (M69).
ExportFiles ltcgi_files(const ExportedBake& bake);
/// The slot _AreaLitOcclusion of Mochie's shaders: half EXR, R G B A, A = 1.
ExportFiles arealit_files(const ExportedBake& bake);
/// Godot 4: EXR and PNG, shader with its tables, script. Throws Error(usage) for monitors of more quads than the
/// shader has room for.
ExportFiles godot_files(const ExportedBake& bake);
/// three.js: the baked glb and a page that shows it.
ExportFiles three_files(const ExportedBake& bake);

/// Quads that Godot's shader has room for; its `most_quads`.
inline constexpr size_t most_godot_quads = 16;

}  // namespace surimi
