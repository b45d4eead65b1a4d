// SPDX-License-Identifier: Apache-2.0
#include "baker/preparation.h"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

namespace surimi {
namespace {

/// Seconds that `work` takes.
template <class Work>
double seconds_of(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Preparation prepare(const Scene& scene, const UnwrapSettings& settings, const Progress& progress) {
    Preparation result;
    result.unwrap_seconds = seconds_of([&] { result.atlas = unwrap(scene, settings, progress); });
    result.texels_seconds = seconds_of([&] {
        for (int page = 0; page < result.atlas.pages; ++page)
            result.texels.push_back(find_texels(scene, result.atlas, page));
    });
    const size_t before = resident_bytes();
    result.rays_seconds = seconds_of([&] { result.rays = std::make_unique<RayScene>(scene); });
    const size_t after = resident_bytes();
    result.rays_bytes = after > before ? after - before : 0;
    result.silhouettes_seconds = seconds_of([&] { result.silhouettes = find_silhouettes(scene, *result.rays); });
    return result;
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
