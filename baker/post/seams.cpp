// SPDX-License-Identifier: Apache-2.0
#include "baker/post/seams.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "baker/post/border_tree.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

// 2 sin(1 degree). Unit normals in bytes are off by up to 0.4 degrees on each side; two degrees change V by at most
// 0.035 V (1 - V) times a difference of two tangents of angles to the light: 2 of 255 codes, mostly far less (M60).
constexpr double normal_chord = 0.0349;
// Cosine of 66 degrees: the coarsest prism that is shaded as round has six sides, which bend by 60; five bend by 72.
constexpr double least_face_cosine = 0.4;
// Edges of equal length and place. More than a handful of sheets with the same normals is a scene gone wrong.
constexpr size_t most_partners = 16;

/// Where a piece of seam lies on an edge, as shares of the edge, in the order of the other's ends.
struct Overlap {
    std::array<double, 2> on_edge;   ///< increasing
    std::array<double, 2> on_other;  ///< decreasing
};

double snap(double share, double tolerance) {
    return share < tolerance ? 0 : share > 1 - tolerance ? 1 : share;
}

/// How far an edge and one that is not shorter and runs the other way are the same line.
std::optional<Overlap> overlap(const BorderEdge& edge, const BorderEdge& other) {
    const double tolerance = std::min(edge.tolerance, other.tolerance);
    const Vec3 along = edge.direction(), against = other.direction();
    if (glm::length(along + against) > 4 * tolerance / edge.length + 8 * std::numeric_limits<double>::epsilon())
        return {};
    const double begin = std::max(0.0, glm::dot(other.ends[1] - edge.ends[0], along));
    const double end = std::min(edge.length, glm::dot(other.ends[0] - edge.ends[0], along));
    if (!(end - begin > 4 * tolerance)) return {};  // one ends where the other begins
    Overlap found;
    const std::array<double, 2> at = {begin, end};
    for (size_t i = 0; i < 2; ++i) {
        const Vec3 place = edge.ends[0] + at[i] * along;
        const double on_other = std::clamp(glm::dot(place - other.ends[0], against), 0.0, other.length);
        if (glm::length(other.ends[0] + on_other * against - place) > tolerance) return {};
        found.on_edge[i] = snap(at[i] / edge.length, tolerance / edge.length);
        found.on_other[i] = snap(on_other / other.length, tolerance / other.length);
    }
    return found;
}

Vec3 normal_at(const BorderEdge& edge, double share) {
    return normalize_or(glm::mix(edge.normals[0], edge.normals[1], share), Vec3(edge.face));
}

bool is_one_place(const SeamPiece& piece, const Atlas& atlas) {
    if (piece.sides[0].page != piece.sides[1].page) return false;
    const double step = 4 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
                        std::max(atlas.width, atlas.height);  // texels: what uv in float can tell apart
    const auto is_near = [&](const Vec2& a, const Vec2& b) {
        return std::abs(a.x - b.x) <= step && std::abs(a.y - b.y) <= step;
    };
    return is_near(piece.sides[0].texels[0], piece.sides[1].texels[0]) &&
           is_near(piece.sides[0].texels[1], piece.sides[1].texels[1]);
}

SeamSide side_of(const BorderEdge& edge, const std::array<double, 2>& shares) {
    SeamSide side{edge.page, edge.chart, {}};
    for (size_t i = 0; i < 2; ++i) side.texels[i] = glm::mix(edge.texels[0], edge.texels[1], shares[i]);
    return side;
}

/// The seam of two edges, of which the second is not shorter.
std::optional<SeamPiece> seam_piece(const BorderEdge& edge, const BorderEdge& other, const Atlas& atlas) {
    if (glm::dot(Vec3(edge.face), Vec3(other.face)) < least_face_cosine) return {};
    const auto shared = overlap(edge, other);
    if (!shared) return {};
    for (size_t i = 0; i < 2; ++i)
        if (glm::length(normal_at(edge, shared->on_edge[i]) - normal_at(other, shared->on_other[i])) > normal_chord)
            return {};
    SeamPiece piece;
    piece.sides = {side_of(edge, shared->on_edge), side_of(other, shared->on_other)};
    piece.length = (shared->on_edge[1] - shared->on_edge[0]) * edge.length;
    if (is_one_place(piece, atlas)) return {};
    return piece;
}

/// The pieces between one edge and all that are longer, or as long and of a higher number.
std::vector<SeamPiece> pieces_of(const std::vector<BorderEdge>& edges, const BorderTree& tree, uint32_t number,
                                 const Atlas& atlas) {
    const BorderEdge& edge = edges[number];
    std::vector<std::pair<uint32_t, SeamPiece>> found;
    tree.visit_opposite(edge, [&](uint32_t other) {
        const bool is_mine =
            edges[other].length > edge.length || (edges[other].length == edge.length && other > number);
        if (!is_mine) return true;
        if (const auto piece = seam_piece(edge, edges[other], atlas)) found.push_back({other, *piece});
        return found.size() < most_partners;
    });
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<SeamPiece> pieces;
    for (const auto& [other, piece] : found) pieces.push_back(piece);
    return pieces;
}

}  // namespace

Seams find_seams(const Scene& scene, const Atlas& atlas) {
    const std::vector<BorderEdge> edges = find_border_edges(scene, atlas);
    const BorderTree tree(edges, normal_chord);
    constexpr size_t grain = 1024;
    std::vector<std::vector<SeamPiece>> found((edges.size() + grain - 1) / grain);
    parallel_ranges(edges.size(), grain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const auto pieces = pieces_of(edges, tree, static_cast<uint32_t>(i), atlas);
            found[begin / grain].insert(found[begin / grain].end(), pieces.begin(), pieces.end());
        }
    });
    Seams seams;
    for (const auto& pieces : found) seams.pieces.insert(seams.pieces.end(), pieces.begin(), pieces.end());
    return seams;
}

}  // namespace surimi
