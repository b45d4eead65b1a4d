// SPDX-License-Identifier: Apache-2.0
// Visibility from a few rays: the ratio estimator.
#pragma once

#include "runtime/reference/direct_light.h"

namespace surimi {

/// Share of what one monitor makes a point reflect to the eye that arrives, for each colour, in [0, 1]: shadowed over
/// unshadowed, both estimated from the same samples with the weights of the BRDF (M32; Heitz, Hill and McGuire 2018).
/// Times the analytic unshadowed light it has noise in penumbrae only. 1 where no sample carries light.
Vec3 stochastic_visibility(const Scene& scene, const RayScene& rays, size_t monitor, const LitMonitor& light,
                           const MonitorSampler& sampler, const ShadingPoint& point, int samples);

}  // namespace surimi
