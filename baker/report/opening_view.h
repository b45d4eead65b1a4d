// SPDX-License-Identifier: Apache-2.0
// Where the page's view of the scene begins, and pictures for pages that have no live view.
#pragma once

#include <vector>

#include "baker/write/bake_files.h"
#include "runtime/map/visibility_map.h"
#include "runtime/preview/camera.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// A picture of the scene as PNG, without shadows and with them.
struct Stills {
    std::vector<uint8_t> unshadowed;
    std::vector<uint8_t> shadowed;
};

struct OpeningView {
    View view;
    double exposure = 1;  ///< factor from nits to what the filmic curve of runtime/preview takes
    Stills stills;        ///< empty unless asked for
};

/// The first camera of the scene, else what frame_automatically finds; with the exposure that `surimi preview` chooses
/// there. Finds the bake's monitors in `baked`. `pages`: the maps.
OpeningView open_view(Scene& baked, const BakeFiles& files, const std::vector<VisibilityMap>& pages, bool with_stills);

}  // namespace surimi
