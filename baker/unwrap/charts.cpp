// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/charts.h"

#include <algorithm>
#include <numeric>

namespace surimi {
namespace {

/// Faces meeting at more than this are cut apart: a seam on a crease is not seen. 46 degrees keeps octagonal
/// columns together.
const double crease_cosine = std::cos(46 * pi / 180);
/// While growing, no face may lean further from the chart's mean normal: stretch up to 1 / cos = 1.5.
const double lean_cosine = std::cos(48 * pi / 180);
/// The verdict on the finished chart leaves some room for what growing only estimates.
const double lean_limit_cosine = std::cos(51.5 * pi / 180);

/// A region remembers its outermost normals in these directions instead of all its normals: faces, edges and
/// corners of the cube.
std::vector<Vec3> make_directions() {
    std::vector<Vec3> directions;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x != 0 || y != 0 || z != 0) directions.push_back(glm::normalize(Vec3(x, y, z)));
    return directions;
}

/// Regions that grow together, cheapest union first. The cost of a union is the area-weighted spread of
/// normals that it adds (Ward's criterion): planes come first, then small pieces join what they resemble.
class Growth {
  public:
    explicit Growth(const FaceGraph& graph) : graph_(graph), directions_(make_directions()) {
        const size_t count = graph.corners.size();
        parent_.resize(count);
        std::iota(parent_.begin(), parent_.end(), 0u);
        size_.assign(count, 1);
        sum_.resize(count);
        double total = 0;
        for (size_t f = 0; f < count; ++f) {
            sum_[f] = graph.areas[f] * graph.normals[f];
            total += graph.areas[f];
        }
        outermost_.resize(count * directions_.size());
        for (size_t f = 0; f < count; ++f)
            std::fill_n(outermost_.begin() + static_cast<std::ptrdiff_t>(f * directions_.size()), directions_.size(),
                        static_cast<uint32_t>(f));
        // Below the rounding of the sums all costs are alike.
        floor_ = 1e-13 * total;
    }

    /// Every edge waits in the bucket of its cost. An edge whose cost has risen since goes to a later bucket;
    /// none goes back, so each edge moves at most `buckets` times.
    void run() {
        std::vector<std::vector<Edge>> waiting(bucket_count);
        for (uint32_t f = 0; f < graph_.corners.size(); ++f)
            for (const uint32_t g : graph_.neighbours[f])
                if (g != no_face && f < g && glm::dot(graph_.normals[f], graph_.normals[g]) > crease_cosine)
                    waiting[bucket(f, g)].push_back({f, g});
        for (size_t b = 0; b < bucket_count; ++b) {
            for (size_t i = 0; i < waiting[b].size(); ++i) {
                const Edge edge = waiting[b][i];
                const uint32_t r = root(edge.a);
                const uint32_t s = root(edge.b);
                if (r == s) continue;
                const size_t now = bucket(r, s);
                if (now > b)
                    waiting[now].push_back(edge);
                else if (is_flat_enough(r, s))
                    unite(r, s);
            }
            waiting[b] = {};
        }
    }

    std::vector<std::vector<uint32_t>> regions() {
        std::vector<uint32_t> number(graph_.corners.size(), no_face);
        std::vector<std::vector<uint32_t>> result;
        for (uint32_t f = 0; f < graph_.corners.size(); ++f) {
            uint32_t& n = number[root(f)];
            if (n == no_face) {
                n = static_cast<uint32_t>(result.size());
                result.emplace_back();
            }
            result[n].push_back(f);
        }
        return result;
    }

  private:
    struct Edge {
        uint32_t a;
        uint32_t b;
    };
    static constexpr size_t bucket_count = 200;

    uint32_t root(uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    size_t bucket(uint32_t r, uint32_t s) const {
        const double cost = glm::length(sum_[r]) + glm::length(sum_[s]) - glm::length(sum_[r] + sum_[s]);
        if (!(cost > floor_)) return 0;
        const double step = 1 + 4 * std::log2(cost / floor_);  // four buckets an octave
        return std::min(bucket_count - 1, static_cast<size_t>(step));
    }

    bool is_flat_enough(uint32_t r, uint32_t s) const {
        const Vec3 axis = normalize_or(sum_[r] + sum_[s], Vec3(0));
        for (const uint32_t region : {r, s})
            for (size_t d = 0; d < directions_.size(); ++d)
                if (glm::dot(axis, graph_.normals[outermost_[region * directions_.size() + d]]) < lean_cosine)
                    return false;
        return true;
    }

    void unite(uint32_t r, uint32_t s) {
        if (size_[r] < size_[s] || (size_[r] == size_[s] && s < r)) std::swap(r, s);
        parent_[s] = r;
        size_[r] += size_[s];
        sum_[r] += sum_[s];
        for (size_t d = 0; d < directions_.size(); ++d) {
            uint32_t& mine = outermost_[r * directions_.size() + d];
            const uint32_t other = outermost_[s * directions_.size() + d];
            if (glm::dot(graph_.normals[other], directions_[d]) > glm::dot(graph_.normals[mine], directions_[d]))
                mine = other;
        }
    }

    const FaceGraph& graph_;
    std::vector<Vec3> directions_;
    std::vector<uint32_t> parent_;
    std::vector<uint32_t> size_;
    std::vector<Vec3> sum_;
    std::vector<uint32_t> outermost_;  ///< for each region and direction, the face whose normal goes furthest
    double floor_ = 0;
};

/// Two faces (numbers within the chart) that cannot stay together, if there are any.
bool find_conflict(const FaceGraph& graph, const FlatChart& chart, std::array<uint32_t, 2>& conflict) {
    if (chart.faces.size() < 2) return false;
    Vec3 sum(0);
    for (const uint32_t f : chart.faces) sum += graph.areas[f] * graph.normals[f];
    const Vec3 axis = normalize_or(sum, Vec3(0));
    const auto lean = [&](uint32_t i) { return glm::dot(axis, graph.normals[chart.faces[i]]); };
    uint32_t outermost = 0;
    for (uint32_t i = 1; i < chart.faces.size(); ++i)
        if (lean(i) < lean(outermost)) outermost = i;
    if (lean(outermost) < lean_limit_cosine) {
        // Against the face that leans the other way the most.
        uint32_t opposite = outermost == 0 ? 1 : 0;
        const Vec3& from = graph.normals[chart.faces[outermost]];
        for (uint32_t i = 0; i < chart.faces.size(); ++i)
            if (i != outermost &&
                glm::dot(graph.normals[chart.faces[i]], from) < glm::dot(graph.normals[chart.faces[opposite]], from))
                opposite = i;
        conflict = {outermost, opposite};
        return true;
    }
    // As fine as float texture coordinates are on a quarter of the map; contacts of a few such units are left
    // to round_chart, which knows the final coordinates.
    constexpr double units = 1 << 22;
    constexpr double margin = 3;
    const auto pairs = overlapping_pairs(rounded_triangles(chart, units), margin, 64);
    if (pairs.empty()) return false;
    conflict = pairs[pairs.size() / 2];
    return true;
}

}  // namespace

void add_valid_charts(const FaceGraph& graph, std::vector<uint32_t> faces, std::vector<FlatChart>& charts) {
    std::vector<std::vector<uint32_t>> open = connected_parts(graph, faces);
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
        FlatChart chart = flatten(graph, std::move(open.back()));
        open.pop_back();
        std::array<uint32_t, 2> conflict{};
        if (!find_conflict(graph, chart, conflict)) {
            charts.push_back(std::move(chart));
            continue;
        }
        auto halves = split_between(graph, chart.faces, conflict);
        open.push_back(std::move(halves[1]));
        open.push_back(std::move(halves[0]));
    }
}

std::vector<FlatChart> cut_into_charts(const FaceGraph& graph) {
    Growth growth(graph);
    growth.run();
    std::vector<FlatChart> charts;
    for (std::vector<uint32_t>& region : growth.regions()) {
        if (region.size() == 1 && graph.is_sliver[region[0]])
            charts.push_back(make_sliver(region[0]));
        else
            add_valid_charts(graph, std::move(region), charts);
    }
    return charts;
}

}  // namespace surimi
