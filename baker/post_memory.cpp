// SPDX-License-Identifier: Apache-2.0
#include "baker/post_memory.h"

#include <algorithm>
#include <bit>

#include "baker/gather/gather.h"
#include "baker/gather/panel.h"
#include "baker/post/bilinear_fit.h"
#include "baker/post/growth.h"
#include "baker/post/near_texels.h"
#include "baker/post/rim.h"
#include "baker/post/stitch_parts.h"

namespace surimi {
namespace {

// As in fill.cpp.
constexpr int target_rings = 4, source_rings = 2;
constexpr int rows_at_a_time = 64;
// A node of the k-d tree for about 3.5 places, and the place's number.
constexpr size_t bytes_of_place_in_tree = sizeof(TexelPlace) + 16;
// Links, equations, both triangles of the matrix and its factor: 240 to 340 measured in rooms, see docs/decisions.md.
constexpr size_t bytes_of_seam_place = 400;

/// For each page, 1 for each of its texels that the monitor lights.
using LitTexels = std::vector<std::vector<uint8_t>>;

bool is_lit(const Vec3& place, const Vec3& normal, const std::vector<Panel>& panels) {
    return std::ranges::any_of(panels, [&](const Panel& panel) {
        return panel.is_before(place) && std::ranges::any_of(panel.places, [&](const Vec3& corner) {
                   return glm::dot(corner - place, normal) > 0;
               });
    });
}

/// By surface and triangle: is any corner lit?
std::vector<std::vector<uint8_t>> lit_triangles(const Scene& scene, const RayScene& rays, size_t monitor) {
    const std::vector<Panel> panels = panels_of(scene.monitors[monitor], rays);
    std::vector<std::vector<uint8_t>> lit;
    for (const Surface& surface : scene.surfaces) {
        std::vector<uint8_t>& of_surface = lit.emplace_back();
        for (const auto& corners : surface.triangles)
            of_surface.push_back(std::ranges::any_of(corners, [&](uint32_t v) {
                return is_lit(surface.positions[v] - rays.center(), surface.normals[v], panels);
            }));
    }
    return lit;
}

LitTexels lit_texels(const Scene& scene, const Preparation& preparation, size_t monitor) {
    const auto triangles = lit_triangles(scene, *preparation.rays, monitor);
    LitTexels lit;
    for (const Texels& page : preparation.texels) {
        std::vector<uint8_t>& of_page = lit.emplace_back(page.texels.size());
        for (size_t i = 0; i < of_page.size(); ++i) {
            const Texel& texel = page.texels[i];
            of_page[i] = !texel.is_inside() &&
                         (texel.may_turn || std::ranges::any_of(page.triangles_of(texel), [&](const TriangleRef& t) {
                              return triangles[t.surface][t.triangle] != 0;
                          }));
        }
    }
    return lit;
}

/// How many texels take part in fill_in_space().
struct RimCounts {
    size_t sources = 0, targets = 0;
};

/// In rows of one page, which are looked at with the rows around them.
RimCounts count_rims(const Texels& page, const std::vector<uint8_t>& lit, const std::vector<uint8_t>& has_lit,
                     const Rows& rows) {
    const Rows around{std::max(0, rows.begin - target_rings), std::min(page.height, rows.end + target_rings)};
    const size_t first = static_cast<size_t>(around.begin) * static_cast<size_t>(page.width);
    const size_t places = static_cast<size_t>(around.end - around.begin) * static_cast<size_t>(page.width);
    std::vector<uint64_t> kinds(places, ~uint64_t{0});
    std::vector<uint8_t> is_covered(places, 0);
    const Numbers at_hand = numbers_in(page, around), own = numbers_in(page, rows);
    for (size_t i = at_hand.begin; i < at_hand.end; ++i) {
        const size_t place = page.texels[i].index - first;
        kinds[place] = uint64_t{page.texels[i].chart} << 1 | lit[i];
        is_covered[place] = lit[i];
    }
    const std::vector<uint8_t> is_source = rim(kinds, page.width, source_rings);
    const std::vector<uint8_t> is_target = spread(std::move(is_covered), page.width, target_rings);
    RimCounts counts;
    for (size_t i = own.begin; i < own.end; ++i) {
        const size_t place = page.texels[i].index - first;
        if (lit[i])
            counts.sources += is_source[place];
        else if (has_lit[page.texels[i].chart])
            counts.targets += is_target[place];
    }
    return counts;
}

RimCounts count_rims(const Preparation& preparation, const LitTexels& lit) {
    std::vector<uint8_t> has_lit(preparation.atlas.charts.size(), 0);  // by chart
    for (size_t p = 0; p < lit.size(); ++p)
        for (size_t i = 0; i < lit[p].size(); ++i)
            if (lit[p][i]) has_lit[preparation.texels[p].texels[i].chart] = 1;
    RimCounts all;
    for (size_t p = 0; p < lit.size(); ++p) {
        const Texels& page = preparation.texels[p];
        for (int begin = 0; begin < page.height; begin += rows_at_a_time) {
            const Rows rows{begin, std::min(begin + rows_at_a_time, page.height)};
            const RimCounts counts = count_rims(page, lit[p], has_lit, rows);
            all.sources += counts.sources;
            all.targets += counts.targets;
        }
    }
    return all;
}

/// What grow() holds from `owned` texels on.
size_t growth_bytes(size_t map, size_t owned) {
    return map * sizeof(int) + grown_bytes(owned, sizeof(size_t));
}

size_t fill_bytes(const Preparation& preparation, const LitTexels& lit, const PostSettings& settings) {
    const size_t map = static_cast<size_t>(preparation.atlas.width) * static_cast<size_t>(preparation.atlas.height);
    const size_t pages = preparation.texels.size();
    size_t most_lit = 0;  // of a page
    for (const auto& of_page : lit)
        most_lit = std::max(most_lit, static_cast<size_t>(std::ranges::count(of_page, uint8_t{1})));
    size_t most = std::max(growth_bytes(map, most_lit), 2 * map);
    if (settings.fills_in_space) {
        const RimCounts rims = count_rims(preparation, lit);
        const size_t lists = grown_bytes(rims.sources, 8) + grown_bytes(rims.targets, 8);
        const size_t kinds = map * (sizeof(uint64_t) + 2);
        const size_t places = rims.sources * bytes_of_place_in_tree + rims.targets * (sizeof(TexelPlace) + 8);
        most = std::max(most, lists + std::max(kinds, rims.targets > 0 ? places : 0));
    }
    return pages * map * 2 * sizeof(uint32_t) + most;  // chart and owner
}

size_t gutter_bytes(const Texels& texels) {
    const size_t map = static_cast<size_t>(texels.width) * static_cast<size_t>(texels.height);
    return map * (sizeof(uint32_t) + 1) + growth_bytes(map, texels.texels.size());
}

size_t stitch_bytes(const Seams& seams) {
    size_t places = 0;
    for (const SeamPiece& piece : seams.pieces) places += steps_of(piece) + 1;
    return places * bytes_of_seam_place;
}

}  // namespace

size_t grown_bytes(size_t count, size_t of_item) {
    return std::bit_ceil(count) * of_item;
}

size_t post_bytes(const Scene& scene, const Preparation& preparation, size_t monitor, const PostSettings& settings) {
    size_t most = fill_bytes(preparation, lit_texels(scene, preparation, monitor), settings);
    for (const Texels& page : preparation.texels) {
        most = std::max(most, gutter_bytes(page));
        if (settings.fit == Fit::bilinear) most = std::max(most, bilinear_fit_bytes(page));
    }
    return std::max(most, stitch_bytes(preparation.seams));
}

size_t audit_bytes(const Texels& texels) {
    const size_t count = texels.texels.size();
    return count * sizeof(IrradianceEstimate) + grown_bytes(count, 2 * sizeof(uint64_t));  // tickets
}

}  // namespace surimi
