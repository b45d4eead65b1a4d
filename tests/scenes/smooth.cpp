// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/smooth.h"

#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace surimi::test {
namespace {

/// At x = -2, shining along +x.
void add_side_monitor(Scene& scene) {
    add_monitor(scene, "Monitor_R", 0, {-2, 0.2, 0.3}, {0, 0, -0.6}, {0, 0.4, 0});
}

/// An open tube around the axis through `from`, of this length, with the normals of a round one. `u`, `v` and `axis`
/// are unit and right-handed.
struct Tube {
    Vec3 from{0}, axis{0, 1, 0}, u{0, 0, 1}, v{1, 0, 0};
    double radius = 0.5, length = 1;
    int sides = 8;

    Vec3 outwards(int side) const {
        const double angle = 2 * pi * (side % sides) / sides;
        return std::cos(angle) * u + std::sin(angle) * v;
    }
};

uint32_t add_tube(Scene& scene, const std::string& name, const Tube& tube) {
    Mesh mesh;
    std::vector<Vec3> normals;
    for (int i = 0; i < tube.sides; ++i)
        for (const double height : {0.0, tube.length}) {
            mesh.positions.push_back(tube.from + tube.radius * tube.outwards(i) + height * tube.axis);
            normals.push_back(tube.outwards(i));
        }
    for (int i = 0; i < tube.sides; ++i) {
        const auto a = static_cast<uint32_t>(2 * i), b = static_cast<uint32_t>(2 * ((i + 1) % tube.sides));
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
    }
    const uint32_t index = add_surface(scene, name, mesh);
    scene.surfaces[index].normals = normals;
    return index;
}

/// The two ends of a tube, flat.
void add_caps(Scene& scene, const Tube& tube) {
    for (const double height : {0.0, tube.length}) {
        Mesh cap;
        for (int i = 0; i < tube.sides; ++i)
            cap.positions.push_back(tube.from + tube.radius * tube.outwards(i) + height * tube.axis);
        for (uint32_t i = 1; i + 1 < static_cast<uint32_t>(tube.sides); ++i)
            cap.triangles.push_back(height > 0 ? std::array<uint32_t, 3>{0, i, i + 1}
                                               : std::array<uint32_t, 3>{0, i + 1, i});
        add_surface(scene, height > 0 ? "Top" : "Bottom", cap);
    }
}

}  // namespace

ArtefactScene smooth_cylinder(int sides) {
    ArtefactScene stage;
    Tube tube;
    tube.from = {0, -0.5, 0};
    tube.sides = sides;
    stage.surfaces = {add_tube(stage.scene, "Side", tube)};
    add_caps(stage.scene, tube);
    add_side_monitor(stage.scene);
    return stage;
}

ArtefactScene smooth_ball(int subdivisions) {
    ArtefactScene stage;
    const Mesh ball = ico_sphere(subdivisions);
    stage.surfaces = {add_surface(stage.scene, "Ball", scaled(ball, 0.5))};
    Surface& surface = stage.scene.surfaces[0];
    for (size_t i = 0; i < surface.positions.size(); ++i) surface.normals[i] = glm::normalize(surface.positions[i]);
    add_side_monitor(stage.scene);
    return stage;
}

ArtefactScene pipe_through_a_wall() {
    ArtefactScene stage;
    Tube pipe;
    pipe.from = {-1, 0, 0};
    pipe.axis = {1, 0, 0};
    pipe.u = {0, 1, 0};
    pipe.v = {0, 0, 1};
    pipe.radius = 0.2;
    pipe.length = 2;
    stage.surfaces = {add_tube(stage.scene, "Pipe", pipe)};
    const uint32_t wall = add_box(stage.scene, "Wall", {0.005, 0, 0}, {0.01, 8, 8});
    stage.solids = {solid_of(stage.scene, wall)};
    add_side_monitor(stage.scene);
    return stage;
}

ArtefactScene cylinder_against_a_wall() {
    ArtefactScene stage;
    Tube tube;
    tube.from = {0.5, -0.5, 0};
    tube.v = {1, 0, 0};
    stage.surfaces = {add_tube(stage.scene, "Side", tube)};
    add_quad(stage.scene, "Wall", {0, -4, -4}, {0, -4, 4}, {0, 4, 4}, {0, 4, -4});
    add_side_monitor(stage.scene);
    return stage;
}

}  // namespace surimi::test
