// SPDX-License-Identifier: Apache-2.0
#include "baker/reach.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "baker/gather/block_light.h"
#include "baker/gather/blocks.h"
#include "baker/gather/cost.h"
#include "baker/gather/monitor_setup.h"

namespace surimi {
namespace {

double area_of(std::span<const Vec3> polygon) {
    Vec3 sum(0);
    for (size_t i = 2; i < polygon.size(); ++i) sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return glm::length(sum) / 2;
}

/// The part of a convex polygon on one side of a panel's plane (Sutherland and Hodgman 1974); side 1: in front.
std::vector<Vec3> part_of(std::span<const Vec3> polygon, const Panel& panel, double side) {
    std::vector<Vec3> part;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double height_a = side * panel.height(a), height_b = side * panel.height(b);
        if (height_a > 0) part.push_back(a);
        if ((height_a > 0) != (height_b > 0)) part.push_back(a + height_a / (height_a - height_b) * (b - a));
    }
    return part;
}

/// From a point to a convex polygon with this unit normal, metres.
double distance_to(const Vec3& point, std::span<const Vec3> polygon, const Vec3& normal) {
    double to_edges = INFINITY;
    bool is_over = true;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        to_edges = std::min(to_edges, distance_to_segment(point, a, b));
        is_over = is_over && glm::dot(glm::cross(normal, b - a), point - a) >= 0;
    }
    return is_over && !polygon.empty() ? std::abs(glm::dot(point - polygon[0], normal)) : to_edges;
}

/// A triangle, relative to RayScene::center().
struct Face {
    std::array<Vec3, 3> corners;
    Vec3 normal;
};

bool is_above_horizon(const Panel& panel, const Vec3& point, const Vec3& normal) {
    return std::ranges::any_of(panel.places, [&](const Vec3& place) { return glm::dot(place - point, normal) > 0; });
}

/// Adds the area in front of the panels to reach.facing, and the distances. What is left behind one panel may still
/// be in front of the next.
void add_face(const Face& face, const std::vector<Panel>& panels, Reach& reach) {
    std::vector<Vec3> rest(face.corners.begin(), face.corners.end());
    for (const Panel& panel : panels) {
        if (!is_above_horizon(panel, face.corners[0], face.normal)) continue;
        const std::vector<Vec3> part = part_of(face.corners, panel, 1);
        if (!(area_of(part) > 0)) continue;
        reach.nearest = std::min(reach.nearest, distance_to(panel.center, part, face.normal));
        for (const Vec3& corner : part) reach.farthest = std::max(reach.farthest, glm::length(corner - panel.center));
        rest = part_of(rest, panel, -1);
    }
    reach.facing += area_of(face.corners) - area_of(rest);
}

Reach facing_of(const Surface& surface, const std::vector<Panel>& panels, const Vec3& center) {
    Reach reach;
    reach.nearest = INFINITY;
    double area = 0;
    for (const auto& [i, j, k] : surface.triangles) {
        const Vec3 &a = surface.positions[i], &b = surface.positions[j], &c = surface.positions[k];
        const Face face{{a - center, b - center, c - center}, normalize_or(area_normal(a, b, c), surface.normals[i])};
        area += area_of(face.corners);
        add_face(face, panels, reach);
    }
    reach.facing = area > 0 ? std::clamp(reach.facing / area, 0.0, 1.0) : 0;
    if (!(reach.farthest > 0)) reach.nearest = 0;
    return reach;
}

/// A block to look at and the surface that it is of.
struct Look {
    uint32_t surface = 0;
    uint32_t page = 0;
    uint32_t block = 0;
};

/// Four of each surface and a sixteenth of the rest, evenly spaced in the map's order.
std::vector<Look> choose_blocks(const Scene& scene, const Preparation& preparation, const std::vector<Blocks>& blocks) {
    std::vector<std::vector<Look>> of_surface(scene.surfaces.size());
    for (uint32_t page = 0; page < blocks.size(); ++page)
        for (uint32_t b = 0; b < blocks[page].count(); ++b) {
            const Texel& texel = preparation.texels[page].texels[blocks[page][b].front()];
            const uint32_t surface = preparation.atlas.charts[texel.chart].surface;
            of_surface[surface].push_back({surface, page, b});
        }
    std::vector<Look> looks;
    for (const auto& all : of_surface) {
        const size_t count = std::min(all.size(), 4 + all.size() / 16);
        for (size_t i = 0; i < count; ++i) looks.push_back(all[(2 * i + 1) * all.size() / (2 * count)]);
    }
    return looks;
}

bool is_lit(const MonitorSetup& setup, const BlockSurfaces& block) {
    return std::ranges::any_of(block.centers, [&](const SurfacePoint& point) {
        const Vec3 place = point.position - setup.rays.center();
        return std::ranges::any_of(setup.panels, [&](const Panel& panel) {
            return panel.height(place) > 0 && is_above_horizon(panel, place, point.normal);
        });
    });
}

/// As the engine will see it (block_light.cpp).
BlockCounts count_block(const MonitorSetup& setup, const BlockSurfaces& block, BlockSight& sight) {
    BlockCounts counts;
    counts.seen = 1;
    if (is_lit(setup, block))
        look_from(sight, setup, block.corners, block.texel_size);
    else
        sight.count = 0;
    const GatherSettings& settings = setup.settings;
    if (sight.count == 0) {
        counts.unlit = 1;
        return counts;
    }
    counts.candidates = sight.candidates();
    if (sight.is_hidden())
        counts.hidden = 1;
    else if (sight.has_cutouts)
        counts.cutouts = 1;
    else if (settings.method == Method::monte_carlo)
        counts.crowded = 1;
    else if (counts.candidates == 0)
        counts.open = 1;
    else if (are_rays_cheaper(counts.candidates, settings))
        counts.crowded = 1;
    else
        counts.silhouettes = 1;
    return counts;
}

}  // namespace

void BlockCounts::add(const BlockCounts& other) {
    seen += other.seen;
    unlit += other.unlit;
    hidden += other.hidden;
    open += other.open;
    silhouettes += other.silhouettes;
    cutouts += other.cutouts;
    crowded += other.crowded;
    candidates += other.candidates;
}

std::vector<Reach> find_reach(const Scene& scene, const Preparation& preparation, size_t monitor,
                              const GatherSettings& settings) {
    const MonitorSetup setup = set_up(scene, *preparation.rays, preparation.silhouettes, monitor, settings);
    std::vector<Reach> reach(scene.surfaces.size());
    parallel_for(reach.size(), 1, [&](size_t s) {
        const Surface& surface = scene.surfaces[s];
        if (surface.receives) reach[s] = facing_of(surface, setup.panels, preparation.rays->center());
    });
    std::vector<Blocks> blocks;
    for (const Texels& texels : preparation.texels) blocks.push_back(find_blocks(texels));
    const std::vector<Look> looks = choose_blocks(scene, preparation, blocks);
    std::vector<BlockCounts> counts(looks.size());
    parallel_for(looks.size(), 8, [&](size_t i) {
        thread_local BlockSight sight;
        const std::span<const uint32_t> members = blocks[looks[i].page][looks[i].block];
        const BlockSurfaces surfaces =
            block_surfaces(setup, preparation.atlas, preparation.texels[looks[i].page], members);
        counts[i] = count_block(setup, surfaces, sight);
    });
    for (size_t i = 0; i < looks.size(); ++i) reach[looks[i].surface].blocks.add(counts[i]);
    return reach;
}

}  // namespace surimi
