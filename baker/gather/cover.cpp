// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/cover.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

constexpr double most_of_side = 0.02;    // of the shorter one; a bezel stands out farther, and its shadow counts
constexpr double least_cosine = 0.9998;  // one degree
constexpr int side = 16;                 // places along the panel's axes

double shorter_side(const Panel& panel) {
    return 2 * std::min(glm::length(panel.axis_s), glm::length(panel.axis_t));
}

bool is_on_panel(const Panel& panel, const Vec2& place) {
    for (size_t i = 0; i < panel.corners.size(); ++i) {
        const Vec2 &a = panel.corners[i], b = panel.corners[(i + 1) % panel.corners.size()];
        if ((b.x - a.x) * (place.y - a.y) - (b.y - a.y) * (place.x - a.x) < 0) return false;
    }
    return true;
}

/// The farthest of what lies flat over one place of the panel, layer by layer.
Cover cover_at(const RayScene& rays, const Panel& panel, size_t monitor, const Vec3& place) {
    const double most = most_of_side * shorter_side(panel);
    constexpr int most_layers = 8;
    Cover cover;
    double start = 0.5 * panel.clearance;
    for (int layer = 0; layer < most_layers; ++layer) {
        const auto hit = rays.closest_occluder(place + start * panel.normal, place + most * panel.normal, 1, monitor);
        if (!hit) break;
        const auto corners = rays.corners_of(*hit);
        const Vec3 normal = normalize_or(area_normal(corners[0], corners[1], corners[2]), Vec3(0));
        const double cosine = glm::dot(normal, panel.normal);
        if (!(std::abs(cosine) >= least_cosine)) break;
        const double height = glm::dot(normal, corners[0] - place) / cosine;
        if (!(height <= most)) break;
        cover = {std::max(cover.height, height), hit->surface};
        start = std::max(start, height) + panel.clearance;
    }
    return cover;
}

}  // namespace

Cover find_cover(const RayScene& rays, const Panel& panel, size_t monitor) {
    Cover highest;
    int covered = 0, all = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const Vec2 place(2 * (x + 0.5) / side - 1, 2 * (y + 0.5) / side - 1);
            if (!is_on_panel(panel, place)) continue;
            ++all;
            const Cover cover = cover_at(rays, panel, monitor, panel.at(place));
            if (!(cover.height > 0)) continue;
            ++covered;
            if (cover.height > highest.height) highest = cover;
        }
    return 2 * covered >= all ? highest : Cover{};
}

void clear_covers(const RayScene& rays, size_t monitor, std::span<Panel> panels) {
    for (Panel& panel : panels) {
        const Cover cover = find_cover(rays, panel, monitor);
        // Over it by as much as panels are cleared of what they are glued to.
        if (cover.height > 0) panel.clearance = cover.height + panel.clearance;
    }
}

std::vector<std::string> describe_covers(const Scene& scene, const RayScene& rays) {
    std::vector<std::string> lines;
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        Cover highest;
        for (const Panel& panel : panels_of(scene.monitors[m], rays)) {
            const Cover cover = find_cover(rays, panel, m);
            if (cover.height > highest.height) highest = cover;
        }
        if (!(highest.height > 0)) continue;
        const bool is_panel = highest.surface >= scene.surfaces.size();
        const std::string& name = is_panel ? scene.monitors[highest.surface - scene.surfaces.size()].name
                                           : scene.surfaces[highest.surface].name;
        lines.push_back(
            fmt::format("monitor {} is covered by {}, {:.2g} m in front of it: what lies so close does not block its "
                        "light (--without covers: it does)",
                        scene.monitors[m].name, name, highest.height));
    }
    return lines;
}

}  // namespace surimi
