// SPDX-License-Identifier: Apache-2.0
#include "baker/memory.h"

#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "baker/gather/blocks.h"
#include "baker/post_memory.h"
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

size_t texels_of_page(const Preparation& preparation) {
    return static_cast<size_t>(preparation.atlas.width) * static_cast<size_t>(preparation.atlas.height);
}

/// More than the last monitor's evidence, which is there when all is done.
size_t beyond(size_t bytes, const Preparation& preparation) {
    const size_t evidence = texels_of_page(preparation) * preparation.texels.size() * bytes_of_estimate;
    return bytes > evidence ? bytes - evidence : 0;
}

/// Of a page of one monitor: its channel and the image of its estimates.
size_t channel_bytes(const Preparation& preparation) {
    return texels_of_page(preparation) * (sizeof(float) + bytes_of_estimate);
}

/// What bake() holds of a monitor while it gathers, page after page: the pages before, then this one's estimates and a
/// band of them, or both and what they become.
size_t light_bytes(const Preparation& preparation, const GatherSettings& settings) {
    size_t most = 0, before = 0;
    for (const Texels& texels : preparation.texels) {
        const size_t estimates = texels.texels.size() * sizeof(IrradianceEstimate);
        const size_t channel = channel_bytes(preparation);
        most = std::max(most, before + estimates + std::max(band_bytes(texels, settings), channel));
        before += channel;
    }
    return beyond(most, preparation);
}

size_t scene_bytes(const Scene& scene) {
    size_t bytes = 0;
    for (const auto& image : scene.images) bytes += bytes_of(image.pixels);
    for (const Surface& surface : scene.surfaces) {
        bytes += bytes_of(surface.positions) + bytes_of(surface.normals) + bytes_of(surface.triangles) +
                 bytes_of(surface.source_triangle) + bytes_of(surface.source_vertex);
        for (const auto& uv : surface.uv_sets) bytes += bytes_of(uv);
    }
    return bytes;
}

/// As write_bake() works: the PNGs, which the baked glb carries, and that glb, which is made, written and read back.
size_t writing_bytes(const Scene& scene, const Preparation& preparation) {
    constexpr size_t copies = 4;            // of what a glb holds: as it comes, edited, as one buffer, as a file
    constexpr size_t decoded = 4, raw = 3;  // bytes of a texel
    const size_t map = texels_of_page(preparation), pages = preparation.texels.size();
    const size_t png = map * scene.monitors.size() / 3;  // a byte a texel of three monitors: noisy
    std::error_code ignored;
    const auto file = static_cast<size_t>(std::filesystem::file_size(scene.path, ignored));
    const size_t at_once = std::min(pages, static_cast<size_t>(thread_count()));
    const size_t made = copies * ((ignored ? 0 : file) + pages * png);
    return pages * png + std::max(made, made / 2 + scene_bytes(scene) + map * (pages * decoded + at_once * raw));
}

/// What the process holds now, without what it could give back.
size_t held_bytes() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    return resident_bytes();
}

/// All that does not depend on the height of a band, and what the process holds.
PlannedMemory memory_without_bands(const Scene& scene, const Preparation& preparation, const BakeSettings& settings) {
    PlannedMemory memory;
    const size_t channels = preparation.texels.size() * channel_bytes(preparation);
    memory.map = map_bytes(texels_of_page(preparation), preparation.texels.size(), scene.monitors.size());
    for (const Texels& texels : preparation.texels) {
        memory.texels += bytes_of(texels.texels) + bytes_of(texels.triangles);
        if (settings.audit > 0) memory.audit = std::max(memory.audit, audit_bytes(texels));
    }
    for (size_t m = 0; m < scene.monitors.size(); ++m)
        memory.post =
            std::max(memory.post, beyond(channels + post_bytes(scene, preparation, m, settings.post), preparation));
    const Silhouettes& s = preparation.silhouettes;
    memory.silhouettes =
        bytes_of(s.planes) + bytes_of(s.edges) + bytes_of(s.nodes) + bytes_of(s.cutout_nodes) + bytes_of(s.cutouts);
    for (const auto& planes : s.plane_of) memory.silhouettes += bytes_of(planes);
    memory.writing = writing_bytes(scene, preparation);
    memory.embree = preparation.rays_bytes;
    return memory;
}

void add_bands(PlannedMemory& memory, const Preparation& preparation, GatherSettings settings, int rows, size_t held) {
    settings.band_rows = rows;
    memory.band_rows = rows;
    memory.light = light_bytes(preparation, settings);
    memory.passing = std::max({memory.light, memory.post, memory.audit});
    const size_t gone = memory.texels + memory.silhouettes;  // when files are written
    const size_t most = std::max(memory.passing, memory.writing > gone ? memory.writing - gone : 0);
    memory.peak = std::max(peak_resident_bytes(), held + memory.map + most);
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
    const size_t held = held_bytes();
    PlannedMemory memory = memory_without_bands(scene, preparation, settings);
    add_bands(memory, preparation, settings.gather, rows_of_band(preparation.atlas.width, settings.gather), held);
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
    const size_t held = held_bytes();
    PlannedMemory memory = memory_without_bands(scene, preparation, settings);
    const int rows = most_rows_within(settings.memory, wanted, [&](int tried) {
        add_bands(memory, preparation, settings.gather, tried, held);
        return memory.peak;
    });
    if (rows == 0)
        throw_too_much(fmt::format("this bake, even in bands of {} rows of the map, takes", tile_size), memory.peak,
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

void return_large_memory() {
#ifdef __GLIBC__
    constexpr int large = 1 << 20;
    mallopt(M_MMAP_THRESHOLD, large);  // else it grows with what is given back
    mallopt(M_TRIM_THRESHOLD, large);
#endif
}

}  // namespace surimi
