// SPDX-License-Identifier: Apache-2.0
#include "tests/support/single_cover.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

namespace surimi::test {
namespace {

/// From the lexicographically lower end to the higher one; vertical edges lean right by an infinitesimal amount.
struct Edge {
    GridPoint left, right;
    bool is_entering;  ///< going up across it leads into a triangle: the triangle's edge runs from left to right
};

bool is_same_segment(const Edge& a, const Edge& b) {
    return a.left == b.left && a.right == b.right;
}

int sign(int64_t x) {
    return (x > 0) - (x < 0);
}

int side(const Edge& edge, const GridPoint& p) {
    return sign(doubled_area(edge.left, edge.right, p));
}

/// The edges that remain when opposite ones have cancelled, sorted by their left ends.
std::vector<Edge> outline(const std::vector<GridTriangle>& triangles) {
    std::vector<Edge> edges;
    for (const GridTriangle& t : triangles)
        for (size_t k = 0; k < 3; ++k) {
            const GridPoint &from = t[k], &to = t[(k + 1) % 3];
            edges.push_back(from < to ? Edge{from, to, true} : Edge{to, from, false});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.left, a.right, a.is_entering) < std::tie(b.left, b.right, b.is_entering);
    });
    std::vector<Edge> kept;
    for (size_t first = 0, last = 0; first < edges.size(); first = last) {
        ptrdiff_t balance = 0;
        for (; last < edges.size() && is_same_segment(edges[first], edges[last]); ++last)
            balance += edges[last].is_entering ? 1 : -1;
        for (; balance > 0; --balance) kept.push_back({edges[first].left, edges[first].right, true});
        for (; balance < 0; ++balance) kept.push_back({edges[first].left, edges[first].right, false});
    }
    return kept;
}

/// Do two edges have a point inside both in common, and different directions there?
bool do_cross(const Edge& a, const Edge& b) {
    return side(a, b.left) * side(a, b.right) < 0 && side(b, a.left) * side(b, a.right) < 0;
}

class Sweep {
  public:
    explicit Sweep(std::vector<Edge> edges) : edges_(std::move(edges)), places_(edges_.size()) {}

    std::string run() {
        std::vector<size_t> by_right(edges_.size());
        for (size_t e = 0; e < edges_.size(); ++e) by_right[e] = e;
        std::sort(by_right.begin(), by_right.end(),
                  [&](size_t a, size_t b) { return edges_[a].right < edges_[b].right; });
        size_t begun = 0, ended = 0;
        while (ended < edges_.size()) {
            const bool begins = begun < edges_.size() && edges_[begun].left < edges_[by_right[ended]].right;
            const GridPoint stop = begins ? edges_[begun].left : edges_[by_right[ended]].right;
            std::vector<size_t> changed;
            for (; ended < edges_.size() && edges_[by_right[ended]].right == stop; ++ended)
                remove(by_right[ended], changed);
            for (; begun < edges_.size() && edges_[begun].left == stop; ++begun) insert(begun, changed);
            for (const size_t e : changed)
                if (places_[e] != active_.end() && !fits_neighbours(places_[e]))
                    return "at " + std::to_string(stop[0]) + ", " + std::to_string(stop[1]);
        }
        return {};
    }

  private:
    /// Order along the sweep line, from below. Of edges in one place the one that leads out comes first.
    struct Below {
        const std::vector<Edge>* edges;
        bool operator()(size_t i, size_t j) const {
            const Edge &a = (*edges)[i], &b = (*edges)[j];
            const bool is_a_older = a.left <= b.left;
            const Edge &older = is_a_older ? a : b, &newer = is_a_older ? b : a;
            const int at_left = side(older, newer.left);
            const int newer_side = at_left != 0 ? at_left : side(older, newer.right);
            if (newer_side != 0) return (newer_side > 0) == is_a_older;
            if (a.is_entering != b.is_entering) return !a.is_entering;
            return i < j;
        }
    };
    using Active = std::set<size_t, Below>;

    void remove(size_t e, std::vector<size_t>& changed) {
        const auto place = places_[e];
        if (place != active_.begin()) changed.push_back(*std::prev(place));
        if (std::next(place) != active_.end()) changed.push_back(*std::next(place));
        active_.erase(place);
        places_[e] = active_.end();
    }

    void insert(size_t e, std::vector<size_t>& changed) {
        places_[e] = active_.insert(e).first;
        changed.push_back(e);
    }

    bool fits_neighbours(Active::iterator place) const {
        const bool is_first = place == active_.begin(), is_last = std::next(place) == active_.end();
        const Edge& edge = edges_[*place];
        if (is_first ? !edge.is_entering : !can_follow(edges_[*std::prev(place)], edge)) return false;
        return is_last ? !edge.is_entering : can_follow(edge, edges_[*std::next(place)]);
    }

    static bool can_follow(const Edge& lower, const Edge& upper) {
        return lower.is_entering != upper.is_entering && !do_cross(lower, upper);
    }

    std::vector<Edge> edges_;
    Active active_{Below{&edges_}};
    std::vector<Active::iterator> places_;  ///< active_.end() before and after an edge's time
};

}  // namespace

int64_t doubled_area(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::string find_double_cover(const std::vector<GridTriangle>& triangles) {
    return Sweep(outline(triangles)).run();
}

}  // namespace surimi::test
