// SPDX-License-Identifier: Apache-2.0
// How exact a bake shall be, what its values stand for, and how that is proved: options, environment and settings file
// on one footing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "baker/gather/settings.h"
#include "baker/post/settings.h"

namespace CLI {
class App;
}

namespace surimi {

struct Config;

/// What one source (settings file, environment or command line) says; empty: nothing.
struct GatherWishes {
    std::optional<double> error;
    std::optional<bool> is_exact;
    std::optional<std::string> method;
    std::optional<std::string> quality;  ///< stands for an error, and for exactness
    std::optional<double> seconds;       ///< --time
    std::optional<int> samples;
    std::optional<int> audit;
    std::optional<bool> is_strict;
    std::optional<uint64_t> seed;
    std::optional<int> supersample;
    std::optional<std::string> fit;
    std::optional<int> memory;  ///< MiB
};

/// --error, --exact, --quality, --time, --method, --samples, --audit, --strict, --seed, --supersample, --fit,
/// --memory.
void add_gather_options(CLI::App& app, GatherWishes& wishes);

/// What SURIMI_ERROR, SURIMI_EXACT and so on say. Throws Error(usage) for values of the wrong type.
GatherWishes environment_wishes();

/// Puts the wishes of a source over those of lower ones. Where two exclude each other, within one source that is an
/// Error(usage), and between sources the higher one wins. Throws Error(usage), starting with `source`, for values out
/// of range and unknown names.
void apply(const GatherWishes& wishes, const std::string& source, Config& config);

/// Throws Error(usage) when, all sources applied, a number of samples is left for a method that has none.
void check_samples(const GatherSettings& settings);

/// "auto", "split", "scanline" or "mc".
std::string name_of(Method method);

/// "none" or "bilinear".
std::string name_of(Fit fit);

/// Lines of TOML that give the same settings when they are read.
std::string gather_toml(const Config& config);

/// Adds the settings that decide the values of a bake to a JSON object.
void add_gather_json(const Config& config, nlohmann::ordered_json& json);

}  // namespace surimi
