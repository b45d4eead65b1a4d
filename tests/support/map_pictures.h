// SPDX-License-Identifier: Apache-2.0
// Pictures of a map where it is wrong: what a camera close by sees of it, of another map, and of the truth.
#pragma once

#include <filesystem>
#include <span>

#include "runtime/preview/camera.h"
#include "tests/support/room_survey.h"

namespace surimi::test {

/// A view of a point from its front, from as far as is free up to 0.7 m.
View view_near(const RayScene& rays, const SurfacePoint& point);

inline constexpr int picture_width = 192, picture_height = 144;

/// One monitor's visibility as the map has it, in grey; what its light cannot reach is blue, what has no surface black.
Image<glm::u8vec3> picture_of_map(const Scene& scene, const RayScene& rays, const Bake& bake, size_t monitor,
                                  const View& view);

/// The same by rays.
Image<glm::u8vec3> picture_of_truth(const Scene& scene, const RayScene& rays, size_t monitor, const View& view);

/// Pictures of one size side by side, and rows of them below one another, with white lines between.
Image<glm::u8vec3> sheet_of(const std::vector<std::vector<Image<glm::u8vec3>>>& rows);

/// Throws Error(cannot_write).
void write_png(const std::filesystem::path& file, const Image<glm::u8vec3>& image);

}  // namespace surimi::test
