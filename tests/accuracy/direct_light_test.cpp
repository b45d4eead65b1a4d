// SPDX-License-Identifier: Apache-2.0
// Brute force, the ratio estimator and pictures against closed forms, and shading against brute force.
#include <gtest/gtest.h>

#include "runtime/ltc/cone.h"
#include "runtime/ltc/polygon.h"
#include "runtime/reference/direct_light.h"
#include "runtime/shade/shade.h"
#include "runtime/shade/textured.h"
#include "runtime/visibility/stochastic.h"
#include "tests/support/closed_form.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// A floor, a monitor that stands on it upright behind, and a box between.
struct Stage {
    Scene scene;
    std::vector<VisibilityMap> pages{1};
    explicit Stage(bool has_box = false) {
        test::add_quad(scene, "Floor", {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4});
        test::add_monitor(scene, "Monitor_R", 0, {0, 1, -2}, {1, 0, 0}, {0, 0.6, 0});
        scene.monitors[0].radiance = {3, 2, 1};
        if (has_box) test::add_box(scene, "Box", {0.4, 0.5, -1}, {0.5, 1, 0.1});
    }
    ShadingPoint point(const Vec3& position, const Vec3& eye, double roughness) const {
        ShadingPoint p;
        p.at.position = position;
        p.at.normal = p.at.geometric_normal = p.normal = {0, 1, 0};
        p.view = normalize_or(eye - position, {0, 1, 0});
        p.roughness = roughness;
        p.diffuse_albedo = {0.5, 0.5, 0.5};
        return p;
    }
};

LitMonitor plain(const Scene& scene) {
    return {scene.monitors[0].radiance, std::nullopt};
}

/// Mean of independent estimates, and its standard error.
struct Mean {
    double sum = 0, squares = 0;
    int count = 0;
    void add(double x) { sum += x, squares += x * x, ++count; }
    double mean() const { return sum / count; }
    double error() const { return std::sqrt(std::max(0.0, squares / count - mean() * mean()) / (count - 1)); }
};

TEST(DirectLight, DiffusePartIsLambertsIrradiance_M31) {
    const Stage stage;
    const RayScene rays(stage.scene);
    const MonitorSampler sampler(stage.scene.monitors[0]);
    const ShadingPoint point = stage.point({0.3, 0, 0.2}, {0, 1, 2}, 0.4);
    const double e =
        irradiance_of_polygon<double>(stage.scene.monitors[0].panels[0].corners, point.at.position, point.normal);
    Mean estimates;
    for (uint64_t key = 0; key < 64; ++key)
        estimates.add(direct_light(stage.scene, rays, 0, plain(stage.scene), sampler, point, 64, false, key)
                          .unshadowed.diffuse.x);
    const double expected = 3 * brdf_at(point).diffuse_albedo.x * e / pi;
    EXPECT_NEAR(estimates.mean(), expected, 4 * estimates.error());
    EXPECT_LT(estimates.error(), 5e-3 * expected);
}

TEST(DirectLight, SpecularPartIsTheBrdfIntegrated_M31) {
    const Stage stage;
    const RayScene rays(stage.scene);
    const Monitor& monitor = stage.scene.monitors[0];
    const MonitorSampler sampler(monitor);
    for (const double roughness : {0.05, 0.2, 0.6}) {
        const ShadingPoint point = stage.point({0.3, 0, 0.2}, {0.1, 1, 2.2}, roughness);
        const Brdf brdf = brdf_at(point);
        // Midpoints over the monitor.
        double expected = 0;
        constexpr int n = 1500;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const LightPoint to = sampler.sample((i + 0.5) / n, (j + 0.5) / n);
                const Vec3 offset = to.position - point.at.position;
                const double r2 = glm::dot(offset, offset);
                const Vec3 direction = offset / std::sqrt(r2);
                expected += reflectance(brdf, direction).specular.x * -glm::dot(direction, to.normal) / r2;
            }
        expected *= 3 * sampler.area() / (n * n);
        Mean estimates;
        for (uint64_t key = 0; key < 64; ++key)
            estimates.add(direct_light(stage.scene, rays, 0, plain(stage.scene), sampler, point, 64, false, key)
                              .unshadowed.specular.x);
        EXPECT_NEAR(estimates.mean(), expected, 4 * estimates.error() + 1e-4 * expected) << roughness;
        EXPECT_LT(estimates.error(), 0.02 * expected) << roughness;
    }
}

TEST(DirectLight, ShadowsMatchTheExactSplit_M31) {
    const Stage stage(true);
    const RayScene rays(stage.scene);
    const MonitorSampler sampler(stage.scene.monitors[0]);
    ShadingPoint point = stage.point({0.3, 0, 0.2}, {0, 1, 2}, 1);
    point.f0 = Vec3(0);
    test::Occluder box;
    for (const double x : {0.15, 0.65})
        for (const double y : {0.0, 1.0})
            for (const double z : {-1.05, -0.95}) box.points.push_back({x, y, z});
    const double v =
        test::exact_visibility(stage.scene.monitors[0].panels[0], point.at.position, point.normal, std::span(&box, 1));
    ASSERT_GT(v, 0.1);
    ASSERT_LT(v, 0.9);
    Mean shadowed, unshadowed;
    for (uint64_t key = 0; key < 64; ++key) {
        const DirectLight light = direct_light(stage.scene, rays, 0, plain(stage.scene), sampler, point, 64, true, key);
        shadowed.add(light.shadowed.diffuse.x);
        unshadowed.add(light.unshadowed.diffuse.x);
    }
    EXPECT_NEAR(shadowed.mean() / unshadowed.mean(), v, 5 * shadowed.error() / unshadowed.mean());
    // The ratio estimator converges to the same, for each colour, and is exact without occlusion.
    const Vec3 ratio = stochastic_visibility(stage.scene, rays, 0, plain(stage.scene), sampler, point, 4096);
    EXPECT_NEAR(ratio.x, v, 0.01);
    EXPECT_NEAR(ratio.x, ratio.z, 1e-12);
}

TEST(StochasticVisibility, IsExactWhereEverythingAgrees_M32) {
    const Stage stage;
    const RayScene rays(stage.scene);
    const MonitorSampler sampler(stage.scene.monitors[0]);
    const ShadingPoint lit = stage.point({0.3, 0, 0.2}, {0, 1, 2}, 0.3);
    EXPECT_EQ(stochastic_visibility(stage.scene, rays, 0, plain(stage.scene), sampler, lit, 4), Vec3(1));
    Stage wall;
    test::add_box(wall.scene, "Wall", {0, 1, -1}, {6, 3, 0.1});
    const RayScene wall_rays(wall.scene);
    EXPECT_EQ(stochastic_visibility(wall.scene, wall_rays, 0, plain(wall.scene), sampler, lit, 4), Vec3(0));
    const ShadingPoint behind = stage.point({0.3, 0, -3}, {0, 1, 2}, 0.3);
    EXPECT_EQ(stochastic_visibility(stage.scene, rays, 0, plain(stage.scene), sampler, behind, 4), Vec3(1));
}

/// A picture of soft blobs and one hard edge.
Image<Vec3f> test_picture(int size) {
    Image<Vec3f> image(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = (x + 0.5) / size, v = (y + 0.5) / size;
            image.at(x, y) = Vec3f(u > 0.6 ? 1 : 0.1, 0.5 + 0.5 * std::sin(9 * u) * std::sin(7 * v), v);
        }
    return image;
}

/// Mean of the picture over a panel as a lobe sees it, exactly: the picture in n x n pieces of one colour each.
Vec3 exact_picture(const MonitorPicture& picture, const Polygon& panel, const Vec3& point, const Mat3& to_cosine,
                   int n) {
    const std::vector<Vec3>& c = panel.corners;
    Vec3 sum(0);
    double total = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const auto at = [&](double u, double v) {
                return to_cosine * (c[0] + u * (c[1] - c[0]) + v * (c[3] - c[0]) - point);
            };
            const double u0 = static_cast<double>(i) / n, v0 = static_cast<double>(j) / n, d = 1.0 / n;
            const std::vector<Vec3> piece = {at(u0, v0), at(u0 + d, v0), at(u0 + d, v0 + d), at(u0, v0 + d)};
            const double share = irradiance_of_polygon<double>(piece, Vec3(0), {0, 0, 1}, true);
            const Vec3 middle = c[0] + (u0 + d / 2) * (c[1] - c[0]) + (v0 + d / 2) * (c[3] - c[0]);
            sum += share * picture_at(picture, 0, middle);
            total += share;
        }
    return sum / total;
}

TEST(Picture, SeenThroughALobeIsNearTheExactMean_M33) {
    const Stage stage;
    const Monitor& monitor = stage.scene.monitors[0];
    const MonitorPicture picture{blurred_levels(test_picture(128)), upright_mappings(monitor)};
    Random random{33};
    double squares = 0, worst = 0;
    int count = 0;
    for (int k = 0; k < 60; ++k) {
        const Vec3 point(2 * random.next() - 1, 0, 2.5 * random.next() - 1.9);
        const Vec3 n = normalize_or({random.next() - 0.5, 1, -random.next()}, {0, 1, 0});
        Mat3 lobe = glm::transpose(frame_around(n));
        if (k % 2 == 1) lobe = Mat3(1.0 / 0.3, 0, 0, 0, 1.0 / 0.3, 0, 0, 0, 1) * lobe;  // narrower
        const Vec3 exact = exact_picture(picture, monitor.panels[0], point, lobe, 96);
        Vec3 seen(0);
        double total = 0;
        for (const LightPiece& piece : pieces_of(monitor, 4)) {
            std::vector<Vec3> corners;
            for (const Vec3& corner : piece.corners) corners.push_back(lobe * (corner - point));
            const double share = irradiance_of_polygon<double>(corners, Vec3(0), {0, 0, 1}, true);
            seen += share * picture_seen(picture, 0, piece.corners, point, lobe);
            total += share;
        }
        seen /= total;
        ASSERT_TRUE(is_finite(seen));
        for (int c = 0; c < 3; ++c) {
            squares += (seen[c] - exact[c]) * (seen[c] - exact[c]);
            worst = std::max(worst, std::abs(seen[c] - exact[c]));
            ++count;
        }
    }
    RecordProperty("rms", std::to_string(std::sqrt(squares / count)));
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LT(std::sqrt(squares / count), 0.01);  // the colours vary by 0.14
    EXPECT_LT(worst, 0.05);
}

TEST(Picture, OfOneColourIsThatColour_M33) {
    const Stage stage;
    const Monitor& monitor = stage.scene.monitors[0];
    const MonitorPicture picture{blurred_levels(Image<Vec3f>(37, 21, Vec3f(0.25f, 0.5f, 1))),
                                 upright_mappings(monitor)};
    for (const double z : {-1.9999, -1.0, 3.0, 300.0}) {
        const Mat3 frame = glm::transpose(frame_around(Vec3(0, 1, 0)));
        const Vec3 seen = picture_seen(picture, 0, monitor.panels[0].corners, {0.2, 0, z}, frame);
        EXPECT_NEAR(glm::length(seen - Vec3(0.25, 0.5, 1)), 0, 1e-5) << z;
    }
}

}  // namespace
}  // namespace surimi
