// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/half_edge.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <tuple>

#include "baker/unwrap/union_find.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace surimi {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraitsDouble {};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// A triangle is a sliver when its area is below this share of its longest edge squared: then its normal and
/// its flattened shape are rounding noise. Twice the limit that is usual for "zero area", so that nobody who
/// counts with other roundings finds a zero-area triangle inside a chart.
constexpr double sliver_share = 2e-12;

uint32_t after(uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// Places in coarse steps of the bounding box: places that are level but for rounding are level. The number of steps is
/// such that the places of regular meshes lie on no border between two.
std::vector<std::array<int32_t, 3>> coarse_places(const std::vector<Vec3>& places) {
    Vec3 low(INFINITY);
    Vec3 high(-INFINITY);
    for (const Vec3& p : places) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    constexpr double steps = 987654.321;
    const double scale = extent > 0 ? steps / extent : 0;
    std::vector<std::array<int32_t, 3>> coarse;
    coarse.reserve(places.size());
    for (const Vec3& p : places) {
        const Vec3 q = glm::round((p - low) * scale);
        coarse.push_back({static_cast<int32_t>(q.x), static_cast<int32_t>(q.y), static_cast<int32_t>(q.z)});
    }
    return coarse;
}

void weld(const Surface& surface, FaceGraph& graph) {
    const size_t count = surface.positions.size();
    std::vector<Vec3> places(count);
    for (size_t i = 0; i < count; ++i) places[i] = surface.positions[i] + 0.0;
    const auto coarse = coarse_places(places);
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](uint32_t i) { return std::make_tuple(coarse[i], places[i].x, places[i].y, places[i].z, i); };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    std::vector<uint32_t> welded(count);
    for (size_t i = 0; i < count; ++i) {
        if (i == 0 || places[order[i]] != places[order[i - 1]]) graph.positions.push_back(places[order[i]]);
        welded[order[i]] = static_cast<uint32_t>(graph.positions.size() - 1);
    }
    graph.corners.reserve(surface.triangles.size());
    for (const auto& t : surface.triangles) graph.corners.push_back({welded[t[0]], welded[t[1]], welded[t[2]]});
}

void measure_faces(FaceGraph& graph) {
    const size_t count = graph.corners.size();
    graph.normals.resize(count);
    graph.areas.resize(count);
    graph.is_sliver.resize(count);
    for (size_t f = 0; f < count; ++f) {
        const Vec3& a = graph.positions[graph.corners[f][0]];
        const Vec3& b = graph.positions[graph.corners[f][1]];
        const Vec3& c = graph.positions[graph.corners[f][2]];
        const Vec3 normal = area_normal(a, b, c);
        graph.areas[f] = 0.5 * glm::length(normal);
        graph.normals[f] = normalize_or(normal, Vec3(0, 0, 1));
        const double longest =
            std::max(glm::dot(b - a, b - a), std::max(glm::dot(c - b, c - b), glm::dot(a - c, a - c)));
        graph.is_sliver[f] = !(graph.areas[f] > sliver_share * longest);
    }
}

using FaceKey = std::array<uint32_t, 3>;

/// Places of a face, the lowest first, in its own winding.
FaceKey key_of(const FaceGraph& graph, uint32_t face) {
    const auto& c = graph.corners[face];
    const size_t k = graph.first_corners[face];
    return {c[k], c[(k + 1) % 3], c[(k + 2) % 3]};
}

void rank_faces(FaceGraph& graph) {
    const size_t count = graph.corners.size();
    graph.first_corners.resize(count);
    for (size_t f = 0; f < count; ++f) {
        const auto& c = graph.corners[f];
        graph.first_corners[f] = static_cast<uint8_t>(std::min_element(c.begin(), c.end()) - c.begin());
    }
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::vector<FaceKey> keys(count);
    for (uint32_t f = 0; f < count; ++f) keys[f] = key_of(graph, f);
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return std::tie(keys[a], a) < std::tie(keys[b], b); });
    graph.ranks.resize(count);
    for (uint32_t i = 0; i < count; ++i) graph.ranks[order[i]] = i;
}

/// The how-manieth face this is on the same three places with the same front. Doubled faces would make every edge a
/// four-face edge; in layers of their own, the second copy of a wall is a wall as well.
std::vector<uint32_t> find_layers(const FaceGraph& graph) {
    const std::vector<uint32_t> order = by_rank(graph);
    std::vector<uint32_t> layers(graph.corners.size(), 0);
    for (size_t i = 1; i < order.size(); ++i)
        if (key_of(graph, order[i]) == key_of(graph, order[i - 1])) layers[order[i]] = layers[order[i - 1]] + 1;
    return layers;
}

struct EdgeUse {
    uint32_t layer;
    uint32_t low;
    uint32_t high;
    uint32_t corner;  ///< 3 * face + k: the edge starts there
    bool operator<(const EdgeUse& o) const {
        return std::tie(layer, low, high, corner) < std::tie(o.layer, o.low, o.high, o.corner);
    }
    bool is_same_edge(const EdgeUse& o) const { return layer == o.layer && low == o.low && high == o.high; }
};

/// Whether two faces are the two sides of one triangle, which continues nowhere but into itself.
bool are_back_to_back(const FaceGraph& graph, uint32_t f, uint32_t g) {
    FaceKey a = graph.corners[f];
    FaceKey b = graph.corners[g];
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b;
}

/// Pairs the uses [begin, end) of one edge: opposite directions, the flattest continuation first.
void pair_uses(const FaceGraph& graph, const EdgeUse* begin, const EdgeUse* end, std::vector<uint32_t>& partner) {
    struct Match {
        int64_t bend;     ///< in millionths: what is equal but for rounding is equal
        bool is_concave;  ///< of two solids that touch, each keeps to itself
        uint32_t low;
        uint32_t high;
        uint32_t a;
        uint32_t b;
    };
    const auto rank = [&](uint32_t corner) { return graph.ranks[corner / 3]; };
    std::vector<Match> matches;
    for (const EdgeUse* i = begin; i != end; ++i) {
        for (const EdgeUse* j = i + 1; j != end; ++j) {
            const uint32_t start_i = graph.corners[i->corner / 3][i->corner % 3];
            const uint32_t start_j = graph.corners[j->corner / 3][j->corner % 3];
            if (start_i == start_j || are_back_to_back(graph, i->corner / 3, j->corner / 3)) continue;
            constexpr double steps = 1e6;
            const double bend = -glm::dot(graph.normals[i->corner / 3], graph.normals[j->corner / 3]);
            const uint32_t low = std::min(rank(i->corner), rank(j->corner));
            const uint32_t high = std::max(rank(i->corner), rank(j->corner));
            const Vec3& edge = graph.positions[graph.corners[i->corner / 3][i->corner % 3]];
            const Vec3& tip = graph.positions[graph.corners[j->corner / 3][(j->corner + 2) % 3]];
            constexpr double rounding = 1e-9;
            const bool is_concave =
                glm::dot(graph.normals[i->corner / 3], tip - edge) > rounding * glm::length(tip - edge);
            matches.push_back({std::llround(bend * steps), is_concave, low, high, i->corner, j->corner});
        }
    }
    std::sort(matches.begin(), matches.end(), [](const Match& l, const Match& r) {
        return std::tie(l.bend, l.is_concave, l.low, l.high) < std::tie(r.bend, r.is_concave, r.low, r.high);
    });
    for (const Match& m : matches) {
        if (partner[m.a] != no_face || partner[m.b] != no_face) continue;
        partner[m.a] = m.b;
        partner[m.b] = m.a;
    }
}

void count_edge(FaceGraph& graph, const EdgeUse* uses, size_t count) {
    const auto start = [&](const EdgeUse& use) { return graph.corners[use.corner / 3][use.corner % 3]; };
    graph.counts.open_edges += count == 1 ? 1 : 0;
    graph.counts.branching_edges += count > 2 ? 1 : 0;
    graph.counts.opposed_edges += count == 2 && start(uses[0]) == start(uses[1]) ? 1 : 0;
}

size_t count_components(const FaceGraph& graph) {
    std::vector<bool> is_seen(graph.corners.size(), false);
    std::vector<uint32_t> open;
    size_t components = 0;
    for (uint32_t start = 0; start < is_seen.size(); ++start) {
        if (is_seen[start] || graph.is_sliver[start]) continue;
        ++components;
        is_seen[start] = true;
        open.push_back(start);
        while (!open.empty()) {
            const uint32_t f = open.back();
            open.pop_back();
            for (const uint32_t beyond : graph.neighbours[f]) {
                if (beyond == no_face || is_seen[beyond]) continue;
                is_seen[beyond] = true;
                open.push_back(beyond);
            }
        }
    }
    return components;
}

/// For each corner the one where the same edge starts in the face beyond, or no_face.
std::vector<uint32_t> pair_edges(FaceGraph& graph) {
    const std::vector<uint32_t> layers = find_layers(graph);
    for (const uint32_t layer : layers) graph.counts.doubled_faces += layer > 0 ? 1 : 0;
    std::vector<EdgeUse> uses;
    uses.reserve(graph.corners.size() * 3);
    for (uint32_t f = 0; f < graph.corners.size(); ++f) {
        if (graph.is_sliver[f]) continue;
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = graph.corners[f][k];
            const uint32_t b = graph.corners[f][(k + 1) % 3];
            uses.push_back({layers[f], std::min(a, b), std::max(a, b), 3 * f + k});
        }
    }
    std::sort(uses.begin(), uses.end());
    std::vector<uint32_t> partner(graph.corners.size() * 3, no_face);
    // An edge with hundreds of faces is a bundle of leaves: nothing continues anything there, and trying all
    // pairs would be quadratic.
    constexpr size_t most_uses = 64;
    for (size_t begin = 0; begin < uses.size();) {
        size_t end = begin + 1;
        while (end < uses.size() && uses[end].is_same_edge(uses[begin])) ++end;
        count_edge(graph, &uses[begin], end - begin);
        if (end - begin <= most_uses) pair_uses(graph, &uses[begin], &uses[begin] + (end - begin), partner);
        begin = end;
    }
    return partner;
}

/// One mesh vertex for each fan of faces: corners are the same vertex when paired edges connect them. A
/// vertex with one fan and edges with two faces are what OpenMesh accepts in every order.
std::vector<uint32_t> unite_fans(const std::vector<uint32_t>& partner) {
    std::vector<uint32_t> fan(partner.size());
    std::iota(fan.begin(), fan.end(), 0u);
    for (uint32_t corner = 0; corner < partner.size(); ++corner) {
        if (partner[corner] == no_face) continue;
        unite(fan, corner, after(partner[corner]));
        unite(fan, after(corner), partner[corner]);
    }
    for (uint32_t corner = 0; corner < fan.size(); ++corner) fan[corner] = find_root(fan, corner);
    return fan;
}

/// Two paired edges between the same two fans are more than a half-edge mesh can hold: all but the first of them, by
/// rank, are taken apart. False when there is none.
bool part_double_edges(const FaceGraph& graph, const std::vector<uint32_t>& fan, std::vector<uint32_t>& partner) {
    struct Pair {
        uint32_t low;  ///< fans
        uint32_t high;
        uint32_t rank;
        uint32_t corner;
    };
    std::vector<Pair> pairs;
    for (uint32_t corner = 0; corner < partner.size(); ++corner) {
        if (partner[corner] == no_face) continue;
        const uint32_t rank = graph.ranks[corner / 3];
        if (graph.ranks[partner[corner] / 3] < rank) continue;
        const auto [low, high] = std::minmax(fan[corner], fan[after(corner)]);
        pairs.push_back({low, high, rank, corner});
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& l, const Pair& r) {
        return std::tie(l.low, l.high, l.rank) < std::tie(r.low, r.high, r.rank);
    });
    bool has_parted = false;
    for (size_t i = 1; i < pairs.size(); ++i) {
        if (pairs[i].low != pairs[i - 1].low || pairs[i].high != pairs[i - 1].high) continue;
        partner[partner[pairs[i].corner]] = no_face;
        partner[pairs[i].corner] = no_face;
        has_parted = true;
    }
    return has_parted;
}

HalfEdgeMesh build_mesh(const FaceGraph& graph, const std::vector<uint32_t>& fan) {
    // OpenMesh tells the terminal about every face it refuses; here a refusal is handled.
    [[maybe_unused]] static const bool is_quiet = (omerr().disable(), true);
    HalfEdgeMesh mesh;
    std::vector<HalfEdgeMesh::VertexHandle> vertices(fan.size());
    const auto add_vertex = [&](uint32_t corner) {
        const Vec3& p = graph.positions[graph.corners[corner / 3][corner % 3]];
        return mesh.add_vertex(HalfEdgeMesh::Point(p.x, p.y, p.z));
    };
    for (uint32_t corner = 0; corner < fan.size(); ++corner)
        vertices[corner] = fan[corner] == corner ? add_vertex(corner) : vertices[fan[corner]];
    // By rank: should a face be refused, it is the same one in every order.
    for (const uint32_t f : by_rank(graph)) {
        std::array<uint32_t, 3> c{};
        for (uint32_t k = 0; k < 3; ++k) c[k] = 3 * f + (graph.first_corners[f] + k) % 3;
        HalfEdgeMesh::FaceHandle face;
        // A face that closes on itself (two corners in one fan) is a sliver or a cone of two faces.
        const std::array<HalfEdgeMesh::VertexHandle, 3> v{vertices[c[0]], vertices[c[1]], vertices[c[2]]};
        if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) face = mesh.add_face(v[0], v[1], v[2]);
        // Two paired edges between the same two fans: the face becomes an island, so that none is lost.
        if (!face.is_valid()) face = mesh.add_face(add_vertex(c[0]), add_vertex(c[1]), add_vertex(c[2]));
        assert(face.is_valid() && face.idx() == static_cast<int>(graph.ranks[f]));
    }
    return mesh;
}

}  // namespace

std::vector<uint32_t> by_rank(const FaceGraph& graph) {
    std::vector<uint32_t> faces(graph.ranks.size());
    for (uint32_t f = 0; f < faces.size(); ++f) faces[graph.ranks[f]] = f;
    return faces;
}

FaceGraph build_face_graph(const Surface& surface) {
    FaceGraph graph;
    weld(surface, graph);
    measure_faces(graph);
    rank_faces(graph);
    std::vector<uint32_t> partner = pair_edges(graph);
    std::vector<uint32_t> fan = unite_fans(partner);
    while (part_double_edges(graph, fan, partner)) fan = unite_fans(partner);
    const HalfEdgeMesh mesh = build_mesh(graph, fan);
    assert(mesh.n_faces() == graph.corners.size());
    const std::vector<uint32_t> faces = by_rank(graph);
    graph.neighbours.assign(graph.corners.size(), {no_face, no_face, no_face});
    for (uint32_t f = 0; f < graph.corners.size(); ++f) {
        if (graph.is_sliver[f]) continue;
        const auto face = mesh.face_handle(graph.ranks[f]);
        // OpenMesh names the half-edge that enters the first corner; the edge from corner 0 comes after it.
        auto edge = mesh.halfedge_handle(face);
        const Vec3& first = graph.positions[graph.corners[f][0]];
        for (int i = 0; i < 3; ++i) {
            const auto& p = mesh.point(mesh.from_vertex_handle(edge));
            if (p[0] == first.x && p[1] == first.y && p[2] == first.z) break;
            edge = mesh.next_halfedge_handle(edge);
        }
        for (uint32_t k = 0; k < 3; ++k) {
            const auto beyond = mesh.face_handle(mesh.opposite_halfedge_handle(edge));
            if (beyond.is_valid()) graph.neighbours[f][k] = faces[static_cast<size_t>(beyond.idx())];
            edge = mesh.next_halfedge_handle(edge);
        }
    }
    graph.counts.components = count_components(graph);
    graph.counts.slivers = static_cast<size_t>(std::count(graph.is_sliver.begin(), graph.is_sliver.end(), true));
    return graph;
}

}  // namespace surimi
