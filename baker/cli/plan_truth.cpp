// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/plan_truth.h"

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "runtime/base/error.h"

namespace surimi {

BakeTruth read_truth(const std::filesystem::path& manifest) {
    std::ifstream file(manifest);
    if (!file)
        throw Error(ErrorKind::scene, manifest.string() + ": cannot be read; give the .visibility.json of a bake");
    BakeTruth truth;
    try {
        const nlohmann::json json = nlohmann::json::parse(file);
        truth.settings_json = json.at("settings").dump();
        for (const auto& [stage, rays] : json.at("rays").items()) truth.rays += rays.get<double>();
        for (const auto& stage : json.at("run").at("stages")) {
            truth.stages.push_back({stage.at("stage").get<std::string>(), stage.at("seconds").get<double>()});
            truth.peak_bytes = std::max(truth.peak_bytes, stage.at("peakBytes").get<double>());
        }
    } catch (const nlohmann::json::exception& error) {
        throw Error(ErrorKind::scene, manifest.string() + ": is no manifest of a bake (" + error.what() +
                                          "); give the .visibility.json that surimi bake wrote");
    }
    return truth;
}

Comparison compare(const Plan& plan, const BakeTruth& truth) {
    Comparison result;
    for (const PlannedStage& stage : plan.stages) {
        const auto same = std::ranges::find(truth.stages, stage.stage, &BakeTruth::Stage::name);
        if (stage.is_part || same == truth.stages.end()) continue;
        result.stages.push_back({stage.stage, stage.seconds, same->seconds});
    }
    result.seconds.predicted = plan.seconds();
    for (const BakeTruth::Stage& stage : truth.stages) result.seconds.truth += stage.seconds;
    result.rays = {"rays", plan.rays(), truth.rays};
    result.peak = {"peak bytes", static_cast<double>(plan.memory.peak), truth.peak_bytes};
    return result;
}

}  // namespace surimi
