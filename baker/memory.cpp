// SPDX-License-Identifier: Apache-2.0
#include "baker/memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "baker/gather/blocks.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr double mebibyte = 1048576;

template <class Item>
size_t bytes_of(const std::vector<Item>& items) {
    return items.size() * sizeof(Item);
}

double mebibytes(size_t bytes) {
    return static_cast<double>(bytes) / mebibyte;
}

/// What a texel of one monitor leaves beside its place on the map.
constexpr size_t bytes_of_estimate = sizeof(TexelState) + sizeof(IrradianceEstimate);

/// Of all pages and monitors.
size_t map_bytes(size_t texels_of_page, size_t pages, size_t monitors) {
    return texels_of_page * pages * (sizeof(Vec3f) + monitors * bytes_of_estimate);
}

/// As fill() works: three numbers for each texel of the map, and lists of those that have a value (8 bytes, grown by
/// doubling).
size_t fill_bytes(const Texels& texels) {
    const size_t map = static_cast<size_t>(texels.width) * static_cast<size_t>(texels.height);
    return map * 3 * sizeof(uint32_t) + texels.texels.size() * 3 * sizeof(uint32_t);
}

/// What is held beside what stays, page after page: a band and the page's estimates, when their image is not there
/// yet; both; or what is filled.
size_t passing_bytes(const Texels& texels, const GatherSettings& settings) {
    const size_t map = static_cast<size_t>(texels.width) * static_cast<size_t>(texels.height);
    const size_t estimates = texels.texels.size() * sizeof(IrradianceEstimate);
    const size_t channel = map * sizeof(float), to_come = map * bytes_of_estimate;
    const size_t light = std::max(to_come, estimates + band_bytes(texels, settings)) - to_come;
    return std::max({light, estimates + channel, channel + fill_bytes(texels)});
}

[[noreturn]] void throw_too_much(const std::string& what, size_t bytes, size_t bound) {
    throw Error(ErrorKind::usage,
                fmt::format("memory: {:.0f} MiB are allowed, and {} at least {:.0f} MiB; raise --memory, or make the "
                            "map smaller with --size or --density (bytes grow with the square of both), or take "
                            "fewer --atlases",
                            mebibytes(bound), what, mebibytes(bytes)));
}

}  // namespace

PlannedMemory planned_memory(const Scene& scene, const Preparation& preparation, const BakeSettings& settings) {
    PlannedMemory memory;
    const Atlas& atlas = preparation.atlas;
    const size_t page = static_cast<size_t>(atlas.width) * static_cast<size_t>(atlas.height);
    memory.map = map_bytes(page, preparation.texels.size(), scene.monitors.size());
    for (const Texels& texels : preparation.texels) {
        memory.texels += bytes_of(texels.texels) + bytes_of(texels.triangles);
        memory.passing = std::max(memory.passing, passing_bytes(texels, settings.gather));
    }
    const Silhouettes& s = preparation.silhouettes;
    memory.silhouettes =
        bytes_of(s.planes) + bytes_of(s.edges) + bytes_of(s.nodes) + bytes_of(s.cutout_nodes) + bytes_of(s.cutouts);
    for (const auto& planes : s.plane_of) memory.silhouettes += bytes_of(planes);
    memory.embree = preparation.rays_bytes;
    memory.peak = std::max(peak_resident_bytes(), resident_bytes() + memory.map + memory.passing);
    return memory;
}

int most_rows_within(size_t bound, int rows, const std::function<size_t(int)>& bytes_with) {
    while (bytes_with(rows) > bound) {
        if (rows <= tile_size) return 0;
        rows = std::max(1, rows / 2 / tile_size) * tile_size;
    }
    return rows;
}

int rows_within_memory(const Scene& scene, const Preparation& preparation, const BakeSettings& settings) {
    const int wanted = rows_of_band(preparation.atlas.width, settings.gather);
    if (settings.memory == 0) return wanted;
    size_t peak = 0;
    const int rows = most_rows_within(settings.memory, wanted, [&](int tried) {
        BakeSettings in_bands = settings;
        in_bands.gather.band_rows = tried;
        return peak = planned_memory(scene, preparation, in_bands).peak;
    });
    if (rows == 0)
        throw_too_much(fmt::format("this bake, even in bands of {} rows of the map, takes", tile_size), peak,
                       settings.memory);
    return rows;
}

void check_memory_of_maps(const Scene& scene, const BakeSettings& settings) {
    const UnwrapSettings& unwrap = settings.unwrap;
    if (settings.memory == 0 || unwrap.texels_per_metre > 0) return;
    const size_t page = static_cast<size_t>(unwrap.width) * static_cast<size_t>(unwrap.height);
    const size_t bytes = resident_bytes() + map_bytes(page, 1, scene.monitors.size());
    if (bytes > settings.memory)
        throw_too_much(fmt::format("{} x {} texels of map and evidence (monitors: {}) take", unwrap.width,
                                   unwrap.height, scene.monitors.size()),
                       bytes, settings.memory);
}

}  // namespace surimi
