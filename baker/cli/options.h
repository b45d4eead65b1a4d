// SPDX-License-Identifier: Apache-2.0
// Options that several subcommands share, and what they come to together with the configuration file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "baker/bake.h"
#include "baker/cli/gather_options.h"
#include "runtime/scene/monitors.h"
#include "runtime/scene/roles.h"

namespace CLI {
class App;
}

namespace surimi {

/// What stands on the command line or in the environment; empty: not given.
struct Given {
    std::filesystem::path scene;
    std::vector<std::string> monitors;
    std::string config;
    std::optional<std::string> glass;
    std::optional<std::string> uv;
    std::vector<int> size;
    std::optional<double> density;
    std::optional<int> gutter;
    std::optional<int> mips;
    bool is_uniform = false;
    std::optional<int> atlases;
    std::optional<double> stretch;
    std::optional<std::string> uv_quality;
    std::vector<std::string> without;
    std::optional<GatherWishes> gather;  ///< none: the subcommand does not gather and has no such options
    std::optional<int> threads;
    std::string progress = "auto";
    bool quiet = false;
    bool json = false;
    bool print_config = false;
};

/// The settings in effect: command line over environment over file over default.
struct Config {
    MonitorRequest monitors;
    RoleSettings roles;
    BakeSettings bake;
    double seconds = 0;      ///< to spend on a bake; 0: as many as the error takes
    bool is_strict = false;  ///< an error that is not reached is a failure
    int threads = 0;         ///< 0: all cores
};

void add_scene_options(CLI::App& app, Given& given);   ///< SCENE, --monitor, --glass, --config and so on
void add_unwrap_options(CLI::App& app, Given& given);  ///< --uv, --size, --density, --gutter, --mips and so on

/// Merges the configuration file (given.config, else NAME.surimi.toml beside the scene, if there) and what is given.
/// Throws Error(usage) for unknown keys, with the nearest known one, and for values out of range.
Config effective_config(const Given& given);

/// The effective settings as TOML; reading it back gives the same settings.
std::string to_toml(const Config& config);

/// The settings that decide a bake's result, as JSON for the manifest.
std::string settings_json(const Config& config);

/// Those of them that decide an unwrap's.
std::string unwrap_settings_json(const Config& config);

/// Reads the scene, decides the roles of its surfaces and finds its monitors; tells stderr what was dropped or
/// repaired, unless quiet.
Scene load_scene(const Given& given, const Config& config);

/// Prints a scene's notes to stderr, a line each.
void print_notes(const Scene& scene);

}  // namespace surimi
