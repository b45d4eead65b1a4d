// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/preview_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/preview/display.h"

namespace surimi {
namespace {

constexpr std::array<double, 6> band_edges = {0, 0.15, 0.3, 0.5, 0.75, 1.0001};  // roughness 1 belongs to the last

Image<Vec3f> scaled(const Image<Vec3f>& image, double factor) {
    Image<Vec3f> result = image;
    for (Vec3f& p : result.pixels) p *= static_cast<float>(factor);
    return result;
}

/// The chosen pixels in a row.
Image<Vec3f> row_of(const Image<Vec3f>& image, const std::vector<size_t>& chosen) {
    Image<Vec3f> row(static_cast<int>(chosen.size()), 1);
    for (size_t i = 0; i < chosen.size(); ++i) row.pixels[i] = image.pixels[chosen[i]];
    return row;
}

std::string line_of(const std::string& name, size_t pixels, const ImageDifference& d) {
    return fmt::format("{:<18} {:>8} {:>10.5f} {:>10.5f} {:>10.5f} {:>10.5f}\n", name, pixels, d.rmse, d.relative_mse,
                       d.mean_absolute, d.largest);
}

nlohmann::ordered_json json_of(const ImageDifference& d) {
    return {{"rmse", d.rmse}, {"relativeMse", d.relative_mse}, {"meanAbsolute", d.mean_absolute},
            {"p99", d.p99},   {"largest", d.largest},          {"notFinite", d.not_finite}};
}

Image<Vec3f> mean_of(const std::vector<Image<Vec3f>>& halves) {
    Image<Vec3f> mean(halves[0].width, halves[0].height);
    for (size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] = 0.5f * (halves[0].pixels[i] + halves[1].pixels[i]);
    return mean;
}

}  // namespace

std::string explanation(const Lighting& lighting, const Picture& picture) {
    const auto count = [](const std::vector<bool>& flags) { return std::count(flags.begin(), flags.end(), true); };
    std::string text = fmt::format("materials       {} of {} can reflect highlights, {} have a diffuse part\n",
                                   count(lighting.plan.is_specular), lighting.plan.is_specular.size(),
                                   count(lighting.plan.is_diffuse));
    const bool is_baked = lighting.settings.visibility == VisibilitySource::baked;
    for (size_t m = 0; m < lighting.plan.monitors.size(); ++m) {
        const MonitorPlan& plan = lighting.plan.monitors[m];
        const MonitorCounts& counts = picture.counts[m];
        const auto share = [&](size_t n) {
            return counts.points > 0 ? 100 * static_cast<double>(n) / static_cast<double>(counts.points) : 0.0;
        };
        text += fmt::format("\n{} ({})\n", lighting.scene.monitors[m].name, "RGB"[lighting.scene.monitors[m].channel]);
        if (!plan.is_lit) text += "  is off: nothing is computed\n";
        if (is_baked && lighting.pages.empty())
            text += "  no map: no shadows\n";
        else if (is_baked && !plan.is_ever_blocked)
            text += "  is never blocked: the map is not read for it\n";
        else if (is_baked)
            text += fmt::format("  map             darkest {:.3f}, 0 in {:.1f} % of the texels\n", plan.darkest,
                                100 * plan.dark_share);
        text += fmt::format("  light           {}\n", plan.has_picture ? "a picture: a blurred lookup for each integral"
                                                                       : "one colour: no lookups");
        text += fmt::format("  points          {}\n", counts.points);
        text += fmt::format("  - not facing    {} ({:.1f} %)\n", counts.unseen, share(counts.unseen));
        text += fmt::format("  - V = 0         {} ({:.1f} %)\n", counts.dark, share(counts.dark));
        text += fmt::format("  map reads       {} ({:.1f} %)\n", counts.map_reads, share(counts.map_reads));
        text += fmt::format("  diffuse         {} ({:.1f} %)\n", counts.diffuse, share(counts.diffuse));
        text += fmt::format("  specular        {} ({:.1f} %)\n", counts.specular, share(counts.specular));
        text += fmt::format("  second lobe     {} ({:.1f} %)\n", counts.schlick, share(counts.schlick));
        if (counts.not_finite > 0) text += fmt::format("  not finite      {}: left black\n", counts.not_finite);
    }
    return text;
}

Comparison compare_pictures(const Picture& picture, const std::vector<Image<Vec3f>>& halves, double exposure) {
    Comparison comparison;
    comparison.reference = mean_of(halves);
    const Image<Vec3f> ours = scaled(picture.pixels, exposure), truth = scaled(comparison.reference, exposure);
    comparison.all = difference(ours, truth);
    // The mean of two halves errs by half of their difference, where the halves' errors are independent.
    comparison.noise = difference(scaled(halves[0], exposure), scaled(halves[1], exposure)).rmse / 2;
    comparison.flip = mean(
        flip(displayed(picture.pixels, Show::lit, exposure), displayed(comparison.reference, Show::lit, exposure)));
    for (size_t b = 0; b + 1 < band_edges.size(); ++b) {
        RoughnessBand band{band_edges[b], band_edges[b + 1], 0, {}};
        std::vector<size_t> chosen;
        for (size_t i = 0; i < picture.roughness.pixels.size(); ++i) {
            const auto roughness = static_cast<double>(picture.roughness.pixels[i]);
            if (roughness >= band.low && roughness < band.high) chosen.push_back(i);
        }
        band.pixels = chosen.size();
        if (!chosen.empty()) band.difference = difference(row_of(ours, chosen), row_of(truth, chosen));
        comparison.bands.push_back(band);
    }
    return comparison;
}

std::string as_text(const Comparison& comparison) {
    std::string text = fmt::format("{:<18} {:>8} {:>10} {:>10} {:>10} {:>10}\n", "roughness", "pixels", "RMSE",
                                   "relMSE", "mean abs.", "largest");
    size_t pixels = 0;
    for (const RoughnessBand& band : comparison.bands) {
        pixels += band.pixels;
        text +=
            line_of(fmt::format("{:.2f} to {:.2f}", band.low, std::min(band.high, 1.0)), band.pixels, band.difference);
    }
    text += line_of("whole picture", pixels, comparison.all);
    text += fmt::format("largest at ({}, {}); FLIP {:.4f}; noise of the reference {:.5f} RMS\n",
                        comparison.all.largest_x, comparison.all.largest_y, comparison.flip, comparison.noise);
    return text;
}

std::string as_json(const Comparison& comparison) {
    nlohmann::ordered_json json = json_of(comparison.all);
    json["largestAt"] = {comparison.all.largest_x, comparison.all.largest_y};
    json["flip"] = comparison.flip;
    json["referenceNoise"] = comparison.noise;
    for (const RoughnessBand& band : comparison.bands) {
        nlohmann::ordered_json entry = json_of(band.difference);
        entry["roughness"] = {band.low, std::min(band.high, 1.0)};
        entry["pixels"] = band.pixels;
        json["bands"].push_back(entry);
    }
    return json.dump(2);
}

}  // namespace surimi
