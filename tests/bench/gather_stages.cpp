// SPDX-License-Identifier: Apache-2.0
// Times of the stages of `gather` on random texels of a room that its first monitor can light, on one thread.
// Usage: gather_stages [FILE.glb] [--benchmark_...]; without a file, the living-room of SURIMI_SCENES.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "baker/gather/monte_carlo.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/base/error.h"
#include "runtime/base/random.h"
#include "runtime/scene/gltf.h"
#include "runtime/scene/monitors.h"

namespace {

using namespace surimi;

constexpr size_t texel_count = 256;
constexpr size_t rays_per_texel = RayPacket::capacity;

struct Ray {
    Vec3 origin, target;
};

/// A room that is ready to be gathered.
struct Room {
    Scene scene;
    Atlas atlas;
    Texels texels;
    std::unique_ptr<RayScene> rays;
    std::unique_ptr<MonitorSampler> sampler;
    SamplePoints points;
    std::vector<TexelSurface> surfaces;  // of the texels that were drawn
    std::vector<Ray> some_rays;          // rays_per_texel of each, one texel after the other; in world space

    MonteCarloTask task(uint64_t key) const {
        return {.rays = *rays, .sampler = *sampler, .points = points, .clearance = 1e-4, .key = key};
    }
};

/// Sixteen rays from a texel to the monitor, spread as monte_carlo does.
void add_rays(const TexelSurface& surface, uint64_t key, Room& room) {
    const Scrambling seeds = scrambling(key);
    for (uint32_t i = 0; i < rays_per_texel; ++i) {
        const auto r = scrambled(sobol::point(i), seeds);
        const SurfacePoint from = surface.sample(r[0], r[1]);
        room.some_rays.push_back({room.rays->ray_origin(from), room.sampler->sample(r[2], r[3]).position});
    }
}

void draw_texels(Room& room) {
    const auto count = static_cast<double>(room.texels.texels.size());
    constexpr uint64_t most_tries = 100 * texel_count;
    for (uint64_t i = 0; i < most_tries && room.surfaces.size() < texel_count; ++i) {
        const auto texel = static_cast<size_t>(unit_double(hash(1, i)) * count);
        TexelSurface surface(room.scene, room.atlas, room.texels, room.texels.texels[texel]);
        MonteCarloTask task = room.task(i);
        task.samples = 16;
        if (!monte_carlo(task, surface).is_lit) continue;
        add_rays(surface, i, room);
        room.surfaces.push_back(surface);
    }
    if (room.surfaces.empty()) throw Error(ErrorKind::nothing_to_bake, "no texel is lit by the first monitor");
}

std::unique_ptr<Room> prepare(const std::string& file) {
    auto room = std::make_unique<Room>();
    room->scene = read_gltf(file);
    find_monitors(room->scene, {});
    UnwrapSettings settings;
    settings.width = settings.height = 512;
    settings.quality = UvQuality::draft;
    room->atlas = unwrap(room->scene, settings, {});
    room->texels = find_texels(room->scene, room->atlas);
    room->rays = std::make_unique<RayScene>(room->scene);
    room->sampler = std::make_unique<MonitorSampler>(room->scene.monitors[0]);
    draw_texels(*room);
    return room;
}

void count_rays(benchmark::State& state, double rays) {
    using benchmark::Counter;
    state.counters["rays/texel"] = Counter(rays / static_cast<double>(state.iterations()));
    state.counters["s/ray"] = Counter(rays, Counter::kIsRate | Counter::kInvert);
}

/// One iteration is one texel.
void single_rays(benchmark::State& state, const Room& room) {
    size_t texel = 0;
    for ([[maybe_unused]] auto _ : state) {
        for (size_t i = 0; i < rays_per_texel; ++i) {
            const Ray& ray = room.some_rays[texel * rays_per_texel + i];
            benchmark::DoNotOptimize(room.rays->is_occluded(ray.origin, ray.target, 0));
        }
        texel = (texel + 1) % room.surfaces.size();
    }
    count_rays(state, static_cast<double>(state.iterations()) * rays_per_texel);
}

void packets_of_16(benchmark::State& state, const Room& room) {
    const Vec3 center = room.rays->center();
    size_t texel = 0;
    for ([[maybe_unused]] auto _ : state) {
        RayPacket packet;
        for (size_t i = 0; i < rays_per_texel; ++i) {
            const Ray& ray = room.some_rays[texel * rays_per_texel + i];
            packet.add(ray.origin - center, ray.target - center, 1 - 1e-4);
        }
        benchmark::DoNotOptimize(room.rays->occluded(packet, 0));
        texel = (texel + 1) % room.surfaces.size();
    }
    count_rays(state, static_cast<double>(state.iterations()) * rays_per_texel);
}

void run_monte_carlo(benchmark::State& state, const Room& room, int samples, double error) {
    size_t texel = 0, rays = 0;
    for ([[maybe_unused]] auto _ : state) {
        MonteCarloTask task = room.task(texel);
        task.samples = samples;
        task.error = error;
        rays += monte_carlo(task, room.surfaces[texel]).rays;
        texel = (texel + 1) % room.surfaces.size();
    }
    count_rays(state, static_cast<double>(rays));
}

void add_benchmarks(const Room& room) {
    const auto add = [](const std::string& name, auto run) {
        benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMicrosecond);
    };
    add("rays, one by one", [&](benchmark::State& state) { single_rays(state, room); });
    add("rays, packets of 16", [&](benchmark::State& state) { packets_of_16(state, room); });
    for (const int samples : {16, 64, 256, 1024, 4096})
        add("monte_carlo, " + std::to_string(samples) + " samples",
            [&room, samples](benchmark::State& state) { run_monte_carlo(state, room, samples, 0); });
    for (const char* error : {"0.01", "0.004", "0.001"})
        add(std::string("monte_carlo, standard error ") + error,
            [&room, error](benchmark::State& state) { run_monte_carlo(state, room, 0, std::atof(error)); });
}

std::string file_of(int argc, char** argv) {
    if (argc > 1) return argv[1];
    const char* scenes = std::getenv("SURIMI_SCENES");
    if (!scenes) throw Error(ErrorKind::usage, "name a .glb, or set SURIMI_SCENES to the folder of real scenes");
    return std::string(scenes) + "/living-room/living-room.glb";
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    try {
        const auto room = prepare(file_of(argc, argv));
        add_benchmarks(*room);
        benchmark::RunSpecifiedBenchmarks();
    } catch (const std::exception& e) {
        std::fprintf(stderr, "gather_stages: %s\n", e.what());
        return 1;
    }
}
