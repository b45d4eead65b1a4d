// SPDX-License-Identifier: Apache-2.0
// The curve that LTCGI's shader puts its shadow map through, and its inverse.
#pragma once

#include <algorithm>
#include <cmath>

namespace surimi {

/// LTCGI's own constants (LTCGI_config.cginc): the map counts as black up to here, as white so much above.
inline constexpr double ltcgi_cutoff = 0.1;
inline constexpr double ltcgi_step = 0.3;

/// What LTCGI multiplies a screen's light with where its map has this value (M69): smoothstep(0, step, map - cutoff).
/// In [0, 1].
inline double ltcgi_factor(double map) {
    const double x = std::clamp((map - ltcgi_cutoff) / ltcgi_step, 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

/// The value for the map that makes LTCGI show a visibility in [0, 1] (M69), to be stored in half precision. 0 and 1
/// come out exactly, and are next to their neighbours, so that bilinear reads do not jump. Not a number counts as 1.
inline double ltcgi_map_value(double visibility) {
    // The half below 0.1 and the one above 0.4: on the flat sides of the curve.
    constexpr double dark = 1638.0 / 16384, lit = 1639.0 / 4096;
    if (!(visibility < 1)) return lit;
    if (!(visibility > 0)) return dark;
    // The root of x^2 (3 - 2 x) = V in [0, 1], by Viete's formula about the end at which it cancels.
    const double angle = 2.0 / 3 * std::atan2(std::sqrt(visibility), std::sqrt(1 - visibility));
    const double sine = std::sin(angle / 2);
    const double x = sine * sine + std::sqrt(0.75) * std::sin(angle);
    return ltcgi_cutoff + ltcgi_step * x;
}

}  // namespace surimi
