// SPDX-License-Identifier: Apache-2.0
// The atlas of a finished bake, from the UVs of its glb.
#pragma once

#include "baker/unwrap/atlas.h"
#include "baker/write/bake_files.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// The atlas that `baked`, the scene in a bake's glb, has in its TEXCOORD_1: on the map are the surfaces that the
/// manifest lists, each on the page that it says. Sets Surface::receives to that. Charts are joined triangles, as in
/// judge_existing. A surface that lost its coordinates is on no page.
Atlas atlas_of_bake(Scene& baked, const BakeFiles& files);

}  // namespace surimi
