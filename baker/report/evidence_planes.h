// SPDX-License-Identifier: Apache-2.0
// What the page shows of a map and the evidence behind it, texel by texel.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "baker/write/bake_files.h"
#include "runtime/base/image.h"
#include "runtime/base/math.h"
#include "runtime/image/image_file.h"

namespace surimi {

/// The evidence of one page: for each of R, G, B the places of its channels in the file; none where it has them not.
struct Evidence {
    Channels channels;
    struct OfMonitor {
        std::optional<size_t> shadowed, unshadowed, error, state, method;
    };
    std::array<OfMonitor, 3> monitors;

    size_t texel_count() const { return static_cast<size_t>(channels.width) * static_cast<size_t>(channels.height); }
    float at(size_t texel, size_t channel) const { return channels.values[texel * channels.names.size() + channel]; }
    /// Whether the monitor's light on the texel was measured.
    bool is_covered(size_t texel, const OfMonitor& monitor) const;
};

/// Reads NAME.lightmaps.exr. Throws Error(scene) when it cannot be read or has another size than the map.
Evidence read_evidence(const std::filesystem::path& path, const BakeFiles& bake);

/// error_code of the standard errors of V by monitor, 0 where nothing was measured. Each pixel has the largest of
/// `reduction` squared texels.
Image<glm::u8vec3> draw_errors(const Evidence& evidence, int reduction);

/// TexelState plus 8 times TexelMethod, by monitor; 0 without a monitor. Each pixel has the first of `reduction`
/// squared texels.
Image<glm::u8vec3> draw_states(const Evidence& evidence, int reduction);

/// sRGB codes of the map. Each pixel has the mean of `reduction` squared texels.
Image<glm::u8vec3> draw_map(const Image<Vec3f>& visibility, int reduction);

}  // namespace surimi
