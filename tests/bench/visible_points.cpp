// SPDX-License-Identifier: Apache-2.0
// Which of an independent oracle's points can be seen, and which lie inside other geometry (M65):
// `visible_points BAKED.glb SIZE <points.csv` prints 1 or 0 a line. SIZE is the map's width, for the size of a texel;
// the points are those of `ORACLE points BAKED.glb ..`: node, triangle, b1, b2, position, normal, ..
#include <array>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "baker/gather/enclosure.h"
#include "runtime/base/error.h"
#include "runtime/scene/gltf.h"
#include "runtime/scene/monitors.h"
#include "runtime/scene/roles.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {
namespace {

struct OraclePoint {
    int node = 0;
    Vec3 barycentric{1, 0, 0};
    Vec3 position{0};
};

OraclePoint read_point(const std::string& line) {
    std::array<double, 7> number{};
    std::istringstream words(line);
    std::string word;
    for (double& n : number) {
        char* end = nullptr;
        if (std::getline(words, word, ',')) n = std::strtod(word.c_str(), &end);
        if (!end || end == word.c_str()) throw Error(ErrorKind::usage, "no point of the oracle: " + line);
    }
    return {static_cast<int>(number[0]),
            {1 - number[2] - number[3], number[2], number[3]},
            {number[4], number[5], number[6]}};
}

struct Place {
    TriangleRef triangle;
    Vec3 barycentric{1, 0, 0};
    double distance = INFINITY;
};

/// The triangle on which the point lies: the one of its node where its barycentric coordinates, in some order of the
/// corners (mirrored nodes turn them round), give its position best.
Place find_place(const Scene& scene, const RayScene& rays, const OraclePoint& point) {
    constexpr std::array<std::array<int, 3>, 6> orders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    const double radius = 1e-4 * (1 + glm::length(point.position - rays.center()));
    std::vector<TriangleRef> near;
    rays.find_triangles_near(point.position - rays.center(), radius, near);
    Place best;
    for (const TriangleRef& triangle : near) {
        if (triangle.surface >= scene.surfaces.size() || scene.surfaces[triangle.surface].node != point.node) continue;
        for (const auto& order : orders) {
            const Vec3 barycentric(point.barycentric[order[0]], point.barycentric[order[1]],
                                   point.barycentric[order[2]]);
            const Vec3 found = surface_point(scene, triangle, barycentric).position;
            const double distance = glm::length(found - point.position);
            if (distance < best.distance) best = {triangle, barycentric, distance};
        }
    }
    if (!(best.distance < radius))
        throw Error(ErrorKind::usage, "a point on no triangle of its node; give the file that the oracle was given");
    return best;
}

/// Metres, by the area that a triangle has in the world and on the map.
double texel_size(const Surface& surface, uint32_t triangle, int size) {
    if (surface.uv_sets.size() < 2) throw Error(ErrorKind::usage, surface.name + " has no TEXCOORD_1: bake first");
    const auto& [a, b, c] = surface.triangles[triangle];
    const std::vector<Vec2>& uv = surface.uv_sets[1];
    const Vec2 u = uv[b] - uv[a], v = uv[c] - uv[a];
    const double on_map = std::abs(u.x * v.y - u.y * v.x) * size * size;
    const double in_world = glm::length(area_normal(surface.positions[a], surface.positions[b], surface.positions[c]));
    return on_map > 0 ? std::sqrt(in_world / on_map) : 0;
}

void run(const std::string& file, int size) {
    Scene scene = read_gltf(file);
    apply_roles(scene, {});
    find_monitors(scene, {});
    const RayScene casters(scene), all(scene, Attach::everything);
    const EnclosureJudge judge(scene, casters);
    std::string line;
    for (uint64_t key = 1; std::getline(std::cin, line); ++key) {
        const Place place = find_place(scene, all, read_point(line));
        const SurfacePoint point = surface_point(scene, place.triangle, place.barycentric);
        const double texel = texel_size(scene.surfaces[place.triangle.surface], place.triangle.triangle, size);
        // As in a bake: where nothing can be judged nothing is inside.
        const bool is_inside = judge.is_reliable() && judge.judge(point, texel, key) == Enclosure::enclosed;
        std::printf("%d\n", is_inside ? 0 : 1);
    }
}

}  // namespace
}  // namespace surimi

int main(int argc, char** argv) {
    try {
        if (argc != 3)
            throw surimi::Error(surimi::ErrorKind::usage, "usage: visible_points BAKED.glb SIZE <points.csv");
        surimi::run(argv[1], std::atoi(argv[2]));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
    return 0;
}
