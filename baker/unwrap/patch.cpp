// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/patch.h"

#include <algorithm>
#include <numeric>

#include "baker/unwrap/union_find.h"

namespace surimi {
namespace {

constexpr uint32_t no_number = UINT32_MAX;

uint32_t next(uint32_t k) {
    return k == 2 ? 0 : k + 1;
}

/// Corner of the surface's face at position k of its triangle in a patch, which starts with the first corner.
uint32_t surface_corner(const FaceGraph& graph, uint32_t face, uint32_t k) {
    return (graph.first_corners[face] + k) % 3;
}

void find_neighbours(const FaceGraph& graph, const SeamFlags& seams, const std::vector<uint32_t>& number,
                     Patch& patch) {
    patch.neighbours.assign(patch.faces.size(), {no_face, no_face, no_face});
    for (uint32_t t = 0; t < patch.faces.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t face = patch.faces[t];
            const uint32_t corner = surface_corner(graph, face, k);
            if (!seams.is_cut(face, corner)) patch.neighbours[t][k] = number[graph.neighbours[face][corner]];
        }
    }
}

/// Position, in the triangle of the patch beyond edge k of triangle t, at which the same edge starts there.
uint32_t edge_beyond(const FaceGraph& graph, const Patch& patch, uint32_t t, uint32_t k) {
    const uint32_t face = patch.faces[t];
    const uint32_t beyond = patch.faces[patch.neighbours[t][k]];
    const uint32_t corner = corner_beyond(graph, face, surface_corner(graph, face, k));
    return (corner + 3 - graph.first_corners[beyond]) % 3;
}

/// One vertex for each fan: corners are the same vertex when uncut edges connect them.
void make_vertices(const FaceGraph& graph, Patch& patch) {
    std::vector<uint32_t> fan(3 * patch.faces.size());
    std::iota(fan.begin(), fan.end(), 0u);
    for (uint32_t t = 0; t < patch.faces.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t beyond = patch.neighbours[t][k];
            if (beyond == no_face || beyond < t) continue;
            const uint32_t start = edge_beyond(graph, patch, t, k);
            unite(fan, 3 * t + k, 3 * beyond + next(start));
            unite(fan, 3 * t + next(k), 3 * beyond + start);
        }
    }
    std::vector<uint32_t> vertex(fan.size(), no_number);
    patch.triangles.resize(patch.faces.size());
    for (uint32_t c = 0; c < fan.size(); ++c) {
        uint32_t& v = vertex[find_root(fan, c)];
        if (v == no_number) {
            const uint32_t face = patch.faces[c / 3];
            v = static_cast<uint32_t>(patch.places.size());
            patch.places.push_back(graph.corners[face][surface_corner(graph, face, c % 3)]);
        }
        patch.triangles[c / 3][c % 3] = v;
    }
}

void find_loops(Patch& patch) {
    std::vector<uint32_t> after(patch.places.size(), no_number);  // vertex that follows on the boundary
    for (uint32_t t = 0; t < patch.faces.size(); ++t)
        for (uint32_t k = 0; k < 3; ++k)
            if (patch.neighbours[t][k] == no_face) after[patch.triangles[t][k]] = patch.triangles[t][next(k)];
    for (uint32_t v = 0; v < after.size(); ++v) {
        if (after[v] == no_number) continue;
        std::vector<uint32_t> loop;
        for (uint32_t w = v; after[w] != no_number;) {
            loop.push_back(w);
            const uint32_t following = after[w];
            after[w] = no_number;
            w = following;
        }
        patch.loops.push_back(std::move(loop));
    }
}

/// Positions in units, areas and the gradients of the vertices' hat functions.
void measure(const FaceGraph& graph, Patch& patch) {
    double area = 0;
    for (const uint32_t f : patch.faces) area += graph.areas[f];
    patch.unit = std::sqrt(area);
    const Vec3 origin = graph.positions[patch.places[0]];
    for (const uint32_t place : patch.places) patch.positions.push_back((graph.positions[place] - origin) / patch.unit);
    for (const auto& t : patch.triangles) {
        const Vec3& a = patch.positions[t[0]];
        const Vec3 ab = patch.positions[t[1]] - a;
        const Vec3 ac = patch.positions[t[2]] - a;
        const Vec3 normal = glm::cross(ab, ac);
        const double doubled = glm::length(normal);
        const double length = glm::length(ab);
        const Vec2 b(length, 0);
        const Vec2 c(glm::dot(ab, ac) / length, doubled / length);
        // The gradient of a hat function is its opposite edge turned by a right angle, over twice the area.
        const auto turned_edge = [&](const Vec2& from, const Vec2& to) {
            return Vec2(from.y - to.y, to.x - from.x) / doubled;
        };
        patch.gradients.push_back({turned_edge(b, c), turned_edge(c, Vec2(0)), turned_edge(Vec2(0), b)});
        patch.areas.push_back(0.5 * doubled);
    }
}

}  // namespace

SeamFlags::SeamFlags(const FaceGraph& graph) : flags(3 * graph.corners.size(), 0) {
    for (uint32_t f = 0; f < graph.corners.size(); ++f)
        for (uint32_t k = 0; k < 3; ++k) flags[3 * f + k] = graph.neighbours[f][k] == no_face ? 1 : 0;
}

uint32_t corner_beyond(const FaceGraph& graph, uint32_t face, uint32_t k) {
    const uint32_t beyond = graph.neighbours[face][k];
    const uint32_t end = graph.corners[face][next(k)];
    const uint32_t start = graph.corners[face][k];
    for (uint32_t i = 0; i < 3; ++i)
        if (graph.neighbours[beyond][i] == face && graph.corners[beyond][i] == end &&
            graph.corners[beyond][next(i)] == start)
            return i;
    return 0;  // unreachable: neighbours are mutual
}

void set_seam(const FaceGraph& graph, uint32_t face, uint32_t k, bool is_cut, SeamFlags& seams) {
    const uint32_t beyond = graph.neighbours[face][k];
    if (beyond == no_face) return;
    seams.flags[3 * face + k] = is_cut ? 1 : 0;
    seams.flags[3 * beyond + corner_beyond(graph, face, k)] = is_cut ? 1 : 0;
}

std::vector<std::vector<uint32_t>> connected_parts(const FaceGraph& graph, const SeamFlags& seams,
                                                   const std::vector<uint32_t>& faces, std::vector<uint32_t>& number) {
    std::vector<uint32_t> sorted = faces;
    const auto is_before = [&](uint32_t a, uint32_t b) { return graph.ranks[a] < graph.ranks[b]; };
    std::sort(sorted.begin(), sorted.end(), is_before);
    for (const uint32_t f : sorted) number[f] = no_number;
    std::vector<std::vector<uint32_t>> parts;
    std::vector<uint32_t> open;
    for (const uint32_t start : sorted) {
        if (number[start] != no_number) continue;
        const auto part = static_cast<uint32_t>(parts.size());
        number[start] = part;
        parts.emplace_back();
        open.push_back(start);
        while (!open.empty()) {
            const uint32_t f = open.back();
            open.pop_back();
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t beyond = graph.neighbours[f][k];
                if (seams.is_cut(f, k) || number[beyond] != no_number) continue;
                number[beyond] = part;
                open.push_back(beyond);
            }
        }
    }
    for (const uint32_t f : sorted) parts[number[f]].push_back(f);
    return parts;
}

int Patch::euler_characteristic() const {
    size_t boundary = 0;
    for (const auto& loop : loops) boundary += loop.size();
    const size_t edges = (3 * triangles.size() + boundary) / 2;
    return static_cast<int>(positions.size()) - static_cast<int>(edges) + static_cast<int>(triangles.size());
}

Patch build_patch(const FaceGraph& graph, const SeamFlags& seams, std::vector<uint32_t> faces,
                  std::vector<uint32_t>& number) {
    Patch patch;
    patch.faces = std::move(faces);
    for (uint32_t t = 0; t < patch.faces.size(); ++t) number[patch.faces[t]] = t;
    find_neighbours(graph, seams, number, patch);
    make_vertices(graph, patch);
    find_loops(patch);
    measure(graph, patch);
    return patch;
}

}  // namespace surimi
