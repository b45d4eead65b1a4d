// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/plan_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <nlohmann/json.hpp>

#include "baker/cli/evidence_summary.h"
#include "baker/evidence.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t listed_surfaces = 12;  // a screenful with the rest
constexpr double mebibyte = 1048576;

std::string title(const Monitor& monitor) {
    return fmt::format("{} {}", "RGB"[monitor.channel], monitor.name);
}

double to_double(size_t count) {
    return static_cast<double>(count);
}

std::string bytes(size_t count) {
    return fmt::format("{:.1f} MiB", to_double(count) / mebibyte);
}

/// "open", "5 % hidden, 95 % silhouettes": of the blocks that were looked at.
std::string blocks_text(const BlockCounts& blocks) {
    if (blocks.seen == 0) return "no texels";
    std::string text;
    const auto append = [&](size_t count, const char* what) {
        if (count == 0) return;
        if (!text.empty()) text += ", ";
        if (count < blocks.seen) text += fmt::format("{:.0f} % ", 100 * to_double(count) / to_double(blocks.seen));
        text += what;
    };
    append(blocks.unlit, "unlit");
    append(blocks.hidden, "hidden by one facet");
    append(blocks.open, "open");
    append(blocks.silhouettes, "silhouettes");
    append(blocks.cutouts, "rays because of cutouts");
    append(blocks.crowded, "rays");
    return text;
}

/// Those that get most of the map first; the first ones of the rest by number.
std::vector<size_t> by_blocks(const std::vector<Reach>& reach) {
    std::vector<size_t> order(reach.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, [&](size_t a, size_t b) { return reach[a].blocks.lit() > reach[b].blocks.lit(); });
    return order;
}

std::string reach_text(const Scene& scene, const PlannedMonitor& planned) {
    std::string text;
    size_t listed = 0, faced = 0;
    for (const Reach& reach : planned.reach) faced += reach.facing > 0;
    for (const size_t s : by_blocks(planned.reach)) {
        const Reach& reach = planned.reach[s];
        if (!(reach.facing > 0)) continue;
        if (listed++ == listed_surfaces) break;
        text +=
            fmt::format("  {:<28} {:>4.0f} % of it faces the monitor, {:.3g} to {:.3g} m; {}\n", scene.surfaces[s].name,
                        100 * reach.facing, reach.nearest, reach.farthest, blocks_text(reach.blocks));
    }
    if (faced > listed_surfaces) text += fmt::format("  and {} more surfaces\n", faced - listed_surfaces);
    if (faced < planned.reach.size())
        text += fmt::format("  {} of {} surfaces do not face it\n", planned.reach.size() - faced, planned.reach.size());
    return text;
}

std::string stage_text(const PlannedStage& stage) {
    const std::string name = (stage.is_part ? "  " : "") + stage.stage;
    const std::string seconds = stage.is_part ? "" : stage.runs ? fmt::format("{:.2f} s", stage.seconds) : "-";
    return fmt::format("  {:<26} {:<3} {:>9}  {}\n", name, stage.runs ? "on" : "off", seconds, stage.why);
}

std::string row_text(const Comparison::Row& row, double unit, const char* name) {
    return fmt::format("  {:<26} {:>9.2f} {:>9.2f} {:<4} {}\n", row.what, row.predicted / unit, row.truth / unit, name,
                       row.ratio() > 0 ? fmt::format("{:.2f}", row.ratio()) : "-");
}

std::string comparison_text(const Comparison& comparison) {
    std::string text = fmt::format("{:<28} {:>9} {:>9}      ratio\n", "plan against bake", "plan", "bake");
    for (const Comparison::Row& row : comparison.stages) text += row_text(row, 1, "s");
    text += row_text(comparison.seconds, 1, "s");
    text += row_text(comparison.rays, 1e6, "M");
    text += row_text(comparison.peak, mebibyte, "MiB");
    return text;
}

std::string memory_text(const PlannedMemory& memory) {
    std::string text = fmt::format(
        "  memory: map {}, texels {}, silhouettes {}, Embree {}; passing {}: light {} in bands "
        "of {} rows, fill and seams {}",
        bytes(memory.map), bytes(memory.texels), bytes(memory.silhouettes), bytes(memory.embree), bytes(memory.passing),
        bytes(memory.light), memory.band_rows, bytes(memory.post));
    if (memory.audit > 0) text += ", audit " + bytes(memory.audit);
    return text + fmt::format("; then files {}\n", bytes(memory.writing));
}

/// What follows from scene and settings alone.
Json memory_json(const PlannedMemory& memory) {
    return {{"map", memory.map},
            {"texels", memory.texels},
            {"silhouettes", memory.silhouettes},
            {"post", memory.post},
            {"audit", memory.audit}};
}

/// What follows from the machine, too; bands do where memory is bounded.
Json memory_run_json(const PlannedMemory& memory) {
    return {{"bandRows", memory.band_rows}, {"light", memory.light},   {"passing", memory.passing},
            {"writing", memory.writing},    {"embree", memory.embree}, {"peak", memory.peak}};
}

Json blocks_json(const BlockCounts& blocks) {
    return {{"seen", blocks.seen},
            {"unlit", blocks.unlit},
            {"hidden", blocks.hidden},
            {"open", blocks.open},
            {"silhouettes", blocks.silhouettes},
            {"cutouts", blocks.cutouts},
            {"rays", blocks.crowded},
            {"candidates", blocks.candidates}};
}

Json reach_json(const Scene& scene, const std::vector<Reach>& reach) {
    Json list = Json::array();
    for (size_t s = 0; s < reach.size(); ++s)
        list.push_back({{"surface", scene.surfaces[s].name},
                        {"node", scene.surfaces[s].node},
                        {"facing", reach[s].facing},
                        {"metres", {reach[s].nearest, reach[s].farthest}},
                        {"blocks", blocks_json(reach[s].blocks)}});
    return list;
}

Json monitor_json(const Scene& scene, size_t m, const PlannedMonitor& planned) {
    const Calibration& c = planned.calibration;
    Json methods = Json::object();
    for (size_t i = 0; i < c.methods.size(); ++i)
        methods[name_of(static_cast<TexelMethod>(i))] = {{"texels", std::round(c.methods[i].texels)},
                                                         {"rays", std::round(c.methods[i].rays)}};
    return {{"name", scene.monitors[m].name},
            {"channel", std::string(1, "RGB"[scene.monitors[m].channel])},
            {"blocks", blocks_json(planned.blocks)},
            {"texels", {{"sampled", c.sampled}, {"all", c.texels}, {"lit", std::round(c.lit)}}},
            {"error", {{"rms", c.rms_error}, {"shareAbove", c.share_above}}},
            {"rays", std::round(c.rays)},
            {"methods", methods},
            {"reach", reach_json(scene, planned.reach)}};
}

Json row_json(const Comparison::Row& row) {
    return {{"predicted", row.predicted}, {"true", row.truth}, {"ratio", row.ratio() > 0 ? Json(row.ratio()) : Json()}};
}

Json comparison_json(const Comparison& comparison) {
    Json stages = Json::object();
    for (const Comparison::Row& row : comparison.stages) stages[row.what] = row_json(row);
    return {{"stages", stages},
            {"seconds", row_json(comparison.seconds)},
            {"rays", row_json(comparison.rays)},
            {"peakBytes", row_json(comparison.peak)}};
}

Json run_json(const Scene& scene, const Plan& plan, const Comparison* comparison) {
    Json stages = Json::object();
    for (const PlannedStage& stage : plan.stages)
        if (!stage.is_part) stages[stage.stage] = stage.seconds;
    Json monitors = Json::object();
    for (size_t m = 0; m < plan.monitors.size(); ++m) {
        const Calibration& c = plan.monitors[m].calibration;
        Json& monitor = monitors[std::string(1, "RGB"[scene.monitors[m].channel])];
        monitor = {{"calibrationSeconds", c.spent}, {"fixedSeconds", c.fixed_seconds}};
        for (size_t i = 0; i < c.methods.size(); ++i)
            if (c.methods[i].texels > 0)
                monitor["microsecondsPerTexel"][name_of(static_cast<TexelMethod>(i))] =
                    c.methods[i].seconds * 1e6 / c.methods[i].texels;
    }
    Json run{{"seconds", plan.seconds()},
             {"stages", stages},
             {"monitors", monitors},
             {"memory", memory_run_json(plan.memory)}};
    if (comparison) run["comparison"] = comparison_json(*comparison);
    return run;
}

}  // namespace

std::string plan_text(const Scene& scene, const Plan& plan, const BakeSettings& settings,
                      const Comparison* comparison) {
    std::string text =
        fmt::format("{}: {} x {} texels{}, {} with a surface, {:.4g} a metre\n", scene.path.filename().string(),
                    plan.width, plan.height, plan.pages > 1 ? fmt::format(" on each of {} maps", plan.pages) : "",
                    plan.texels, plan.texels_per_metre);
    for (size_t m = 0; m < plan.monitors.size(); ++m) {
        const PlannedMonitor& planned = plan.monitors[m];
        text += fmt::format("{}: {}\n{}", title(scene.monitors[m]), blocks_text(planned.blocks),
                            reach_text(scene, planned));
    }
    text += "stages\n";
    for (const PlannedStage& stage : plan.stages) text += stage_text(stage);
    text += fmt::format("foretold: {:.1f} s, {:.1f} M rays, {}\n{}", plan.seconds(), plan.rays() / 1e6,
                        bytes(plan.memory.peak), memory_text(plan.memory));
    for (size_t m = 0; m < plan.monitors.size(); ++m) {
        const Calibration& c = plan.monitors[m].calibration;
        if (c.lit > 0)
            text += fmt::format("  {}: estimated error: {} within {}, RMS {:.2g}; from {} of {} texels\n",
                                title(scene.monitors[m]), percent_within(c.share_above), settings.gather.error,
                                c.rms_error, c.sampled, c.texels);
    }
    if (comparison) text += comparison_text(*comparison);
    return text;
}

std::string plan_json(const Scene& scene, const Plan& plan, const std::string& settings, const Comparison* comparison) {
    Json monitors = Json::array(), stages = Json::array();
    for (size_t m = 0; m < plan.monitors.size(); ++m) monitors.push_back(monitor_json(scene, m, plan.monitors[m]));
    for (const PlannedStage& stage : plan.stages)
        stages.push_back({{"stage", stage.stage},
                          {"part", stage.is_part},
                          {"runs", stage.runs},
                          {"why", stage.why},
                          {"rays", std::round(stage.rays)}});
    const Json json{{"scene", scene.path.filename().string()},
                    {"settings", Json::parse(settings)},
                    {"map",
                     {{"width", plan.width},
                      {"height", plan.height},
                      {"pages", plan.pages},
                      {"texelsPerMetre", plan.texels_per_metre},
                      {"texels", plan.texels}}},
                    {"monitors", monitors},
                    {"stages", stages},
                    {"rays", std::round(plan.rays())},
                    {"memory", memory_json(plan.memory)},
                    {"warnings", plan.warnings},
                    {"run", run_json(scene, plan, comparison)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace surimi
