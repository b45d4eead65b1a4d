// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/line_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/batch/batch.h"
#include "tests/support/quadrature.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

void add(Segments& segments, const Vec2& a, const Vec2& b, double jump) {
    segments.x0.push_back(a.x), segments.y0.push_back(a.y);
    segments.x1.push_back(b.x), segments.y1.push_back(b.y);
    segments.jump.push_back(jump);
    ++segments.count;
}

/// As project leaves them: with room for the widest lanes.
void pad(Segments& segments) {
    for (auto* numbers : {&segments.x0, &segments.y0, &segments.x1, &segments.y1, &segments.jump})
        numbers->resize(segments.count + 8, 0.0);
}

Lattice lattice_at(double angle, int count) {
    return {std::cos(angle), std::sin(angle), -1.3, 2.6 / count, 0.37, count};
}

TEST(LineSegments, CrossTheLinesThatPlainArithmeticSays) {
    Choice choice{Random{1}};
    Segments segments;
    for (int i = 0; i < 203; ++i) {
        const Vec2 a(choice.between(-1, 1), choice.between(-1, 1));
        add(segments, a, a + choice.between(0.001, 0.5) * Vec2(choice.between(-1, 1), choice.between(-1, 1)),
            i % 5 - 2.0);
    }
    pad(segments);
    const Lattice lattice = lattice_at(0.5, 64);
    for (const std::string& set : instruction_sets()) {
        SCOPED_TRACE(set);
        use_instruction_set(set);
        LineSegments crossed;
        find_crossed_lines(segments, lattice, crossed);
        size_t next = 0;
        for (size_t i = 0; i < segments.count; ++i) {
            const Vec2 a = lattice.to_frame({segments.x0[i], segments.y0[i]});
            const Vec2 b = lattice.to_frame({segments.x1[i], segments.y1[i]});
            std::vector<int> lines;
            for (int j = 0; j < lattice.count; ++j)
                if (std::min(a.y, b.y) <= lattice.height(j) && lattice.height(j) < std::max(a.y, b.y))
                    lines.push_back(j);
            if (lines.empty()) continue;
            ASSERT_LT(next, crossed.count);
            EXPECT_EQ(crossed.first[next], lines.front());
            EXPECT_EQ(crossed.last[next], lines.back());
            for (const int j : lines) {
                const double x = a.x + (lattice.height(j) - a.y) * (b.x - a.x) / (b.y - a.y);
                EXPECT_NEAR(crossed.x[next] + (j - lines.front()) * crossed.step[next], x, 1e-9);
            }
            EXPECT_EQ(crossed.jump[next], a.y < b.y ? -segments.jump[i] : segments.jump[i]);
            ++next;
        }
        EXPECT_EQ(next, crossed.count);
        EXPECT_GT(next, 100u);
    }
    use_instruction_set("");
}

TEST(LineSegments, ClosedChainsAreCrossedAnEvenNumberOfTimesByEveryLine) {
    // Some corners lie exactly on lines: whoever owns them, none is counted twice and none left out.
    Choice choice{Random{2}};
    const Lattice lattice{1, 0, -1, 1.0 / 16, 0, 33};
    for (int i = 0; i < 200; ++i) {
        std::vector<Vec2> corners;
        for (int k = 0; k < 7; ++k) {
            const double y = choice.between(-0.99, 0.99);
            corners.emplace_back(choice.between(-1, 1), k % 2 ? std::round(y * 16) / 16 : y);
        }
        Segments chain;
        for (size_t k = 0; k < corners.size(); ++k) add(chain, corners[k], corners[(k + 1) % corners.size()], 1);
        pad(chain);
        LineSegments crossed;
        find_crossed_lines(chain, lattice, crossed);
        for (int j = 0; j < lattice.count; ++j) {
            double sum = 0;
            for (size_t k = 0; k < crossed.count; ++k)
                if (crossed.first[k] <= j && j <= crossed.last[k]) sum += crossed.jump[k];
            EXPECT_EQ(sum, 0) << j;
        }
    }
}

TEST(LineEnds, IntegralsAreThoseOfQuadratureWithEveryInstructionSet_M54) {
    Choice choice{Random{3}};
    struct Case {
        double a, b, c, d, from, to;  // integral of (a + b x) / (c + d x^2)^2
    };
    std::vector<Case> cases;
    for (int i = 0; i < 101; ++i) {
        const double from = choice.between(-3, 3);
        cases.push_back({choice.between(-1, 1), choice.between(-1, 1), choice.between(0.05, 4), choice.between(0.1, 2),
                         from, from + choice.between(0.001, 4)});
    }
    for (const std::string& set : instruction_sets()) {
        SCOPED_TRACE(set);
        use_instruction_set(set);
        LineEnds ends;
        for (const Case& c : cases) {
            const double scale = std::sqrt(c.d / c.c), factor = 0.5 / (c.c * c.d);
            for (const double x : {c.from, c.to}) ends.add(x * scale, factor * c.a * scale, factor * c.b);
        }
        integrate_to_ends(ends);
        for (size_t i = 0; i < cases.size(); ++i) {
            const Case& c = cases[i];
            const auto value = [&](test::Real x) {
                const test::Real q = c.c + c.d * x * x;
                return (c.a + c.b * x) / (q * q);
            };
            const auto expected = static_cast<double>(test::integral(value, c.from, c.to));
            const double size = std::abs(ends.light[2 * i]) + std::abs(ends.light[2 * i + 1]);
            EXPECT_NEAR(ends.light[2 * i + 1] - ends.light[2 * i], expected, 4e-15 * size + 1e-15) << i;
        }
    }
    use_instruction_set("");
}

TEST(LineEnds, ArctangentsKeepTheirDigitsForAnyTangent) {
    LineEnds ends;
    std::vector<double> tangents;
    for (int k = -60; k <= 60; ++k)
        for (const double sign : {-1.0, 1.0}) tangents.push_back(sign * std::pow(1.7, k));
    for (const double t : {0.0, 0.41421356237309503, 0.41421356237309509, 1.0, 2.4142135623730949})
        tangents.push_back(t);
    for (const std::string& set : instruction_sets()) {
        use_instruction_set(set);
        ends.clear();
        for (const double t : tangents) ends.add(t, 1, 0);
        integrate_to_ends(ends);
        for (size_t i = 0; i < tangents.size(); ++i) {
            const double t = tangents[i], expected = t / (1 + t * t) + std::atan(t);
            EXPECT_NEAR(ends.light[i], expected, 1e-15 * std::abs(expected)) << set << ' ' << t;
        }
    }
    use_instruction_set("");
}

}  // namespace
}  // namespace surimi
