// SPDX-License-Identifier: Apache-2.0
// A monitor over random occluders as points below see it: what the tests of projection, lines and splitting share.
#pragma once

#include <numeric>

#include "baker/gather/monitor_setup.h"
#include "baker/gather/segments.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi::test {

/// A five-cornered monitor 2.5 m above the floor, and quads and boxes between the two.
inline Scene occluded_scene(uint64_t seed, int quads, int boxes) {
    Scene scene;
    add_quad(scene, "Floor", {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3});
    Monitor monitor;
    monitor.name = "Pentagon";
    monitor.panels.resize(1);
    for (const Vec2& c : {Vec2(-0.8, -0.4), Vec2(0.7, -0.5), Vec2(0.9, 0.1), Vec2(0.1, 0.6), Vec2(-0.7, 0.4)})
        monitor.panels[0].corners.emplace_back(c.x, 2.5 + 0.1 * c.x - 0.05 * c.y, c.y);  // its front is below
    scene.monitors.push_back(monitor);
    Choice choice{Random{seed}};
    for (int i = 0; i < quads; ++i) {
        const Vec3 center(choice.between(-0.7, 0.7), choice.between(0.6, 1.8), choice.between(-0.7, 0.7));
        const Vec3 u = choice.between(0.05, 0.5) * choice.direction();
        const Vec3 v = choice.between(0.05, 0.5) * normalize_or(glm::cross(u, choice.direction()), {1, 0, 0});
        add_quad(scene, "Quad", center - u - v, center + u - v, center + u + v, center - u + v);
    }
    for (int i = 0; i < boxes; ++i)
        add_box(scene, "Box", {choice.between(-0.7, 0.7), choice.between(0.6, 1.8), choice.between(-0.7, 0.7)},
                Vec3(0.1) + 0.4 * glm::abs(choice.vector()));
    return scene;
}

/// The monitor of such a scene as seen from a point, with all edges of the scene as candidates.
struct SeenPanel {
    explicit SeenPanel(Scene from) : scene(std::move(from)), rays(scene), silhouettes(find_silhouettes(scene, rays)) {
        panel = panels_of(scene.monitors[0], rays)[0];
        std::vector<uint32_t> all(silhouettes.edges.size());
        std::iota(all.begin(), all.end(), 0u);
        candidates.assign(silhouettes, all);
        candidates.finish();
        first_cut = candidates.ax.size();
        const Silhouettes cuts = cut_edges(scene, rays, panel, 0);
        all.resize(cuts.edges.size());
        std::iota(all.begin(), all.end(), 0u);
        candidates.append(cuts, all);
        candidates.finish();
    }
    /// From a place of the scene's coordinates.
    void look_from(const Vec3& place, const Vec3& normal) {
        look_at(view, panel, place - rays.center(), normal, normal);
        project(candidates, first_cut, view, segments);
    }
    /// Some place under the monitor, with a normal that leans by `tilt`.
    void look_from_below(Choice& choice, double tilt) {
        const Vec3 normal = normalize_or(Vec3(0, 1, 0) + tilt * choice.vector(), {0, 1, 0});
        const double x = choice.between(-1.5, 1.5), z = choice.between(-1.5, 1.5);
        look_from({x, 0.01, z}, normal);
    }

    Scene scene;
    RayScene rays;
    Silhouettes silhouettes;
    Panel panel;
    Candidates candidates;
    size_t first_cut = 0;
    PanelView view;
    Segments segments;
};

}  // namespace surimi::test
