// SPDX-License-Identifier: Apache-2.0
// What the stages of a bake cost: time, rays, and the memory of the process.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace surimi {

/// What one stage cost, over all monitors and pages that it names.
struct StageCost {
    std::string stage;
    double seconds = 0;
    size_t rays = 0;
    size_t peak_bytes = 0;  ///< resident set of the process at its highest so far
};

/// Seconds of the stage of this name, or of all; 0 if it has not run.
double seconds_of(const std::vector<StageCost>& costs, const std::string& stage);
double seconds_of(const std::vector<StageCost>& costs);

/// Times stages, one after the other. A stage that comes again, for another page, is the same stage.
class Stopwatch {
  public:
    /// Adds to `costs`, which must outlive it.
    explicit Stopwatch(std::vector<StageCost>& costs) : costs_(costs) {}

    /// The time since the last stage was finished, or since the beginning, was this stage's.
    void finish(const std::string& stage, size_t rays = 0);

  private:
    std::vector<StageCost>& costs_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Bytes that the process holds in memory now, from the kernel; 0 where it does not tell.
size_t resident_bytes();

/// The same at its highest so far.
size_t peak_resident_bytes();

}  // namespace surimi
