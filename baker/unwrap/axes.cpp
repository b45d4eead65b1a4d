// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/axes.h"

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

constexpr size_t most_axes = 3;  ///< more cost time in proportion, and gained nothing
constexpr size_t angles = 90;    ///< of a quarter turn that are tried
/// Axes that are nearer to each other than this (radians) lay a chart in much the same way.
constexpr double least_difference = 0.06;
/// Boxes larger than the best by more than this leave too much empty around the chart.
constexpr double most_box = 1.4;
/// A turn has to spare this share of the map's extent to be worth more than a tighter box.
constexpr double least_saving = 0.03;

struct Option {
    double angle = 0;
    double box = 0;   ///< area
    double need = 0;  ///< the smallest copy of the map that holds the box, relative
};

std::vector<Option> list_options(const FlatChart& chart, const Outline& outline, const MapSize& map) {
    std::vector<Option> options;
    for (size_t i = 0; i < angles; ++i) {
        const double angle = 0.5 * pi * static_cast<double>(i) / angles;
        const Vec2 axis(std::cos(angle), std::sin(angle));
        Vec2 low{INFINITY};
        Vec2 high{-INFINITY};
        for (const auto& edge : outline) {  // every corner of an outline begins or ends an edge
            const Vec2 q = to_axis(chart.points[edge[0]], axis);
            const Vec2 r = to_axis(chart.points[edge[1]], axis);
            low = glm::min(low, glm::min(q, r));
            high = glm::max(high, glm::max(q, r));
        }
        const Vec2 size = high - low;
        const double upright = std::max(size.x / map.width, size.y / map.height);
        const double turned = std::max(size.y / map.width, size.x / map.height);
        options.push_back({angle, size.x * size.y, std::min(upright, turned)});
    }
    return options;
}

}  // namespace

std::vector<Vec2> pack_axes(const FlatChart& chart, const Outline& outline, const MapSize& map) {
    const std::vector<Option> options = list_options(chart, outline, map);
    std::vector<Option> candidates;
    const auto needs_less = [](const Option& a, const Option& b) { return a.need < b.need; };
    const Option& least = *std::min_element(options.begin(), options.end(), needs_less);
    for (size_t i = 0; i < angles; ++i) {
        const double before = options[(i + angles - 1) % angles].box;
        const bool is_tight = options[i].box < before && options[i].box <= options[(i + 1) % angles].box;
        if (is_tight && options[i].box < most_box * options[0].box) candidates.push_back(options[i]);
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Option& a, const Option& b) { return a.box < b.box; });
    if (least.need < (1 - least_saving) * options[0].need) candidates.insert(candidates.begin(), least);

    std::vector<double> chosen{0};
    for (const Option& option : candidates) {
        const auto is_near = [&](double angle) {
            const double difference = std::abs(option.angle - angle);
            return std::min(difference, 0.5 * pi - difference) < least_difference;
        };
        if (chosen.size() < most_axes && std::none_of(chosen.begin(), chosen.end(), is_near))
            chosen.push_back(option.angle);
    }
    std::vector<Vec2> axes;
    for (const double angle : chosen) axes.emplace_back(std::cos(angle), std::sin(angle));
    return axes;
}

}  // namespace surimi
