// SPDX-License-Identifier: Apache-2.0
#include "baker/report/difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "baker/report/codes.h"
#include "runtime/base/error.h"
#include "runtime/map/map_file.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();
constexpr int bins = 81;  // odd: one is centred on 0

bool is_map(const Channels& channels) {
    return std::all_of(std::begin("RGB"), std::end("RGB") - 1, [&](char c) {
        return std::find(channels.names.begin(), channels.names.end(), std::string(1, c)) != channels.names.end();
    });
}

/// Map minus reference; NaN where they are not to be compared.
double difference_at(const ComparedPage& page, size_t texel, size_t channel) {
    if (!page.evidence.is_covered(texel, page.evidence.monitors[channel])) return no_value;
    const auto c = static_cast<int>(channel);
    return static_cast<double>(page.map.pixels[texel][c]) - static_cast<double>(page.reference.pixels[texel][c]);
}

struct Compared {
    double difference = 0;
    size_t page = 0;
    size_t texel = 0;
};

std::vector<Compared> compare(const std::vector<ComparedPage>& pages, size_t channel) {
    std::vector<Compared> all;
    for (size_t p = 0; p < pages.size(); ++p)
        for (size_t i = 0; i < pages[p].map.pixels.size(); ++i) {
            const double d = difference_at(pages[p], i, channel);
            if (std::isfinite(d)) all.push_back({d, p, i});
        }
    return all;
}

/// The smallest of the magnitudes that `share` of them do not exceed.
double percentile(const std::vector<double>& sorted, double share) {
    const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::max<size_t>(rank, 1) - 1];
}

Json histogram(const std::vector<Compared>& all, double range) {
    std::vector<size_t> counts(bins, 0);
    for (const Compared& one : all) {
        const double place = (one.difference + range) / (2 * range) * bins;
        ++counts[static_cast<size_t>(std::clamp(place, 0.0, bins - 1.0))];
    }
    return {{"range", range}, {"texels", counts}};
}

Json channel_section(const std::vector<Compared>& all, int width, double error) {
    double squares = 0, sum = 0;
    size_t beyond = 0;
    std::vector<double> magnitudes;
    Compared largest;
    for (const Compared& one : all) {
        const double magnitude = std::abs(one.difference);
        squares += one.difference * one.difference;
        sum += one.difference;
        if (magnitude > error) ++beyond;
        if (magnitude > std::abs(largest.difference)) largest = one;
        magnitudes.push_back(magnitude);
    }
    std::sort(magnitudes.begin(), magnitudes.end());
    const auto count = static_cast<double>(all.size());
    const double p999 = percentile(magnitudes, 0.999);
    const auto columns = static_cast<size_t>(width);
    return {{"texels", all.size()},
            {"rmse", std::sqrt(squares / count)},
            {"bias", sum / count},
            {"p99", percentile(magnitudes, 0.99)},
            {"p999", p999},
            {"largest",
             {{"difference", largest.difference},
              {"x", largest.texel % columns},
              {"y", largest.texel / columns},
              {"page", largest.page}}},
            {"shareBeyond", static_cast<double>(beyond) / count},
            {"histogram", histogram(all, std::max(2 * error, p999))}};
}

}  // namespace

ReferenceMap read_reference(const std::filesystem::path& path, const BakeFiles& bake) {
    const Channels channels = read_channels(path);
    if (channels.width != bake.width || channels.height != bake.height)
        throw Error(ErrorKind::usage, path.string() + ": has " + std::to_string(channels.width) + " x " +
                                          std::to_string(channels.height) + " texels, the map " +
                                          std::to_string(bake.width) + " x " + std::to_string(bake.height) +
                                          "; bake the reference with the same --size");
    if (is_map(channels)) return read_map_exr(path).visibility;
    const Evidence evidence = read_evidence(path, bake);
    ReferenceMap reference(bake.width, bake.height, Vec3f(no_value));
    bool has_monitor = false;
    for (const BakedMonitor& baked : bake.monitors) {
        const Evidence::OfMonitor& monitor = evidence.monitors[static_cast<size_t>(baked.channel)];
        if (!monitor.shadowed || !monitor.unshadowed) continue;
        has_monitor = true;
        for (size_t i = 0; i < evidence.texel_count(); ++i) {
            const float all = evidence.at(i, *monitor.unshadowed);
            if (evidence.is_covered(i, monitor) && all > 0)
                reference.pixels[i][baked.channel] = evidence.at(i, *monitor.shadowed) / all;
        }
    }
    if (!has_monitor)
        throw Error(ErrorKind::scene, path.string() +
                                          ": is no reference for this bake: it has neither R, G, B nor the monitors' "
                                          "NAME.shadowed and NAME.unshadowed; give a NAME.visibility.exr or "
                                          "NAME.lightmaps.exr of the same scene");
    return reference;
}

Image<glm::u8vec3> draw_difference(const Image<Vec3f>& map, const ReferenceMap& reference, const Evidence& evidence,
                                   int reduction) {
    const ComparedPage page{map, reference, evidence};
    Image<glm::u8vec3> picture(std::max(1, map.width / reduction), std::max(1, map.height / reduction), glm::u8vec3(0));
    Image<Vec3f> largest(picture.width, picture.height, Vec3f(0));
    for (int y = 0; y < picture.height * reduction; ++y)
        for (int x = 0; x < picture.width * reduction; ++x)
            for (size_t c = 0; c < 3; ++c) {
                const auto d = static_cast<float>(difference_at(page, map.index(x, y), c));
                float& known = largest.at(x / reduction, y / reduction)[static_cast<int>(c)];
                uint8_t& code = picture.at(x / reduction, y / reduction)[static_cast<int>(c)];
                if (!std::isfinite(d) || (code != 0 && std::abs(d) <= std::abs(known))) continue;
                known = d;
                code = difference_code(d);
            }
    return picture;
}

Json difference_section(const std::vector<ComparedPage>& pages, const BakeFiles& bake, double error) {
    Json section = Json::object();
    for (const BakedMonitor& monitor : bake.monitors) {
        const std::vector<Compared> all = compare(pages, static_cast<size_t>(monitor.channel));
        if (!all.empty()) section[std::string(1, "RGB"[monitor.channel])] = channel_section(all, bake.width, error);
    }
    return section;
}

}  // namespace surimi
