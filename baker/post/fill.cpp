// SPDX-License-Identifier: Apache-2.0
#include "baker/post/fill.h"

#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace surimi {
namespace {

constexpr uint32_t nobody = std::numeric_limits<uint32_t>::max();
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

/// Grows known texels outwards, a ring a round, until nothing can be reached. A texel takes the mean of its neighbours
/// of one owner that were known before the round; among owners the one with the most such neighbours, then the lower
/// number. `may_take(index, owner)` says whether a texel accepts an owner's value.
template <class MayTake>
void grow(Image<float>& visibility, std::vector<uint32_t>& owner, const MayTake& may_take) {
    struct Gain {
        size_t index;
        float value;
        uint32_t owner;
    };
    std::vector<size_t> front;
    for (size_t i = 0; i < owner.size(); ++i)
        if (owner[i] != nobody) front.push_back(i);
    std::vector<uint32_t> round_of(owner.size(), 0);  // each candidate is looked at once a round
    for (uint32_t round = 1; !front.empty(); ++round) {
        std::vector<Gain> gains;
        for (const size_t known : front) {
            for_neighbours(visibility, known, [&](size_t i) {
                if (owner[i] != nobody || round_of[i] == round) return;
                round_of[i] = round;
                std::array<std::pair<uint32_t, int>, 8> votes{};  // owner, how many
                size_t voters = 0;
                for_neighbours(visibility, i, [&](size_t j) {
                    if (owner[j] == nobody || !may_take(i, owner[j])) return;
                    size_t v = 0;
                    while (v < voters && votes[v].first != owner[j]) ++v;
                    if (v == voters) votes[voters++] = {owner[j], 0};
                    ++votes[v].second;
                });
                if (voters == 0) return;
                auto best = votes[0];
                for (size_t v = 1; v < voters; ++v)
                    if (votes[v].second > best.second ||
                        (votes[v].second == best.second && votes[v].first < best.first))
                        best = votes[v];
                double sum = 0;
                for_neighbours(visibility, i, [&](size_t j) {
                    if (owner[j] == best.first) sum += static_cast<double>(visibility.pixels[j]);
                });
                gains.push_back({i, static_cast<float>(sum / best.second), best.first});
            });
        }
        front.clear();
        for (const Gain& gain : gains) {
            visibility.pixels[gain.index] = gain.value;
            owner[gain.index] = gain.owner;
            front.push_back(gain.index);
        }
    }
}

/// Mean of the measured texels of each surface; 1 where there is none.
std::vector<float> surface_means(const Atlas& atlas, const Texels& texels, const Image<float>& visibility,
                                 const Image<TexelState>& state) {
    std::vector<double> sum(atlas.surfaces.size(), 0), count(atlas.surfaces.size(), 0);
    for (const Texel& texel : texels.texels) {
        if (state.pixels[texel.index] != TexelState::covered) continue;
        const uint32_t surface = atlas.charts[texel.chart].surface;
        sum[surface] += static_cast<double>(visibility.pixels[texel.index]);
        count[surface] += 1;
    }
    std::vector<float> means(atlas.surfaces.size(), 1.f);
    for (size_t s = 0; s < means.size(); ++s)
        if (count[s] > 0) means[s] = static_cast<float>(sum[s] / count[s]);
    return means;
}

}  // namespace

void fill(const Atlas& atlas, const Texels& texels, Image<float>& visibility, Image<TexelState>& state) {
    std::vector<uint32_t> chart(visibility.pixels.size(), nobody);
    for (const Texel& texel : texels.texels) chart[texel.index] = texel.chart;

    // Unlit texels, from the measured ones of their own chart.
    std::vector<uint32_t> owner(visibility.pixels.size(), nobody);
    for (const Texel& texel : texels.texels)
        if (state.pixels[texel.index] == TexelState::covered) owner[texel.index] = texel.chart;
    grow(visibility, owner, [&](size_t index, uint32_t from) { return chart[index] == from; });
    const std::vector<float> means = surface_means(atlas, texels, visibility, state);
    for (const Texel& texel : texels.texels) {
        if (owner[texel.index] != nobody) continue;
        visibility.pixels[texel.index] = means[atlas.charts[texel.chart].surface];
        owner[texel.index] = texel.chart;
    }

    // Everything outside the charts, from the nearest chart.
    grow(visibility, owner, [](size_t, uint32_t) { return true; });
    for (size_t i = 0; i < owner.size(); ++i)
        if (state.pixels[i] == TexelState::empty && owner[i] != nobody) state.pixels[i] = TexelState::filled;
}

}  // namespace surimi
