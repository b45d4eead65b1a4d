// SPDX-License-Identifier: Apache-2.0
#include "baker/post/ratio.h"

#include <algorithm>

namespace surimi {

Channel visibility_channel(const Texels& texels, const std::vector<IrradianceEstimate>& estimates) {
    Channel channel{Image<float>(texels.width, texels.height, 1.f),
                    Image<TexelState>(texels.width, texels.height, TexelState::empty)};
    for (size_t i = 0; i < texels.texels.size(); ++i) {
        const size_t index = texels.texels[i].index;
        const IrradianceEstimate& e = estimates[i];
        const TexelState without_light = texels.texels[i].is_inside() ? TexelState::inside : TexelState::unlit;
        channel.state.pixels[index] = e.unshadowed > 0 ? TexelState::covered : without_light;
        if (e.unshadowed > 0) channel.visibility.pixels[index] = std::clamp(e.shadowed / e.unshadowed, 0.f, 1.f);
    }
    return channel;
}

}  // namespace surimi
