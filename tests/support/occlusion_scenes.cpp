// SPDX-License-Identifier: Apache-2.0
#include "tests/support/occlusion_scenes.h"

#include <cmath>
#include <stdexcept>

#include "tests/support/meshes.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi::test {
namespace {

/// The study has z up.
Vec3 at(double x, double y, double z) {
    return {x, z, -y};
}

/// x, y, z of the mesh along these axes, from `center`.
Mesh placed(Mesh mesh, const Vec3& center, const Vec3& x, const Vec3& y, const Vec3& z) {
    for (Vec3& p : mesh.positions) p = center + p.x * x + p.y * y + p.z * z;
    return mesh;
}

/// A box of the half extents `half` of the study's axes, turned about its vertical.
Mesh turned_box(const Vec3& center, const Vec3& half, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return placed(box(Vec3(0), 2.0 * half), center, at(c, s, 0), at(-s, c, 0), at(0, 0, 1));
}

Mesh parallelogram(const Vec3& corner, const Vec3& u, const Vec3& v) {
    return {{corner, corner + u, corner + u + v, corner + v}, {{0, 1, 2}, {0, 2, 3}}};
}

Mesh pillar(double x, double y, double radius, double height, int segments) {
    return placed(capped_cylinder(segments), at(x, y, 0), at(radius / 0.3, 0, 0), at(0, radius / 0.3, 0),
                  at(0, 0, height / 4));
}

Mesh noisy_blob(const Vec3& center, double radius, double noise, double phase) {
    Mesh mesh = ico_sphere(6);
    for (Vec3& p : mesh.positions) {
        double bump = 0, frequency = 3, amplitude = noise;
        for (int octave = 0; octave < 4; ++octave, frequency *= 2.1, amplitude *= 0.5)
            bump += amplitude * std::sin(frequency * p.x + phase + octave) *
                    std::sin(1.1 * frequency * p.y + 2 * phase) * std::sin(0.9 * frequency * p.z + 3 * phase + octave);
        p = center + radius * (1 + bump) * p;
    }
    return mesh;
}

void add(Mesh& mesh, const Mesh& other) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

std::string numbered(const std::string& name, int number) {
    return name + "_" + std::to_string(number);
}

void add_room(Scene& scene) {
    add_box(scene, "Plain_Room", at(0, 0, 1.75), {10, 3.5, 10}, true);
    add_monitor(scene, "Monitor_R", 0, at(0, 4.95, 2), at(1.6, 0, 0), at(0, 0, 0.9));
    add_monitor(scene, "Monitor_G", 1, at(-1, -1, 3.45), at(0, 0.6, 0), at(0.6, 0, 0));
    add_monitor(scene, "Monitor_B", 2, at(-4.9, -2, 1.1), at(0, 0.3, 0), at(0, 0, 0.17));
}

void add_furniture(Scene& scene, Choice& choice) {
    for (int i = 0; i < 24; ++i) {
        const double x = choice.between(-4.3, 4.3), y = choice.between(-4.3, 3.7), half = choice.between(0.15, 0.65);
        const Vec3 extent(choice.between(0.1, 0.4), choice.between(0.1, 0.4), half);
        const double angle = i % 3 == 0 ? choice.between(0, 3) : 0;
        add_surface(scene, numbered("Plain_Box", i), turned_box(at(x, y, half), extent, angle));
    }
    for (int i = 0; i < 4; ++i) add_surface(scene, numbered("Plain_Pillar", i), pillar(-3 + 2 * i, 1.5, 0.15, 3.5, 24));
    for (int i = 0; i < 10; ++i)
        add_surface(scene, numbered("Plain_Board", i), turned_box(at(3.5, -2, 0.6 + 0.22 * i), {0.6, 0.15, 0.012}, 0));
}

void add_balls_and_rings(Scene& scene, Choice& choice) {
    for (int i = 0; i < 20; ++i) {
        const Vec3 center = at(choice.between(-4, 4), choice.between(-4, 3.5), choice.between(0.4, 2));
        if (i % 2 == 1) {
            const double radius = choice.between(0.15, 0.45);
            add_surface(scene, numbered("Ball", i),
                        placed(ico_sphere(4), center, at(radius, 0, 0), at(0, radius, 0), at(0, 0, radius)));
        } else {
            const double radius = choice.between(0.3, 0.5), tilt = choice.between(0, 3);
            const Vec3 y = radius * at(0, std::cos(tilt), std::sin(tilt));
            const Vec3 z = radius * at(0, -std::sin(tilt), std::cos(tilt));
            add_surface(scene, numbered("Ring", i), placed(torus(64, 40), center, at(radius, 0, 0), y, z));
        }
    }
}

void add_blobs(Scene& scene, Choice& choice) {
    for (int i = 0; i < 12; ++i) {
        const Vec3 center = at(choice.between(-4, 4), choice.between(-4, 3.5), choice.between(0.6, 1.4));
        add_surface(scene, numbered("Blob", i), noisy_blob(center, choice.between(0.35, 0.6), 0.35, 1.7 * i));
    }
}

void add_trees(Scene& scene, Choice& choice) {
    for (int i = 0; i < 10; ++i) {
        const double x = choice.between(-4, 4), y = choice.between(-4, 3.5), height = choice.between(0.8, 1.6);
        add_surface(scene, numbered("Plain_Trunk", i), pillar(x, y, 0.05, height, 12));
        Mesh leaves;
        while (leaves.triangles.size() < 10000) {
            const Vec3 offset = choice.vector();
            if (glm::dot(offset, offset) > 1) continue;
            const Vec3 along = choice.direction();
            const Vec3 across = normalize_or(glm::cross(along, choice.vector()), {1, 0, 0});
            add(leaves, parallelogram(at(x, y, height + 0.3) + 0.7 * offset, 0.06 * along, 0.03 * across));
        }
        add_surface(scene, numbered("Leaves", i), leaves);
    }
}

// ---- what breaks geometry

void add_touching_boxes(Scene& scene) {
    for (int i = 0; i < 6; ++i)  // in contact on all sides
        for (int j = 0; j < 3; ++j)
            add_surface(scene, numbered("Stacked", 3 * i + j),
                        box(at(-3 + 0.5 * i, 1, 0.25 + 0.5 * j), {0.5, 0.5, 0.5}));
    for (int copy = 0; copy < 3; ++copy) add_surface(scene, numbered("Copy", copy), box(at(2, 0, 0.5), Vec3(1)));
    add_surface(scene, "Sides in common planes", box(at(2, 0, 1), Vec3(1)));
    for (int i = 0; i < 2; ++i)
        add_surface(scene, numbered("Interpenetrating", i), turned_box(at(0.1 * i, -2, 0.4), {0.3, 0.3, 0.4}, pi / 4));
    add_surface(scene, "Decal", parallelogram(at(1, 1, 0), at(1, 0, 0), at(0, 1, 0)));
    add_surface(scene, "Decal on a box", parallelogram(at(1.75, -0.5, 0.25), at(0.5, 0, 0), at(0, 0, 0.5)));
}

void add_junctions_and_slivers(Scene& scene, Choice& choice) {
    Mesh sheet = parallelogram(at(-1, 2, 0), at(2, 0, 0), at(0, 0, 1));
    add(sheet, parallelogram(at(-1, 2, 1), at(0.7, 0, 0), at(0, 0, 0.5)));
    add(sheet, parallelogram(at(-0.3, 2, 1), at(1.3, 0, 0), at(0, 0, 0.5)));
    add_surface(scene, "T junction", sheet);
    Mesh slivers;
    for (int i = 0; i < 30; ++i) {
        const Vec3 corner = at(choice.between(-3, 3), choice.between(-3, 3), choice.between(0, 2));
        add(slivers, parallelogram(corner, at(0.5, choice.between(0, 0.3), 1e-6), at(1e-6, 1e-7, 0)));
    }
    for (int i = 0; i < 5; ++i) {  // on one line once they are float
        const Vec3 a = at(1, 1 + 0.1 * i, 1);
        add(slivers, {{a, a + at(1, 0, 0), a + at(2, 0, 1e-8)}, {{0, 1, 2}}});
    }
    add_surface(scene, "Slivers", slivers);
}

void add_neighbours_of_monitors(Scene& scene) {
    add_surface(scene, "Box through R", turned_box(at(0.7, 4.9, 2.2), {0.2, 0.3, 0.1}, 0));
    add_surface(scene, "Sheet through R", parallelogram(at(-1.2, 4.6, 1.3), at(0, 0.7, 0), at(0.3, 0, 1.2)));
    add_surface(scene, "Sheet through G", parallelogram(at(-1.2, -1, 3.2), at(0.9, 0.3, 0.3), at(0, 0.5, 0.35)));
    // R is glued to a wall of its own, and a bezel of four bars touches its border.
    add_surface(scene, "Wall behind R", parallelogram(at(-2.5, 4.95, 0.5), at(5, 0, 0), at(0, 0, 2.9)));
    for (const double side : {-1.0, 1.0}) {
        add_surface(scene, side < 0 ? "Bezel left" : "Bezel right", box(at(side * 1.65, 4.93, 2), {0.1, 1.8, 0.06}));
        add_surface(scene, side < 0 ? "Bezel below" : "Bezel above",
                    box(at(0, 4.93, 2 + side * 0.95), {3.4, 0.1, 0.06}));
    }
    // B is let into a plate that ends in its plane; the wall of the plate's front runs on behind it.
    add_surface(scene, "Plate around B", box(at(-4.95, -2, 1.1), {0.1, 1, 1.6}));
}

}  // namespace

Scene room_with(Contents contents) {
    Scene scene;
    Choice choice{Random{7}};
    add_room(scene);
    if (contents != Contents::leaf) add_furniture(scene, choice);
    if (contents == Contents::mid || contents == Contents::million) add_balls_and_rings(scene, choice);
    if (contents == Contents::high || contents == Contents::million) add_blobs(scene, choice);
    if (contents == Contents::leaf) add_trees(scene, choice);
    return scene;
}

Contents contents_named(const std::string& name) {
    if (name == "low") return Contents::low;
    if (name == "mid") return Contents::mid;
    if (name == "high") return Contents::high;
    if (name == "leaf") return Contents::leaf;
    if (name == "million") return Contents::million;
    throw std::invalid_argument("no such room: " + name);
}

std::vector<uint32_t> plain_surfaces(const Scene& room) {
    std::vector<uint32_t> surfaces;
    for (uint32_t s = 0; s < room.surfaces.size(); ++s)
        if (room.surfaces[s].name.starts_with("Plain_")) surfaces.push_back(s);
    return surfaces;
}

Scene nasty_room() {
    Scene scene;
    Choice choice{Random{9}};
    add_room(scene);
    add_touching_boxes(scene);
    add_junctions_and_slivers(scene, choice);
    add_neighbours_of_monitors(scene);
    return scene;
}

}  // namespace surimi::test
