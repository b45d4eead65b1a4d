// SPDX-License-Identifier: Apache-2.0
// Stands in for window.cpp where its libraries are missing.
#include "runtime/base/error.h"
#include "runtime/window/window.h"

namespace surimi {

bool has_window() {
    return false;
}

void open_window(Lighting, const Choices&, const WindowSettings&) {
    throw Error(
        ErrorKind::usage,
        "this build of surimi has no window: " SURIMI_WINDOW_MISSING
        " not found when it was configured; install libimgui-dev, libglfw3-dev and libgl-dev (Debian), configure "
        "and build again; or write a file with -o");
}

}  // namespace surimi
