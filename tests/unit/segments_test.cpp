// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/batch/batch.h"
#include "tests/support/edge_sight.h"
#include "tests/support/seen_panel.h"

namespace surimi {
namespace {

using test::SeenPanel;

struct Plain {
    Vec2 a, b;
    int jump = 0, side_a = -1, side_b = -1;
};

/// One candidate after the other, in double: classified, clipped by the cone over the open polygon, by the clearance
/// and before the apex, projected.
std::vector<Plain> plainly_projected(const SeenPanel& seen) {
    const Candidates& c = seen.candidates;
    const PanelView& view = seen.view;
    std::vector<Plain> all;
    for (size_t i = 0; i < c.count; ++i) {
        const auto sign = [&](const Vec3& n, double d) { return glm::dot(n, view.origin) >= d ? 1 : -1; };
        const int jump = sign({c.nx[i], c.ny[i], c.nz[i]}, c.nd[i]) +
                         static_cast<int>(c.second[i]) * sign({c.mx[i], c.my[i], c.mz[i]}, c.md[i]);
        if (jump == 0) continue;
        const auto seen_at = [&](const Vec3& place) {
            const Vec3 x = place - view.origin;
            return Vec3(glm::dot(view.row_s, x), glm::dot(view.row_t, x), glm::dot(view.row_w, x));
        };
        const Vec3 a = seen_at({c.ax[i], c.ay[i], c.az[i]}), b = seen_at({c.bx[i], c.by[i], c.bz[i]});
        double low = 0, high = 1;
        Plain plain{{}, {}, jump, -1, -1};
        const auto clip = [&](double from, double to, int side) {
            if (from < 0 && to < 0) low = 2;
            if (from < 0 && to >= 0 && from / (from - to) > low) low = from / (from - to), plain.side_a = side;
            if (to < 0 && from >= 0 && from / (from - to) < high) high = from / (from - to), plain.side_b = side;
        };
        for (size_t k = 0; k < view.open.size(); ++k) {
            const Vec2 u = view.open[k], along = view.open[(k + 1) % view.open.size()] - u;
            const auto left_of = [&](const Vec3& h) {
                return along.x * (h.y - u.y * h.z) - along.y * (h.x - u.x * h.z);
            };
            clip(left_of(a), left_of(b), static_cast<int>(k));
        }
        if (i < seen.first_cut) clip(view.end - a.z, view.end - b.z, -2);
        clip(a.z - 1e-9, b.z - 1e-9, -2);
        if (!(low < high)) continue;
        const auto place = [&](double at) {
            const Vec3 h = a + at * (b - a);
            return Vec2(h.x, h.y) / h.z;
        };
        plain.a = place(low), plain.b = place(high);
        all.push_back(plain);
    }
    return all;
}

TEST(Segments, AreThoseOfPlainArithmeticWithEveryInstructionSet) {
    SeenPanel seen(test::occluded_scene(3, 40, 6));
    for (const std::string& set : instruction_sets()) {
        SCOPED_TRACE(set);
        use_instruction_set(set);
        Choice choice{Random{4}};
        size_t count = 0, clipped = 0;
        for (int i = 0; i < 60; ++i) {
            seen.look_from_below(choice, i % 2);
            const std::vector<Plain> plain = plainly_projected(seen);
            ASSERT_EQ(seen.segments.count, plain.size());
            std::vector<uint32_t> on_sides;
            for (size_t k = 0; k < plain.size(); ++k) {
                const Segments& s = seen.segments;
                EXPECT_LT(glm::length(Vec2(s.x0[k], s.y0[k]) - plain[k].a), 1e-9);
                EXPECT_LT(glm::length(Vec2(s.x1[k], s.y1[k]) - plain[k].b), 1e-9);
                EXPECT_EQ(s.jump[k], plain[k].jump);
                EXPECT_EQ(s.side0[k], plain[k].side_a);
                EXPECT_EQ(s.side1[k], plain[k].side_b);
                if (plain[k].side_a >= 0 || plain[k].side_b >= 0) on_sides.push_back(static_cast<uint32_t>(k));
            }
            EXPECT_EQ(seen.segments.on_sides, on_sides);
            count += plain.size();
            clipped += on_sides.size();
        }
        EXPECT_GT(count, 1000u);
        EXPECT_GT(clipped, 100u);
    }
    use_instruction_set("");
}

/// Is c to the left of the line from a to b?
bool is_left(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) > (b.y - a.y) * (c.x - a.x);
}

TEST(Segments, JumpsCountTheOccludersBetweenTwoPlacesOfThePanel_M50) {
    SeenPanel seen(test::occluded_scene(5, 40, 6));
    Choice choice{Random{6}};
    int different = 0;
    for (int i = 0; i < 40; ++i) {
        seen.look_from_below(choice, 0);
        const Segments& s = seen.segments;
        for (int k = 0; k < 50; ++k) {
            const auto inside = [&] { return Vec2(choice.between(-0.4, 0.4), choice.between(-0.4, 0.4)); };
            const Vec2 from = inside(), to = inside();
            int jumps = 0;
            for (size_t j = 0; j < s.count; ++j) {
                const Vec2 a(s.x0[j], s.y0[j]), b(s.x1[j], s.y1[j]);
                if (is_left(from, to, a) == is_left(from, to, b) || is_left(a, b, from) == is_left(a, b, to)) continue;
                jumps += static_cast<int>(s.jump[j]) * (is_left(a, b, to) ? 1 : -1);
            }
            const auto depth = [&](const Vec2& q) {
                const Vec3 way = seen.panel.at(q) - seen.view.origin;
                return test::depth_complexity(seen.scene, seen.rays.center(), seen.view.origin,
                                              seen.view.origin + seen.view.end * way);
            };
            EXPECT_EQ(jumps, depth(to) - depth(from));
            different += jumps != 0;
        }
    }
    EXPECT_GT(different, 500);
}

TEST(Segments, WhatCrossesTheClearanceIsClosedByItsCuts_M53) {
    // A sheet through the panel: seen from below only its part before the plane hides anything.
    Scene scene = test::occluded_scene(0, 0, 0);
    test::add_quad(scene, "Through", {-0.3, 2, 0.2}, {0.3, 2.1, 0.2}, {0.3, 3, 0.3}, {-0.3, 3.1, 0.3});
    SeenPanel seen(std::move(scene));
    EXPECT_GT(seen.candidates.count, seen.first_cut) << "two triangles, two cuts";
    EXPECT_EQ(seen.candidates.count - seen.first_cut, 2u);
    seen.look_from({0.1, 0.01, -1.2}, {0, 1, 0});
    const Segments& s = seen.segments;
    ASSERT_GT(s.count, 3u);
    // Every end that is not on the polygon's border is another segment's beginning or end: the outline is closed.
    for (size_t i = 0; i < s.count; ++i) {
        for (const auto& [end, side] :
             {std::pair{Vec2(s.x0[i], s.y0[i]), s.side0[i]}, {Vec2(s.x1[i], s.y1[i]), s.side1[i]}}) {
            if (side >= 0) continue;
            double nearest = INFINITY;
            for (size_t j = 0; j < s.count; ++j) {
                if (j == i) continue;
                nearest = std::min(
                    {nearest, glm::length(Vec2(s.x0[j], s.y0[j]) - end), glm::length(Vec2(s.x1[j], s.y1[j]) - end)});
            }
            EXPECT_LT(nearest, 1e-5) << end.x << ' ' << end.y;  // cuts are stored as float
        }
    }
}

TEST(Segments, NoCandidatesGiveNone) {
    Candidates none;
    none.finish();
    SeenPanel seen(test::occluded_scene(0, 0, 0));
    seen.look_from({0, 0.01, 0}, {0, 1, 0});
    project(none, 0, seen.view, seen.segments);
    EXPECT_EQ(seen.segments.count, 0u);
    EXPECT_TRUE(seen.segments.on_sides.empty());
}

}  // namespace
}  // namespace surimi
