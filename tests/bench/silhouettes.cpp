// SPDX-License-Identifier: Apache-2.0
// Prints as Markdown how long it takes to find a scene's silhouette edges, what they occupy, and what a block's query
// costs. Usage: silhouettes [FILE.glb ...]
#include "baker/gather/silhouettes.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <random>

#include "runtime/scene/gltf.h"
#include "tests/support/meshes.h"

namespace {

using namespace surimi;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of all threads: what a busy machine does not change.
double processor_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

size_t bytes_of(const Silhouettes& silhouettes) {
    size_t bytes = silhouettes.edges.capacity() * sizeof(Edge) + silhouettes.nodes.capacity() * sizeof(EdgeNode) +
                   silhouettes.planes.capacity() * sizeof(FacePlane);
    for (const auto& planes : silhouettes.plane_of) bytes += planes.capacity() * sizeof(uint32_t);
    return bytes;
}

struct Queries {
    double shaft = 0, query = 0, found = 0;  ///< microseconds, microseconds, edges; means
};

/// From flat blocks of 16 cm on the lowest eighth of the scene to a panel of 1.6 x 0.9 m at its upper end.
Queries time_queries(const Silhouettes& silhouettes, const Scene& scene) {
    constexpr int count = 2000;
    const Bounds box = bounds(scene);
    const Vec3 low = box.low - silhouettes.center, high = box.high - silhouettes.center, size = high - low;
    const double scale = std::max({size.x, size.y, size.z});
    const Vec3 at(0, low.y + 0.6 * size.y, low.z);
    const std::vector<Vec3> panel = {at + Vec3(-0.8, 0, 0), at + Vec3(0.8, 0, 0), at + Vec3(0.8, 0.9, 0),
                                     at + Vec3(-0.8, 0.9, 0)};
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0.05, 0.95);
    std::vector<Shaft> shafts;
    Queries result;
    for (int i = 0; i < count; ++i) {
        const double x = share(random), z = share(random), y = share(random);
        const Vec3 p = low + size * Vec3(x, 0.125 * y, z), u(0.16, 0, 0), v(0, 0, 0.16);
        const std::vector<Vec3> block = {p, p + u, p + v, p + u + v};
        const double start = now();
        shafts.push_back(make_shaft(block, panel, scale));
        result.shaft += (now() - start) / count * 1e6;
    }
    std::vector<uint32_t> found;
    const double start = now();
    for (const Shaft& shaft : shafts) {
        find_candidates(silhouettes, shaft, 0, found);
        result.found += static_cast<double>(found.size()) / count;
    }
    result.query = (now() - start) / count * 1e6;
    return result;
}

void print_row(const char* name, const Scene& scene) {
    const RayScene rays(scene);
    const double peak_before = peak_megabytes(), start = now(), processor_start = processor_seconds();
    const Silhouettes silhouettes = find_silhouettes(scene, rays);
    const double seconds = now() - start, processor = processor_seconds() - processor_start;
    const double grown = peak_megabytes() - peak_before;
    const Queries queries = time_queries(silhouettes, scene);
    std::printf("| %s | %zu | %zu | %zu | %.2f | %.2f | %.1f | %.0f | %.1f | %.1f | %.0f |\n", name,
                triangle_count(scene), silhouettes.edges.size(), silhouettes.planes.size(), seconds, processor,
                static_cast<double>(bytes_of(silhouettes)) / static_cast<double>(silhouettes.edges.size()), grown,
                queries.shaft, queries.query, queries.found);
    std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
    std::printf(
        "| scene | triangles | edges | planes | seconds | processor seconds | bytes/edge | peak grown by, MB | "
        "us/shaft | us/query |"
        " candidates |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 1; i < count; ++i) print_row(arguments[i], read_gltf(arguments[i]));
    if (count > 1) return 0;
    print_row("foliage", test::scene_of({test::foliage(50000)}));
    print_row("sphere", test::scene_of({test::ico_sphere(8)}));
    print_row("terrain", test::scene_of({test::terrain(836)}));
}
