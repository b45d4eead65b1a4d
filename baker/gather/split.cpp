// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/split.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

using Segment = SplitWorkspace::Segment;

// In the panel's coordinates, which are of size 1. Coordinates carry the rounding of a projection, some 1e-15; corners
// this close to a line lie on it.
constexpr double corner_tolerance = 1e-12;
// Segments this close to a line have been cut by it: what they would add are slivers of this width.
constexpr double segment_tolerance = 1e-10;

/// A line through two places; its normal is of length 1.
struct Line {
    Vec2 normal;
    double offset;
    double height(const Vec2& p) const { return glm::dot(normal, p) + offset; }
};

Line line_through(const Segment& s) {
    const Vec2 d = s.b - s.a;
    const Vec2 normal = Vec2(-d.y, d.x) / glm::length(d);
    return {normal, -glm::dot(normal, s.a)};
}

/// A list on top of one of the workspace's stacks.
struct Range {
    size_t begin, end;
};

class Splitter {
  public:
    Splitter(const PanelView& view, double least, SplitWorkspace& work) : view_(view), least_(least), work_(work) {}

    void split(Range polygon, Range segments) {
        if (polygon.end - polygon.begin < 3) return;
        if (segments.begin == segments.end) return keep(polygon);
        const size_t longest = longest_of(segments);
        const Line line = line_through(work_.segments[longest]);
        for (const double side : {1.0, -1.0}) {
            const size_t corners = work_.corners.size(), pieces = work_.segments.size();
            cut_polygon(polygon, line, side);
            cut_segments(segments, longest, line, side);
            split({corners, work_.corners.size()}, {pieces, work_.segments.size()});
            work_.corners.resize(corners);
            work_.segments.resize(pieces);
        }
    }

  private:
    void keep(Range polygon) {
        const std::span<const Vec2> corners(work_.corners.data() + polygon.begin, polygon.end - polygon.begin);
        const double weight = contour_integral(view_, corners);
        if (!(weight > least_)) return;
        // The centre of area, by a fan.
        Vec2 sum(0);
        double doubled_area = 0;
        for (size_t i = 1; i + 1 < corners.size(); ++i) {
            const Vec2 u = corners[i] - corners[0], v = corners[i + 1] - corners[0];
            const double doubled = u.x * v.y - u.y * v.x;
            sum += doubled * (u + v) / 3.0;
            doubled_area += doubled;
        }
        const bool is_thin = !(std::abs(doubled_area) > 0);
        work_.fragments.push_back({weight, is_thin ? corners[0] : corners[0] + sum / doubled_area});
    }

    size_t longest_of(Range segments) const {
        size_t longest = segments.begin;
        double most = -1;
        for (size_t i = segments.begin; i < segments.end; ++i) {
            const Vec2 d = work_.segments[i].b - work_.segments[i].a;
            if (glm::dot(d, d) > most) most = glm::dot(d, d), longest = i;
        }
        return longest;
    }

    void cut_polygon(Range polygon, const Line& line, double side) {
        const size_t count = polygon.end - polygon.begin;
        Vec2 previous = work_.corners[polygon.end - 1];
        double previous_height = side * line.height(previous);
        for (size_t i = 0; i < count; ++i) {
            const Vec2 corner = work_.corners[polygon.begin + i];
            const double height = side * line.height(corner);
            if ((previous_height > corner_tolerance && height < -corner_tolerance) ||
                (previous_height < -corner_tolerance && height > corner_tolerance))
                work_.corners.push_back(previous +
                                        (corner - previous) * (previous_height / (previous_height - height)));
            if (height >= -corner_tolerance) work_.corners.push_back(corner);
            previous = corner;
            previous_height = height;
        }
    }

    void cut_segments(Range segments, size_t used, const Line& line, double side) {
        for (size_t i = segments.begin; i < segments.end; ++i) {
            if (i == used) continue;
            const Segment s = work_.segments[i];
            const double a = side * line.height(s.a), b = side * line.height(s.b);
            if (a < segment_tolerance && b < segment_tolerance) continue;
            if (a > -segment_tolerance && b > -segment_tolerance) {
                work_.segments.push_back(s);
                continue;
            }
            const Vec2 crossing = s.a + (s.b - s.a) * (a / (a - b));
            work_.segments.push_back(a > 0 ? Segment{s.a, crossing} : Segment{crossing, s.b});
        }
    }

    const PanelView& view_;
    double least_;
    SplitWorkspace& work_;
};

}  // namespace

PointVisibility split(const PanelView& view, const Segments& segments, const RayScene& rays, size_t monitor,
                      SplitWorkspace& work) {
    PointVisibility result;
    const double all = contour_integral(view, view.lit);
    if (!(all > 0) || view.open.empty()) return result;
    work.segments.clear();
    work.fragments.clear();
    work.corners.assign(view.open.begin(), view.open.end());
    for (size_t i = 0; i < segments.count; ++i) {
        const Segment s{{segments.x0[i], segments.y0[i]}, {segments.x1[i], segments.y1[i]}};
        const Vec2 d = s.b - s.a;
        if (glm::dot(d, d) > segment_tolerance * segment_tolerance) work.segments.push_back(s);
    }
    Splitter(view, 1e-12 * all, work).split({0, work.corners.size()}, {0, work.segments.size()});

    double seen = 0, blocked = 0;
    for (size_t i = 0; i < work.fragments.size(); i += RayPacket::capacity) {
        RayPacket packet;
        const size_t count = std::min(RayPacket::capacity, work.fragments.size() - i);
        for (size_t k = 0; k < count; ++k)
            packet.add(view.origin, view.panel->at(work.fragments[i + k].middle), view.end);
        const uint32_t hits = rays.occluded(packet, monitor);
        for (size_t k = 0; k < count; ++k) (hits >> k & 1u ? blocked : seen) += work.fragments[i + k].weight;
    }
    result.rays = work.fragments.size();
    // What the surface itself hides is missing from the fragments; what rounding dropped is too small to see.
    const double total = view.is_open() ? seen + blocked : all;
    result.visibility = total > 0 ? std::clamp(seen / total, 0.0, 1.0) : 0;
    return result;
}

}  // namespace surimi
