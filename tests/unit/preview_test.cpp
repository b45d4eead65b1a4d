// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "runtime/material/emission.h"
#include "runtime/preview/display.h"
#include "runtime/preview/see.h"
#include "tests/support/closed_form.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// A white floor under a coloured monitor, and a map that halves the light on its right half.
struct Stage {
    Scene scene;
    std::vector<VisibilityMap> pages{1};
    Stage() {
        const uint32_t floor = test::add_quad(scene, "Floor", {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
        scene.surfaces[floor].uv_sets.assign(2, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        test::add_monitor(scene, "Monitor_G", 1, {0, 2, 0}, {0.5, 0, 0}, {0, 0, 0.5});
        scene.monitors[0].radiance = {3, 2, 1};
        pages[0].visibility = Image<Vec3f>(64, 64, Vec3f(1));
        for (int y = 0; y < 64; ++y)
            for (int x = 32; x < 64; ++x) pages[0].visibility.at(x, y) = Vec3f(1, 0.5f, 1);
        Material& matte = scene.materials.emplace_back();
        matte.metallic = 0;
        matte.specular = 0;
        scene.surfaces[floor].material = 0;
    }
};

Lighting lighting_of(const Scene& scene, const std::vector<VisibilityMap>& pages, const RayScene& rays,
                     const LightingSettings& settings = {}) {
    return Lighting(scene, pages, rays, lit_monitors(scene), settings);
}

/// What a ray sees, shaded.
Seen look(const Lighting& lighting, const Vec3& eye, const Vec3& direction, Show show) {
    std::vector<SeenPoint> points;
    Seen seen = see(lighting, eye, direction, show, 0, 0, points);
    std::vector<MonitorCounts> counts(lighting.scene.monitors.size());
    for (const SeenPoint& p : points) {
        std::vector<Parts> reflected(1);
        shade(lighting, std::span(&p.point, 1), reflected, counts);
        seen.color += p.weight * reflected[0].sum();
    }
    return seen;
}

TEST(Preview, ShowsAlbedoTimesShadowedIrradiance) {
    const Stage stage;
    const RayScene rays(stage.scene);
    const Lighting lighting = lighting_of(stage.scene, stage.pages, rays);
    for (const double x : {-0.5, 0.5}) {
        const Seen seen = look(lighting, {x, 1, 0}, {0, -1, 0}, Show::lit);
        const double e = test::irradiance_by_quadrature(stage.scene.monitors[0].panels[0], {x, 0, 0}, {0, 1, 0}, 200);
        const Vec3 expected = Vec3(3, 2, 1) * e / pi * (x < 0 ? 1.0 : 0.5);
        EXPECT_NEAR(glm::length(seen.color - expected), 0, 1e-4 * glm::length(expected));
        EXPECT_NEAR(seen.distance, 1, 1e-5);
        EXPECT_TRUE(seen.is_surface);
    }
}

TEST(Preview, EachChannelShowsItsOwnMonitor) {
    const Stage stage;
    const RayScene rays(stage.scene);
    const Lighting lighting = lighting_of(stage.scene, stage.pages, rays);
    const Seen v = look(lighting, {0.5, 1, 0}, {0, -1, 0}, Show::visibility);
    EXPECT_NEAR(glm::length(v.color - Vec3(1, 0.5, 1)), 0, 1e-6);
    const Seen e = look(lighting, {0.5, 1, 0}, {0, -1, 0}, Show::unshadowed);
    const Seen s = look(lighting, {0.5, 1, 0}, {0, -1, 0}, Show::shadowed);
    EXPECT_EQ(e.color.r, 0);
    EXPECT_GT(e.color.g, 0.01);
    EXPECT_NEAR(s.color.g, 0.5 * e.color.g, 1e-9);
}

TEST(Preview, DoesNotSeeBackFacesOfSingleSidedMaterials) {
    Stage stage;
    const RayScene rays(stage.scene);
    const Seen below = look(lighting_of(stage.scene, stage.pages, rays), {0.2, -1, 0.3}, {0, 1, 0}, Show::normals);
    EXPECT_GT(below.distance, 2.5);  // through the floor, to the monitor's front
    stage.scene.materials[0].double_sided = true;
    const Lighting lighting = lighting_of(stage.scene, stage.pages, rays);
    EXPECT_NEAR(look(lighting, {0.2, -1, 0.3}, {0, 1, 0}, Show::normals).distance, 1, 1e-5);
}

TEST(Preview, PictureIsUprightAndNotMirrored) {
    Scene scene;
    test::add_quad(scene, "Upper right", {0.2, 0.2, -2}, {0.4, 0.2, -2}, {0.4, 0.4, -2}, {0.2, 0.4, -2});
    const RayScene rays(scene);
    const std::vector<VisibilityMap> pages;
    const Picture picture = render(lighting_of(scene, pages, rays), look_at(Vec3(0), {0, 0, -1}, 1.0),
                                   {.width = 40, .height = 40, .samples_per_side = 2, .show = Show::normals}, {});
    double upper_right = 0, elsewhere = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) (x >= 20 && y < 20 ? upper_right : elsewhere) += picture.pixels.at(x, y).z;
    EXPECT_GT(upper_right, 1);
    EXPECT_EQ(elsewhere, 0);
}

TEST(Preview, PassesAddUpToThePictureForAnyNumberOfThreads) {
    const Scene scene = test::kanikama_room();
    const RayScene rays(scene);
    const std::vector<VisibilityMap> pages;
    const Lighting lighting =
        lighting_of(scene, pages, rays, {.visibility = VisibilitySource::stochastic, .samples = 2});
    const View view = look_at({0, 1, 2.5}, {0, 0, -1}, 1.0);
    const RenderSettings settings{.width = 70, .height = 40, .samples_per_side = 2};
    int calls = 0;
    const auto render_with = [&](int threads) {
        set_thread_count(threads);
        return render(lighting, view, settings, {}, [&](const Picture& so_far, int pass, int passes) {
            EXPECT_EQ(passes, 4);
            EXPECT_EQ(so_far.pixels.pixels.size(), 2800u);
            calls += pass;
        });
    };
    const Picture one = render_with(1), three = render_with(3);
    set_thread_count(0);
    EXPECT_EQ(calls, 2 * (1 + 2 + 3));
    EXPECT_TRUE(one.pixels.pixels == three.pixels.pixels);
    EXPECT_EQ(one.counts[0].points, three.counts[0].points);
    EXPECT_GT(one.counts[0].specular, 1000u);
}

TEST(Preview, ShadingAgreesWithBruteForce) {
    Scene scene = test::kanikama_room();
    scene.materials.assign(1, {});
    scene.materials[0].metallic = 0;
    scene.materials[0].roughness = 0.5;
    for (Surface& surface : scene.surfaces)
        if (surface.monitor < 0) surface.material = 0;
    const RayScene rays(scene);
    const std::vector<VisibilityMap> pages;
    const View view = look_at({0, 1, 2.5}, {0, 0, -1}, 1.0);
    const RenderSettings settings{.width = 48, .height = 27, .samples_per_side = 1};
    const auto picture_of = [&](ShadingModel model, VisibilitySource source) {
        return render(lighting_of(scene, pages, rays, {.visibility = source, .model = model, .samples = 256}), view,
                      settings, {});
    };
    for (const VisibilitySource source : {VisibilitySource::none, VisibilitySource::stochastic}) {
        const Picture ours = picture_of(ShadingModel::exact, source);
        const Picture truth = picture_of(ShadingModel::reference, source);
        double squares = 0, bright = 0;
        for (size_t i = 0; i < ours.pixels.pixels.size(); ++i) {
            const Vec3 difference(ours.pixels.pixels[i] - truth.pixels.pixels[i]);
            squares += glm::dot(difference, difference) / 3;
            bright = std::max(bright, static_cast<double>(truth.pixels.pixels[i].x));
        }
        // Noise of 512 samples and the fit of the lobes.
        EXPECT_LT(std::sqrt(squares / static_cast<double>(ours.pixels.pixels.size())), 0.01 * bright);
    }
}

TEST(Shade, PointsOfAllMaterialsInOneBatchGetWhatTheyGetAlone) {
    Scene scene = test::kanikama_room();
    scene.materials.assign(4, {});  // a metal, a gloss, a matte, an unlit one, by turns
    scene.materials[1].metallic = scene.materials[2].metallic = scene.materials[2].specular = 0;
    scene.materials[1].roughness = 0.2;
    scene.materials[3].unlit = true;
    const RayScene rays(scene);
    const std::vector<VisibilityMap> pages;
    std::vector<SurfacePoint> places;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        scene.surfaces[s].material = static_cast<int>(s % 4);
        for (uint32_t t = 0; t < scene.surfaces[s].triangles.size(); ++t)
            places.push_back(surface_point(scene, {s, t}, {0.2, 0.3, 0.5}));
    }
    const Lighting lighting = lighting_of(scene, pages, rays);
    std::vector<ShadingPoint> points;
    for (const SurfacePoint& place : places)
        points.push_back(shading_point(scene, place, normalize_or(Vec3(0.3, 0.4, 1) - place.position, {0, 1, 0})));
    std::vector<MonitorCounts> counts(scene.monitors.size());
    std::vector<Parts> together(points.size()), alone(1);
    shade(lighting, points, together, counts);
    int lit = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        shade(lighting, std::span(&points[i], 1), alone, counts);
        EXPECT_EQ(together[i].diffuse, alone[0].diffuse) << i;
        EXPECT_EQ(together[i].specular, alone[0].specular) << i;
        lit += together[i].sum() != Vec3(0);
    }
    EXPECT_GT(lit, 10);
}

TEST(Shade, ThreeShowsNothingSmootherThanItsLeastRoughness) {
    const Scene scene = test::kanikama_room();
    const std::vector<VisibilityMap> pages;
    const RayScene rays(scene, Attach::everything);
    LightingSettings settings;
    const auto specular_of = [&](ShadingModel model, double roughness) {
        settings.model = model;
        const Lighting lighting = lighting_of(scene, pages, rays, settings);
        const Monitor& monitor = scene.monitors.front();
        const Vec3 front = front_normal(monitor.panels.front()), center = monitor.panels.front().corners.front();
        ShadingPoint point;
        point.at.triangle.surface = 0;
        point.at.position = center + 2.0 * front;
        point.normal = normalize_or(-front + 0.3 * Vec3(0, 1, 0), {0, 1, 0});
        point.view = normalize_or(-front + 0.5 * Vec3(0, 1, 0), {0, 1, 0});
        point.roughness = roughness;
        std::vector<Parts> reflected(1);
        std::vector<MonitorCounts> counts(scene.monitors.size());
        shade(lighting, {&point, 1}, reflected, counts);
        return reflected[0].specular.x;
    };
    EXPECT_EQ(specular_of(ShadingModel::three, 0.01), specular_of(ShadingModel::three, 0.045));
    EXPECT_NE(specular_of(ShadingModel::three, 0.045), specular_of(ShadingModel::three, 0.06));
    EXPECT_NE(specular_of(ShadingModel::kanikama, 0.01), specular_of(ShadingModel::kanikama, 0.045));
}

TEST(ShadingPlan, ComputesOnlyWhatTheSceneCallsFor) {
    Stage stage;
    const RayScene rays(stage.scene);
    std::vector<MonitorCounts> counts(1);
    const auto count = [&](const Lighting& lighting, const Vec3& eye) {
        counts.assign(1, {});
        std::vector<SeenPoint> points;
        see(lighting, eye, {0, -1, 0}, Show::lit, 0, 0, points);
        std::vector<Parts> reflected(1);
        shade(lighting, std::span(&points.at(0).point, 1), reflected, counts);
        return counts[0];
    };
    // A matte floor: no lobe, but a read of the map, since a part of it is shadowed.
    MonitorCounts c = count(lighting_of(stage.scene, stage.pages, rays), {0.5, 1, 0});
    EXPECT_EQ(c.specular, 0u);
    EXPECT_EQ(c.diffuse, 1u);
    EXPECT_EQ(c.map_reads, 1u);
    stage.scene.materials[0].specular = 1;
    EXPECT_EQ(count(lighting_of(stage.scene, stage.pages, rays), {0.5, 1, 0}).specular, 1u);
    stage.scene.materials[0].metallic = 1;
    EXPECT_EQ(count(lighting_of(stage.scene, stage.pages, rays), {0.5, 1, 0}).diffuse, 0u);
    // Dark in the map: nothing.
    for (Vec3f& v : stage.pages[0].visibility.pixels) v = Vec3f(1, v.y < 1 ? 0 : 1, 1);
    c = count(lighting_of(stage.scene, stage.pages, rays), {0.5, 1, 0});
    EXPECT_EQ(c.dark, 1u);
    EXPECT_EQ(c.specular + c.diffuse, 0u);
    // Never blocked: no reads. Off: nothing at all.
    stage.pages[0].visibility = Image<Vec3f>(4, 4, Vec3f(0, 1, 0));
    EXPECT_EQ(count(lighting_of(stage.scene, stage.pages, rays), {0.5, 1, 0}).map_reads, 0u);
    const Lighting off(stage.scene, stage.pages, rays, {LitMonitor{Vec3(0), std::nullopt}}, {});
    EXPECT_EQ(count(off, {0.5, 1, 0}).unseen, 1u);
    // Below the monitor's horizon.
    stage.scene.monitors[0].panels[0].corners = {{-1, -2, 1}, {-1, -2, 0}, {1, -2, 0}, {1, -2, 1}};
    EXPECT_EQ(count(lighting_of(stage.scene, stage.pages, rays), {0.5, 1, 0}).unseen, 1u);
}

TEST(Preview, FilmicCurveIsMonotoneAndBounded) {
    double before = 0;
    for (double x = 1e-6; x < 1e12; x *= 1.1) {
        EXPECT_GE(filmic(x), before);
        EXPECT_LE(filmic(x), 1);
        before = filmic(x);
    }
    EXPECT_EQ(filmic(NAN), 0);
    EXPECT_EQ(filmic(-1), 0);
    EXPECT_EQ(filmic(INFINITY), filmic(1e6));
}

TEST(Preview, AutomaticFramingSeesSomethingLit) {
    const Scene scene = test::kanikama_room();
    const RayScene rays(scene);
    const std::vector<VisibilityMap> pages;
    const Lighting lighting = lighting_of(scene, pages, rays);
    const View view = frame_automatically(lighting, 16.0 / 9);
    const Picture picture = render(lighting, view, {.width = 64, .height = 36, .samples_per_side = 1}, {});
    int lit = 0;
    for (const Vec3f& p : picture.pixels.pixels) lit += luminance(Vec3(p)) > 0;
    EXPECT_GT(lit, 64 * 36 / 2);
    EXPECT_GT(picture.bright_level, 0);
}

}  // namespace
}  // namespace surimi
