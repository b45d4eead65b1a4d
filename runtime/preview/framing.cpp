// SPDX-License-Identifier: Apache-2.0
// The choice of a view when nobody made one.
#include <algorithm>
#include <vector>

#include "runtime/light/sample.h"
#include "runtime/preview/see.h"

namespace surimi {
namespace {

constexpr double framing_yfov = 1.0;  // radians, a wide angle, since rooms are narrow

/// Eyes in front of a monitor, most of the free way out in several directions, looking back at it or past it.
void add_candidates(const RayScene& rays, const Monitor& monitor, double size, std::vector<View>& candidates) {
    const LightPoint middle = MonitorSampler(monitor).sample(0.5, 0.5);
    const Vec3 side = normalize_or(glm::cross(Vec3(0, 1, 0), middle.normal), {1, 0, 0});
    const Vec3 up = glm::cross(middle.normal, side);
    const Vec3 start = middle.position + 1e-3 * size * middle.normal;
    for (const double turn : {-0.9, -0.55, -0.25, 0.0, 0.25, 0.55, 0.9}) {
        for (const double lift : {-0.1, 0.15, 0.4}) {
            const Vec3 direction = normalize_or(middle.normal + turn * side + lift * up, middle.normal);
            const auto hit = rays.closest_hit(start, direction);
            const double free_way = std::min(hit ? hit->distance : 4 * size, 8 * size);
            for (const double share : {0.5, 0.9}) {
                const Vec3 eye = start + share * free_way * direction;
                candidates.push_back(look_at(eye, middle.position - 0.25 * size * up, framing_yfov));
                candidates.push_back(
                    look_at(eye, middle.position + free_way * middle.normal - 0.5 * size * up, framing_yfov));
                candidates.push_back(look_at(eye, eye - turn * side * free_way - 0.3 * size * up, framing_yfov));
            }
        }
    }
}

/// How much a tiny picture shows: lit surface in many shades, a monitor, nothing nearer than `near_distance` metres.
double score(const Lighting& lighting, const View& view, double aspect, double near_distance) {
    constexpr int width = 48, height = 27;
    double lit = 0, glowing = 0, near = 0;
    std::vector<SeenPoint> points;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Vec3 direction = ray_direction(view, (x + 0.5) / width, (y + 0.5) / height, aspect);
            const Seen seen = see(lighting, view.eye, direction, Show::lit, 0, 0, points);
            if (seen.distance < near_distance) near += 1;
            if (!seen.is_surface && seen.color != Vec3(0)) glowing += 1;
        }
    }
    std::vector<ShadingPoint> opaque;  // what takes most of a ray
    for (const SeenPoint& seen : points)
        if (seen.weight > 0.5) opaque.push_back(seen.point);
    std::vector<Parts> reflected(opaque.size());
    std::vector<MonitorCounts> counts(lighting.scene.monitors.size());
    shade(lighting, opaque, reflected, counts);
    std::vector<double> levels;  // stops
    for (const Parts& parts : reflected) {
        const double level = luminance(parts.sum());
        if (level > 0) lit += 1, levels.push_back(std::log2(level));
    }
    std::sort(levels.begin(), levels.end());
    const double pixels = width * height;
    // Four stops between dark and bright are a well-modelled picture; more adds nothing.
    const double spread = levels.empty() ? 0 : levels[levels.size() * 9 / 10] - levels[levels.size() / 10];
    const double monitor = glowing > 0 ? 0.2 + 2 * std::min(glowing / pixels, 0.12) : 0;
    return lit / pixels + 0.15 * std::min(spread, 4.0) + monitor - 1.5 * near / pixels;
}

}  // namespace

View frame_automatically(const Lighting& lighting, double aspect) {
    const Scene& scene = lighting.scene;
    std::vector<View> candidates;
    double size = 0;
    for (const Monitor& monitor : scene.monitors) {
        const double own_size = std::sqrt(area(monitor));
        size = std::max(size, own_size);
        add_candidates(lighting.rays, monitor, own_size, candidates);
    }
    const Bounds box = bounds(scene);
    if (candidates.empty()) {  // no monitor: the whole scene from outside
        const Vec3 center = 0.5 * (box.low + box.high);
        return look_at(center + glm::length(box.high - box.low) * Vec3(0.6, 0.5, 0.8), center, framing_yfov);
    }
    // What is nearer than a tenth of the room hides it; a ground plane that dwarfs the room must not set that scale.
    const double near_distance = std::min(0.1 * glm::length(box.high - box.low), size);
    // The same view however it is shaded then; and by brute force hundreds of pictures would take minutes.
    const Lighting quick(scene, lighting.pages, lighting.rays, lighting.lights, {});
    std::vector<double> scores(candidates.size());
    parallel_for(candidates.size(), 1,
                 [&](size_t i) { scores[i] = score(quick, candidates[i], aspect, near_distance); });
    return candidates[static_cast<size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin())];
}

}  // namespace surimi
