// SPDX-License-Identifier: Apache-2.0
#include "baker/study/techniques.h"

#include <fmt/format.h>

#include <array>

#include "baker/study/closest_point.h"
#include "baker/study/hard_shadows.h"
#include "baker/study/point_sampling.h"
#include "baker/study/shadow_map.h"
#include "baker/study/study.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr std::array<double, 6> errors = {0.02, 0.01, 0.004, 0.002, 0.001, 0.0005};
constexpr std::array<int, 6> ray_counts = {16, 64, 256, 1024, 4096, 16384};  // squares and powers of 2
constexpr int depth_map_size = 1024;

GatherSettings engine_settings(Method method, double error) {
    GatherSettings settings;
    settings.method = method;
    settings.error = error;
    return settings;
}

void add_engine_trial(Technique& technique, const Silhouettes& silhouettes, double seconds, GatherSettings settings) {
    const bool is_counted = settings.samples > 0;
    Trial& trial = technique.trials.emplace_back();
    trial.value = is_counted ? settings.samples : settings.error;
    trial.setting = is_counted ? fmt::format("{} rays", settings.samples) : fmt::format("E = {:g}", settings.error);
    const double setup = settings.method == Method::monte_carlo ? 0 : seconds;
    trial.run = [&silhouettes, setup, settings](const Subject& subject) {
        GatherSettings seeded = settings;
        seeded.seed = subject.seed;
        return measure_engine(subject, silhouettes, seeded, setup);
    };
}

/// One trial of an estimator that takes an int, without setup.
template <class Estimate>
void add_trial(Technique& technique, int value, const std::string& setting, const Estimate& estimate) {
    technique.trials.push_back({setting, static_cast<double>(value), [value, estimate](const Subject& subject) {
                                    const auto at_value = [&](const Receiver& r) { return estimate(r, value); };
                                    return measure(subject, at_value, 0);
                                }});
}

template <class Estimate>
Technique point_technique(Series series, const Estimate& estimate) {
    Technique technique{std::move(series), {}};
    for (const int count : ray_counts) add_trial(technique, count, fmt::format("{} rays", count), estimate);
    return technique;
}

using SobolTable = std::vector<std::array<uint32_t, 4>>;

std::shared_ptr<const SobolTable> sobol_table() {
    auto table = std::make_shared<SobolTable>();
    for (int i = 0; i < ray_counts.back(); ++i) table->push_back(sobol::point(static_cast<uint32_t>(i)));
    return table;
}

/// The depth maps of all monitors and the CPU seconds that they took.
struct RenderedMaps {
    std::vector<DepthMaps> of_monitor;
    double seconds = 0;
};

/// One trial of an estimator that looks into depth maps. Whoever comes first renders them.
template <class Estimate>
void add_depth_trial(Technique& technique, const std::shared_ptr<RenderedMaps>& maps, int value,
                     const std::string& setting, const Estimate& estimate) {
    technique.trials.push_back(
        {setting, static_cast<double>(value), [maps, value, estimate](const Subject& subject) {
             const double start = thread_seconds();
             for (size_t m = maps->of_monitor.size(); m < subject.monitors.size(); ++m)
                 maps->of_monitor.push_back(make_depth_maps(subject.monitors[m], depth_map_size));
             maps->seconds += thread_seconds() - start;
             const auto look = [&](const Receiver& r) { return estimate(r, maps->of_monitor[r.light.index], value); };
             return measure(subject, look, maps->seconds);
         }});
}

std::vector<Technique> depth_map_techniques() {
    const auto maps = std::make_shared<RenderedMaps>();
    Technique pcf{
        {"pcf",
         "shadow map, PCF",
         fmt::format("Reeves et al. 1987, n x n texels of a {0} x {0} depth map from the monitor's centre, at "
                     "the texel's middle; its rendering is spread over the map's texels",
                     depth_map_size),
         Family::approximation,
         {}},
        {}};
    for (const int n : {1, 3, 7, 15, 31})
        add_depth_trial(pcf, maps, n, fmt::format("{0} x {0} texels", n), percentage_closer_filter);
    Technique pcss{{"pcss",
                    "shadow map, PCSS",
                    "Fernando 2005, on the same depth map, at the texel's middle",
                    Family::approximation,
                    {}},
                   {}};
    for (const int taps : {16, 64, 256, 1024})
        add_depth_trial(pcss, maps, taps, fmt::format("2 x {} taps", taps), percentage_closer_soft_shadow);
    return {pcf, pcss};
}

}  // namespace

std::vector<Technique> baker_techniques(const Silhouettes& silhouettes, double seconds) {
    std::vector<Technique> all;
    all.push_back({{automatic_id, "Surimi", "bake --error E, footprint average", Family::surimi, {}}, {}});
    for (const double error : errors)
        add_engine_trial(all.back(), silhouettes, seconds, engine_settings(Method::automatic, error));
    all.push_back(
        {{"scanline", "scanlines", "bake --method scanline --error E, footprint average", Family::surimi, {}}, {}});
    for (const double error : errors)
        add_engine_trial(all.back(), silhouettes, seconds, engine_settings(Method::scanline, error));
    all.push_back({{"exact", "exact split", "bake --exact --error E, footprint average", Family::surimi, {}}, {}});
    for (const double error : {0.02, 0.004, 0.001}) {
        GatherSettings settings = engine_settings(Method::split, error);
        settings.is_exact = true;
        add_engine_trial(all.back(), silhouettes, seconds, settings);
    }
    all.push_back({{"mc", "Surimi's rays", "bake --method mc --samples N, footprint average", Family::surimi, {}}, {}});
    for (const int count : {16, 64, 256, 1024, 4096}) {
        GatherSettings settings = engine_settings(Method::monte_carlo, 0.004);
        settings.samples = count;
        add_engine_trial(all.back(), silhouettes, seconds, settings);
    }
    return all;
}

std::vector<Technique> other_techniques() {
    const auto table = sobol_table();
    const auto first = [](const std::shared_ptr<const SobolTable>& points, int count) {
        return SobolPoints(*points).first(static_cast<size_t>(count));
    };
    std::vector<Technique> all;
    all.push_back(point_technique(
        {random_id, "random", "uniform pairs of points, footprint average", Family::sampling, {}}, random_points));
    all.push_back(point_technique(
        {"stratified", "stratified", "jittered pairs of points (Cook 1986), footprint average", Family::sampling, {}},
        stratified_points));
    all.push_back(point_technique(
        {"sobol", "Sobol-Owen", "scrambled Sobol pairs (Owen 1995), footprint average", Family::sampling, {}},
        [=](const Receiver& r, int count) { return sobol_points(r, first(table, count)); }));
    all.push_back(
        point_technique({"probe",
                         "probe and refine",
                         "16 Sobol-Owen rays, all of them only where those differ, footprint average",
                         Family::approximation,
                         {}},
                        [=](const Receiver& r, int count) { return probe_and_refine(r, first(table, count)); }));

    Technique closest{{"closest",
                       "closest point (Godot)",
                       "16 places of the footprint to the monitor's closest point, or a disk there (Godot 015dffd9)",
                       Family::approximation,
                       {}},
                      {}};
    for (const int count : {16, 128, 512, 2048})
        add_trial(closest, count, fmt::format("{} rays", count), closest_point);
    all.push_back(closest);

    Technique grid{{"hard-grid",
                    "N x N hard shadows",
                    "Heckbert and Herf 1997, one place of the footprint for each light, the same for all texels",
                    Family::approximation,
                    {}},
                   {}};
    for (const int n : {2, 4, 8, 16, 32, 64, 128})
        add_trial(grid, n, fmt::format("{0} x {0} lights", n), hard_shadow_grid);
    all.push_back(grid);
    for (Technique& technique : depth_map_techniques()) all.push_back(std::move(technique));
    return all;
}

}  // namespace surimi
