// SPDX-License-Identifier: Apache-2.0
#include "runtime/trace/ray_scene.h"

#include <gtest/gtest.h>

#include "runtime/scene/texture.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

SurfacePoint middle(const Scene& scene, uint32_t surface) {
    return surface_point(scene, {surface, 0}, Vec3(1.0 / 3));
}

TEST(RayScene, SeesTheNearestSurfaceAndItsSide) {
    Scene scene;
    const uint32_t near = test::add_quad(scene, "Near", {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});  // faces +z
    test::add_quad(scene, "Far", {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1});
    const RayScene rays(scene);
    const auto front = rays.closest_hit({0.25, 0.5, 2}, {0, 0, -2});
    ASSERT_TRUE(front);
    EXPECT_EQ(front->triangle.surface, near);
    EXPECT_TRUE(front->is_front);
    EXPECT_NEAR(front->distance, 1, 1e-6);  // in lengths of the direction
    const SurfacePoint at = surface_point(scene, front->triangle, front->barycentric);
    EXPECT_NEAR(glm::length(at.position - Vec3(0.25, 0.5, 0)), 0, 1e-6);
    const auto back = rays.closest_hit({0, 0.1, -0.5}, {0, 0, 1});
    ASSERT_TRUE(back);
    EXPECT_FALSE(back->is_front);
    EXPECT_FALSE(rays.closest_hit({5, 5, 5}, {0, 0, 1}));
}

TEST(RayScene, IsEmptyWithoutSurfaces) {
    const Scene scene;
    const RayScene rays(scene);
    EXPECT_FALSE(rays.closest_hit(Vec3(0), {0, 0, 1}));
}

TEST(RayScene, AMonitorsOwnPanelsDoNotOcclude) {
    Scene scene;
    const uint32_t floor = test::add_quad(scene, "Floor", {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    test::add_monitor(scene, "Lower", 0, {0, 1, 0}, {0.5, 0, 0}, {0, 0, 0.5});
    test::add_monitor(scene, "Upper", 1, {0, 2, 0}, {0.5, 0, 0}, {0, 0, 0.5});
    const RayScene rays(scene);
    const Vec3 origin = rays.ray_origin(middle(scene, floor));
    EXPECT_FALSE(rays.is_occluded(origin, {0, 1, 0}, 0));
    EXPECT_FALSE(rays.is_occluded(origin, {0, 1.5, 0}, 0));  // past its own panel
    EXPECT_TRUE(rays.is_occluded(origin, {0, 2, 0}, 1));     // behind the other's
}

TEST(RayScene, PanelsWithoutASurfaceOccludeTheOthers) {
    Scene scene;
    const uint32_t floor = test::add_quad(scene, "Floor", {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    test::add_monitor(scene, "Upper", 1, {0, 2, 0}, {0.5, 0, 0}, {0, 0, 0.5});
    Monitor rectangle;
    rectangle.name = "Lower";
    rectangle.panels = {{{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}}}};
    scene.monitors.push_back(rectangle);
    const RayScene rays(scene);
    const Vec3 origin = rays.ray_origin(middle(scene, floor));
    EXPECT_TRUE(rays.is_occluded(origin, {0, 2, 0}, 0));
    EXPECT_FALSE(rays.is_occluded(origin, {0, 1, 0}, 1));
    const auto hit = rays.closest_hit({0, 0.5, 0}, {0, 1, 0});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->triangle.surface, scene.surfaces.size() + 1);
}

TEST(RayScene, GeometryJustBeforeOrBehindTheMonitorDoesNotOcclude) {
    Scene scene;
    const uint32_t floor = test::add_quad(scene, "Floor", {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    test::add_monitor(scene, "Screen", 0, {0, 2, 0}, {0.5, 0, 0}, {0, 0, 0.5});
    test::add_quad(scene, "Glued", {-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1});  // in the screen's plane
    const RayScene rays(scene);
    EXPECT_FALSE(rays.is_occluded(rays.ray_origin(middle(scene, floor)), {0.1, 2, 0.1}, 0));
}

/// A floor under a sheet whose alpha is 0 on its left half.
Scene masked_scene(AlphaMode mode) {
    Scene scene;
    test::add_quad(scene, "Floor", {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    const uint32_t sheet = test::add_quad(scene, "Sheet", {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1});
    scene.surfaces[sheet].uv_sets = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    scene.surfaces[sheet].material = 0;
    Material& material = scene.materials.emplace_back();
    material.alpha_mode = mode;
    material.base_color_texture.image = 0;
    material.base_color_texture.wrap_s = Wrap::clamp;
    Image<glm::u8vec4> image(2, 1, glm::u8vec4(255));
    image.at(0, 0).a = 0;
    scene.images.push_back(image);
    return scene;
}

TEST(RayScene, LightPassesTheHolesOfAnAlphaMaskedMaterial) {
    const Scene scene = masked_scene(AlphaMode::mask);
    const RayScene rays(scene);
    EXPECT_FALSE(rays.is_occluded({-0.5, 0.1, 0}, {-0.5, 2, 0}, 0));
    EXPECT_TRUE(rays.is_occluded({0.5, 0.1, 0}, {0.5, 2, 0}, 0));
    EXPECT_FALSE(rays.closest_hit({-0.5, 0.1, 0}, {0, 1, 0}));
    EXPECT_TRUE(rays.closest_hit({0.5, 0.1, 0}, {0, 1, 0}));
}

TEST(RayScene, BlendedMaterialsOcclude) {
    const Scene scene = masked_scene(AlphaMode::blend);
    EXPECT_TRUE(RayScene(scene).is_occluded({-0.5, 0.1, 0}, {-0.5, 2, 0}, 0));
}

TEST(Texture, WrapsAsAsked) {
    Scene scene = masked_scene(AlphaMode::mask);
    SurfacePoint at = surface_point(scene, {1, 0}, {1, 0, 0});
    const auto alpha = [&](double u, Wrap wrap) {
        scene.surfaces[1].uv_sets[0][0] = {u, 0.5};
        TextureUse use = scene.materials[0].base_color_texture;
        use.wrap_s = wrap;
        return look_up_texture(scene, use, at).a;
    };
    EXPECT_EQ(alpha(-3, Wrap::clamp), 0);
    EXPECT_EQ(alpha(3, Wrap::clamp), 1);
    EXPECT_EQ(alpha(1.25, Wrap::repeat), 0);
    EXPECT_EQ(alpha(1.25, Wrap::mirrored_repeat), 1);
    EXPECT_EQ(alpha(-0.25, Wrap::repeat), 1);
    EXPECT_EQ(alpha(NAN, Wrap::repeat), 1);
    EXPECT_EQ(alpha(1e300, Wrap::repeat), 1);
}

}  // namespace
}  // namespace surimi
