// SPDX-License-Identifier: Apache-2.0
// What a bake really took, from its manifest, beside what a plan foretold.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "baker/plan.h"

namespace surimi {

/// From a manifest's run.stages and rays.
struct BakeTruth {
    struct Stage {
        std::string name;
        double seconds = 0;
    };
    std::vector<Stage> stages;
    double rays = 0;
    double peak_bytes = 0;
    std::string settings_json;  ///< of the bake
};

/// Reads NAME.visibility.json. Throws Error(scene) where that is no manifest of a bake.
BakeTruth read_truth(const std::filesystem::path& manifest);

struct Comparison {
    struct Row {
        std::string what;  ///< a stage's name, or "all stages", "rays", "peak bytes"
        double predicted = 0;
        double truth = 0;

        double ratio() const { return truth > 0 ? predicted / truth : 0; }  ///< 0: there is none
    };
    std::vector<Row> stages;  ///< seconds of the stages that both know
    Row seconds{"all stages"}, rays{"rays"}, peak{"peak bytes"};
};

Comparison compare(const Plan& plan, const BakeTruth& truth);

}  // namespace surimi
