// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "runtime/base/color.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

/// Which three of the file's channels are red, green and blue.
std::array<size_t, 3> choose_channels(const std::filesystem::path& path, const std::vector<std::string>& names,
                                      const std::string& wanted) {
    const auto place = [&](const std::string& name) {
        return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    if (!wanted.empty() && place(wanted) < names.size()) return {place(wanted), place(wanted), place(wanted)};
    const std::string prefix = wanted.empty() ? "" : wanted + ".";
    const std::array<size_t, 3> colors{place(prefix + "R"), place(prefix + "G"), place(prefix + "B")};
    if (*std::max_element(colors.begin(), colors.end()) < names.size()) return colors;
    const bool has_alpha = names.size() == 2 && names[1] == "A";
    if (wanted.empty() && (names.size() == 1 || has_alpha)) return {0, 0, 0};
    throw Error(ErrorKind::usage,
                fmt::format("{}: has no channels {}; choose one, or a layer, with --channel, of: {}", path.string(),
                            wanted.empty() ? "R, G and B" : wanted, fmt::join(names, " ")));
}

}  // namespace

bool holds_linear_values(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".exr" || extension == ".hdr" || extension == ".pfm";
}

Image<Vec3f> stored_colors(const std::filesystem::path& path, const Channels& channels, const std::string& channel) {
    const std::array<size_t, 3> chosen = choose_channels(path, channels.names, channel);
    Image<Vec3f> image(channels.width, channels.height);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            image.pixels[i][c] = channels.values[i * channels.names.size() + chosen[static_cast<size_t>(c)]];
    return image;
}

Image<Vec3f> read_colors(const std::filesystem::path& path, const std::string& channel) {
    Image<Vec3f> image = stored_colors(path, read_channels(path), channel);
    if (holds_linear_values(path)) return image;
    for (Vec3f& color : image.pixels)
        for (int c = 0; c < 3; ++c) color[c] = static_cast<float>(linear_from_srgb(static_cast<double>(color[c])));
    return image;
}

Image<uint8_t> read_mask(const std::filesystem::path& path) {
    if (path.empty()) return {};
    const Image<Vec3f> colors = stored_colors(path, read_channels(path), "");
    Image<uint8_t> mask(colors.width, colors.height);
    std::transform(colors.pixels.begin(), colors.pixels.end(), mask.pixels.begin(), [](const Vec3f& color) {
        return static_cast<uint8_t>(std::max({color.x, color.y, color.z}) > 0.5F);
    });
    return mask;
}

}  // namespace surimi
