// SPDX-License-Identifier: Apache-2.0
#include "runtime/map/map_file.h"
#include "runtime/base/color.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/error.h"

namespace surimi {

ChannelLayout map_layout(const VisibilityMap& map) {
    return {map.visibility.width, map.visibility.height, {"R", "G", "B"}};
}

void give_map(const VisibilityMap& map, int begin, std::span<float> values) {
    size_t i = map.visibility.index(0, begin);
    for (auto value = values.begin(); value != values.end(); ++i)
        for (int c = 0; c < 3; ++c) *value++ = map.visibility.pixels[i][c];
}

void write_map_exr(const std::filesystem::path& path, const VisibilityMap& map) {
    write_exr(path, map_layout(map), ExrDepth::half,
              [&](int begin, int, std::span<float> values) { give_map(map, begin, values); });
}

std::vector<uint8_t> encode_map_png(const VisibilityMap& map) {
    const Image<Vec3f>& image = map.visibility;
    return encode_png(image.width, image.height, [&](int begin, int, std::span<glm::u8vec3> pixels) {
        const auto first = image.pixels.begin() + static_cast<std::ptrdiff_t>(image.index(0, begin));
        std::transform(first, first + static_cast<std::ptrdiff_t>(pixels.size()), pixels.begin(),
                       [](const Vec3f& v) { return srgb8(Vec3(v)); });
    });
}

VisibilityMap read_map_exr(const std::filesystem::path& path) {
    const Channels channels = read_channels(path);
    VisibilityMap map;
    map.visibility = Image<Vec3f>(channels.width, channels.height);
    for (int c = 0; c < 3; ++c) {
        const std::string name(1, "RGB"[c]);
        const auto found = std::find(channels.names.begin(), channels.names.end(), name);
        if (found == channels.names.end())
            throw Error(ErrorKind::scene, path.string() + ": is no visibility map, it has no channel " + name);
        const auto offset = static_cast<size_t>(found - channels.names.begin());
        for (size_t i = 0; i < map.visibility.pixels.size(); ++i) {
            const float v = channels.values[i * channels.names.size() + offset];
            if (!(v >= 0 && v <= 1))
                throw Error(ErrorKind::scene, path.string() + ": is no visibility map, channel " + name +
                                                  " has a value outside [0, 1] at texel " + std::to_string(i));
            map.visibility.pixels[i][c] = v;
        }
    }
    return map;
}

VisibilityMap map_from_image(const Image<glm::u8vec4>& image, bool is_srgb) {
    VisibilityMap map;
    map.visibility = Image<Vec3f>(image.width, image.height);
    std::transform(image.pixels.begin(), image.pixels.end(), map.visibility.pixels.begin(), [&](const auto& pixel) {
        Vec3f v;
        for (int c = 0; c < 3; ++c) {
            const double code = pixel[c] / 255.0;
            v[c] = static_cast<float>(is_srgb ? linear_from_srgb(code) : code);
        }
        return v;
    });
    return map;
}

}  // namespace surimi
