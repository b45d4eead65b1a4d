// SPDX-License-Identifier: Apache-2.0
// From a picture in nits to what a screen shows.
#pragma once

#include "runtime/preview/render.h"

namespace surimi {

/// Filmic curve (Narkowicz 2015), in [0, 1], still linear. Monotone; NaN becomes 0.
double filmic(double x);

/// Exposure that brings the picture's bright level to 0.7 before the curve.
double automatic_exposure(const Picture& picture);

/// What the screen shows, linear, in [0, 1]: filmic of linear * exposure for lit views, the clamped value for others.
Image<Vec3f> displayed(const Image<Vec3f>& pixels, Show show, double exposure);

/// The same as the sRGB codes of one pixel; quick, since it is called for each pixel of each pass that a window shows.
glm::u8vec3 codes_of(const Vec3f& pixel, Show show, double exposure);

/// What `displayed` gave, as sRGB codes.
Image<glm::u8vec3> to_codes(const Image<Vec3f>& displayed);

}  // namespace surimi
