// SPDX-License-Identifier: Apache-2.0
// Texels -> shadowed and unshadowed irradiance from one monitor.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baker/gather/settings.h"
#include "baker/gather/silhouettes.h"
#include "baker/texel/texels.h"
#include "runtime/base/image.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/scene.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {

/// Texel averages at unit radiance. 0 <= shadowed <= unshadowed <= pi.
struct IrradianceEstimate {
    float unshadowed = 0;  ///< E (M1), closed form
    float shadowed = 0;    ///< S (M2)
    float error = 0;       ///< standard error of the visibility S / E, estimated
    TexelMethod method = TexelMethod::none;
};

/// What was done how often, and the seconds of CPU that it took. Counts do not depend on the number of threads.
struct GatherStatistics {
    struct OfMethod {
        size_t texels = 0;
        size_t points = 0;  ///< of texels' surfaces
        size_t rays = 0;
        double seconds = 0;
    };
    std::array<OfMethod, texel_method_count> methods;  ///< by TexelMethod
    size_t blocks = 0;                                 ///< of texels of one chart that the monitor may light
    size_t shadowed_blocks = 0;                        ///< hidden by one facet
    size_t open_blocks = 0;                            ///< no silhouette candidates
    size_t candidates = 0;                             ///< silhouette candidates of all blocks
    size_t segments = 0;                               ///< silhouettes on the monitor, of all points that split or scan
    size_t failed_checks = 0;   ///< points whose cross-check rays disagreed; Monte Carlo took over
    size_t refined_texels = 0;  ///< that needed more than one point
    double query_seconds = 0;   ///< shafts, candidates, certificates
    static constexpr int bins = 16;
    std::array<size_t, bins> error_histogram{};  ///< texels by estimated error: bin 0 is exact, bin b < 2^(b - 15)
    size_t above_error = 0;                      ///< texels whose estimate is above the error asked for

    size_t rays() const;
    void add(const GatherStatistics& other);
    void count(const IrradianceEstimate& estimate, double asked);  ///< one more texel
};

struct Gathered {
    std::vector<IrradianceEstimate> estimates;  ///< one for each of Texels::texels
    GatherStatistics statistics;
};

/// Rows of the map that gather() works on at a time with these settings: those asked for, or else so many that a band
/// has about a million subtexels.
int rows_of_band(int width, const GatherSettings& settings);

/// Bytes that gather() takes in passing at most, beside its arguments and what it returns.
size_t band_bytes(const Texels& texels, const GatherSettings& settings);

/// Irradiance that `scene.monitors[monitor]` sends to every texel. Texels that it cannot light (all points behind the
/// monitor or with the monitor below the horizon) and texels inside other geometry get zeros and cost no ray. Each
/// texel's random numbers depend on its page and index, the monitor's channel and the seed alone. With supersampling
/// light is gathered on subtexels, with random numbers of their own, and put together by downsample(); points and rays
/// are counted for subtexels, texels and errors for texels. Works from the top of the page down, band by band, so that
/// what is on the way is bounded.
Gathered gather(const Scene& scene, const Atlas& atlas, const Texels& texels, const RayScene& rays,
                const Silhouettes& silhouettes, size_t monitor, const GatherSettings& settings,
                const Progress& progress);

/// The same for one point of a surface, by splitting or scanlines as the settings say, for tests and studies.
/// `segments` (if not null) gets the number of silhouettes on the monitor.
IrradianceEstimate irradiance_at(const Scene& scene, const RayScene& rays, const Silhouettes& silhouettes,
                                 size_t monitor, const SurfacePoint& point, const GatherSettings& settings,
                                 size_t* segments = nullptr);

}  // namespace surimi
