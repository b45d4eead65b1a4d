// SPDX-License-Identifier: Apache-2.0
#include "runtime/map/map_file.h"
#include "runtime/base/color.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/error.h"
#include "runtime/image/image_file.h"

namespace surimi {

void write_map_exr(const std::filesystem::path& path, const VisibilityMap& map) {
    Channels channels{map.visibility.width, map.visibility.height, {"R", "G", "B"}, {}};
    channels.values.reserve(map.visibility.pixels.size() * 3);
    for (const Vec3f& v : map.visibility.pixels) channels.values.insert(channels.values.end(), {v.x, v.y, v.z});
    write_exr(path, channels, ExrDepth::half);
}

std::vector<uint8_t> encode_map_png(const VisibilityMap& map) {
    Image<glm::u8vec3> image(map.visibility.width, map.visibility.height);
    std::transform(map.visibility.pixels.begin(), map.visibility.pixels.end(), image.pixels.begin(),
                   [](const Vec3f& v) { return srgb8(Vec3(v)); });
    return encode_png(image);
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
