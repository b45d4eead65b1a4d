// SPDX-License-Identifier: Apache-2.0
#include "tests/support/room_survey.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/random.h"
#include "runtime/scene/texture.h"
#include "tests/support/map_judge.h"
#include "tests/support/point_rays.h"
#include "tests/support/random.h"

namespace surimi::test {
namespace {

/// Evenly over a list of triangles by their area.
class AreaSampler {
  public:
    explicit AreaSampler(const Scene& scene) {
        for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
            const Surface& surface = scene.surfaces[s];
            if (surface.monitor >= 0 || !surface.receives) continue;
            for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
                const auto& [a, b, c] = surface.triangles[t];
                sum_ += glm::length(area_normal(surface.positions[a], surface.positions[b], surface.positions[c]));
                triangles_.push_back({s, t});
                sums_.push_back(sum_);
            }
        }
    }
    SurfacePoint sample(const Scene& scene, Random& random) const {
        const auto found = std::lower_bound(sums_.begin(), sums_.end(), random.next() * sum_) - sums_.begin();
        const auto i = std::min(static_cast<size_t>(found), triangles_.size() - 1);
        const double root = std::sqrt(random.next()), r = random.next();
        return surface_point(scene, triangles_[i], {1 - root, root * (1 - r), root * r});
    }

  private:
    std::vector<TriangleRef> triangles_;
    std::vector<double> sums_;
    double sum_ = 0;
};

bool is_thin(const Scene& scene, const Surface& surface) {
    return is_cutout(scene, surface) || material_of(scene, surface).double_sided;
}

}  // namespace

double form_factor(const Scene& scene, size_t monitor, const SurfacePoint& point) {
    double sum = 0;
    for (const Polygon& panel : scene.monitors[monitor].panels) {
        const Vec3 normal = front_normal(panel);
        for (size_t c = 1; c + 1 < panel.corners.size(); ++c) {
            const Vec3 &a = panel.corners[0], u = panel.corners[c] - a, v = panel.corners[c + 1] - a;
            for (int i = 0; i < 64; ++i) {
                const double root = std::sqrt((i % 8 + 0.5) / 8), r = (i / 8 + 0.5) / 8;
                const Vec3 d = a + root * (1 - r) * u + root * r * v - point.position;
                const double square = glm::dot(d, d), height = -glm::dot(d, normal);
                const double emitted = scene.monitors[monitor].two_sided ? std::abs(height) : std::max(height, 0.0);
                const double cosine = std::max(glm::dot(d, point.normal), 0.0);
                if (square > 0) sum += emitted * cosine / (square * square) * glm::length(glm::cross(u, v)) / 128;
            }
        }
    }
    return sum / pi;
}

Obstructed panels_alone(const Scene& scene, const RayScene& rays, size_t monitor) {
    Obstructed result;
    result.center = rays.center();
    result.is_two_sided = scene.monitors[monitor].two_sided;
    for (const Polygon& polygon : scene.monitors[monitor].panels) {
        Obstructed::Panel& panel = result.panels.emplace_back();
        for (const Vec3& corner : polygon.corners) panel.corners.push_back(corner - rays.center());
        panel.normal = front_normal(polygon);
        double diameter = 0, size = 0;
        for (const Vec3& corner : panel.corners) {
            panel.center += corner / static_cast<double>(panel.corners.size());
            diameter = std::max(diameter, glm::length(corner - panel.corners[0]));
            size = std::max(size, largest_component(corner));
        }
        panel.clearance = 1e-4 * diameter + 0x1p-18 * size;  // and the rounding of floats
    }
    return result;
}

bool is_enclosed(const Scene& scene, const RayScene& rays, const SurfacePoint& point) {
    constexpr uint32_t count = 64;
    const Vec3 n = point.geometric_normal;
    const Vec3 u = normalize_or(glm::cross(n, std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)), {1, 0, 0});
    const Vec3 origin = rays.ray_origin(point);
    uint32_t behind = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const auto r = scrambled(sobol::point(i), scrambling(11));
        const double height = 0.02 + 0.98 * r[0], radius = std::sqrt(1 - height * height), angle = 2 * pi * r[1];
        const Vec3 d = height * n + radius * (std::cos(angle) * u + std::sin(angle) * glm::cross(n, u));
        const auto hit = rays.closest_hit(origin, d);
        if (!hit || hit->is_front || hit->triangle.surface >= scene.surfaces.size()) continue;
        behind += !is_thin(scene, scene.surfaces[hit->triangle.surface]);
    }
    return 2 * behind > count;
}

std::vector<RoomPoint> survey_room(const Scene& scene, const RayScene& rays, size_t monitor,
                                   const SurveySettings& settings) {
    constexpr double least_light = 1e-5;  // as the external oracle counts
    const AreaSampler sampler(scene);
    const Obstructed panels = panels_alone(scene, rays, monitor);
    std::vector<RoomPoint> points(settings.points);
    parallel_for(points.size(), 16, [&](size_t i) {
        Random random{hash(settings.seed, i)};
        RoomPoint& point = points[i];
        point.point = sampler.sample(scene, random);
        point.light = form_factor(scene, monitor, point.point);
        if (point.light < least_light) return;
        point.truth = visibility_by_rays(scene, rays, panels, monitor, point.point, settings.rays).visibility;
        point.is_enclosed = is_enclosed(scene, rays, point.point);
    });
    std::erase_if(points, [](const RoomPoint& point) { return point.light < least_light; });
    return points;
}

void read_values(const Bake& bake, int channel, std::vector<RoomPoint>& points) {
    for (RoomPoint& point : points)
        point.value = read_map(bake, point.point.triangle, point.point.barycentric, channel);
}

SurveyResult judge(const std::vector<RoomPoint>& points, bool is_all) {
    SurveyResult result;
    std::vector<double> errors;
    for (const RoomPoint& point : points) {
        if (point.is_enclosed && !is_all) continue;
        const double error = std::abs(point.value - point.truth);
        errors.push_back(error);
        result.mean += error;
        result.rmse += error * error;
        if (point.truth > 0.05 && point.truth < 0.95) continue;
        ++result.plain;
        result.leaks += point.truth <= 0.05 && point.value > 0.5;
        result.shadows += point.truth >= 0.95 && point.value < 0.5;
        result.tenths += error > 0.1;
    }
    if (errors.empty()) return result;
    std::sort(errors.begin(), errors.end());
    const auto count = static_cast<double>(errors.size());
    result.points = errors.size();
    result.mean /= count;
    result.rmse = std::sqrt(result.rmse / count);
    result.p99 = errors[static_cast<size_t>(0.99 * (count - 1))];
    result.largest = errors.back();
    return result;
}

std::vector<RoomPoint> worst_of(std::vector<RoomPoint> points, size_t count, double apart) {
    std::erase_if(points, [](const RoomPoint& point) { return point.is_enclosed; });
    const auto weight = [](const RoomPoint& p) { return std::abs(p.value - p.truth) * std::sqrt(p.light); };
    std::stable_sort(points.begin(), points.end(),
                     [&](const RoomPoint& a, const RoomPoint& b) { return weight(a) > weight(b); });
    std::vector<RoomPoint> worst;
    for (const RoomPoint& point : points) {
        if (worst.size() == count) break;
        const auto is_near = [&](const RoomPoint& other) {
            return glm::length(other.point.position - point.point.position) < apart;
        };
        if (std::none_of(worst.begin(), worst.end(), is_near)) worst.push_back(point);
    }
    return worst;
}

}  // namespace surimi::test
