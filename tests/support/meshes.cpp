// SPDX-License-Identifier: Apache-2.0
#include "tests/support/meshes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <string>

#include "runtime/scene/gltf_surfaces.h"

namespace surimi::test {
namespace {

Surface surface_of(const Mesh& mesh) {
    Surface surface;
    surface.positions = mesh.positions;
    surface.normals.resize(mesh.positions.size(), Vec3(0));
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) surface.source_vertex.push_back(v);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
        if (is_degenerate(p, q, r)) continue;
        surface.triangles.push_back(mesh.triangles[t]);
        surface.source_triangle.push_back(t);
        for (const uint32_t v : mesh.triangles[t]) surface.normals[v] += glm::cross(q - p, r - p);
    }
    for (Vec3& normal : surface.normals) normal = normalize_or(normal, Vec3(0, 0, 1));
    return surface;
}

uint32_t add(Mesh& mesh, const Vec3& p) {
    mesh.positions.push_back(p);
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

void add_triangle(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
    const uint32_t first = add(mesh, a);
    mesh.triangles.push_back({first, add(mesh, b), add(mesh, c)});
}

void add_mesh(Mesh& mesh, const Mesh& other) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

/// n x m cells over [0, 1]^2, bent by `place`. Where the sheet closes upon itself, it has vertices twice, as a file
/// with texture coordinates does.
Mesh sheet(int n, int m, const std::function<Vec3(double, double)>& place) {
    Mesh mesh;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= m; ++j) add(mesh, place(static_cast<double>(i) / n, static_cast<double>(j) / m));
    const auto at = [&](int i, int j) { return static_cast<uint32_t>(i * (m + 1) + j); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

/// cos and sin that close: after a full turn they are what they were, to the bit.
Vec2 turn(double fraction) {
    const double angle = 2 * pi * (fraction - std::floor(fraction));
    return {std::cos(angle), std::sin(angle)};
}

/// In [0, 1); the same on every standard library, unlike its distributions.
double unit(std::mt19937& random) {
    return static_cast<double>(random()) / 4294967296.0;
}

void turn_around(std::array<uint32_t, 3>& triangle) {
    std::swap(triangle[1], triangle[2]);
}

}  // namespace

uint32_t add_surface(Scene& scene, const std::string& name, const Mesh& mesh) {
    Surface surface = surface_of(mesh);
    surface.name = name;
    surface.node = surface.mesh = static_cast<int>(scene.nodes.size());
    Node node;
    node.name = name;
    node.mesh = surface.mesh;
    node.is_in_scene = true;
    scene.nodes.push_back(node);
    scene.surfaces.push_back(std::move(surface));
    return static_cast<uint32_t>(scene.surfaces.size()) - 1;
}

Scene scene_of(const std::vector<Mesh>& meshes) {
    Scene scene;
    for (const Mesh& mesh : meshes) add_surface(scene, "mesh_" + std::to_string(scene.surfaces.size()), mesh);
    return scene;
}

Mesh scaled(Mesh mesh, double factor) {
    for (Vec3& p : mesh.positions) p *= factor;
    return mesh;
}

Mesh reordered(const Mesh& mesh, const std::vector<size_t>& order) {
    Mesh result{mesh.positions, {}};
    for (const size_t t : order) result.triangles.push_back(mesh.triangles[t]);
    return result;
}

std::vector<size_t> shuffled_order(size_t count, uint32_t seed) {
    std::vector<size_t> order(count);
    std::iota(order.begin(), order.end(), size_t{0});
    std::mt19937 random(seed);
    for (size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
}

Mesh terrain(int cells) {
    return sheet(cells, cells, [](double u, double v) {
        double height = 0, frequency = 4.1, phase = 0.7;
        for (int octave = 0; octave < 5; ++octave) {
            const double x = frequency * (u + 0.31 * v), y = frequency * (v - 0.23 * u);
            height += std::sin(x + phase) * std::sin(y + 2 * phase) / frequency;
            frequency *= 2.03;
            phase += 1.9;
        }
        return Vec3(10 * u, 10 * v, 4.5 * height);
    });
}

Mesh arch(int across, int along) {
    return sheet(along, across, [](double u, double v) { return Vec3(turn(0.75 * u), 4 * v); });
}

Mesh dome(int rings, int spokes) {
    return sheet(rings, spokes, [](double u, double v) {
        const double polar = 0.05 + 1.2 * u;
        return Vec3(std::sin(polar) * turn(v), std::cos(polar));
    });
}

Mesh cloth(int along, int across) {
    return sheet(along, across, [](double u, double v) {
        const double x = 4 * u - 2, y = 4 * v - 2;
        return Vec3(0.45 * x + 0.12 * std::sin(18 * x), y, 0.5 * std::sin(9 * x) * (1 + 0.3 * std::sin(3 * y)));
    });
}

Mesh helix(int turns, int cells_a_turn) {
    return sheet(turns * cells_a_turn, 1,
                 [&](double u, double v) { return Vec3((1 + 0.15 * v) * turn(turns * u), 0.6 * turns * u); });
}

Mesh signed_zeros() {
    Mesh mesh = sheet(8, 8, [](double u, double v) { return Vec3(u - 1 == 0 ? -0.0 : u - 1, v, 0.05 * (1 - u)); });
    add_mesh(mesh, sheet(8, 8, [](double u, double v) { return Vec3(u, v, v == 0.5 ? -0.0 : 0.0); }));
    return mesh;
}

Mesh uv_sphere(int segments, int rings) {
    return sheet(segments, rings, [](double u, double v) {
        const double height = v == 0 ? -1 : v == 1 ? 1 : -std::cos(pi * v);
        const double radius = v == 0 || v == 1 ? 0 : std::sin(pi * v);
        return Vec3(radius * turn(u), height);
    });
}

Mesh ico_sphere(int subdivisions) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    Mesh mesh;
    for (const Vec3& p :
         {Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0), Vec3(0, -1, g), Vec3(0, 1, g),
          Vec3(0, -1, -g), Vec3(0, 1, -g), Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)})
        add(mesh, glm::normalize(p));
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int s = 0; s < subdivisions; ++s) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), 0);
            if (is_new) entry->second = add(mesh, glm::normalize(mesh.positions[a] + mesh.positions[b]));
            return entry->second;
        };
        std::vector<std::array<uint32_t, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    return mesh;
}

Mesh torus(int segments, int rings) {
    return sheet(segments, rings,
                 [](double u, double v) { return Vec3((1 + 0.35 * turn(v).x) * turn(u), 0.35 * turn(v).y); });
}

Mesh box(const Vec3& center, const Vec3& size) {
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        add(mesh, center + size * (Vec3(corner & 1, corner >> 1 & 1, corner >> 2) - 0.5));
    constexpr uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads) {
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
    }
    return mesh;
}

Mesh capped_cylinder(int segments) {
    Mesh mesh = sheet(segments, 1, [](double u, double v) { return Vec3(0.3 * turn(u), 4 * v); });
    for (int i = 0; i < segments; ++i) {
        const Vec2 from = 0.3 * turn(static_cast<double>(i) / segments);
        const Vec2 to = 0.3 * turn(static_cast<double>(i + 1) / segments);
        add_triangle(mesh, Vec3(0, 0, 0), Vec3(to, 0), Vec3(from, 0));
        add_triangle(mesh, Vec3(0, 0, 4), Vec3(from, 4), Vec3(to, 4));
    }
    return mesh;
}

Mesh book() {
    Mesh mesh;
    const auto add_page = [&](double degrees, double length, double inset) {
        const Vec2 way = length * turn(degrees / 360);
        add_mesh(mesh, sheet(8, 1, [&](double u, double v) {
                     const double margin = u > 0 ? inset : 0;
                     return Vec3(u * way, margin + v * (1 - 2 * margin));
                 }));
    };
    add_page(0, 1, 0);
    add_page(12, 0.7, 0.15);
    add_page(180, 1, 0);
    return mesh;
}

Mesh moebius() {
    return sheet(60, 1, [](double u, double v) {
        const bool has_closed = u == 1;  // with its sides swapped
        const double w = (v > 0) != has_closed ? 0.3 : -0.3, angle = has_closed ? 0 : pi * u;
        return Vec3((1 + w * std::cos(angle)) * turn(u), w * std::sin(angle));
    });
}

Mesh walls() {
    Mesh mesh = sheet(8, 8, [](double u, double v) { return Vec3(4 * u, 4 * v, 0); });
    for (size_t t = 0; t < mesh.triangles.size(); t += 5) turn_around(mesh.triangles[t]);
    const std::vector<std::array<uint32_t, 3>> floor = mesh.triangles;
    add_mesh(mesh, sheet(8, 1, [](double u, double v) { return Vec3(4 * u, 2, v); }));
    add_mesh(mesh, sheet(8, 1, [](double u, double v) { return Vec3(2, 4 * u, v); }));
    for (size_t t = 0; t < 20; ++t) {
        mesh.triangles.push_back(floor[t]);  // back sides
        turn_around(mesh.triangles.back());
        if (t < 10) mesh.triangles.push_back(floor[t]);
    }
    // A floor beside it whose vertices lie within the edges of the first.
    add_mesh(mesh, sheet(5, 3, [](double u, double v) { return Vec3(4 * u, 4 + 2 * v, 0); }));
    return mesh;
}

Mesh touching_cubes() {
    Mesh mesh;
    for (const Vec3& center : {Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(2, 2, 1), Vec3(-1, 0, 0)})
        add_mesh(mesh, box(center, Vec3(1)));
    return mesh;
}

Mesh mixed_winding() {
    Mesh mesh = terrain(16);
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        if (t * 7 % 4 == 0) turn_around(mesh.triangles[t]);
    return mesh;
}

Mesh degenerate_grid() {
    constexpr int n = 20;
    Mesh mesh = sheet(
        n, n, [](double u, double v) { return Vec3(2.5 * u, 2.5 * v, 0.15 * std::sin(14 * u) * std::cos(10 * v)); });
    Mesh result{mesh.positions, {}};
    std::mt19937 random(1);
    auto& out = result.triangles;
    for (size_t t = 0; t < mesh.triangles.size(); t += 2) {
        const auto& [a, b, c] = mesh.triangles[t];
        const uint32_t d = mesh.triangles[t + 1][2];
        const double kind = unit(random);
        // Rounded to float, as a file stores it, so that areas meant to be zero are almost zero.
        const auto between = [&](uint32_t p, uint32_t q, double off) {
            return add(result, Vec3(Vec3f(0.5 * (result.positions[p] + result.positions[q]) + Vec3(0, off, 0))));
        };
        if (kind < 0.05) {
            out.insert(out.end(), {{a, b, b}, {a, b, c}, {a, c, d}});
        } else if (kind < 0.12) {  // next to no area upon the diagonal
            const uint32_t m = between(a, c, 0);
            out.insert(out.end(), {{a, b, c}, {a, c, m}, {a, m, d}, {m, c, d}});
        } else if (kind < 0.2) {  // a needle along an edge
            const uint32_t m = between(a, b, 1e-6);
            out.insert(out.end(), {{a, b, m}, {a, m, d}, {m, b, c}, {m, c, d}});
        } else if (kind < 0.26) {  // a vertex within an edge of the neighbour
            const uint32_t m = between(b, c, 0);
            out.insert(out.end(), {{a, b, m}, {a, m, c}, {a, c, d}});
        } else {
            out.insert(out.end(), {{a, b, c}, {a, c, d}});
        }
    }
    return result;
}

Mesh needle_fan() {
    Mesh mesh;
    const auto add_slice = [&](double from, double to) {
        add_triangle(mesh, Vec3(0), Vec3(5.0 * turn(from), 0), Vec3(5.0 * turn(to), 0));
    };
    for (int i = 0; i < 60; ++i) {
        const double from = i / 60.0, to = (i + 1) / 60.0, middle = i % 5 == 0 ? from + 1e-7 / (2 * pi) : to;
        add_slice(from, middle);
        if (middle < to) add_slice(middle, to);
    }
    std::mt19937 random(7);
    for (int i = 0; i < 40; ++i) {
        const Vec3 a(unit(random), unit(random), 3 + unit(random));
        add_triangle(mesh, a, a + Vec3(1, 0, 0), a + Vec3(0.5, std::pow(10.0, -1 - 0.3 * i), 0));
    }
    return mesh;
}

Mesh foliage(int quads) {
    std::mt19937 random(3);
    Mesh mesh;
    for (int i = 0; i < quads; ++i) {
        const Vec3 center = 6.0 * Vec3(unit(random), unit(random), unit(random));
        const double size = 0.03 + 0.09 * unit(random), tilt = 2 * unit(random) - 1;
        const Vec2 way = turn(unit(random));
        const Vec3 along = size * Vec3(way, 0);
        const Vec3 across = 2 * size * Vec3(-way.y * std::sin(tilt), way.x * std::sin(tilt), std::cos(tilt));
        add_mesh(mesh,
                 sheet(1, 1, [&](double u, double v) { return center + (2 * u - 1) * along + (2 * v - 1) * across; }));
    }
    return mesh;
}

const std::vector<NamedMesh>& all_meshes() {
    static const std::vector<NamedMesh> meshes{{"terrain", [] { return terrain(48); }},
                                               {"arch", [] { return arch(4, 400); }},
                                               {"dome", [] { return dome(24, 96); }},
                                               {"cloth", [] { return cloth(80, 24); }},
                                               {"helix", [] { return helix(10, 60); }},
                                               {"signed_zeros", signed_zeros},
                                               {"uv_sphere", [] { return uv_sphere(48, 24); }},
                                               {"ico_sphere", [] { return ico_sphere(3); }},
                                               {"torus", [] { return torus(60, 24); }},
                                               {"box", [] { return box(Vec3(0), Vec3(2, 3, 1)); }},
                                               {"capped_cylinder", [] { return capped_cylinder(64); }},
                                               {"book", book},
                                               {"moebius", moebius},
                                               {"walls", walls},
                                               {"touching_cubes", touching_cubes},
                                               {"mixed_winding", mixed_winding},
                                               {"degenerate_grid", degenerate_grid},
                                               {"needle_fan", needle_fan},
                                               {"foliage", [] { return foliage(150); }}};
    return meshes;
}

}  // namespace surimi::test
