// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "baker/cli/colors.h"
#include "baker/cli/commands.h"
#include "baker/write/file.h"
#include "runtime/base/error.h"
#include "runtime/compare/compare.h"
#include "runtime/image/image_file.h"

namespace surimi {
namespace {

struct CompareOptions {
    std::filesystem::path image, reference, heat_map;
    std::string channel;
    std::string metric = "rmse";
    std::optional<double> limit;
    double pixels_per_degree = default_pixels_per_degree;
    bool json = false;
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
    if (metric == "flip") return comparison.flip;
    return comparison.numbers.rmse;
}

void print_report(const CompareOptions& options, const Comparison& comparison) {
    const ImageDifference& numbers = comparison.numbers;
    if (options.json) {
        const nlohmann::ordered_json report{{"image", options.image.string()},
                                            {"reference", options.reference.string()},
                                            {"width", comparison.seen.width},
                                            {"height", comparison.seen.height},
                                            {"rmse", numbers.rmse},
                                            {"relative_mse", numbers.relative_mse},
                                            {"mean_absolute", numbers.mean_absolute},
                                            {"largest", numbers.largest},
                                            {"largest_at", {numbers.largest_x, numbers.largest_y}},
                                            {"p99", numbers.p99},
                                            {"flip", comparison.flip},
                                            {"pixels_per_degree", options.pixels_per_degree},
                                            {"not_finite", numbers.not_finite}};
        fmt::print("{}\n", report.dump(2));
        return;
    }
    fmt::print("RMSE           {:.6g}\n", numbers.rmse);
    fmt::print("relative MSE   {:.6g}\n", numbers.relative_mse);
    fmt::print("mean absolute  {:.6g}\n", numbers.mean_absolute);
    fmt::print("99th percent   {:.6g}\n", numbers.p99);
    fmt::print("largest        {:.6g} at pixel ({}, {})\n", numbers.largest, numbers.largest_x, numbers.largest_y);
    fmt::print("FLIP           {:.6g} at {:.4g} pixels per degree\n", comparison.flip, options.pixels_per_degree);
    if (numbers.not_finite > 0) fmt::print("not finite     {} pixels, left out of all but FLIP\n", numbers.not_finite);
}

/// FLIP from 0 to 1, or absolute differences from 0 to what 99 % of the pixels stay below, or to the largest.
void write_heat_map(const CompareOptions& options, const Comparison& comparison, const Image<float>& absolute) {
    const bool shows_flip = options.metric == "flip";
    const ImageDifference& numbers = comparison.numbers;
    const double high = shows_flip                                        ? 1
                        : options.metric == "largest" || numbers.p99 == 0 ? numbers.largest
                                                                          : numbers.p99;
    write_file(options.heat_map, encode_png(heat_map(shows_flip ? comparison.seen : absolute, 0, high)));
    if (!options.json)
        fmt::print("{}: {}, black 0 to yellow {:.6g}\n", options.heat_map.string(),
                   shows_flip ? "FLIP" : "absolute difference", high);
}

int compare(const CompareOptions& options) {
    if (!options.heat_map.empty() && options.heat_map.extension() != ".png")
        throw Error(ErrorKind::usage, options.heat_map.string() + ": the heat map must be a .png");
    const Image<Vec3f> image = read_colors(options.image, options.channel);
    const Image<Vec3f> reference = read_colors(options.reference, options.channel);
    Comparison comparison{difference(image, reference), flip(image, reference, options.pixels_per_degree), 0};
    comparison.flip = mean(comparison.seen);
    print_report(options, comparison);
    if (!options.heat_map.empty()) write_heat_map(options, comparison, absolute_difference(image, reference));
    if (!options.limit) return 0;
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
    command
        ->add_option("--channel", options->channel,
                     "Compare this channel, or the R, G and B of this layer [R G B, or the only channel]")
        ->type_name("NAME");
    command->add_option("-o,--output", options->heat_map, "Write a heat map: FLIP with --metric flip, else differences")
        ->type_name("FILE.png");
    command->add_option("--fail-above", options->limit, "Exit with 5 when the metric is above, or a pixel not finite")
        ->type_name("NUMBER");
    command->add_option("--metric", options->metric, "rmse, largest, p99 or flip [rmse]")
        ->type_name("WHICH")
        ->check(CLI::IsMember({"rmse", "largest", "p99", "flip"}));
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
