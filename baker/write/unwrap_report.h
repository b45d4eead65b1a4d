// SPDX-License-Identifier: Apache-2.0
// The numbers of an unwrap as JSON for people and programs.
#pragma once

#include <string>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "baker/unwrap/measure.h"
#include "runtime/scene/scene.h"

namespace surimi {

/// A finished unwrap.
struct Unwrapped {
    Atlas atlas;
    UnwrapNumbers numbers;
    std::string settings_json;  ///< an object
    double seconds = 0;         ///< that cutting and packing took
};

/// A file that was written.
struct UnwrapFile {
    std::string role;  ///< "glb", "charts", "density" or "stretch"
    std::string name;
    int page = -1;    ///< of a picture
    double low = 0;   ///< of a heat map: what is black
    double high = 0;  ///< and what is pale yellow; 0 where the file is no heat map
    std::string unit;
};

/// The report, a JSON object. What differs from run to run is in its last member, "run".
std::string make_unwrap_report(const Scene& scene, const Unwrapped& unwrapped, const std::vector<UnwrapFile>& files);

}  // namespace surimi
