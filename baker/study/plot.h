// SPDX-License-Identifier: Apache-2.0
// A study as a picture: error against CPU time, both logarithmic.
#pragma once

#include <string>

#include "baker/study/study.h"

namespace surimi {

/// An SVG document of its own: white ground, colours that survive colour blindness (Okabe and Ito 2008), names on the
/// lines, every point with its setting as a tooltip. `title` is the scene's name. Points without time or error above 0
/// are left out.
std::string to_svg(const Study& study, const std::string& title);

}  // namespace surimi
