// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <memory>

#include "runtime/base/error.h"

namespace surimi {
namespace {

// TBB's limit lasts as long as its handle, so the handle lasts as long as the process.
std::unique_ptr<tbb::global_control>& thread_limit() {
    static std::unique_ptr<tbb::global_control> limit;
    return limit;
}

}  // namespace

void set_thread_count(int threads) {
    thread_limit().reset();
    if (threads > 0) {
        thread_limit() = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                               static_cast<size_t>(threads));
    }
}

int thread_count() {
    const size_t limit = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return static_cast<int>(std::max<size_t>(1, limit));
}

Progress part_of(const Progress& progress, size_t part, size_t count) {
    if (count == 1 || !progress.report) return progress;
    const auto report = [whole = progress.report, part, count](std::string_view stage, double fraction) {
        whole(stage, (static_cast<double>(part) + fraction) / static_cast<double>(count));
    };
    return {report, progress.is_cancelled};
}

void parallel_ranges(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    grain = std::max<size_t>(1, grain);
    const size_t ranges = (count + grain - 1) / grain;
    // Ranges of fixed bounds, whatever the number of threads: a body may keep per-range state.
    tbb::parallel_for(tbb::blocked_range<size_t>(0, ranges, 1), [&](const tbb::blocked_range<size_t>& some) {
        for (size_t r = some.begin(); r != some.end(); ++r) body(r * grain, std::min(count, (r + 1) * grain));
    });
}

void parallel_stage(std::string_view stage, size_t count, size_t grain, const Progress& progress,
                    const std::function<void(size_t, size_t)>& body) {
    std::atomic<size_t> done{0};
    if (progress.report) progress.report(stage, 0);
    parallel_ranges(count, grain, [&](size_t begin, size_t end) {
        if (progress.is_cancelled && progress.is_cancelled()) throw Error(ErrorKind::interrupted, "interrupted");
        body(begin, end);
        const size_t now = done.fetch_add(end - begin) + (end - begin);
        if (progress.report) progress.report(stage, static_cast<double>(now) / static_cast<double>(count));
    });
    if (progress.report) progress.report(stage, 1);
}

}  // namespace surimi
