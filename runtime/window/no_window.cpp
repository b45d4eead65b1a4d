// SPDX-License-Identifier: Apache-2.0
// Stands in for window.cpp where its libraries are missing.
#include "runtime/base/error.h"
#include "runtime/window/window.h"

namespace surimi {

void open_window(Lighting, const Choices&, const WindowSettings&) {
    throw Error(ErrorKind::usage, "this build of surimi has no window (" SURIMI_WINDOW_MISSING
                                  "); install libimgui-dev, libglfw3-dev and libgl-dev (Debian), configure and build "
                                  "again; or write a file with -o");
}

}  // namespace surimi
