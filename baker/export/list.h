// SPDX-License-Identifier: Apache-2.0
// What an engine has to know beside the picture: which object has which map, and where the monitors are.
#pragma once

#include <string>
#include <vector>

#include "baker/write/bake_files.h"
#include "runtime/base/math.h"

namespace surimi {

/// Which way engines count their axes. glTF: right-handed, y up. Unity: left-handed, x mirrored.
enum class Axes { gltf, unity };

/// An object of the scene and its map; ones of several maps have an entry for each.
struct ListedObject {
    std::string name;             ///< of the node in the baked glb
    int map = 0;                  ///< page
    std::vector<int> primitives;  ///< of its mesh that read this map
};

/// A quad that shines: four corners in metres, counter-clockwise seen from the front (clockwise about a mirrored axis).
/// Triangles repeat their last corner.
struct ListedQuad {
    int channel = 0;
    bool is_two_sided = false;
    Vec3 corners[4];
};

/// In the manifest's order. Throws Error(scene) for a manifest that lacks what it should have.
std::vector<ListedObject> listed_objects(const BakeFiles& bake);

/// Every panel of every monitor, fanned into quads about its first corner.
std::vector<ListedQuad> listed_quads(const BakeFiles& bake, Axes axes);

/// What a component reads to set its property blocks: a JSON text. `maps` are the names of the map's files;
/// `texture` and `scale_offset` the shader's properties, the latter empty where it has none.
struct ListWishes {
    Axes axes = Axes::gltf;
    std::vector<std::string> maps;
    std::string texture;
    std::string scale_offset;
};
std::string make_list(const BakeFiles& bake, const ListWishes& wishes);

}  // namespace surimi
