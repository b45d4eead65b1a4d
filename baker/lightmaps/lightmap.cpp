// SPDX-License-Identifier: Apache-2.0
#include "baker/lightmaps/lightmap.h"

#include <cmath>

#include "runtime/base/color.h"

namespace surimi {

double step_at(const Lightmap& lightmap, double light) {
    const double relative = lightmap.relative_step * std::abs(light);
    if (!(lightmap.code_step > 0)) return relative;
    if (!lightmap.is_srgb) return lightmap.code_step + relative;
    // One code down, so that white has a step, too.
    const double code = srgb_from_linear(light), below = code - lightmap.code_step;
    const double step =
        below > 0 ? linear_from_srgb(code) - linear_from_srgb(below) : linear_from_srgb(lightmap.code_step);
    return step + relative;
}

}  // namespace surimi
