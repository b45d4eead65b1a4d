// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/pack.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "runtime/base/parallel.h"

namespace surimi {
namespace {

/// Height that a rule looks at, above the mask's lowest row, in 1/16 texels.
int64_t height_under(PackRule rule, const Mask& mask) {
    if (rule == PackRule::upper_end) return 16 * mask.height;
    int64_t sum = 0;
    for (const Mask::Run& run : mask.runs) sum += static_cast<int64_t>(run.row) * run.length;
    return 16 * sum / static_cast<int64_t>(std::max<size_t>(1, mask.texels));
}

class Packer {
  public:
    Packer(const PackCharts& charts, const MapSize& map, int gutter, const PackPlan& plan)
        : charts_(charts), gutter_(gutter), plan_(plan), taken_(map) {}

    bool place(uint32_t chart, Placement& result) {
        const MapSize& map = taken_.size();
        const std::vector<Mask>& masks = charts_.masks[chart];
        // A chart of the same size lies there, and the map only fills up: below it, one of the same form finds no
        // place, and one of another form seldom. Looking costs three times the time for 0.3 % of density.
        const Mask& m = masks[0];
        int& hint = hint_[{std::max(m.width, m.height), std::min(m.width, m.height)}];
        const auto is_pose = [&](const Mask& mask) {
            return plan_.poses[chart].shape == mask.shape && plan_.poses[chart].turns == mask.turns;
        };
        const bool has_pose = !plan_.poses.empty() && std::any_of(masks.begin(), masks.end(), is_pose);
        std::tuple<int64_t, int> best{INT64_MAX, INT32_MAX};  // height, x
        for (size_t i = 0; i < masks.size(); ++i) {
            const Mask& mask = masks[i];
            if (has_pose && !is_pose(mask)) continue;
            const int64_t height = height_under(plan_.rule, mask);
            const int last = map.height - mask.height;
            template_ = charts_.templates[chart][i];
            for (int y = hint; y <= last && 16 * y + height <= std::get<0>(best); ++y) {
                const int x = taken_.first_free(template_, y);
                if (x < 0) continue;
                if (std::tuple<int64_t, int>{16 * y + height, x} < best) {
                    best = {16 * y + height, x};
                    result = {x, y, mask.turns, static_cast<int>(i)};
                }
                break;
            }
        }
        if (std::get<0>(best) == INT64_MAX) return false;
        hint = result.y;
        taken_.take(masks[static_cast<size_t>(result.mask)], result.x, result.y, gutter_);
        return true;
    }

    uint64_t work() const { return taken_.work(); }

  private:
    const PackCharts& charts_;
    int gutter_;
    const PackPlan& plan_;
    Occupancy taken_;
    Template template_;  ///< of the mask at hand
    std::map<std::array<int, 2>, int> hint_;
};

double size_under(PackOrder order, const Mask& mask) {
    switch (order) {
        case PackOrder::longer_side:
            return std::max(mask.width, mask.height);
        case PackOrder::half_perimeter:
            return mask.width + mask.height;
        case PackOrder::box:
            return std::sqrt(static_cast<double>(mask.width) * mask.height);
        default:
            return std::sqrt(static_cast<double>(mask.texels));
    }
}

std::vector<uint32_t> sort_charts(const std::vector<std::vector<Mask>>& charts, const PackPlan& plan) {
    std::vector<uint32_t> sorted(charts.size());
    std::iota(sorted.begin(), sorted.end(), 0u);
    const auto key = [&](uint32_t i) {
        const Mask& m = charts[i][0];
        const double boost = plan.boosts.empty() ? 1 : plan.boosts[i];
        return std::make_tuple(-boost * size_under(plan.order, m), -std::max(m.width, m.height),
                               -std::min(m.width, m.height), -static_cast<int64_t>(m.texels), i);
    };
    std::sort(sorted.begin(), sorted.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    return sorted;
}

}  // namespace

PackCharts prepare_charts(std::vector<std::vector<Mask>> masks) {
    PackCharts charts{std::move(masks), {}};
    charts.templates.resize(charts.masks.size());
    constexpr size_t grain = 64;
    parallel_for(charts.masks.size(), grain, [&](size_t i) {
        for (const Mask& mask : charts.masks[i]) charts.templates[i].push_back(make_template(mask));
    });
    return charts;
}

Packing pack(const PackCharts& charts, const MapSize& map, int gutter, const PackPlan& plan, size_t most_failures) {
    Packer packer(charts, map, gutter, plan);
    Packing packing{std::vector<Placement>(charts.masks.size()), {}, 0};
    for (const uint32_t i : sort_charts(charts.masks, plan)) {
        if (packer.place(i, packing.placements[i])) continue;
        packing.failed.push_back(i);
        if (packing.failed.size() >= most_failures) break;
    }
    packing.work = packer.work();
    return packing;
}

double least_texels(const std::vector<std::vector<Mask>>& charts, int gutter) {
    // Charts grown by the gutter to the right and upwards only are still disjoint. Every column of a
    // connected mask then has `gutter` texels more, and so has every row.
    double sum = 0;
    for (const auto& masks : charts) {
        double least = INFINITY;
        for (const Mask& m : masks)
            least = std::min(
                least, static_cast<double>(m.texels) + static_cast<double>(gutter) * (m.width + m.height + gutter));
        sum += least;
    }
    return sum;
}

}  // namespace surimi
