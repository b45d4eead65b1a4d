// SPDX-License-Identifier: Apache-2.0
// A bake on several pages against the same bake on one.
#include <gtest/gtest.h>

#include <filesystem>

#include "baker/bake.h"
#include "baker/write/output.h"
#include "runtime/material/emission.h"
#include "runtime/preview/render.h"
#include "runtime/scene/gltf.h"
#include "runtime/scene/monitors.h"
#include "runtime/visibility/baked.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

BakeSettings on_pages(int pages, int size, const GatherSettings& gather = {}) {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = size;
    settings.unwrap.atlases = pages;
    settings.gather = gather;
    return settings;
}

/// V at a point of a surface, as the bake's maps have it.
Vec3 visibility_at(const Bake& bake, const TriangleRef& where, const Vec3& barycentric) {
    const SurfaceUv& surface = bake.atlas.surfaces[where.surface];
    const auto& uv = surface.uv[where.triangle];
    const Vec2 at = barycentric.x * Vec2(uv[0]) + barycentric.y * Vec2(uv[1]) + barycentric.z * Vec2(uv[2]);
    return look_up(bake.pages[static_cast<size_t>(surface.page)].map, at);
}

TEST(BakePages, PointsHaveTheVisibilityThatOneMapGivesThem_M3) {
    const Scene scene = test::kanikama_room();
    const Bake one = bake(scene, on_pages(1, 256), {});
    const Bake two = bake(scene, on_pages(2, 256), {});
    ASSERT_EQ(two.pages.size(), 2u);
    Random random{5};
    double sum = 0;
    size_t count = 0;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        if (scene.surfaces[s].monitor >= 0) continue;
        for (int i = 0; i < 400; ++i) {
            const double size = static_cast<double>(scene.surfaces[s].triangles.size());
            const TriangleRef where{s, static_cast<uint32_t>(random.next() * size)};
            const double root = std::sqrt(random.next()), r = random.next();
            const Vec3 b(1 - root, root * (1 - r), root * r);
            const Vec3 error = glm::abs(visibility_at(one, where, b) - visibility_at(two, where, b));
            sum += error.x + error.y;
            count += 2;
        }
    }
    // Values are right to 0.004; between them maps of different texels interpolate, and penumbras are narrower than
    // texels in places.
    EXPECT_LT(sum / static_cast<double>(count), 0.01);
}

TEST(BakePages, TheSameBytesForOneThreadAndForMany) {
    const Scene scene = test::kanikama_room();
    set_thread_count(1);
    const Bake one = bake(scene, on_pages(2, 96), {});
    set_thread_count(7);
    const Bake many = bake(scene, on_pages(2, 96), {});
    set_thread_count(0);
    ASSERT_EQ(one.pages.size(), 2u);
    for (size_t p = 0; p < 2; ++p) EXPECT_EQ(one.pages[p].map.visibility.pixels, many.pages[p].map.visibility.pixels);
}

TEST(BakePages, TexelsAreThoseOfTheSurfacesOnThePage) {
    const Scene scene = test::kanikama_room();
    const Atlas atlas = unwrap(scene, on_pages(2, 96).unwrap, {});
    ASSERT_EQ(atlas.pages, 2);
    for (int page = 0; page < 2; ++page) {
        const Texels texels = find_texels(scene, atlas, page);
        EXPECT_GT(texels.texels.size(), 100u);
        for (const Texel& texel : texels.texels)
            for (const TriangleRef& triangle : texels.triangles_of(texel))
                EXPECT_EQ(atlas.surfaces[triangle.surface].page, page);
    }
}

TEST(BakePages, PagesHaveRandomNumbersOfTheirOwn) {
    Scene scene;
    const uint32_t floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    test::add_monitor(scene, "Monitor_R", 0, {0, 1, -2}, {1, 0, 0}, {0, 0.6, 0});
    test::add_box(scene, "Box", {0, 0.5, -1}, {0.5, 0.2, 0.1});
    const RayScene rays(scene);
    const Silhouettes silhouettes = find_silhouettes(scene, rays);
    Atlas atlas = test::whole_map_atlas(scene, floor, 32);
    const auto gathered = [&](int page) {
        const GatherSettings settings{.method = Method::monte_carlo, .samples = 16};
        return gather(scene, atlas, find_texels(scene, atlas, page), rays, silhouettes, 0, settings, {});
    };
    const Gathered first = gathered(0);
    for (SurfaceUv& surface : atlas.surfaces) surface.page = 1;
    const Gathered second = gathered(1);
    ASSERT_EQ(first.estimates.size(), second.estimates.size());
    size_t penumbra = 0;
    size_t different = 0;
    for (size_t i = 0; i < first.estimates.size(); ++i) {
        const IrradianceEstimate& estimate = first.estimates[i];
        if (!(estimate.shadowed > 0 && estimate.shadowed < estimate.unshadowed)) continue;
        ++penumbra;
        different += first.estimates[i].shadowed != second.estimates[i].shadowed;
    }
    EXPECT_GT(penumbra, 50u);
    EXPECT_GT(different, penumbra / 2);
}

/// The monitor's diffuse light in a file that a bake wrote: where none arrives V has no meaning, and does not show.
/// `is_swapped`: with the maps in the wrong order.
Image<Vec3f> picture_of(const std::filesystem::path& file, size_t page_count, bool is_swapped = false) {
    Scene scene = read_gltf(file);
    find_monitors(scene, {});
    std::vector<VisibilityMap> pages = carried_pages(scene);
    EXPECT_EQ(pages.size(), page_count);
    if (is_swapped) std::swap(pages.front(), pages.back());
    const RayScene rays(scene);
    const Lighting lighting(scene, pages, rays, lit_monitors(scene), {});
    const View view = look_at({0, 1.5, 0}, {0, 1, -3}, pi / 3);
    return render(lighting, view, {.width = 160, .height = 90, .samples_per_side = 2, .show = Show::diffuse}, {})
        .pixels;
}

double mean_difference(const Image<Vec3f>& a, const Image<Vec3f>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i].x - b.pixels[i].x);
    return sum / static_cast<double>(a.pixels.size());
}

TEST(BakePages, ThePreviewOfTwoPagesIsThatOfOne) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "surimi_BakePages_preview";
    std::filesystem::remove_all(folder);
    Scene scene = read_gltf(std::filesystem::path(SURIMI_SAMPLES) / "scenes/home-theater/home-theater.glb");
    find_monitors(scene, {});
    const GatherSettings rays{.method = Method::monte_carlo, .samples = 16};  // quick, and good enough to look at
    const auto bake_to = [&](const std::string& name, int pages, int size) {
        return write_bake(folder / name, scene, bake(scene, on_pages(pages, size, rays), {}), "{}").baked_glb;
    };
    const Image<Vec3f> one = picture_of(bake_to("one", 1, 512), 1);
    const std::filesystem::path file = bake_to("two", 2, 512);
    // A single map of as many texels is another layout too: other texels, other noise.
    const double usual = mean_difference(one, picture_of(bake_to("larger", 1, 724), 1));
    EXPECT_GT(usual, 0);
    EXPECT_LT(mean_difference(one, picture_of(file, 2)), 1.25 * usual);
    EXPECT_GT(mean_difference(one, picture_of(file, 2, true)), 5 * usual);
}

}  // namespace
}  // namespace surimi
