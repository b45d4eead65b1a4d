// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/block_sight.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

Vec3 middle_of(std::span<const Vec3> corners) {
    Vec3 sum(0);
    for (const Vec3& corner : corners) sum += corner;
    return sum / static_cast<double>(corners.size());
}

/// Does the plane have all of the block on one side and the ends of all rays on the other? They end at the clearance
/// before the panel: of a facet that comes closer to it than that, a part hides nothing.
bool separates(const FacePlane& plane, const Shaft& shaft, const Panel& panel) {
    const auto height = [&](const Vec3& p) { return glm::dot(plane.normal, p) - plane.distance; };
    const double side = height(shaft.block.front()) > 0 ? 1 : -1;
    double nearest = INFINITY, farthest = 0, lowest = INFINITY, behind = -INFINITY;
    for (const Vec3& p : shaft.block) {
        nearest = std::min(nearest, side * height(p));
        farthest = std::max(farthest, side * height(p));
        lowest = std::min(lowest, panel.height(p));
    }
    for (const Vec3& q : shaft.panel) behind = std::max(behind, side * height(q));
    if (!(nearest > shaft.margin) || !(lowest > panel.clearance)) return false;
    const double share = panel.clearance / lowest;  // of the way that is left at a ray's end, at most
    return behind * (1 - share) + farthest * share < -shaft.margin;
}

/// The certificate of (M51): the facet that the ray between the middles meets hides everything from everywhere.
bool is_hidden_by_facet(const MonitorSetup& setup, const Panel& panel, const Shaft& shaft) {
    const Vec3 origin = middle_of(shaft.block);
    const auto hit = setup.rays.closest_occluder(origin, panel.center, end_of_rays(panel, origin), setup.monitor);
    if (!hit || hit->surface >= setup.silhouettes.plane_of.size()) return false;
    const uint32_t plane = setup.silhouettes.plane_of[hit->surface][hit->triangle];
    if (plane == Edge::no_plane) return false;
    return separates(setup.silhouettes.planes[plane], shaft, panel) && !meets_rim(setup.silhouettes, shaft, plane);
}

/// Candidates so close to the block that moving by an eighth of a texel moves their shadows by half the panel or more:
/// between the middles of four cells of a texel such a shadow could go unseen.
void find_near(PanelSight& sight, const Vec3& middle, double texel_size) {
    const Panel& panel = *sight.panel;
    const double reach = std::min(glm::length(panel.axis_s), glm::length(panel.axis_t));
    // (1 - w) / w > reach / (texel / 8), w: height over the block as a share of the way to the panel
    const double nearest = 1 / (1 + 8 * reach / texel_size);
    const double height = panel.height(middle);
    sight.near.clear();
    const Candidates& c = sight.candidates;
    const auto way = [&](const Vec3& place) { return 1 - panel.height(place) / height; };
    for (size_t i = 0; i < c.count; ++i)
        if (way({c.ax[i], c.ay[i], c.az[i]}) < nearest || way({c.bx[i], c.by[i], c.bz[i]}) < nearest)
            sight.near.push_back(i);
}

/// Cut edges are stored as float. Off the plane of the clearance, what is rounded moves as far as a grazing view
/// reaches; so they are put back on the line in which their triangle meets that plane.
void put_on_lines(Candidates& c, size_t first_cut, const Panel& panel) {
    for (size_t i = first_cut; i < c.ax.size(); ++i) {
        const Vec3 n(c.nx[i], c.ny[i], c.nz[i]);
        const double cosine = glm::dot(n, panel.normal), sine2 = 1 - cosine * cosine;
        if (!(sine2 > 1e-6)) continue;
        const auto move = [&](double& x, double& y, double& z) {
            const Vec3 p(x, y, z);
            const double f = glm::dot(n, p) - c.nd[i], g = panel.height(p) - panel.clearance;
            const Vec3 moved = p - ((f - cosine * g) * n + (g - cosine * f) * panel.normal) / sine2;
            x = moved.x, y = moved.y, z = moved.z;
        };
        move(c.ax[i], c.ay[i], c.az[i]);
        move(c.bx[i], c.by[i], c.bz[i]);
    }
}

void look_at_panel(BlockSight& block, PanelSight& sight, const MonitorSetup& setup, size_t panel_index,
                   const Shaft& shaft) {
    sight.is_hidden = is_hidden_by_facet(setup, *sight.panel, shaft);
    sight.candidates.assign(setup.silhouettes, {});
    if (sight.is_hidden) return;
    find_candidates(setup.silhouettes, shaft, setup.monitor, block.found);
    sight.candidates.assign(setup.silhouettes, block.found);
    sight.candidates.finish();
    sight.first_cut = sight.candidates.ax.size();
    const Silhouettes& cuts = setup.cuts[panel_index];
    if (!cuts.nodes.empty()) {
        find_candidates(cuts, shaft, setup.monitor, block.found);
        sight.candidates.append(cuts, block.found);
        put_on_lines(sight.candidates, sight.first_cut, *sight.panel);
        sight.candidates.finish();
    }
}

}  // namespace

size_t BlockSight::candidates() const {
    size_t sum = 0;
    for (size_t i = 0; i < count; ++i) sum += panels[i].candidates.count;
    return sum;
}

bool BlockSight::is_hidden() const {
    return std::all_of(panels.begin(), panels.begin() + static_cast<std::ptrdiff_t>(count),
                       [](const PanelSight& panel) { return panel.is_hidden; });
}

size_t look_from(BlockSight& sight, const MonitorSetup& setup, std::span<const Vec3> corners, double texel_size) {
    sight.count = 0;
    sight.texel_size = texel_size;
    sight.has_cutouts = false;
    double scale = 0;
    for (const Vec3& corner : corners) scale = std::max(scale, largest_component(corner));
    size_t rays = 0;
    for (size_t i = 0; i < setup.panels.size(); ++i) {
        const Panel& panel = setup.panels[i];
        if (std::ranges::all_of(corners, [&](const Vec3& corner) { return !panel.is_before(corner); })) continue;
        if (sight.panels.size() == sight.count) sight.panels.emplace_back();
        PanelSight& panel_sight = sight.panels[sight.count++];
        panel_sight.panel = &panel;
        for (const Vec3& place : panel.places) scale = std::max(scale, largest_component(place));
        const Shaft shaft = make_shaft(corners, panel.places, scale);
        look_at_panel(sight, panel_sight, setup, i, shaft);
        ++rays;  // of the certificate
        if (!panel_sight.is_hidden) {
            sight.has_cutouts = sight.has_cutouts || meets_cutout(setup.silhouettes, shaft);
            find_near(panel_sight, middle_of(corners), texel_size);
        }
    }
    return rays;
}

}  // namespace surimi
