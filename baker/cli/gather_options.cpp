// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/gather_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <nlohmann/json.hpp>

#include "baker/cli/config_file.h"
#include "baker/cli/numbers.h"
#include "baker/cli/options.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr std::array methods{Method::automatic, Method::split, Method::scanline, Method::monte_carlo};
constexpr std::array fits{Fit::none, Fit::bilinear};

struct Quality {
    const char* name;
    double error;
    bool is_exact;
};
/// 0.02 is hardly seen in a texture, 0.004 is a step of an 8-bit map, 0.001 is below all that a map can store.
constexpr std::array qualities{Quality{"draft", 0.02, false}, Quality{"medium", 0.004, false},
                               Quality{"high", 0.001, false}, Quality{"reference", 0.001, true}};

void require(bool holds, const std::string& source, const std::string& what) {
    if (!holds) throw Error(ErrorKind::usage, source + ": " + what);
}

[[noreturn]] void throw_unknown(const std::string& source, const std::string& what, const std::string& text,
                                const std::vector<std::string>& names) {
    throw Error(ErrorKind::usage, fmt::format("{}: {} must be one of {}, not \"{}\"; did you mean \"{}\"?", source,
                                              what, fmt::join(names, ", "), text, nearest(text, names)));
}

/// The one of `choices` that has this name.
template <class Choices>
auto parse_choice(const Choices& choices, const char* what, const std::string& text, const std::string& source) {
    std::vector<std::string> names;
    for (const auto choice : choices) {
        if (text == name_of(choice)) return choice;
        names.push_back(name_of(choice));
    }
    throw_unknown(source, what, text, names);
}

Method parse_method(const std::string& text, const std::string& source) {
    return parse_choice(methods, "method", text, source);
}

const Quality& parse_quality(const std::string& text, const std::string& source) {
    std::vector<std::string> names;
    for (const Quality& quality : qualities) {
        if (text == quality.name) return quality;
        names.push_back(quality.name);
    }
    throw_unknown(source, "quality", text, names);
}

std::string meaning_of(const Quality& quality) {
    return fmt::format("{}{}", quality.is_exact ? "exact, error " : "error ", quality.error);
}

/// "draft = error 0.02, medium = ..."
std::string meaning_of_qualities() {
    std::string text;
    for (const Quality& quality : qualities)
        text += fmt::format("{}{} = {}", text.empty() ? "" : "; ", quality.name, meaning_of(quality));
    return text;
}

bool is_about_scanlines_or_rays(Method method) {
    return method == Method::scanline || method == Method::monte_carlo;
}

/// Within one source.
void check_exclusions(const GatherWishes& wishes, const std::string& source) {
    if (wishes.quality) {
        const char* other = wishes.error ? "error" : wishes.is_exact ? "exact" : wishes.seconds ? "time" : nullptr;
        require(!other, source,
                fmt::format("quality and {} exclude each other: quality {} stands for {}; leave one out",
                            other ? other : "", *wishes.quality, meaning_of(parse_quality(*wishes.quality, source))));
    }
    const bool is_exact = wishes.quality ? parse_quality(*wishes.quality, source).is_exact : wishes.is_exact == true;
    require(!wishes.seconds || !wishes.error, source,
            "time and error exclude each other: with time the error is what can be had in it; leave one out");
    require(!wishes.seconds || !is_exact, source,
            "time and exact exclude each other: exactness takes the time that it takes; leave one out");
    require(!is_exact || !wishes.method || !is_about_scanlines_or_rays(parse_method(*wishes.method, source)), source,
            fmt::format("{} and method {} exclude each other: only splitting is exact; leave one out",
                        wishes.quality ? "quality reference" : "exact", wishes.method.value_or("")));
}

void check_ranges(const GatherWishes& wishes, const std::string& source) {
    if (wishes.error) require(*wishes.error > 0 && *wishes.error <= 1, source, "error must be above 0 and at most 1");
    if (wishes.seconds)
        require(*wishes.seconds > 0 && std::isfinite(*wishes.seconds), source, "time must be above 0 seconds");
    if (wishes.samples)
        require(*wishes.samples >= 0 && *wishes.samples <= 1 << 20, source,
                "samples must be from 0 (as many as the error takes) to 1048576");
    if (wishes.audit)
        require(*wishes.audit >= 0 && *wishes.audit <= 1000000, source, "audit must be from 0 to 1000000 texels");
    if (wishes.supersample)
        require(*wishes.supersample >= 1 && *wishes.supersample <= largest_supersample, source,
                fmt::format("supersample must be from 1 to {}", largest_supersample));
    if (wishes.memory) require(*wishes.memory >= 0, source, "memory must be in MiB, or 0 for no bound");
}

/// A variable of the environment that is set and not empty.
std::optional<std::string> variable(const char* name) {
    const char* text = std::getenv(name);
    return text && *text ? std::optional<std::string>(text) : std::nullopt;
}

std::optional<double> number(const char* name) {
    const auto text = variable(name);
    return text ? std::optional(parse_number(*text, name)) : std::nullopt;
}

template <class Integer>
std::optional<Integer> integer(const char* name) {
    const auto text = variable(name);
    if (!text) return std::nullopt;
    Integer value = 0;
    const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
    require(error == std::errc() && end == text->data() + text->size(), name,
            "\"" + *text + "\" is not a whole number");
    return value;
}

std::optional<bool> truth(const char* name) {
    const auto text = variable(name);
    if (!text) return std::nullopt;
    require(*text == "true" || *text == "1" || *text == "false" || *text == "0", name,
            "\"" + *text + "\" must be true, false, 1 or 0");
    return *text == "true" || *text == "1";
}

}  // namespace

std::string name_of(Method method) {
    switch (method) {
        case Method::split:
            return "split";
        case Method::scanline:
            return "scanline";
        case Method::monte_carlo:
            return "mc";
        default:
            return "auto";
    }
}

std::string name_of(Fit fit) {
    return fit == Fit::bilinear ? "bilinear" : "none";
}

// The environment is a source of its own (environment_wishes), so that options win where both exclude each other; the
// text beside an option names its variable as CLI11 does for those that it reads itself.
void add_gather_options(CLI::App& app, GatherWishes& wishes) {
    app.add_option("--error", wishes.error,
                   "How far the visibility of a texel may be off, above 0 to 1: 99.9 % of texels are within it, the "
                   "RMSE is within half [0.004]")
        ->option_text("E (Env:SURIMI_ERROR)");
    app.add_flag_callback(
        "--exact", [&wishes] { wishes.is_exact = true; },
        "Every point by exact splitting; only the average over a texel's area is estimated, within a quarter "
        "of the error (Env:SURIMI_EXACT)");
    app.add_option("--quality", wishes.quality, meaning_of_qualities())
        ->option_text("draft|medium|high|reference (Env:SURIMI_QUALITY)");
    app.add_option("--time", wishes.seconds, "Seconds to spend; the error follows")->option_text("S (Env:SURIMI_TIME)");
    app.add_option("--method", wishes.method,
                   "auto: what is cheapest for the error, block by block; split: exact; scanline: along lines on the "
                   "monitor; mc: rays [auto]")
        ->option_text("auto|split|scanline|mc (Env:SURIMI_METHOD)");
    app.add_option("--samples", wishes.samples,
                   "With --method mc: rays for each texel and monitor, up to 1048576; 0: as many as the error takes "
                   "[0]")
        ->option_text("N (Env:SURIMI_SAMPLES)");
    app.add_option("--audit", wishes.audit,
                   "Random texels of each monitor to check against 65536 rays each; the result is in the manifest [0]")
        ->option_text("N (Env:SURIMI_AUDIT)");
    app.add_flag_callback(
        "--strict", [&wishes] { wishes.is_strict = true; },
        "Exit with 5 when the estimates or the audit say that the error asked for is not reached "
        "(Env:SURIMI_STRICT)");
    app.add_option("--seed", wishes.seed, "Seed of the random numbers [0]")->option_text("N (Env:SURIMI_SEED)");
    app.add_option("--supersample", wishes.supersample,
                   "Gather light on N x N subtexels of each texel, 1 to 4, then average what arrives [1]")
        ->option_text("N (Env:SURIMI_SUPERSAMPLE)");
    app.add_option(
           "--fit", wishes.fit,
           "What a texel's value stands for. none: the visibility measured on average over the texel; bilinear: "
           "values whose bilinear reads average to that, for less error in penumbras and slight halos beside "
           "shadows sharper than a texel [none]")
        ->option_text("none|bilinear (Env:SURIMI_FIT)");
    app.add_option("--memory", wishes.memory,
                   "MiB that the bake may take, up to its files: the map is lit in bands of rows that keep within it; "
                   "the map itself must fit; 0: no bound [0]")
        ->option_text("MIB (Env:SURIMI_MEMORY)");
}

GatherWishes environment_wishes() {
    return {number("SURIMI_ERROR"),
            truth("SURIMI_EXACT"),
            variable("SURIMI_METHOD"),
            variable("SURIMI_QUALITY"),
            number("SURIMI_TIME"),
            integer<int>("SURIMI_SAMPLES"),
            integer<int>("SURIMI_AUDIT"),
            truth("SURIMI_STRICT"),
            integer<uint64_t>("SURIMI_SEED"),
            integer<int>("SURIMI_SUPERSAMPLE"),
            variable("SURIMI_FIT"),
            integer<int>("SURIMI_MEMORY")};
}

void apply(const GatherWishes& wishes, const std::string& source, Config& config) {
    check_exclusions(wishes, source);
    check_ranges(wishes, source);
    GatherSettings& gather = config.bake.gather;
    if (wishes.quality || wishes.error || wishes.is_exact == true) config.seconds = 0;
    if (wishes.seconds) {
        config.seconds = *wishes.seconds;
        gather.error = GatherSettings{}.error;
        gather.is_exact = false;
    }
    if (wishes.quality) {
        const Quality& quality = parse_quality(*wishes.quality, source);
        gather.error = quality.error;
        gather.is_exact = quality.is_exact;
    }
    if (wishes.error) gather.error = *wishes.error;
    if (wishes.is_exact) gather.is_exact = *wishes.is_exact;
    if (wishes.method) {
        gather.method = parse_method(*wishes.method, source);
        if (is_about_scanlines_or_rays(gather.method)) gather.is_exact = false;
    } else if (gather.is_exact && is_about_scanlines_or_rays(gather.method)) {
        gather.method = Method::automatic;  // a lower source's
    }
    if (gather.method != Method::monte_carlo && (wishes.method || gather.is_exact)) gather.samples = 0;
    if (wishes.samples) gather.samples = *wishes.samples;
    if (wishes.seed) gather.seed = *wishes.seed;
    if (wishes.supersample) gather.supersample = *wishes.supersample;
    if (wishes.fit) config.bake.post.fit = parse_choice(fits, "fit", *wishes.fit, source);
    if (wishes.memory) config.bake.memory = static_cast<size_t>(*wishes.memory) << 20;
    if (wishes.audit) config.bake.audit = static_cast<size_t>(*wishes.audit);
    if (wishes.is_strict) config.is_strict = *wishes.is_strict;
}

void check_samples(const GatherSettings& settings) {
    if (settings.samples == 0 || settings.method == Method::monte_carlo) return;
    throw Error(ErrorKind::usage,
                fmt::format("samples = {} is for --method mc alone, and the method is {}, which takes what the error "
                            "needs; add --method mc, or give --error in place of samples",
                            settings.samples, name_of(settings.method)));
}

std::string gather_toml(const Config& config) {
    const GatherSettings& gather = config.bake.gather;
    std::string text;
    if (config.seconds > 0) {
        text += fmt::format("time = {}             # seconds; the error follows\n", config.seconds);
    } else {
        text += fmt::format("error = {}          # of a texel's visibility; quality: {}\n", gather.error,
                            meaning_of_qualities());
        text += fmt::format("exact = {}          # every point by splitting\n", gather.is_exact);
    }
    text += fmt::format("method = \"{}\"        # auto, split, scanline, mc\n", name_of(gather.method));
    text +=
        fmt::format("samples = {}            # rays for each texel and monitor with method mc; 0: as the error takes\n",
                    gather.samples);
    text += fmt::format("audit = {}              # texels of each monitor\n", config.bake.audit);
    text += fmt::format("strict = {}         # exit with 5 when the error is not reached\n", config.is_strict);
    text += fmt::format("seed = {}\n", gather.seed);
    text += fmt::format("supersample = {}          # subtexels along a texel's side\n", gather.supersample);
    text += fmt::format("fit = \"{}\"             # none, bilinear\n", name_of(config.bake.post.fit));
    text += fmt::format("memory = {}               # MiB; 0: no bound\n", config.bake.memory >> 20);
    return text;
}

void add_gather_json(const Config& config, nlohmann::ordered_json& json) {
    const GatherSettings& gather = config.bake.gather;
    if (config.seconds > 0) json["time"] = config.seconds;
    json["error"] = gather.error;
    json["exact"] = gather.is_exact;
    json["method"] = name_of(gather.method);
    json["samples"] = gather.samples;
    json["audit"] = config.bake.audit;
    json["seed"] = gather.seed;
    json["supersample"] = gather.supersample;
    json["fit"] = name_of(config.bake.post.fit);
}

}  // namespace surimi
