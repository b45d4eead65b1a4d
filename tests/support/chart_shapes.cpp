// SPDX-License-Identifier: Apache-2.0
#include "tests/support/chart_shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace surimi::test {
namespace {

/// std's distributions differ between libraries; this is the same everywhere.
class Random {
  public:
    explicit Random(uint32_t seed) : bits_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(bits_()) / 4294967296.0);
    }
    /// Many small and few large ones.
    double size(double least, double most) { return least * std::pow(most / least, std::pow(between(0, 1), 2)); }

  private:
    std::mt19937 bits_;
};

void finish(FlatChart& chart, double angle) {
    Vec2 low{INFINITY};
    Vec2 high{-INFINITY};
    for (Vec2& p : chart.points) {
        p = {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    for (Vec2& p : chart.points) p -= low;
    chart.extent = high - low;
    for (uint32_t i = 0; i < chart.triangles.size(); ++i) {
        const auto& t = chart.triangles[i];
        chart.faces.push_back(i);
        chart.flat_area += 0.5 * doubled_area(chart.points[t[0]], chart.points[t[1]], chart.points[t[2]]);
    }
    chart.area = chart.flat_area;
}

Vec2 on_circle(double radius, double angle) {
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Two arcs of a circle that end in the same points.
FlatChart crescent(double radius, double thickness) {
    std::vector<Vec2> left;
    std::vector<Vec2> right;
    constexpr int steps = 48;
    for (int i = 1; i < steps; ++i) {
        const double angle = pi * i / steps;
        right.push_back(on_circle(radius, angle));
        left.push_back(on_circle(radius, angle) * Vec2(1, 1 - thickness));
    }
    return strip_between(left, right, 0);
}

/// A sphere's surface between two meridians, laid flat along its middle.
FlatChart lune(double radius, double sector) {
    std::vector<Vec2> left;
    std::vector<Vec2> right;
    constexpr int steps = 32;
    for (int i = 1; i < steps; ++i) {
        const double latitude = pi * i / steps;
        const double half = 0.5 * sector * radius * std::sin(latitude);
        left.emplace_back(radius * latitude, half);
        right.emplace_back(radius * latitude, -half);
    }
    return strip_between(left, right, 0);
}

/// A band along a course of right angles.
FlatChart bent_band(const std::vector<Vec2>& course, double half) {
    std::vector<Vec2> left;
    std::vector<Vec2> right;
    for (size_t i = 0; i < course.size(); ++i) {
        const Vec2 before = glm::normalize(course[std::max<size_t>(i, 1)] - course[std::max<size_t>(i, 1) - 1]);
        const size_t next = std::min(i + 1, course.size() - 1);
        const Vec2 after = glm::normalize(course[next] - course[next - 1]);
        const Vec2 normal(-(before + after).y, (before + after).x);
        const double scale = half / (0.5 * glm::dot(normal, normal));  // keeps the band's width around corners
        left.push_back(course[i] + normal * scale);
        right.push_back(course[i] - normal * scale);
    }
    return strip_between(left, right, 0);
}

FlatChart blob(Random& random, double radius) {
    FlatChart chart;
    constexpr int corners = 72;
    double phase[5];
    double height[5];
    for (int k = 0; k < 5; ++k) {
        phase[k] = random.between(0, 2 * pi);
        height[k] = random.between(0, 0.6) / (k + 2);
    }
    chart.points.emplace_back(0, 0);
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * pi * i / corners;
        double r = 1;
        for (int k = 0; k < 5; ++k) r += height[k] * std::sin((k + 2) * angle + phase[k]);
        chart.points.push_back(on_circle(radius * std::max(r, 0.15), angle));
    }
    for (uint32_t i = 0; i < corners; ++i) chart.triangles.push_back({0, 1 + i, 1 + (i + 1) % corners});
    finish(chart, 0);
    return chart;
}

std::vector<FlatChart> repeat(int count, const std::function<FlatChart()>& make) {
    std::vector<FlatChart> charts;
    for (int i = 0; i < count; ++i) charts.push_back(make());
    return charts;
}

FlatChart random_arc(Random& random) {
    const double outer = random.size(1, 6);
    return arc_chart(outer * random.between(0.5, 0.9), outer, random.between(0.5, 5.5));
}

FlatChart random_band(Random& random) {
    const double a = random.size(1, 6);
    const double b = random.size(1, 6);
    const double half = random.between(0.05, 0.2) * std::min(a, b);
    if (random.between(0, 1) < 0.5) return bent_band({{0, 0}, {a, 0}, {a, b}}, half);
    return bent_band({{0, b}, {0, 0}, {a, 0}, {a, b * random.between(0.6, 1)}}, half);
}

FlatChart random_strip(Random& random) {
    return rectangle_chart(random.size(4, 20), random.between(0.2, 1));
}

FlatChart random_rectangle(Random& random, double most) {
    const double size = random.size(0.1, most);
    return rectangle_chart(size, size * random.between(0.2, 1));
}

std::vector<FlatChart> mixture(Random& random, int count) {
    std::vector<FlatChart> charts;
    for (int i = 0; i < count; ++i) {
        charts.push_back(random_arc(random));
        charts.push_back(random_band(random));
        charts.push_back(blob(random, random.size(0.3, 4)));
        charts.push_back(random_strip(random));
        charts.push_back(lune(random.size(0.5, 3), random.between(0.3, 1)));
        charts.push_back(crescent(random.size(0.5, 4), random.between(0.2, 0.8)));
        for (int k = 0; k < 4; ++k) charts.push_back(random_rectangle(random, 3));
    }
    return charts;
}

}  // namespace

FlatChart strip_between(const std::vector<Vec2>& left, const std::vector<Vec2>& right, double angle) {
    FlatChart chart;
    for (uint32_t i = 0; i < left.size(); ++i) {
        chart.points.push_back(right[i]);
        chart.points.push_back(left[i]);
        if (i == 0) continue;
        chart.triangles.push_back({2 * i - 2, 2 * i, 2 * i + 1});
        chart.triangles.push_back({2 * i - 2, 2 * i + 1, 2 * i - 1});
    }
    finish(chart, angle);
    return chart;
}

FlatChart rectangle_chart(double width, double height, double angle) {
    return strip_between({{0, height}, {width, height}}, {{0, 0}, {width, 0}}, angle);
}

FlatChart arc_chart(double inner, double outer, double sector) {
    std::vector<Vec2> left;
    std::vector<Vec2> right;
    constexpr int steps = 64;
    for (int i = 0; i <= steps; ++i) {
        const double angle = sector * i / steps;
        left.push_back(on_circle(inner, angle));
        right.push_back(on_circle(outer, angle));
    }
    return strip_between(left, right, 0);
}

std::vector<ChartSet> chart_sets() {
    Random random(1);
    std::vector<ChartSet> sets;
    sets.push_back({"one blob", {blob(random, 1)}});
    sets.push_back({"one strip", {rectangle_chart(20, 1)}});
    sets.push_back({"3 strips", {rectangle_chart(20, 1), rectangle_chart(19, 1), rectangle_chart(5, 2)}});
    sets.push_back({"6 blobs", repeat(6, [&] { return blob(random, random.between(0.6, 2)); })});
    sets.push_back({"12 lunes", repeat(12, [] { return lune(1, pi / 6); })});
    sets.push_back({"12 arcs", repeat(12, [] { return arc_chart(2, 3, 5.5); })});
    sets.push_back({"40 arcs", repeat(40, [&] { return random_arc(random); })});
    sets.push_back({"40 L and U", repeat(40, [&] { return random_band(random); })});
    sets.push_back({"60 blobs", repeat(60, [&] { return blob(random, random.size(0.2, 4)); })});
    sets.push_back({"60 strips", repeat(60, [&] { return random_strip(random); })});
    sets.push_back({"100 mixed", mixture(random, 10)});
    sets.push_back({"1000 mixed", mixture(random, 100)});
    sets.push_back({"1000 blobs", repeat(1000, [&] { return blob(random, random.size(0.2, 4)); })});
    sets.push_back({"10000 rectangles", repeat(10000, [&] { return random_rectangle(random, 3); })});
    sets.push_back({"10000 mixed", mixture(random, 1000)});
    return sets;
}

}  // namespace surimi::test
