// SPDX-License-Identifier: Apache-2.0
#include "baker/write/lightmaps.h"

#include <algorithm>
#include <cassert>
#include <string>

namespace surimi {
namespace {

std::string layer_name(const Scene& scene, const Monitor& monitor) {
    const auto shares_name = [&](const Monitor& other) { return other.name == monitor.name; };
    const bool is_unique = std::count_if(scene.monitors.begin(), scene.monitors.end(), shares_name) == 1;
    return is_unique ? monitor.name : monitor.name + "_" + "RGB"[monitor.channel];
}

}  // namespace

ChannelLayout lightmap_layout(const Scene& scene, const BakedPage& page) {
    ChannelLayout layout{page.map.visibility.width, page.map.visibility.height, {}};
    for (const Monitor& monitor : scene.monitors)
        for (const char* quantity : {".shadowed", ".unshadowed", ".error", ".method", ".state"})
            layout.names.push_back(layer_name(scene, monitor) + quantity);
    return layout;
}

void give_lightmaps(const Scene& scene, const BakedPage& page, int begin, std::span<float> values) {
    size_t i = page.map.visibility.index(0, begin);
    for (auto value = values.begin(); value != values.end(); ++i)
        for (const Monitor& monitor : scene.monitors) {
            const auto c = static_cast<size_t>(monitor.channel);
            assert(i < page.irradiance[c].pixels.size() && i < page.state[c].pixels.size());
            const IrradianceEstimate& estimate = page.irradiance[c].pixels[i];
            const auto state = static_cast<float>(page.state[c].pixels[i]);
            const auto method = static_cast<float>(estimate.method);
            for (const float one : {estimate.shadowed, estimate.unshadowed, estimate.error, method, state})
                *value++ = one;
        }
}

}  // namespace surimi
