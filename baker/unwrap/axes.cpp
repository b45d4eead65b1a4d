// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/axes.h"

#include <algorithm>
#include <cmath>

namespace surimi {

std::vector<Vec2> pack_axes(const FlatChart& chart, const MapSize& map) {
    std::vector<Vec2> axes{{1, 0}};
    if (chart.is_sliver) return axes;
    struct Option { double angle, area, need; };
    std::vector<Option> options;
    std::vector<Vec2> hull;
    {
        std::vector<Vec2> p = chart.points;
        const auto less = [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
        std::sort(p.begin(), p.end(), less);
        const auto side = [&](auto begin, auto end) {
            const size_t start = hull.size();
            for (auto q = begin; q != end; ++q) {
                while (hull.size() >= start + 2 && doubled_area(hull[hull.size() - 2], hull.back(), *q) <= 0) hull.pop_back();
                hull.push_back(*q);
            }
            hull.pop_back();
        };
        side(p.begin(), p.end());
        side(p.rbegin(), p.rend());
    }
    constexpr int steps = 90;
    for (int i = 0; i < steps; ++i) {
        const double angle = 0.5 * pi * i / steps;
        const Vec2 axis(std::cos(angle), std::sin(angle));
        Vec2 low{INFINITY}, high{-INFINITY};
        for (const Vec2& p : hull) {
            const Vec2 q(glm::dot(p, axis), axis.x * p.y - axis.y * p.x);
            low = glm::min(low, q);
            high = glm::max(high, q);
        }
        const Vec2 e = high - low;
        options.push_back({angle, e.x * e.y, std::min(std::max(e.x / map.width, e.y / map.height), std::max(e.y / map.width, e.x / map.height))});
    }
    std::vector<double> chosen{0};
    const auto add = [&](double angle) {
        for (double c : chosen) {
            double d = std::abs(angle - c);
            d = std::min(d, 0.5 * pi - d);
            if (d < 0.06) return;
        }
        chosen.push_back(angle);
        axes.emplace_back(std::cos(angle), std::sin(angle));
    };
    const auto least = std::min_element(options.begin(), options.end(), [](auto& a, auto& b) { return a.need < b.need; });
    if (least->need < 0.97 * options[0].need) add(least->angle);
    std::vector<Option> minima;
    for (int i = 0; i < steps; ++i)
        if (options[size_t(i)].area <= options[size_t((i + 1) % steps)].area && options[size_t(i)].area < options[size_t((i + steps - 1) % steps)].area) minima.push_back(options[size_t(i)]);
    std::sort(minima.begin(), minima.end(), [](auto& a, auto& b) { return a.area < b.area; });
    for (const Option& o : minima)
        if (o.area < 1.4 * options[0].area) add(o.angle);
    const size_t cap = getenv("AXES") ? size_t(atoi(getenv("AXES"))) : 9;
    if (axes.size() > cap) axes.resize(cap);
    if (getenv("A45")) { add(pi / 4);  add(pi / 8); add(3 * pi / 8);}
    return axes;
}

}  // namespace surimi
