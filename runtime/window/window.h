// SPDX-License-Identifier: Apache-2.0
// A window that shows a scene and lets the user walk in it and change its light.
#pragma once

#include "runtime/window/choices.h"

namespace surimi {

struct NamedView {
    std::string name;
    View view;
};

struct WindowSettings {
    std::string title;  ///< of the scene
    int width = 1280;   ///< of the picture in pixels; the controls come beside it. No larger than the screen
    int height = 720;
    std::vector<NamedView> views;  ///< to go back to
    std::string note;              ///< to tell the user, such as that there is no map; may be empty

    /// Writes the picture that is shown, as a file with this extension (".png", ".exr"), and returns its name. Called
    /// from a thread of its own; what it throws is shown.
    std::function<std::string(const Frame& frame, const std::string& extension)> save;

    /// Gets what the window shows, controls and all, once the picture is finished; then the window closes. Empty: it
    /// stays open.
    std::function<void(const Image<glm::u8vec3>& pixels)> screenshot;
    int most_frames = 0;  ///< of the window, before the screenshot is taken of an unfinished picture; 0: any number
};

/// Opens the window, and returns when the user closes it. Throws Error(usage) where no window can be opened: the
/// build has none (Dear ImGui, GLFW or OpenGL were missing), there is no screen, or it has no OpenGL 3.
void open_window(Lighting lighting, const Choices& choices, const WindowSettings& settings);

}  // namespace surimi
