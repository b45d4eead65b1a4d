// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "runtime/base/color.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"

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

Image<Vec3f> read_colors(const std::filesystem::path& path, const std::string& channel) {
    const Channels channels = read_channels(path);
    const std::array<size_t, 3> chosen = choose_channels(path, channels.names, channel);
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool is_linear = extension == ".exr" || extension == ".hdr" || extension == ".pfm";
    Image<Vec3f> image(channels.width, channels.height);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float value = channels.values[i * channels.names.size() + chosen[static_cast<size_t>(c)]];
            image.pixels[i][c] = is_linear ? value : static_cast<float>(linear_from_srgb(value));
        }
    return image;
}

}  // namespace surimi
