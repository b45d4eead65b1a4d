// SPDX-License-Identifier: Apache-2.0
#include "baker/report/atlas_planes.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "baker/report/codes.h"
#include "baker/unwrap/coverage.h"
#include "baker/write/paint.h"

namespace surimi {
namespace {

constexpr uint8_t smooth_side = 255, other_side = 128;

/// Density and stretch of one triangle, as codes.
glm::u8vec3 codes_of(const Scene& scene, const Atlas& atlas, const TriangleRef& ref, double density_high) {
    const Stretch stretch = stretch_of(scene, atlas, ref.surface, ref.triangle);
    const double density = atlas.charts[atlas.surfaces[ref.surface].chart[ref.triangle]].texels_per_metre;
    const bool has_shape = stretch.smallest > 0 && density > 0;
    const double worst = has_shape ? std::max(stretch.largest * density, 1 / (stretch.smallest * density)) : 1;
    return {linear_code(stretch.largest > 0 ? 1 / stretch.largest : 0, 0, density_high),
            linear_code(worst, 1, stretch_high), 0};
}

}  // namespace

Image<glm::u8vec3> draw_atlas(const Scene& scene, const Atlas& atlas, int page, double density_high, int reduction) {
    const glm::ivec2 size = glm::max(glm::ivec2(atlas.width, atlas.height) / reduction, glm::ivec2(1));
    Image<glm::u8vec3> picture(size.x, size.y, glm::u8vec3(0));
    const PlacedTriangles placed = place_triangles(atlas, page, size);
    paint(
        placed, [&](size_t i) { return codes_of(scene, atlas, placed.source[i], density_high); }, picture);
    Image<uint8_t> sides(size.x, size.y, 0);
    const std::vector<ChartSide> all = chart_sides(scene, atlas);
    for (const bool is_smooth : {false, true})  // those that show on top
        for (const ChartSide& side : all) {
            const SurfaceUv& surface = atlas.surfaces[side.triangle.surface];
            if (side.is_smooth != is_smooth || surface.page != page) continue;
            const auto& uv = surface.uv[side.triangle.triangle];
            draw_line(Vec2(uv[side.corner]) * Vec2(size), Vec2(uv[(side.corner + 1) % 3]) * Vec2(size),
                      is_smooth ? smooth_side : other_side, sides);
        }
    for (size_t i = 0; i < sides.pixels.size(); ++i) picture.pixels[i].z = sides.pixels[i];
    return picture;
}

nlohmann::ordered_json atlas_section(const Atlas& atlas, const UnwrapNumbers& numbers) {
    return {
        {"charts", atlas.charts.size()},
        {"triangles", numbers.triangles},
        {"squareMetres", numbers.area},
        {"texelsPerMetre", {{"p1", numbers.density_p1}, {"p50", numbers.density_p50}, {"p99", numbers.density_p99}}},
        {"l2Stretch", numbers.l2_stretch},
        {"smoothSeamMetres", numbers.smooth_seam_length},
        {"seamMetres", numbers.seam_length},
        {"touchedShare", numbers.touched_share},
        {"densityHigh", numbers.density_p99},
        {"stretchHigh", stretch_high}};
}

}  // namespace surimi
