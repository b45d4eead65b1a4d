// SPDX-License-Identifier: Apache-2.0
#include "baker/lightmaps/lightmap_ratio.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "baker/lightmaps/noise.h"
#include "baker/post/growth.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr double clearly_above_one = 1.05;  // noise and denoisers alone reach 1.01 to 1.03

/// One texel's light, and whether the ratio can be told.
struct Sorted {
    double shadowed = 0, unshadowed = 0;
    bool is_usable = false;
};

/// Counts what is wrong with a texel.
Sorted sort_texel(float shadowed, float unshadowed, double noise, double most_noise, LightmapFaults& faults) {
    if (!std::isfinite(shadowed) || !std::isfinite(unshadowed)) {
        ++faults.not_finite;
        return {};
    }
    if (shadowed < 0 || unshadowed < 0) ++faults.negative;
    const Sorted light{std::max(0.0, static_cast<double>(shadowed)), std::max(0.0, static_cast<double>(unshadowed)),
                       true};
    if (!(light.unshadowed > 0)) {
        ++faults.without_light;
        if (light.shadowed > 0) ++faults.shadow_of_nothing;
        return {};
    }
    if (light.unshadowed <= faults.least_light) {
        ++faults.residue;
        return {};
    }
    if (noise > most_noise * light.unshadowed) {
        ++faults.noisy;
        return {};
    }
    return light;
}

/// Values for what has none: through each island first, then over all that is empty.
void fill_around(Channel& channel, const Coverage& coverage, std::vector<uint32_t>& owner) {
    grow(channel.visibility, owner, {coverage.island, {}, all_rings});
    // What growth has not reached lies on islands without any value, and stays 1.
    for (size_t i = 0; i < owner.size(); ++i)
        if (coverage.island[i] != no_chart) owner[i] = coverage.island[i];
    grow(channel.visibility, owner, {});
}

uint32_t count_dark_islands(const Coverage& coverage, const std::vector<uint32_t>& owner) {
    std::vector<uint8_t> has_value(coverage.islands, 0);
    for (size_t i = 0; i < owner.size(); ++i)
        if (owner[i] != no_chart) has_value[owner[i]] = 1;
    return static_cast<uint32_t>(std::count(has_value.begin(), has_value.end(), 0));
}

}  // namespace

RatioOfLightmaps ratio_of(const LightPair& pair, const Coverage& coverage, const LightmapRatioSettings& settings) {
    const auto& [shadowed, unshadowed] = pair;
    const int width = unshadowed.light.width, height = unshadowed.light.height;
    const Image<float> noise = noise_of(unshadowed, coverage);
    RatioOfLightmaps result{{Image<float>(width, height, 1), Image<TexelState>(width, height, TexelState::filled)}, {}};
    LightmapFaults& faults = result.faults;
    faults.least_light = settings.threshold * top_of(unshadowed.light);
    std::vector<uint32_t> owner(coverage.island.size(), no_chart);
    for (size_t i = 0; i < owner.size(); ++i) {
        if (coverage.island[i] == no_chart) continue;
        result.channel.state.pixels[i] = TexelState::unlit;
        const Sorted light = sort_texel(shadowed.light.pixels[i], unshadowed.light.pixels[i],
                                        static_cast<double>(noise.pixels[i]), settings.noise, faults);
        if (!light.is_usable) continue;
        const double ratio = light.shadowed / light.unshadowed;
        ++faults.measured;
        if (ratio > clearly_above_one) ++faults.above_one;
        faults.largest_ratio = std::max(faults.largest_ratio, ratio);
        result.channel.visibility.pixels[i] = static_cast<float>(std::min(1.0, ratio));
        result.channel.state.pixels[i] = TexelState::covered;
        owner[i] = coverage.island[i];
    }
    if (faults.measured == 0)
        throw Error(
            ErrorKind::nothing_to_bake,
            fmt::format("of {} covered texels none has unshadowed light that can be told from residue and "
                        "noise; is it the unshadowed bake, and of a monitor that was on? (--threshold, --noise)",
                        coverage.texels));
    faults.dark_islands = count_dark_islands(coverage, owner);
    fill_around(result.channel, coverage, owner);
    return result;
}

Image<float> kanikama_ratio(const LightPair& pair) {
    constexpr double least = 1e-4;
    Image<float> ratio(pair.unshadowed.light.width, pair.unshadowed.light.height);
    for (size_t i = 0; i < ratio.pixels.size(); ++i) {
        const auto n = static_cast<double>(pair.shadowed.light.pixels[i]);
        const auto d = static_cast<double>(pair.unshadowed.light.pixels[i]);
        const double value = d == 0 ? 0 : n / std::max(least, d);
        ratio.pixels[i] = std::isfinite(value) ? static_cast<float>(value) : 0.0F;
    }
    return ratio;
}

std::vector<std::string> describe(const LightmapFaults& faults, const std::string& name, const Coverage& coverage) {
    std::vector<std::string> lines;
    const auto say = [&](size_t count, const char* what) {
        if (count > 0)
            lines.push_back(fmt::format("{}: {} texels ({:.2g} %) {}", name, count,
                                        100 * static_cast<double>(count) / static_cast<double>(coverage.texels), what));
    };
    say(faults.not_finite, "are NaN or infinite; they are filled from around");
    say(faults.negative, "have negative light; taken for 0");
    say(faults.shadow_of_nothing, "have shadowed light where unshadowed light is 0; they are filled from around");
    say(faults.residue, "have unshadowed light that is only residue; they are filled from around (--threshold)");
    say(faults.noisy, "have unshadowed light that is mostly noise; they are filled from around (--noise)");
    say(faults.above_one, "are brighter with shadows than without by more than 5 %; they are 1");
    if (faults.above_one > 0)
        lines.push_back(
            fmt::format("{}: shadowed light is up to {:.3g} times unshadowed light", name, faults.largest_ratio));
    if (faults.dark_islands > 0)
        lines.push_back(
            fmt::format("{}: {} of {} islands have no light that can be used; they are 1, nothing known to "
                        "block",
                        name, faults.dark_islands, coverage.islands));
    return lines;
}

}  // namespace surimi
