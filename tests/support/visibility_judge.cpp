// SPDX-License-Identifier: Apache-2.0
#include "tests/support/visibility_judge.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace surimi::test {

double visibility_of(const IrradianceEstimate& estimate) {
    return estimate.unshadowed > 0 ? static_cast<double>(estimate.shadowed) / static_cast<double>(estimate.unshadowed)
                                   : 0;
}

VisibilityJudge::VisibilityJudge(Scene scene)
    : scene_(std::move(scene)), rays_(scene_), silhouettes_(find_silhouettes(scene_, rays_)) {
    for (size_t m = 0; m < scene_.monitors.size(); ++m) obstructed_.push_back(obstructed(scene_, rays_, m));
}

SubtractedIrradiance VisibilityJudge::truth(const SurfacePoint& point, size_t monitor) const {
    return subtract_triangles(obstructed_[monitor], rays_, point);
}

double VisibilityJudge::split(const SurfacePoint& point, size_t monitor) const {
    GatherSettings settings;
    settings.is_exact = true;
    return visibility_of(irradiance_at(scene_, rays_, silhouettes_, monitor, point, settings));
}

double VisibilityJudge::scanline(const SurfacePoint& point, double error, size_t monitor) const {
    GatherSettings settings;
    settings.method = Method::scanline;
    settings.error = error;
    return visibility_of(irradiance_at(scene_, rays_, silhouettes_, monitor, point, settings));
}

bool VisibilityJudge::is_ambiguous(const SurfacePoint& point) const {
    const Vec3 origin = rays_.ray_origin(point) - rays_.center();
    const double lift = glm::distance(origin, point.position - rays_.center());
    return std::ranges::any_of(obstructed_[0].triangles, [&](const std::array<Vec3, 3>& t) {
        const Vec3 normal = normalize_or(area_normal(t[0], t[1], t[2]), Vec3(0));
        if (normal == Vec3(0) || std::abs(glm::dot(normal, origin - t[0])) > 0.5 * lift) return false;
        for (size_t k = 0; k < 3; ++k) {
            const Vec3 inwards = normalize_or(glm::cross(normal, t[(k + 1) % 3] - t[k]), Vec3(0));
            if (glm::dot(inwards, origin - t[k]) < -2 * lift) return false;
        }
        return true;
    });
}

Vec3 VisibilityJudge::seen(const Vec3& vertex) const {
    return Vec3(Vec3f(vertex - rays_.center())) + rays_.center();
}

SurfacePoint VisibilityJudge::point_below(uint32_t surface, const Vec3& origin) const {
    SurfacePoint point = surface_point(scene_, {surface, 0}, Vec3(1.0 / 3));
    point.position = origin;
    for (int step = 0; step < 3; ++step) point.position += origin - rays_.ray_origin(point);
    return point;
}

SurfacePoint random_point(const Scene& scene, Choice& choice, double tilt) {
    const auto below = [&](size_t count) {
        return std::min(static_cast<size_t>(choice.random.next() * static_cast<double>(count)), count - 1);
    };
    size_t surface = 0;
    do surface = below(scene.surfaces.size());
    while (scene.surfaces[surface].monitor >= 0 || scene.surfaces[surface].triangles.empty());
    const TriangleRef where{static_cast<uint32_t>(surface),
                            static_cast<uint32_t>(below(scene.surfaces[surface].triangles.size()))};
    const double u = std::sqrt(choice.random.next()), v = choice.random.next();
    SurfacePoint point = surface_point(scene, where, {1 - u, u * (1 - v), u * v});
    point.normal = normalize_or(point.geometric_normal + 0.9 * tilt * choice.vector(), point.geometric_normal);
    return point;
}

void Deviations::add(double value, double truth, const SurfacePoint& where) {
    const double error = std::isfinite(value) ? std::abs(value - truth) : INFINITY;
    if (error > most_) {
        std::ostringstream text;
        text << "worst: " << value << " for " << truth << " on surface " << where.triangle.surface << " at ("
             << where.position.x << ", " << where.position.y << ", " << where.position.z << ")";
        worst = text.str();
    }
    most_ = std::max(most_, error);
    errors.push_back(error);
    penumbra += truth > 1e-6 && truth < 1 - 1e-6;
}

double Deviations::rmse() const {
    double sum = 0;
    for (const double error : errors) sum += error * error;
    return errors.empty() ? 0 : std::sqrt(sum / static_cast<double>(errors.size()));
}

double Deviations::largest() const {
    return most_;
}

double Deviations::quantile(double share) const {
    if (errors.empty()) return 0;
    std::vector<double> sorted = errors;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace surimi::test
