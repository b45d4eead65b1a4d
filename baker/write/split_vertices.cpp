// SPDX-License-Identifier: Apache-2.0
#include "baker/write/split_vertices.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr uint32_t none = UINT32_MAX;

using CornerUv = std::array<Vec2f, 3>;

/// A copy of a source vertex at one place of the map; the copies of one source vertex form a list.
struct Copy {
    uint32_t source = 0;
    Vec2f uv{0};
    uint32_t next = none;
};

class Copies {
  public:
    explicit Copies(size_t vertex_count) : first_(vertex_count, none) {}

    uint32_t at(uint32_t source, const Vec2f& uv) {
        uint32_t* link = &first_[source];
        while (*link != none) {
            Copy& copy = copies_[*link];
            if (copy.uv == uv) return *link;
            link = &copy.next;
        }
        const auto id = static_cast<uint32_t>(copies_.size());
        *link = id;  // before the push: it may move the copy that `link` points into
        copies_.push_back({source, uv, none});
        return id;
    }

    std::optional<Vec2f> first_uv(uint32_t source) const {
        if (first_[source] == none) return std::nullopt;
        return copies_[first_[source]].uv;
    }

    /// Ids of all copies, sorted by source vertex, then by first use.
    std::vector<uint32_t> in_file_order() const {
        std::vector<uint32_t> order;
        order.reserve(copies_.size());
        for (const uint32_t first : first_)
            for (uint32_t id = first; id != none; id = copies_[id].next) order.push_back(id);
        return order;
    }

    const Copy& operator[](uint32_t id) const { return copies_[id]; }
    size_t size() const { return copies_.size(); }

  private:
    std::vector<uint32_t> first_;
    std::vector<Copy> copies_;
};

[[noreturn]] void throw_mismatch(const Surface& surface) {
    throw Error(ErrorKind::scene, surface.name + ": the file is not the one that was baked; run the bake again");
}

/// The uv of the file's corners, or nothing for triangles that the Scene dropped. The Scene may list a
/// triangle's corners in another order than the file (mirrored nodes, fans), so they are matched by vertex.
std::vector<std::optional<CornerUv>> uv_by_file_triangle(const Surface& surface, const SurfaceUv& uv,
                                                         std::span<const Triangle> file_triangles) {
    if (uv.uv.size() != surface.triangles.size()) throw_mismatch(surface);
    std::vector<std::optional<CornerUv>> result(file_triangles.size());
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        const uint32_t f = surface.source_triangle[t];
        if (f >= file_triangles.size()) throw_mismatch(surface);
        CornerUv corners;
        for (size_t c = 0; c < 3; ++c) {
            size_t k = 0;
            while (k < 3 && surface.source_vertex[surface.triangles[t][k]] != file_triangles[f][c]) ++k;
            if (k == 3) throw_mismatch(surface);
            corners[c] = uv.uv[t][k];
        }
        result[f] = corners;
    }
    return result;
}

CornerUv uv_of_dropped(const Triangle& triangle, const Copies& copies, const CornerUv& some_triangle) {
    std::array<std::optional<Vec2f>, 3> known;
    for (size_t c = 0; c < 3; ++c) known[c] = copies.first_uv(triangle[c]);
    CornerUv corners;
    for (size_t c = 0; c < 3; ++c) {
        size_t k = c;
        while (k < c + 3 && !known[k % 3]) ++k;
        corners[c] = known[k % 3].value_or(some_triangle[0]);
    }
    if (corners[0] == corners[1] && corners[1] == corners[2]) return some_triangle;
    return corners;
}

}  // namespace

SplitVertices split_vertices(const Surface& surface, const SurfaceUv& uv, std::span<const Triangle> file_triangles,
                             size_t vertex_count) {
    assert(!surface.triangles.empty());
    const auto kept = uv_by_file_triangle(surface, uv, file_triangles);
    Copies copies(vertex_count);
    std::vector<Triangle> triangles(file_triangles.size());
    const auto place = [&](size_t f, const CornerUv& corners) {
        for (size_t c = 0; c < 3; ++c) triangles[f][c] = copies.at(file_triangles[f][c], corners[c]);
    };
    for (const Triangle& triangle : file_triangles)
        for (const uint32_t vertex : triangle)
            if (vertex >= vertex_count) throw_mismatch(surface);
    for (size_t f = 0; f < kept.size(); ++f)
        if (kept[f]) place(f, *kept[f]);
    for (size_t f = 0; f < kept.size(); ++f)
        if (!kept[f]) place(f, uv_of_dropped(file_triangles[f], copies, uv.uv[0]));

    SplitVertices split;
    std::vector<uint32_t> position(copies.size());
    for (const uint32_t id : copies.in_file_order()) {
        position[id] = static_cast<uint32_t>(split.source.size());
        split.source.push_back(copies[id].source);
        split.uv.push_back(copies[id].uv);
    }
    for (Triangle& triangle : triangles)
        for (uint32_t& vertex : triangle) vertex = position[vertex];
    split.triangles = std::move(triangles);
    split.is_unchanged = split.source.size() == vertex_count &&
                         std::adjacent_find(split.source.begin(), split.source.end(), std::greater_equal<uint32_t>()) ==
                             split.source.end();
    return split;
}

}  // namespace surimi
