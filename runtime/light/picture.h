// SPDX-License-Identifier: Apache-2.0
// What a monitor shows: an image over its panels, with blurred copies for lookups through a lobe.
#pragma once

#include <vector>

#include "runtime/base/image.h"
#include "runtime/light/monitor.h"

namespace surimi {

/// Where on the picture a place of a panel lies: uv = (dot(p - origin, u), dot(p - origin, v)), v down, in the panel's
/// plane; affine, so parallel to the plane only.
struct PictureMapping {
    Vec3 origin{0};               ///< metres; where uv is (0, 0)
    Vec3 u{1, 0, 0}, v{0, 1, 0};  ///< gradients, 1/m
};

/// Linear colours in [0, 1] or beyond, times the monitor's radiance. Outside the image the border goes on.
struct MonitorPicture {
    std::vector<Image<Vec3f>> levels;      ///< the image, then copies of half the size each, down to one texel
    std::vector<PictureMapping> mappings;  ///< one for each panel
};

/// Blurs and halves the image down to one texel, which is its mean. Each step weighs neighbours (1 3 3 1) / 8 in both
/// directions and counts inner texels only, so that light next to an edge of the monitor is not mixed with anything
/// from outside (Heitz and Hill 2016 extend the image instead). Throws nothing; an empty image gives no levels.
std::vector<Image<Vec3f>> blurred_levels(Image<Vec3f> image);

/// The picture upright over all panels together: fills their bounding rectangle in the plane of the first, u to the
/// right seen from the front, v down (or towards -z of the world where the monitor lies flat).
std::vector<PictureMapping> upright_mappings(const Monitor& monitor);

/// Bilinear lookup of the picture itself at a place on a panel.
Vec3 picture_at(const MonitorPicture& picture, size_t panel, const Vec3& position);

/// Mean of the picture under a Gaussian of standard deviation `sigma` metres around a place on a panel, from two
/// neighbouring levels.
Vec3 blurred_picture_at(const MonitorPicture& picture, size_t panel, const Vec3& position, double sigma);

}  // namespace surimi
