// SPDX-License-Identifier: Apache-2.0
#include "tests/scenes/screens.h"

#include "tests/support/scenes.h"

namespace surimi::test {
namespace {

constexpr double half_width = 0.8, half_height = 0.45;

/// A room of 4 x 2.5 x 4 m; its wall behind the monitor is at x = -2.
ArtefactScene room() {
    ArtefactScene stage;
    stage.surfaces = {add_box(stage.scene, "Room", {0, 1.25, 0}, {4, 2.5, 4}, true)};
    return stage;
}

void add_screen(Scene& scene, double x, double height) {
    add_monitor(scene, "Monitor_R", 0, {x, height, 0.1}, {0, 0, -half_width}, {0, half_height, 0});
}

int add_material(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

Material leaves() {
    Material material;
    material.name = "Leaves";
    material.double_sided = true;
    return material;
}

void set_material(Scene& scene, uint32_t surface, const Material& material) {
    scene.surfaces[surface].material = add_material(scene, material);
}

/// As the rules for roles have it for foliage: light on the back counts.
void make_leaf(Scene& scene, uint32_t surface, const Material& material) {
    set_material(scene, surface, material);
    scene.surfaces[surface].is_two_sided = true;
}

uint32_t add_floor(Scene& scene) {
    return add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
}

/// An upright card along the direction `along`, whose front looks to the left of it, seen from above.
uint32_t add_card(Scene& scene, const std::string& name, const Vec3& middle, const Vec3& along) {
    const Vec3 up(0, 0.4, 0);
    return add_quad(scene, name, middle - along, middle + along, middle + along + up, middle - along + up);
}

}  // namespace

ArtefactScene screen_on_a_wall(double gap) {
    ArtefactScene stage = room();
    add_screen(stage.scene, -2 + gap, 1.1);
    return stage;
}

ArtefactScene screen_behind(Cover cover) {
    ArtefactScene stage = room();
    const double x = -2 + 0.01, before = x + 0.002;
    const uint32_t plate =
        add_quad(stage.scene, cover == Cover::mesh ? "Screen_mesh" : "Screen_glass",
                 {before, 1.1 - half_height, 0.1 + half_width}, {before, 1.1 - half_height, 0.1 - half_width},
                 {before, 1.1 + half_height, 0.1 - half_width}, {before, 1.1 + half_height, 0.1 + half_width});
    Material material;
    material.name = "Cover";
    if (cover == Cover::glass) material.transmission = 1;
    set_material(stage.scene, plate, material);
    add_screen(stage.scene, x, 1.1);
    return stage;
}

ArtefactScene screen_on_the_floor() {
    ArtefactScene stage = room();
    add_screen(stage.scene, -0.53, half_height);
    return stage;
}

ArtefactScene card_with_a_hole() {
    ArtefactScene stage;
    Scene& scene = stage.scene;
    stage.surfaces = {add_floor(scene)};
    // Half the texture is open. Linear filtering crosses the cutoff in its very middle, at u = 0.5.
    Image<glm::u8vec4> image(64, 4, glm::u8vec4(255));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width / 2; ++x) image.at(x, y).a = 0;
    scene.images.push_back(image);
    Material material = leaves();
    material.alpha_mode = AlphaMode::mask;
    material.base_color_texture = {.image = 0, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};
    const double height = 1;
    const Vec3 a(-0.6, height, 0.45), b(0.8, height, 0.45), c(0.8, height, -0.35), d(-0.6, height, -0.35);
    stage.equal = scene;
    const uint32_t card = add_quad(scene, "Card", a, b, c, d);
    make_leaf(scene, card, material);
    scene.surfaces[card].uv_sets = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    add_quad(*stage.equal, "Half", 0.5 * (a + b), b, c, 0.5 * (d + c));
    for (Scene* some : {&scene, &*stage.equal})
        add_monitor(*some, "Monitor_R", 0, {0.1, 2.5, -0.05}, {0.6, 0, 0}, {0, 0, 0.4});
    return stage;
}

ArtefactScene cards_lit_from_behind() {
    ArtefactScene stage;
    Scene& scene = stage.scene;
    stage.surfaces = {add_floor(scene)};
    const Vec3 middle(0.1, 0, 0.05);
    // The monitor is at x = -2; fronts look along +x, more or less.
    for (const auto& [name, at, along] :
         {std::tuple{"Card_A", middle, Vec3(0.1, 0, -0.3)}, std::tuple{"Card_B", middle, Vec3(-0.1, 0, -0.3)},
          std::tuple{"Card_C", middle + Vec3(0.01, 0, 0), Vec3(0.1, 0, -0.3)}}) {
        stage.surfaces.push_back(add_card(scene, name, at, along));
        make_leaf(scene, stage.surfaces.back(), leaves());
    }
    add_monitor(scene, "Monitor_R", 0, {-2, 1, 0}, {0, 0, -0.6}, {0, 0.4, 0});
    return stage;
}

ArtefactScene card_lit_from_behind() {
    ArtefactScene stage;
    stage.surfaces = {add_card(stage.scene, "Card", {0.1, 0, 0.05}, {0.1, 0, -0.3})};
    make_leaf(stage.scene, stage.surfaces[0], leaves());
    add_monitor(stage.scene, "Monitor_R", 0, {-2, 1, 0}, {0, 0, -0.6}, {0, 0.4, 0});
    return stage;
}

}  // namespace surimi::test
