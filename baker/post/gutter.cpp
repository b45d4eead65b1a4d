// SPDX-License-Identifier: Apache-2.0
#include "baker/post/gutter.h"

namespace surimi {

void grow_gutters(const Texels& texels, Channel& channel, int rings) {
    auto& state = channel.state.pixels;
    std::vector<uint32_t> owner(state.size(), no_chart);
    for (const Texel& texel : texels.texels) owner[texel.index] = texel.chart;
    // Who owns a gutter texel follows from the charts alone, so the rings that exist are walked again.
    std::vector<uint8_t> is_filled(state.size());
    for (size_t i = 0; i < state.size(); ++i) is_filled[i] = state[i] == TexelState::filled;
    grow(channel.visibility, owner, {.only_chart = {}, .keeps_value = is_filled, .rings = rings});
    for (size_t i = 0; i < state.size(); ++i)
        if (state[i] == TexelState::empty && owner[i] != no_chart) state[i] = TexelState::filled;
}

}  // namespace surimi
