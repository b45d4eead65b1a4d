// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/facets.h"

#include <algorithm>
#include <limits>

#include "runtime/base/parallel.h"

namespace surimi {
namespace {

constexpr size_t grain = 1 << 14;
constexpr uint32_t none = std::numeric_limits<uint32_t>::max();
constexpr double equal_normals = 1e-6;  // sine of the angle

bool is_parallel(const Vec3& a, const Vec3& b) {
    const Vec3 sine = glm::cross(a, b);
    return glm::dot(a, b) > 0 && glm::dot(sine, sine) < equal_normals * equal_normals;
}

double area_of(const WeldedMesh& mesh, uint32_t triangle) {
    const auto& [a, b, c] = mesh.corners[triangle];
    return glm::length(area_normal(Vec3(mesh.places[a]), Vec3(mesh.places[b]), Vec3(mesh.places[c])));
}

/// The triangle on the other side of each half-edge, where the two may lie in one facet.
std::vector<uint32_t> flat_neighbours(const WeldedMesh& mesh, const std::vector<Keyed>& half_edges) {
    std::vector<uint32_t> neighbours(3 * mesh.corners.size(), none);
    parallel_ranges(half_edges.size(), grain, [&](size_t from, size_t to) {
        for_each_edge(half_edges, from, to, [&](size_t begin, size_t end) {
            if (end - begin != 2) return;
            const uint32_t one = half_edges[begin].index, two = half_edges[begin + 1].index;
            if (start_of(mesh, one) == start_of(mesh, two)) return;
            if (!is_parallel(mesh.planes[one / 3].normal, mesh.planes[two / 3].normal)) return;
            neighbours[one] = two / 3;
            neighbours[two] = one / 3;
        });
    });
    return neighbours;
}

struct Seed {
    double area = 0;
    uint32_t triangle = 0;
};

/// Triangles with a flat neighbour, the largest first.
std::vector<Seed> seeds_of(const WeldedMesh& mesh, const std::vector<uint32_t>& neighbours) {
    std::vector<Seed> seeds;
    for (uint32_t t = 0; t < mesh.corners.size(); ++t)
        if (std::any_of(&neighbours[3 * size_t{t}], &neighbours[3 * size_t{t}] + 3,
                        [](uint32_t n) { return n != none; }))
            seeds.push_back({area_of(mesh, t), t});
    std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) {
        return a.area != b.area ? a.area > b.area : a.triangle < b.triangle;
    });
    return seeds;
}

bool lies_in(const WeldedMesh& mesh, uint32_t triangle, uint32_t standing) {
    const FacePlane& plane = mesh.planes[standing];
    if (!is_parallel(plane.normal, mesh.planes[triangle].normal)) return false;
    const double around = largest_component(Vec3(mesh.places[mesh.corners[standing][0]]));
    for (const uint32_t corner : mesh.corners[triangle]) {
        const Vec3 place(mesh.places[corner]);
        const double rounding = std::numeric_limits<float>::epsilon() * std::max(around, largest_component(place));
        if (std::abs(glm::dot(plane.normal, place) - plane.distance) > rounding) return false;
    }
    return true;
}

}  // namespace

FacePlane plane_through(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    const Vec3 u = Vec3(b) - Vec3(a), v = Vec3(c) - Vec3(a);
    const Vec3 normal = glm::cross(u, v);
    const double length = glm::length(normal);
    // What rounding makes of a cross product that is zero.
    const double zero = 4 * std::numeric_limits<double>::epsilon() * glm::length(u) * glm::length(v);
    if (!(length > zero) || !std::isfinite(length)) return {Vec3(0), 0};
    const Vec3 unit = normal / length;
    return {unit, glm::dot(unit, (Vec3(a) + Vec3(b) + Vec3(c)) / 3.0)};
}

std::vector<Keyed> sorted_half_edges(const WeldedMesh& mesh) {
    const auto has_area = [&](uint32_t t) { return mesh.planes[t].normal != Vec3(0); };
    std::vector<Keyed> half_edges(3 * mesh.corners.size());
    size_t count = 0;
    for (uint32_t t = 0; t < mesh.corners.size(); ++t)
        for (uint32_t k = 0; k < 3 && has_area(t); ++k) half_edges[count++].index = 3 * t + k;
    half_edges.resize(count);
    parallel_for(count, grain, [&](size_t i) {
        const uint64_t start = start_of(mesh, half_edges[i].index), end = end_of(mesh, half_edges[i].index);
        half_edges[i].key = mixed(std::min(start, end) << 32 | std::max(start, end));
    });
    sort_by_key(half_edges);
    return half_edges;
}

std::vector<uint32_t> find_facets(const WeldedMesh& mesh, const std::vector<Keyed>& half_edges) {
    const std::vector<uint32_t> neighbours = flat_neighbours(mesh, half_edges);
    std::vector<uint32_t> facets(mesh.corners.size(), none);
    std::vector<uint32_t> front;
    for (const Seed& seed : seeds_of(mesh, neighbours)) {
        if (facets[seed.triangle] != none) continue;
        facets[seed.triangle] = seed.triangle;
        front.assign(1, seed.triangle);
        while (!front.empty()) {
            const size_t first = 3 * size_t{front.back()};
            front.pop_back();
            for (size_t h = first; h < first + 3; ++h) {
                const uint32_t next = neighbours[h];
                if (next == none || facets[next] != none || !lies_in(mesh, next, seed.triangle)) continue;
                facets[next] = seed.triangle;
                front.push_back(next);
            }
        }
    }
    for (uint32_t t = 0; t < facets.size(); ++t)
        if (facets[t] == none) facets[t] = t;
    return facets;
}

}  // namespace surimi
