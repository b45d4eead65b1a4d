// SPDX-License-Identifier: Apache-2.0
// --window of preview: what it takes, and the window that comes of it.
#pragma once

#include <filesystem>

#include "runtime/window/window.h"

namespace CLI {
class App;
}

namespace surimi {

struct WindowOptions {
    bool is_wanted = false;
    std::filesystem::path screenshot;  ///< empty: the window stays open
    int frames = 0;                    ///< 0: the screenshot waits for the finished picture
};

void add_window_options(CLI::App& command, WindowOptions& options);  ///< --window, --screenshot, --frames

/// Throws Error(usage) for options that do not go together.
void check(const WindowOptions& options);

/// Shows a scene in a window until the user closes it. `settings` has the size and the title; `out` is the name under
/// which pictures are saved, whatever its extension; empty: NAME.preview-1 and so on, of the scene, in the working
/// folder. Throws what open_window throws.
void show_window(Lighting lighting, const Choices& choices, WindowSettings settings, const std::filesystem::path& out,
                 const WindowOptions& options);

}  // namespace surimi
