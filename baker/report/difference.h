// SPDX-License-Identifier: Apache-2.0
// A map against a reference: signed difference, texel by texel, and its distribution.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "baker/report/evidence_planes.h"

namespace surimi {

/// V of R, G, B on one page; NaN where the reference has no value.
using ReferenceMap = Image<Vec3f>;

/// Reads a reference: the map of another bake (R, G, B) or its lightmaps (where the light on a texel was measured).
/// Throws Error(scene) when it can be read as neither, and Error(usage) when it has another size than the map.
ReferenceMap read_reference(const std::filesystem::path& path, const BakeFiles& bake);

/// difference_code of map - reference by monitor where `evidence` covers the texel and the reference has a value, else
/// 0. Each pixel has the largest of `reduction` squared texels, whatever its sign.
Image<glm::u8vec3> draw_difference(const Image<Vec3f>& map, const ReferenceMap& reference, const Evidence& evidence,
                                   int reduction);

/// A page that is compared.
struct ComparedPage {
    const Image<Vec3f>& map;
    const ReferenceMap& reference;
    const Evidence& evidence;
};

/// By channel: texels compared, RMSE, bias, percentiles, the largest difference and its place, the share beyond
/// `error`, and the histogram of the signed difference in equal bins from -range to range, the outer ones holding all
/// beyond. Channels without compared texels are left out.
nlohmann::ordered_json difference_section(const std::vector<ComparedPage>& pages, const BakeFiles& bake, double error);

}  // namespace surimi
