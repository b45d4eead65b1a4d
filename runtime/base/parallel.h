// SPDX-License-Identifier: Apache-2.0
// The one parallel construct: a loop whose items write only their own slot, so that the result does not depend on
// the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace surimi {

/// Limits how many threads parallel_for uses in this process; 0 means all cores.
void set_thread_count(int threads);
int thread_count();

/// What a long stage tells the one who waits, and how that one stops it. Both are called from any thread.
struct Progress {
    std::function<void(std::string_view stage, double fraction)> report;  ///< fraction done, in [0, 1]; may be empty
    std::function<bool()> is_cancelled;                                   ///< may be empty: never
};

/// For a stage that is done in `count` equal parts: what part number `part` tells, as progress of the whole.
Progress part_of(const Progress& progress, size_t part, size_t count);

/// Calls `body(begin, end)` on ranges that together cover [0, count), each at most `grain` long, on several threads.
/// Exceptions of `body` reach the caller.
void parallel_ranges(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body);

/// Calls `body(i)` for every i in [0, count) on several threads, in ranges of `grain` items.
template <class Body>
void parallel_for(size_t count, size_t grain, const Body& body) {
    parallel_ranges(count, grain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) body(i);
    });
}

/// As parallel_ranges, reporting to `progress` under the name `stage`; throws Error(interrupted) soon after
/// `progress.is_cancelled` answers true.
void parallel_stage(std::string_view stage, size_t count, size_t grain, const Progress& progress,
                    const std::function<void(size_t, size_t)>& body);

}  // namespace surimi
