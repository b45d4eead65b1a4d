// SPDX-License-Identifier: Apache-2.0
#include "runtime/trace/ray_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "runtime/base/random.h"
#include "runtime/scene/gltf.h"
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

TEST(RayScene, FindsTrianglesNearAPlace_MonitorsOfSettingsAmongThem) {
    Scene scene;
    const uint32_t near = test::add_quad(scene, "Near", {9, 9, 10}, {11, 9, 10}, {11, 11, 10}, {9, 11, 10});
    test::add_quad(scene, "Far", {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1});
    Monitor monitor;
    monitor.panels.push_back({{{9, 9, 12}, {11, 9, 12}, {11, 11, 12}, {9, 11, 12}}});
    scene.monitors.push_back(monitor);
    const RayScene rays(scene);
    std::vector<TriangleRef> found = {{7, 7}};
    const auto has = [&](uint32_t surface, uint32_t triangle) {
        return std::ranges::any_of(
            found, [&](const TriangleRef& t) { return t.surface == surface && t.triangle == triangle; });
    };
    rays.find_triangles_near(Vec3(10) - rays.center(), 0.5, found);
    EXPECT_TRUE(has(near, 0) && has(near, 1));
    EXPECT_FALSE(has(7, 7)) << "what was in it is gone";
    EXPECT_TRUE(std::ranges::is_sorted(found, {}, [](const TriangleRef& t) { return 2 * t.surface + t.triangle; }));
    const auto corners = rays.corners_of({near, 0});
    EXPECT_NEAR(glm::length(corners[0] + rays.center() - Vec3(9, 9, 10)), 0, 1e-12);
    const auto panels = static_cast<uint32_t>(scene.surfaces.size());
    rays.find_triangles_near(Vec3(10, 10, 11.9) - rays.center(), 0.5, found);
    EXPECT_TRUE(has(panels, 0) && has(panels, 1));
    EXPECT_NEAR(rays.corners_of({panels, 1})[2].z + rays.center().z, 12, 1e-12);
    rays.find_triangles_near(Vec3(10, 10, 500) - rays.center(), 0.5, found);
    EXPECT_FALSE(has(near, 0) || has(panels, 0));
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

TEST(RayScene, PacketsPassTheHolesOfAnAlphaMaskedMaterial) {
    const Scene scene = masked_scene(AlphaMode::mask);
    const RayScene rays(scene);
    RayPacket packet;
    uint32_t expected = 0;
    for (size_t i = 0; i < RayPacket::capacity; ++i) {
        const double x = i % 3 == 0 ? -0.6 + 0.01 * static_cast<double>(i) : 0.2 + 0.04 * static_cast<double>(i);
        packet.add(Vec3(x, 0.1, 0) - rays.center(), Vec3(x, 2, 0.1) - rays.center(), 1);
        if (i % 3 != 0) expected |= 1u << i;
    }
    EXPECT_EQ(rays.occluded(packet, 0), expected);
}

TEST(RayScene, PacketsEndWhereTold) {
    Scene scene;
    test::add_quad(scene, "Sheet", {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1});
    test::add_monitor(scene, "Screen", 0, {0, 0.5, 0}, {0.5, 0, 0}, {0, 0, 0.5});
    const RayScene rays(scene);
    RayPacket packet;
    for (const double end : {0.0, 0.26, 0.49, 0.51, 1.0})
        packet.add(Vec3(0.1, 0, 0.2) - rays.center(), Vec3(0.1, 2, 0.2) - rays.center(), end);
    EXPECT_EQ(rays.occluded(packet, 0), 0b11000u);  // the sheet is half way; the monitor's own panel a quarter
    EXPECT_EQ(rays.occluded(packet, 1), 0b11110u);  // for another monitor that panel counts
}

TEST(RayScene, TheClosestOccluderIsNotTheMonitor) {
    Scene scene;
    const uint32_t sheet = test::add_quad(scene, "Sheet", {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1});
    test::add_quad(scene, "Farther", {-1, 1.5, 1}, {1, 1.5, 1}, {1, 1.5, -1}, {-1, 1.5, -1});
    test::add_monitor(scene, "Screen", 0, {0, 0.5, 0}, {0.5, 0, 0}, {0, 0, 0.5});
    const RayScene rays(scene);
    const Vec3 origin = Vec3(0.1, 0, 0.2) - rays.center(), target = Vec3(0.1, 2, 0.2) - rays.center();
    const auto found = rays.closest_occluder(origin, target, 1, 0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->surface, sheet);
    EXPECT_FALSE(rays.closest_occluder(origin, target, 0.49, 0));
}

/// Random rays between random points of a scene's surfaces, relative to the scene's centre: some graze, some are
/// blocked at once.
struct Segment {
    Vec3 origin, target;
};
std::vector<Segment> random_segments(const Scene& scene, const RayScene& rays, uint64_t count) {
    const auto place = [&](uint64_t key) {
        uint64_t tries = 0;
        uint32_t s = 0;
        do s = static_cast<uint32_t>(hash(key, ++tries) % scene.surfaces.size());
        while (scene.surfaces[s].triangles.empty());
        const auto t = static_cast<uint32_t>(hash(key, 0) % scene.surfaces[s].triangles.size());
        return rays.ray_origin(surface_point(scene, {s, t}, Vec3(0.5, 0.3, 0.2))) - rays.center();
    };
    std::vector<Segment> segments;
    for (uint64_t i = 0; i < count; ++i) segments.push_back({place(2 * i), place(2 * i + 1)});
    return segments;
}

/// Packets of every size against rays one by one.
void expect_packets_agree(const Scene& scene) {
    const RayScene rays(scene);
    const std::vector<Segment> segments = random_segments(scene, rays, 20000);
    size_t blocked = 0;
    for (size_t first = 0, size = 1; first + size <= segments.size(); first += size, size = size % 16 + 1) {
        RayPacket packet;
        uint32_t expected = 0;
        for (size_t i = 0; i < size; ++i) {
            const Segment& segment = segments[first + i];
            packet.add(segment.origin, segment.target, 0.999);
            if (rays.closest_occluder(segment.origin, segment.target, 0.999, 0)) expected |= 1u << i;
        }
        EXPECT_EQ(rays.occluded(packet, 0), expected) << "rays from " << first;
        blocked += static_cast<size_t>(std::popcount(expected));
    }
    EXPECT_GT(blocked, segments.size() / 20);
    EXPECT_LT(blocked, segments.size());
}

TEST(RayScene, PacketsAgreeWithSingleRays) {
    Scene scene = test::kanikama_room();
    expect_packets_agree(scene);
}

TEST(RayScene, PacketsAgreeWithSingleRaysInRealRooms) {
    const char* folder = std::getenv("SURIMI_SCENES");
    if (!folder || !*folder) GTEST_SKIP() << "SURIMI_SCENES does not name a folder of scenes";
    for (const char* file : {"home-theater/home-theater.glb", "classroom/classroom.glb", "nasty-house/house.glb"}) {
        SCOPED_TRACE(file);
        expect_packets_agree(read_gltf(std::filesystem::path(folder) / file));
    }
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
