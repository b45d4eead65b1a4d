// SPDX-License-Identifier: Apache-2.0
// How the controls look: dark, so that the picture is the brightest thing, in the desktop's font.
#pragma once

namespace surimi {

/// Sets the colours, spaces and font of Dear ImGui's present context. `scale`: pixels to a point, of the screen.
void set_style(float scale);

}  // namespace surimi
