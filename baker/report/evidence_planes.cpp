// SPDX-License-Identifier: Apache-2.0
#include "baker/report/evidence_planes.h"

#include <algorithm>

#include "baker/post/channel.h"
#include "baker/report/codes.h"
#include "runtime/base/color.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

/// Calls `visit(pixel, texel)` for the `reduction` squared texels of every pixel that has all of them.
template <class Visit>
Image<glm::u8vec3> reduced(int width, int height, int reduction, const Visit& visit) {
    Image<glm::u8vec3> picture(std::max(1, width / reduction), std::max(1, height / reduction), glm::u8vec3(0));
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) picture.at(x, y) = visit(x * reduction, y * reduction);
    return picture;
}

size_t index_of_texel(const Evidence& evidence, int x, int y) {
    return static_cast<size_t>(y) * static_cast<size_t>(evidence.channels.width) + static_cast<size_t>(x);
}

uint8_t error_of_texel(const Evidence& evidence, size_t texel, const Evidence::OfMonitor& monitor) {
    if (!monitor.error || !evidence.is_covered(texel, monitor)) return 0;
    return error_code(evidence.at(texel, *monitor.error));
}

}  // namespace

bool Evidence::is_covered(size_t texel, const OfMonitor& monitor) const {
    return monitor.state && at(texel, *monitor.state) == static_cast<float>(TexelState::covered);
}

Evidence read_evidence(const std::filesystem::path& path, const BakeFiles& bake) {
    Evidence evidence{read_channels(path), {}};
    const Channels& channels = evidence.channels;
    if (channels.width != bake.width || channels.height != bake.height)
        throw Error(ErrorKind::scene, path.string() + ": has " + std::to_string(channels.width) + " x " +
                                          std::to_string(channels.height) + " texels, but the map of this bake has " +
                                          std::to_string(bake.width) + " x " + std::to_string(bake.height) +
                                          "; give the files of one bake");
    for (const BakedMonitor& monitor : bake.monitors) {
        const auto c = static_cast<size_t>(monitor.channel);
        const auto find = [&](const std::string& quantity) -> std::optional<size_t> {
            for (const std::string& name : {monitor.name + "_" + "RGB"[c], monitor.name}) {
                const auto found = std::find(channels.names.begin(), channels.names.end(), name + quantity);
                if (found != channels.names.end()) return static_cast<size_t>(found - channels.names.begin());
            }
            return {};
        };
        evidence.monitors[c] = {find(".shadowed"), find(".unshadowed"), find(".error"), find(".state"),
                                find(".method")};
    }
    return evidence;
}

Image<glm::u8vec3> draw_errors(const Evidence& evidence, int reduction) {
    return reduced(evidence.channels.width, evidence.channels.height, reduction, [&](int left, int top) {
        glm::u8vec3 codes(0);
        for (int y = top; y < std::min(top + reduction, evidence.channels.height); ++y)
            for (int x = left; x < std::min(left + reduction, evidence.channels.width); ++x)
                for (int c = 0; c < 3; ++c)
                    codes[c] = std::max(codes[c], error_of_texel(evidence, index_of_texel(evidence, x, y),
                                                                 evidence.monitors[static_cast<size_t>(c)]));
        return codes;
    });
}

Image<glm::u8vec3> draw_states(const Evidence& evidence, int reduction) {
    return reduced(evidence.channels.width, evidence.channels.height, reduction, [&](int x, int y) {
        const size_t texel = index_of_texel(evidence, x, y);
        glm::u8vec3 codes(0);
        for (int c = 0; c < 3; ++c) {
            const Evidence::OfMonitor& monitor = evidence.monitors[static_cast<size_t>(c)];
            const auto whole = [&](const std::optional<size_t>& channel) {
                const float value = channel ? evidence.at(texel, *channel) : 0;
                return value >= 0 && value <= 7 ? static_cast<int>(value) : 0;
            };
            codes[c] = static_cast<uint8_t>(whole(monitor.state) + 8 * whole(monitor.method));
        }
        return codes;
    });
}

Image<glm::u8vec3> draw_map(const Image<Vec3f>& visibility, int reduction) {
    return reduced(visibility.width, visibility.height, reduction, [&](int left, int top) {
        Vec3 sum(0);
        double count = 0;
        for (int y = top; y < std::min(top + reduction, visibility.height); ++y)
            for (int x = left; x < std::min(left + reduction, visibility.width); ++x, count += 1)
                sum += Vec3(visibility.at(x, y));
        return srgb8(sum / count);
    });
}

}  // namespace surimi
