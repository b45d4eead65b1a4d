// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "baker/cli/colors.h"
#include "baker/cli/commands.h"
#include "baker/write/file.h"
#include "runtime/base/error.h"
#include "runtime/compare/compare.h"
#include "runtime/image/image_file.h"

namespace surimi {
namespace {

struct CompareOptions {
    std::filesystem::path image, reference, mask, heat_map;
    std::string channel;
    std::string metric = "rmse";
    std::optional<double> limit;
    double pixels_per_degree = default_pixels_per_degree;
    bool is_signed = false, json = false;
};

/// Everything that is known about two images.
struct Comparison {
    ImageDifference numbers;
    Image<float> seen;  ///< FLIP
    double flip = 0;    ///< its mean
};

double value_of(const std::string& metric, const Comparison& comparison) {
    if (metric == "largest") return comparison.numbers.largest;
    if (metric == "p99") return comparison.numbers.p99;
    if (metric == "p999") return comparison.numbers.p999;
    if (metric == "mean") return comparison.numbers.mean_absolute;
    if (metric == "flip") return comparison.flip;
    return comparison.numbers.rmse;
}

void print_report(const CompareOptions& options, const Comparison& comparison) {
    const ImageDifference& numbers = comparison.numbers;
    if (options.json) {
        const nlohmann::ordered_json report{
            {"image", options.image.string()},
            {"reference", options.reference.string()},
            {"width", comparison.seen.width},
            {"height", comparison.seen.height},
            {"rmse", numbers.rmse},
            {"relative_mse", numbers.relative_mse},
            {"mean_absolute", numbers.mean_absolute},
            {"largest", numbers.largest},
            {"largest_at", {numbers.largest_x, numbers.largest_y}},
            {"p50", numbers.p50},
            {"p95", numbers.p95},
            {"p99", numbers.p99},
            {"p999", numbers.p999},
            {"rmse_of_channel", {numbers.rmse_of_channel.x, numbers.rmse_of_channel.y, numbers.rmse_of_channel.z}},
            {"flip", comparison.flip},
            {"pixels_per_degree", options.pixels_per_degree},
            {"compared", numbers.compared},
            {"not_finite", numbers.not_finite}};
        fmt::print("{}\n", report.dump(2));
        return;
    }
    const Vec3& of_channel = numbers.rmse_of_channel;
    fmt::print("pixels         {}\n", numbers.compared);
    fmt::print("RMSE           {:.6g} (R {:.6g}, G {:.6g}, B {:.6g})\n", numbers.rmse, of_channel.x, of_channel.y,
               of_channel.z);
    fmt::print("relative MSE   {:.6g}\n", numbers.relative_mse);
    fmt::print("mean absolute  {:.6g}\n", numbers.mean_absolute);
    fmt::print("50, 95 % below {:.6g}, {:.6g}\n", numbers.p50, numbers.p95);
    fmt::print("99, 99.9 %     {:.6g}, {:.6g}\n", numbers.p99, numbers.p999);
    fmt::print("largest        {:.6g} at pixel ({}, {})\n", numbers.largest, numbers.largest_x, numbers.largest_y);
    fmt::print("FLIP           {:.6g} at {:.4g} pixels per degree\n", comparison.flip, options.pixels_per_degree);
    if (numbers.not_finite > 0) fmt::print("not finite     {} pixels, left out of all but FLIP\n", numbers.not_finite);
}

/// FLIP from 0 to 1, or differences up to what 99 % of the pixels stay below, or to the largest.
void write_heat_map(const CompareOptions& options, const Comparison& comparison, const Image<float>& differences) {
    const bool shows_flip = options.metric == "flip";
    const ImageDifference& numbers = comparison.numbers;
    const double high = shows_flip                                        ? 1
                        : options.metric == "largest" || numbers.p99 == 0 ? numbers.largest
                                                                          : numbers.p99;
    const Image<float>& shown = shows_flip ? comparison.seen : differences;
    write_file(options.heat_map,
               encode_png(options.is_signed ? signed_heat_map(shown, high) : heat_map(shown, 0, high)));
    if (options.json) return;
    if (options.is_signed)
        fmt::print("{}: image less reference, blue -{:.6g} over white to orange {:.6g}, black left out\n",
                   options.heat_map.string(), high, high);
    else
        fmt::print("{}: {}, black 0 to yellow {:.6g}\n", options.heat_map.string(),
                   shows_flip ? "FLIP" : "absolute difference", high);
}

/// What is not compared is not shown.
Image<float> within(Image<float> values, const Image<uint8_t>& mask) {
    for (size_t i = 0; i < mask.pixels.size(); ++i)
        if (!mask.pixels[i]) values.pixels[i] = std::numeric_limits<float>::quiet_NaN();
    return values;
}

int compare(const CompareOptions& options) {
    if (!options.heat_map.empty() && options.heat_map.extension() != ".png")
        throw Error(ErrorKind::usage, options.heat_map.string() + ": the heat map must be a .png");
    if (options.is_signed && options.metric == "flip")
        throw Error(ErrorKind::usage, "--signed: what FLIP sees has no sign; choose another --metric");
    const Image<Vec3f> image = read_colors(options.image, options.channel);
    const Image<Vec3f> reference = read_colors(options.reference, options.channel);
    const Image<uint8_t> mask = read_mask(options.mask);
    Comparison comparison{difference(image, reference, mask), flip(image, reference, options.pixels_per_degree), 0};
    comparison.flip = mean(comparison.seen, mask);
    comparison.seen = within(std::move(comparison.seen), mask);
    print_report(options, comparison);
    if (!options.heat_map.empty())
        write_heat_map(
            options, comparison,
            within(options.is_signed ? signed_difference(image, reference) : absolute_difference(image, reference),
                   mask));
    if (!options.limit) return 0;
    if (comparison.numbers.compared == 0)
        throw Error(ErrorKind::target_missed, "no pixel could be compared, so no limit holds");
    if (comparison.numbers.not_finite > 0)
        throw Error(ErrorKind::target_missed,
                    fmt::format("{} pixels are not finite, so no limit holds", comparison.numbers.not_finite));
    if (const double value = value_of(options.metric, comparison); !(value <= *options.limit))
        throw Error(ErrorKind::target_missed,
                    fmt::format("{} is {:.6g}, above {:.6g}", options.metric, value, *options.limit));
    return 0;
}

}  // namespace

Run add_compare_command(CLI::App& app) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand("compare", "How far an image or a map is from a reference");
    command->add_option("IMAGE", options->image, "EXR or HDR (linear), PNG or JPEG (read as sRGB)")
        ->required()
        ->type_name("FILE");
    command->add_option("REFERENCE", options->reference, "What it should be; of the same size")
        ->required()
        ->type_name("FILE");
    command->add_option("--mask", options->mask, "Compare only where this image is white")->type_name("FILE");
    command
        ->add_option("--channel", options->channel,
                     "Compare this channel, or the R, G and B of this layer [R G B, or the only channel]")
        ->type_name("NAME");
    command->add_option("-o,--output", options->heat_map, "Write a heat map: FLIP with --metric flip, else differences")
        ->type_name("FILE.png");
    command->add_flag("--signed", options->is_signed, "Heat map from blue, too dark, to orange, too bright");
    command->add_option("--fail-above", options->limit, "Exit with 5 when the metric is above, or a pixel not finite")
        ->type_name("NUMBER");
    command->add_option("--metric", options->metric, "rmse, mean, p99, p999, largest or flip [rmse]")
        ->type_name("WHICH")
        ->check(CLI::IsMember({"rmse", "mean", "p99", "p999", "largest", "flip"}));
    command
        ->add_option("--pixels-per-degree", options->pixels_per_degree,
                     "For FLIP: of the viewer's eye, 1 to 10000 [67]. It sees linear values as an sRGB screen shows "
                     "them, clamped to [0, 1], those of a map too")
        ->type_name("NUMBER")
        ->check(CLI::Range(1.0, 10000.0));
    command->add_flag("--json", options->json, "Print the numbers as JSON");
    return [options] { return compare(*options); };
}

}  // namespace surimi
