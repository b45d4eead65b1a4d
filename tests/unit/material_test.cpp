// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "runtime/material/brdf.h"
#include "runtime/material/emission.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

constexpr double half_code = 0.5 / 255;  // of 8-bit textures

SurfacePoint first_triangle_point(const Scene& scene) {
    return surface_point(scene, {0, 0}, {0.2, 0.3, 0.5});
}

/// A quad in the plane y = 0, facing up, u along x, v along z: an upright picture seen from above with -z at its top.
Scene floor_scene() {
    Scene scene;
    test::add_quad(scene, "Floor", {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    scene.surfaces[0].uv_sets = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    scene.surfaces[0].material = 0;
    scene.materials.emplace_back();
    return scene;
}

void add_image(Scene& scene, TextureUse& use, const glm::u8vec4& color) {
    use.image = static_cast<int>(scene.images.size());
    scene.images.emplace_back(2, 2, color);
}

TEST(ShadingPoint, ReadsRoughnessFromGreenAndMetallicFromBlue) {
    Scene scene = floor_scene();
    Material& material = scene.materials[0];
    material.roughness = 0.5;
    add_image(scene, material.metallic_roughness_texture, {255, 128, 64, 255});
    material.base_color = {0.8, 0.4, 0.2, 1};
    const ShadingPoint point = shading_point(scene, first_triangle_point(scene), {0, 1, 0});
    const double metallic = 64 / 255.0;
    EXPECT_NEAR(point.roughness, 0.5 * 128 / 255, 1e-12);
    EXPECT_NEAR(point.f0.x, 0.04 * (1 - metallic) + 0.8 * metallic, 1e-12);
    EXPECT_NEAR(point.diffuse_albedo.y, 0.4 * (1 - metallic), 1e-12);
}

TEST(ShadingPoint, ColorTexturesAreLinearisedBeforeTheyAreFiltered) {
    Scene scene = floor_scene();
    Material& material = scene.materials[0];
    material.metallic = 0;
    add_image(scene, material.base_color_texture, {0, 0, 0, 255});
    scene.images[0].at(0, 0) = scene.images[0].at(0, 1) = {255, 255, 255, 255};
    const ShadingPoint middle = shading_point(scene, surface_point(scene, {0, 0}, {0.25, 0.5, 0.25}), {0, 1, 0});
    EXPECT_NEAR(surface_point(scene, {0, 0}, {0.25, 0.5, 0.25}).position.x, 0.5, 1e-12);
    const ShadingPoint center = shading_point(scene, surface_point(scene, {0, 0}, {0.5, 0, 0.5}), {0, 1, 0});
    EXPECT_NEAR(center.diffuse_albedo.x, 0.5, 1e-12);  // half black, half white
    EXPECT_NEAR(middle.diffuse_albedo.x, 0, 1e-12);
}

TEST(ShadingPoint, NormalMapsLeanToTheRightAndUpThePicture) {
    Scene scene = floor_scene();
    Material& material = scene.materials[0];
    const double tilt = std::sqrt(0.5);
    const auto code = [](double x) { return static_cast<uint8_t>(std::lround(127.5 * (x + 1))); };
    const SurfacePoint at = first_triangle_point(scene);
    add_image(scene, material.normal_texture, {code(tilt), 128, code(tilt), 255});
    Vec3 normal = shading_point(scene, at, {0, 1, 0}).normal;
    EXPECT_NEAR(glm::length(normal - Vec3(tilt, tilt, 0)), 0, 4 * half_code);
    scene.images[0] = Image<glm::u8vec4>(1, 1, {128, code(tilt), code(tilt), 255});
    normal = shading_point(scene, at, {0, 1, 0}).normal;
    EXPECT_NEAR(glm::length(normal - Vec3(0, tilt, -tilt)), 0, 4 * half_code);  // the picture's top is at -z
    SurfacePoint behind = at;                                                   // all of the mapped normal turns
    behind.normal = -at.normal, behind.geometric_normal = -at.geometric_normal;
    EXPECT_NEAR(glm::length(shading_point(scene, behind, {0, -1, 0}).normal + normal), 0, 1e-12);
    for (auto& uv : scene.surfaces[0].uv_sets[0]) uv.x = 1 - uv.x;  // mirrored: u grows to the left, up stays up
    EXPECT_NEAR(glm::length(shading_point(scene, at, {0, 1, 0}).normal - normal), 0, 4 * half_code);
    scene.images[0] = Image<glm::u8vec4>(1, 1, {code(tilt), 128, code(tilt), 255});
    EXPECT_NEAR(shading_point(scene, at, {0, 1, 0}).normal.x, -tilt, 4 * half_code);
    scene.surfaces[0].uv_sets[0].assign(4, Vec2(0.5));  // spans nothing
    EXPECT_EQ(shading_point(scene, at, {0, 1, 0}).normal, at.normal);
}

TEST(ShadingPoint, ReflectanceOfDielectricsAndMetals_M30) {
    Material material;
    EXPECT_NEAR(reflectance_at_normal_incidence(material, Vec3(0.5), 0).x, 0.04, 1e-12);
    EXPECT_NEAR(reflectance_at_normal_incidence(material, Vec3(0.5), 1).x, 0.5, 1e-12);
    material.index_of_refraction = 1.33;
    EXPECT_NEAR(reflectance_at_normal_incidence(material, Vec3(1), 0).x, 0.33 * 0.33 / (2.33 * 2.33), 1e-12);
    material.metallic = 0;
    EXPECT_TRUE(is_specular(material));
    material.specular = 0;
    EXPECT_FALSE(is_specular(material));
    material.metallic = 0.5;
    EXPECT_TRUE(is_specular(material));
    material.unlit = true;
    EXPECT_FALSE(is_specular(material));
}

ShadingPoint white_point(double roughness, double cosine, double f0) {
    ShadingPoint point;
    point.normal = normalize_or({0.3, -0.5, 0.8}, {0, 0, 1});
    const Vec3 side = normalize_or(glm::cross(point.normal, Vec3(1, 0, 0)), {0, 0, 1});
    point.view = cosine * point.normal + std::sqrt(1 - cosine * cosine) * side;
    point.roughness = roughness;
    point.f0 = Vec3(f0);
    point.diffuse_albedo = Vec3(1);
    return point;
}

TEST(Brdf, WhiteFurnaceNeverReturnsMoreThanItGets_M30) {
    Random random{30};
    for (const double roughness : {0.2, 0.5, 1.0})
        for (const double cosine : {0.05, 0.5, 1.0})
            for (const double f0 : {0.0, 0.04, 1.0}) {
                const Brdf brdf = brdf_at(white_point(roughness, cosine, f0));
                double sum = 0, squares = 0;
                constexpr int n = 40000;
                for (int i = 0; i < n; ++i) {
                    const double a = random.next(), b = random.next(), c = random.next();
                    const Vec3 light = sample_direction(brdf, a, b, c);
                    const double density = direction_density(brdf, light);
                    const double value = density > 0 ? reflectance(brdf, light).sum().x / density : 0;
                    sum += value, squares += value * value;
                }
                const double mean = sum / n, error = std::sqrt((squares / n - mean * mean) / n);
                EXPECT_LE(mean, 1 + 4 * error + 2e-3) << roughness << ' ' << cosine << ' ' << f0;  // table: 2e-3
                // Lambert's part is white: what GGX leaves is lost only by its own missing multiple scattering.
                if (f0 < 1) {
                    EXPECT_GE(mean, 1 - 4 * error - 2e-3) << roughness << ' ' << cosine << ' ' << f0;
                }
            }
}

TEST(Emission, TexturedMonitorsShowTheirEmissiveTexture) {
    Scene scene;
    test::add_monitor(scene, "Monitor_R", 0, {0, 1, 0}, {2, 0, 0}, {0, 1, 0});
    Material& material = scene.materials.emplace_back();
    material.emissive = Vec3(5);
    Surface& screen = scene.surfaces[0];
    screen.material = 0;
    screen.uv_sets = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    add_image(scene, material.emissive_texture, {0, 0, 0, 255});
    scene.images[0].at(1, 0) = {255, 0, 0, 255};  // upper right
    scene.monitors[0].radiance = Vec3(5);
    const std::vector<LitMonitor> lights = lit_monitors(scene);
    ASSERT_TRUE(lights[0].picture);
    EXPECT_NEAR(glm::length(radiance_at(lights[0], 0, {1, 1.5, 0}) - Vec3(5, 0, 0)), 0, 1e-6);
    EXPECT_NEAR(glm::length(radiance_at(lights[0], 0, {-1, 1.5, 0})), 0, 1e-6);
    EXPECT_NEAR(glm::length(radiance_at(lights[0], 0, {1, 0.5, 0})), 0, 1e-6);
    EXPECT_NEAR(lights[0].picture->levels.back().pixels[0].x, 0.25f, 1e-6f);
}

}  // namespace
}  // namespace surimi
