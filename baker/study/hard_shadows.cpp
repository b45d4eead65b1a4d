// SPDX-License-Identifier: Apache-2.0
#include "baker/study/hard_shadows.h"

#include <cmath>

#include "baker/study/shadow_rays.h"

namespace surimi {

StudyEstimate hard_shadow_grid(const Receiver& receiver, int n) {
    ShadowRays rays(receiver.light);
    // Roberts' sequence (2018): steps by the powers of the plastic number spread any number of places evenly.
    constexpr double step_u = 0.7548776662466927, step_v = 0.5698402909980532;
    double u = 0.5, v = 0.5;
    for (int i = 0; i < n * n; ++i) {
        const LightPoint light = receiver.light.sampler.sample((i % n + 0.5) / n, (i / n + 0.5) / n);
        rays.add(receiver.surface.sample(u, v), light);
        u += step_u - (u + step_u >= 1 ? 1 : 0);
        v += step_v - (v + step_v >= 1 ? 1 : 0);
    }
    return rays.estimate();
}

}  // namespace surimi
