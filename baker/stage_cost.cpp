// SPDX-License-Identifier: Apache-2.0
#include "baker/stage_cost.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace surimi {

double seconds_of(const std::vector<StageCost>& costs, const std::string& stage) {
    const auto cost = std::ranges::find(costs, stage, &StageCost::stage);
    return cost == costs.end() ? 0 : cost->seconds;
}

double seconds_of(const std::vector<StageCost>& costs) {
    double sum = 0;
    for (const StageCost& cost : costs) sum += cost.seconds;
    return sum;
}

void Stopwatch::finish(const std::string& stage, size_t rays) {
    const auto now = std::chrono::steady_clock::now();
    auto cost = std::ranges::find(costs_, stage, &StageCost::stage);
    if (cost == costs_.end()) cost = costs_.insert(cost, {stage});
    cost->seconds += std::chrono::duration<double>(now - start_).count();
    cost->rays += rays;
    cost->peak_bytes = peak_resident_bytes();
    start_ = now;
}

size_t resident_bytes() {
    std::ifstream file("/proc/self/statm");  // pages: all, resident, ...
    size_t all = 0, resident = 0;
    if (!(file >> all >> resident)) return 0;
    return resident * static_cast<size_t>(sysconf(_SC_PAGESIZE));
}

size_t peak_resident_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace surimi
