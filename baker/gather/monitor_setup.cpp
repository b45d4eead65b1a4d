// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/monitor_setup.h"

#include <algorithm>
#include <array>

#include "baker/gather/cover.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/texture.h"

namespace surimi {
namespace {

struct CutEdge {
    Edge edge;
    FacePlane plane;
};

/// The side that a triangle gets where the plane cuts it, if it does. Going around the triangle it leaves what is in
/// front at one place and comes back at the other: the part in front closes its outline from the first to the second.
void add_cut(const Panel& panel, const std::array<Vec3f, 3>& corners, uint32_t owner, std::vector<CutEdge>& found) {
    std::array<double, 3> heights{};
    for (size_t i = 0; i < 3; ++i) heights[i] = panel.height(Vec3(corners[i])) - panel.clearance;
    const auto [low, high] = std::ranges::minmax(heights);
    if (!(low < 0 && high >= 0)) return;
    Vec3 left(0), back(0);
    for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3;
        if ((heights[i] >= 0) == (heights[j] >= 0)) continue;
        const Vec3 a(corners[i]), b(corners[j]);
        const Vec3 crossing = a + (b - a) * (heights[i] / (heights[i] - heights[j]));
        (heights[i] >= 0 ? left : back) = crossing;
    }
    const Vec3 a(corners[0]);
    const Vec3 normal = normalize_or(area_normal(a, Vec3(corners[1]), Vec3(corners[2])), Vec3(0));
    if (normal == Vec3(0)) return;
    CutEdge cut;
    cut.edge.a = Vec3f(left);
    cut.edge.b = Vec3f(back);
    cut.edge.first_and_owner = owner << 30;
    cut.edge.second_and_sense = Edge::no_plane;
    cut.plane = {normal, glm::dot(normal, a)};
    if (cut.edge.a != cut.edge.b) found.push_back(cut);
}

}  // namespace

double MonitorSetup::largest_clearance() const {
    double largest = 0;
    for (const Panel& panel : panels) largest = std::max(largest, panel.clearance);
    return largest;
}

Silhouettes cut_edges(const Scene& scene, const RayScene& rays, const Panel& panel, size_t monitor) {
    std::vector<std::vector<CutEdge>> by_surface(scene.surfaces.size());
    parallel_for(scene.surfaces.size(), 1, [&](size_t s) {
        const Surface& surface = scene.surfaces[s];
        if (!surface.casts || surface.monitor == static_cast<int>(monitor) || is_cutout(scene, surface)) return;
        const uint32_t owner = surface.monitor < 0 ? Edge::ordinary : static_cast<uint32_t>(surface.monitor);
        for (const auto& triangle : surface.triangles) {
            std::array<Vec3f, 3> corners;
            for (size_t i = 0; i < 3; ++i) corners[i] = Vec3f(surface.positions[triangle[i]] - rays.center());
            add_cut(panel, corners, owner, by_surface[s]);
        }
    });
    Silhouettes cuts;
    cuts.center = rays.center();
    for (const auto& found : by_surface)
        for (CutEdge cut : found) {
            cut.edge.first_and_owner |= static_cast<uint32_t>(cuts.planes.size());
            cuts.planes.push_back(cut.plane);
            cuts.edges.push_back(cut.edge);
        }
    build_tree(cuts);
    return cuts;
}

MonitorSetup set_up(const Scene& scene, const RayScene& rays, const Silhouettes& silhouettes, size_t monitor,
                    const GatherSettings& settings) {
    const Monitor& light = scene.monitors[monitor];
    MonitorSetup setup{scene,
                       rays,
                       silhouettes,
                       monitor,
                       settings,
                       tolerances(settings),
                       panels_of(light, rays),
                       {},
                       MonitorSampler(light)};
    if (settings.clears_covers) clear_covers(rays, monitor, setup.panels);
    for (const Panel& panel : setup.panels) setup.cuts.push_back(cut_edges(scene, rays, panel, monitor));
    return setup;
}

}  // namespace surimi
