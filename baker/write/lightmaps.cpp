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

Channels lightmap_channels(const Scene& scene, const BakedPage& page) {
    Channels channels;
    channels.width = page.map.visibility.width;
    channels.height = page.map.visibility.height;
    for (const Monitor& monitor : scene.monitors)
        for (const char* quantity : {".shadowed", ".unshadowed", ".error", ".method", ".state"})
            channels.names.push_back(layer_name(scene, monitor) + quantity);
    const size_t texel_count = static_cast<size_t>(channels.width) * static_cast<size_t>(channels.height);
    channels.values.reserve(texel_count * channels.names.size());
    for (size_t i = 0; i < texel_count; ++i)
        for (const Monitor& monitor : scene.monitors) {
            const auto c = static_cast<size_t>(monitor.channel);
            assert(page.irradiance[c].pixels.size() == texel_count && page.state[c].pixels.size() == texel_count);
            const IrradianceEstimate& estimate = page.irradiance[c].pixels[i];
            const auto state = static_cast<float>(page.state[c].pixels[i]);
            const auto method = static_cast<float>(estimate.method);
            channels.values.insert(channels.values.end(),
                                   {estimate.shadowed, estimate.unshadowed, estimate.error, method, state});
        }
    return channels;
}

void write_lightmaps(const std::filesystem::path& path, const Channels& channels) {
    write_exr(path, channels, ExrDepth::full);
}

}  // namespace surimi
