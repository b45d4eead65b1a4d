// SPDX-License-Identifier: Apache-2.0
// What the page shows of an atlas: density, stretch and the outlines of charts, texel by texel, and its numbers.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "baker/unwrap/atlas.h"
#include "baker/unwrap/measure.h"
#include "runtime/base/image.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// The highest stretch that the page tells from higher ones.
inline constexpr double stretch_high = 2;

/// One page of the atlas, texel by texel, divided by `reduction`. R: linear_code of the texels per metre in the worst
/// direction from 0 to `density_high`; G: linear_code of the stretch against the chart's density from 1 to
/// stretch_high; both 0 where there is no chart. B: 255 where a seam of a smooth surface runs, which shows in a
/// lightmap, 128 where another side of a chart does, else 0.
Image<glm::u8vec3> draw_atlas(const Scene& scene, const Atlas& atlas, int page, double density_high, int reduction);

/// The numbers of an atlas for the page.
nlohmann::ordered_json atlas_section(const Atlas& atlas, const UnwrapNumbers& numbers);

}  // namespace surimi
