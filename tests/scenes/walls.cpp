// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/walls.h"

#include "tests/support/scenes.h"

namespace surimi::test {
namespace {

/// A monitor at x = -2 that shines along +x.
void add_side_monitor(Scene& scene) {
    add_monitor(scene, "Monitor_R", 0, {-2, 1, 0}, {0, 0, -0.6}, {0, 0.4, 0});
}

/// At a height of 2.5 m, shining down.
void add_ceiling_monitor(Scene& scene) {
    add_monitor(scene, "Monitor_R", 0, {0.1, 2.5, -0.05}, {0.6, 0, 0}, {0, 0, 0.4});
}

/// A floor of 4 m at y = 0 with solid ground below it.
uint32_t add_ground(ArtefactScene& stage) {
    const uint32_t floor = add_quad(stage.scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    stage.solids.push_back({floor, {-2, -2, -2}, {2, 0, 2}});
    stage.surfaces.push_back(floor);
    return floor;
}

/// A box that is full and is judged.
void add_solid_box(ArtefactScene& stage, const std::string& name, const Vec3& center, const Vec3& size) {
    stage.surfaces.push_back(add_box(stage.scene, name, center, size));
    stage.solids.push_back(solid_of(stage.scene, stage.surfaces.back()));
}

/// A box of 0.8 x 0.9 m that reaches from `low` to 0.7 m.
ArtefactScene box_and_floor(double low) {
    ArtefactScene stage;
    add_ground(stage);
    add_solid_box(stage, "Box", {0.3, 0.5 * (low + 0.7), 0.1}, {0.8, 0.7 - low, 0.9});
    add_side_monitor(stage.scene);
    return stage;
}

/// A wall of 3 x 2 m that faces +z, a poster of 1 x 0.7 m at z = `height`, and a monitor before them.
ArtefactScene wall_and_poster(double height) {
    ArtefactScene stage;
    const auto sheet = [&](const char* name, double x, double y, double z) {
        return add_quad(stage.scene, name, {-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z});
    };
    stage.surfaces = {sheet("Wall", 1.5, 1, 0), sheet("Poster", 0.5, 0.35, height)};
    add_monitor(stage.scene, "Monitor_R", 0, {0.1, 0.2, 2}, {-0.6, 0, 0}, {0, 0.4, 0});
    return stage;
}

}  // namespace

ArtefactScene two_rooms() {
    ArtefactScene stage;
    for (const double side : {-1.0, 1.0}) {
        const double center = side * (1.5 + 0.005);
        stage.surfaces.push_back(
            add_box(stage.scene, side < 0 ? "Lit room" : "Dark room", {center, 1.25, 0}, {3, 2.5, 4}, true));
    }
    add_monitor(stage.scene, "Monitor_R", 0, {-2.99, 1, 0}, {0, 0, -0.6}, {0, 0.4, 0});
    return stage;
}

ArtefactScene two_rooms_on_one_floor() {
    ArtefactScene stage;
    add_ground(stage);
    const uint32_t wall = add_box(stage.scene, "Wall", {0.012, 1.25, 0}, {0.01, 2.5, 4});
    stage.solids.push_back(solid_of(stage.scene, wall));
    add_side_monitor(stage.scene);
    return stage;
}

ArtefactScene closed_room(double thickness) {
    ArtefactScene stage;
    stage.surfaces.push_back(add_box(stage.scene, "Room", Vec3(0), {2, 2, 2}, true));
    if (thickness > 0) add_box(stage.scene, "Outside", Vec3(0), Vec3(2 + 2 * thickness));
    add_side_monitor(stage.scene);
    stage.scene = moved(stage.scene, Vec3(1, 2, 3), 0.7, 1, Vec3(0));
    return stage;
}

ArtefactScene box_sunk_into_a_floor() {
    return box_and_floor(-0.3);
}

ArtefactScene box_upon_a_floor() {
    return box_and_floor(0);
}

ArtefactScene boxes_that_interpenetrate() {
    ArtefactScene stage;
    add_solid_box(stage, "Box_A", {0, 0.5, 0}, {1, 1, 1});
    add_solid_box(stage, "Box_B", {0.45, 0.6, 0.35}, {0.9, 0.7, 0.83});
    add_side_monitor(stage.scene);
    return stage;
}

ArtefactScene boxes_in_a_row() {
    ArtefactScene stage;
    for (int i = 0; i < 3; ++i)
        add_solid_box(stage, "Box_" + std::to_string(i), {0, 0.25, 0.5 * i - 0.5}, {0.5, 0.5, 0.5});
    add_ceiling_monitor(stage.scene);
    return stage;
}

ArtefactScene rug_in_the_plane_of_a_floor() {
    ArtefactScene stage;
    stage.surfaces.push_back(add_quad(stage.scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}));
    stage.surfaces.push_back(
        add_quad(stage.scene, "Rug", {-0.7, 0, 0.5}, {0.6, 0, 0.5}, {0.6, 0, -0.4}, {-0.7, 0, -0.4}));
    add_ceiling_monitor(stage.scene);
    return stage;
}

ArtefactScene poster_behind_a_wall() {
    ArtefactScene stage = wall_and_poster(-0.001);
    stage.solids.push_back({stage.surfaces[0], {-1.5, -1, -1}, {1.5, 1, 0}});
    return stage;
}

ArtefactScene poster_before_a_wall() {
    ArtefactScene stage = wall_and_poster(0.001);
    stage.solids.push_back({stage.surfaces[1], {-0.5, -0.35, 0}, {0.5, 0.35, 0.001}});
    return stage;
}

}  // namespace surimi::test
