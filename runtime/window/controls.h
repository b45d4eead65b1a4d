// SPDX-License-Identifier: Apache-2.0
// The panel of switches, the picture under the hand, and the line that says how far it is. Draws with Dear ImGui, in
// the frame that the window has begun.
#pragma once

#include <string>

#include "runtime/window/window.h"

namespace surimi {

/// What the user asks of the window itself.
struct Requests {
    std::string save_as;  ///< extension of the picture to save; empty: none
    bool wants_close = false;
    bool wants_help = false;  ///< the list of keys is shown or hidden
};

/// Where something is drawn, in points of the window.
struct Area {
    float x = 0, y = 0, width = 0, height = 0;
};

/// What the hand can ask the scene.
struct Sight {
    const RayScene& rays;
    bool has_map = false;
};

/// The panel. Changes `choices` as the user does.
Requests draw_panel(const Area& area, const WindowSettings& settings, bool has_map, const RenderStatus& status,
                    Choices& choices);

/// The status line; `message` is about what the user did last.
void draw_status(const Area& area, const RenderStatus& status, Show show, const std::string& message);

/// The list of keys, over the picture.
void draw_help(const Area& area);

/// What mouse and keyboard do to the view and the switches, the pointer being over the picture. `aspect` is the
/// picture's.
Requests use_hand(const Area& area, const Sight& sight, const WindowSettings& settings, Choices& choices);

}  // namespace surimi
