// SPDX-License-Identifier: Apache-2.0
#include "baker/post/growth.h"

#include <array>
#include <utility>

namespace surimi {
namespace {

constexpr std::array<std::pair<int, int>, 8> around = {
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

/// Calls `visit(index of neighbour)` for the up to eight texels around `index`.
template <class Visit>
void for_neighbours(const Image<float>& image, size_t index, const Visit& visit) {
    const int x = static_cast<int>(index % static_cast<size_t>(image.width));
    const int y = static_cast<int>(index / static_cast<size_t>(image.width));
    for (const auto& [dx, dy] : around)
        if (x + dx >= 0 && y + dy >= 0 && x + dx < image.width && y + dy < image.height)
            visit(image.index(x + dx, y + dy));
}

struct Gain {
    size_t index = 0;
    float value = 0;
    uint32_t owner = no_chart;
};

/// What a texel without owner takes from its neighbours; `no_chart` where none of them may give.
Gain gain_of(const Image<float>& visibility, const std::vector<uint32_t>& owner, size_t index, uint32_t only) {
    std::array<std::pair<uint32_t, int>, 8> votes{};  // owner, how many
    size_t voters = 0;
    for_neighbours(visibility, index, [&](size_t j) {
        if (owner[j] == no_chart || (only != no_chart && owner[j] != only)) return;
        size_t v = 0;
        while (v < voters && votes[v].first != owner[j]) ++v;
        if (v == voters) votes[voters++] = {owner[j], 0};
        ++votes[v].second;
    });
    if (voters == 0) return {index, 0, no_chart};
    auto best = votes[0];
    for (size_t v = 1; v < voters; ++v)
        if (votes[v].second > best.second || (votes[v].second == best.second && votes[v].first < best.first))
            best = votes[v];
    double sum = 0;
    for_neighbours(visibility, index, [&](size_t j) {
        if (owner[j] == best.first) sum += static_cast<double>(visibility.pixels[j]);
    });
    return {index, static_cast<float>(sum / best.second), best.first};
}

}  // namespace

void grow(Image<float>& visibility, std::vector<uint32_t>& owner, const GrowthRules& rules) {
    const auto may_grow = [&](size_t i) {
        return owner[i] == no_chart && (rules.only_chart.empty() || rules.only_chart[i] != no_chart);
    };
    std::vector<size_t> front;
    for (size_t i = 0; i < owner.size(); ++i)
        if (owner[i] != no_chart) front.push_back(i);
    std::vector<int> round_of(owner.size(), -1);  // each candidate is looked at once a round
    for (int round = 0; round < rules.rings && !front.empty(); ++round) {
        std::vector<Gain> gains;
        for (const size_t known : front) {
            for_neighbours(visibility, known, [&](size_t i) {
                if (!may_grow(i) || round_of[i] == round) return;
                round_of[i] = round;
                const uint32_t only = rules.only_chart.empty() ? no_chart : rules.only_chart[i];
                const Gain gain = gain_of(visibility, owner, i, only);
                if (gain.owner != no_chart) gains.push_back(gain);
            });
        }
        front.clear();
        for (const Gain& gain : gains) {
            if (rules.keeps_value.empty() || !rules.keeps_value[gain.index]) visibility.pixels[gain.index] = gain.value;
            owner[gain.index] = gain.owner;
            front.push_back(gain.index);
        }
    }
}

}  // namespace surimi
