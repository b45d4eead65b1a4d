// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "runtime/base/color.h"
#include "runtime/material/emission.h"
#include "runtime/preview/display.h"
#include "runtime/window/choices.h"
#include "runtime/window/orbit.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// A room with two monitors and no map, lit by a few rays, seen from inside.
struct Room {
    Scene scene = test::kanikama_room();
    std::vector<VisibilityMap> pages;
    RayScene rays{scene};
    View view = look_at({0, 1, 2.5}, {0, 0, -1}, 1.0);
    RenderSettings settings{.width = 70, .height = 40, .samples_per_side = 2};

    Lighting lighting(const LightingSettings& of = {.visibility = VisibilitySource::stochastic, .samples = 2}) const {
        return Lighting(scene, pages, rays, lit_monitors(scene), of);
    }
    Wish wish() const {
        Wish wish = wish_of(choices_for(lighting(), view), settings.width, settings.height);
        wish.picture = settings;
        return wish;
    }
};

size_t lit_pixels(const Image<Vec3f>& pixels) {
    return static_cast<size_t>(
        std::count_if(pixels.pixels.begin(), pixels.pixels.end(), [](const Vec3f& p) { return p != Vec3f(0); }));
}

/// Takes frames until one passes, a minute at most.
template <class Passes>
bool wait_for(ProgressiveRenderer& renderer, Frame& frame, const Passes& passes) {
    for (int i = 0; i < 60000; ++i) {
        if (renderer.take(frame) && passes(frame)) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

Frame finished(ProgressiveRenderer& renderer, const Wish& wish) {
    Frame frame;
    const size_t number = renderer.show(wish);
    EXPECT_TRUE(wait_for(renderer, frame, [&](const Frame& f) { return f.status.is_done && f.status.wish == number; }));
    return frame;
}

TEST(GrowingPicture, EndsAsTheBytesOfTheBatchForAnyStepsAndThreads) {
    const Room room;
    const Lighting lighting = room.lighting();
    const Picture batch = render(lighting, room.view, room.settings, {});
    for (const int first_block : {1, 2, 8, 16})
        for (const size_t step : {size_t{0}, size_t{700}, SIZE_MAX}) {
            set_thread_count(first_block == 8 ? 3 : 1);
            GrowingPicture picture(lighting, room.view, room.settings, first_block);
            while (!picture.is_done()) picture.advance(step);
            EXPECT_TRUE(picture.pixels().pixels == batch.pixels.pixels) << first_block << " " << step;
            EXPECT_EQ(picture.bright_level(), batch.bright_level);
        }
    set_thread_count(0);
}

TEST(GrowingPicture, ShowsTheWholeCoarselyBeforeAnyOfItFinely) {
    const Room room;
    const Lighting lighting = room.lighting();
    GrowingPicture picture(lighting, room.view, room.settings, 16);
    EXPECT_TRUE(picture.is_first_sight());
    EXPECT_EQ(lit_pixels(picture.pixels()), 0u);
    EXPECT_EQ(picture.advance(SIZE_MAX).size(), 6u);  // 70 x 40 in tiles of 32: all of it is new
    EXPECT_FALSE(picture.is_first_sight());
    EXPECT_EQ(picture.samples(), 5u * 3);  // a ray for each block of 16
    EXPECT_EQ(lit_pixels(picture.pixels()), 2800u);
    EXPECT_EQ(picture.block(), 4);
    EXPECT_EQ(picture.passes(), 0);
}

TEST(GrowingPicture, ShowsPartsOfAPassFromTheMiddleOutwards) {
    const Room room;
    const Lighting lighting = room.lighting();
    set_thread_count(1);
    GrowingPicture picture(lighting, room.view, room.settings, 8);
    picture.advance(SIZE_MAX);
    ASSERT_EQ(picture.block(), 1);
    const Image<Vec3f> coarse = picture.pixels();
    const std::vector<Tile> fresh = picture.advance(0);
    set_thread_count(0);
    ASSERT_EQ(fresh.size(), 1u);  // an item for the one thread
    EXPECT_EQ(picture.passes(), 0);
    const Tile& tile = fresh[0];
    EXPECT_TRUE(tile.x0 <= 35 && 35 <= tile.x0 + tile.width && tile.y0 <= 20 && 20 <= tile.y0 + tile.height);
    int changed_inside = 0, changed_outside = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 70; ++x) {
            const bool is_inside =
                x >= tile.x0 && x < tile.x0 + tile.width && y >= tile.y0 && y < tile.y0 + tile.height;
            (is_inside ? changed_inside : changed_outside) += picture.pixels().at(x, y) != coarse.at(x, y);
        }
    EXPECT_GT(changed_inside, tile.width * tile.height / 2);
    EXPECT_EQ(changed_outside, 0);
}

TEST(GrowingPicture, BeginsNoItemAfterItIsCancelledAndLosesNone) {
    const Room room;
    const Lighting lighting = room.lighting({.visibility = VisibilitySource::stochastic, .samples = 32});
    const Picture batch = render(lighting, room.view, room.settings, {});
    GrowingPicture picture(lighting, room.view, room.settings, 1);
    std::atomic<int> asked{0};
    const std::vector<Tile> fresh = picture.advance(SIZE_MAX, [&] { return ++asked > 7; });
    EXPECT_EQ(fresh.size(), 7u);            // one item for each question that was answered with no
    EXPECT_EQ(picture.samples(), 7u * 64);  // 128 rays a pixel: items of eight pixels squared
    EXPECT_EQ(picture.passes(), 0);
    EXPECT_TRUE(picture.advance(SIZE_MAX, [] { return true; }).empty());
    while (!picture.is_done()) picture.advance(SIZE_MAX);
    EXPECT_TRUE(picture.pixels().pixels == batch.pixels.pixels);
}

TEST(GrowingPicture, OfNoPixelsIsDoneAtOnce) {
    const Room room;
    const Lighting lighting = room.lighting();
    for (const auto& [width, height] : {std::pair{0, 0}, {0, 40}, {70, 0}}) {
        RenderSettings settings = room.settings;
        settings.width = width;
        settings.height = height;
        GrowingPicture picture(lighting, room.view, settings, 16);
        EXPECT_TRUE(picture.is_done());
        EXPECT_TRUE(picture.advance(SIZE_MAX).empty());
        EXPECT_EQ(picture.samples(), 0u);
        EXPECT_EQ(picture.bright_level(), 0);
    }
}

TEST(ProgressiveRenderer, FinishedItIsThePictureThatTheFilePreviewWrites) {
    const Room room;
    const Lighting lighting = room.lighting();
    ProgressiveRenderer renderer(room.lighting());
    const Frame frame = finished(renderer, room.wish());
    const Picture batch = render(lighting, room.view, room.settings, {});
    EXPECT_TRUE(frame.pixels.pixels == batch.pixels.pixels);
    const double exposure = automatic_exposure(batch);
    EXPECT_EQ(frame.status.exposure, exposure);
    EXPECT_TRUE(frame.codes.pixels == to_codes(displayed(batch.pixels, Show::lit, exposure)).pixels);
    EXPECT_EQ(frame.status.passes, 4);
    EXPECT_GT(frame.status.light_samples, 4u * 2800);
}

TEST(ProgressiveRenderer, StartsAnewForEveryChangeButExposure) {
    const Room room;
    const Wish first = room.wish();
    ProgressiveRenderer renderer(room.lighting());
    const Frame before = finished(renderer, first);
    EXPECT_EQ(renderer.show(first), before.status.wish);  // nothing changed
    Frame none;
    EXPECT_FALSE(renderer.take(none));
    const std::vector<std::function<void(Wish&)>> changes = {
        [](Wish& w) { w.view.eye.x += 0.5; },
        [](Wish& w) { w.picture.width = 50; },
        [](Wish& w) { w.picture.samples_per_side = 1; },
        [](Wish& w) { w.picture.show = Show::normals; },
        [](Wish& w) { w.lighting.visibility = VisibilitySource::none; },
        [](Wish& w) { w.lighting.model = ShadingModel::three; },
        [](Wish& w) { w.lighting.samples = 1; },
        [](Wish& w) { w.lighting.roughness = 0.1; },
        [](Wish& w) { w.radiance[0] = Vec3(0); },
    };
    for (size_t i = 0; i < changes.size(); ++i) {
        Wish wish = first;
        changes[i](wish);
        const Frame after = finished(renderer, wish);
        EXPECT_NE(after.status.wish, before.status.wish) << i;
        EXPECT_FALSE(after.pixels.pixels == before.pixels.pixels) << i;
    }
    EXPECT_TRUE(finished(renderer, first).pixels.pixels == before.pixels.pixels);
    Wish brighter = first;
    brighter.exposure = std::log2(before.status.exposure) + 1;
    Frame after;
    const size_t number = renderer.show(brighter);
    ASSERT_TRUE(wait_for(renderer, after, [&](const Frame& f) { return f.status.wish == number; }));
    EXPECT_TRUE(after.status.is_done) << "an exposure takes no new picture";
    EXPECT_TRUE(after.pixels.pixels == before.pixels.pixels);
    EXPECT_FALSE(after.codes.pixels == before.codes.pixels);
}

TEST(ProgressiveRenderer, LeavesASlowWishForTheNext) {
    const Room room;
    ProgressiveRenderer renderer(room.lighting());
    Wish slow = room.wish();
    slow.lighting.model = ShadingModel::reference;
    slow.lighting.samples = 1024;
    slow.picture.samples_per_side = 64;  // hours
    Frame frame;
    renderer.show(slow);
    ASSERT_TRUE(wait_for(renderer, frame, [](const Frame& f) { return f.status.camera_rays > 0; }));
    EXPECT_FALSE(frame.status.is_done);
    EXPECT_EQ(lit_pixels(frame.pixels), 2800u);  // its first sight is whole
    EXPECT_TRUE(finished(renderer, room.wish()).status.is_done);
    renderer.show(slow);  // and the renderer's end does not wait for it
}

TEST(ProgressiveRenderer, ShowsAFirstPictureOfEachWishWhileTheViewMoves) {
    const Room room;
    ProgressiveRenderer renderer(room.lighting());
    Wish wish = room.wish();
    wish.picture.samples_per_side = 64;
    Frame frame;
    for (int step = 0; step < 5; ++step) {
        wish.view = orbited(wish.view, Vec3(0), 0.05, 0);
        const size_t number = renderer.show(wish);
        ASSERT_TRUE(wait_for(renderer, frame, [&](const Frame& f) { return f.status.wish == number; }));
        EXPECT_GT(lit_pixels(frame.pixels), 2000u);  // the rest lies in shadow
    }
}

TEST(ProgressiveRenderer, KeepsTheExposureWhenLightsGoOutUntilItIsAsked) {
    const Room room;
    ProgressiveRenderer renderer(room.lighting());
    Wish wish = room.wish();
    const double both = finished(renderer, wish).status.exposure;
    wish.radiance[0] *= 0.25;
    wish.radiance[1] *= 0.25;
    EXPECT_EQ(finished(renderer, wish).status.exposure, both);
    wish.exposure = 3;
    EXPECT_EQ(finished(renderer, wish).status.exposure, 8);
    wish.exposure.reset();
    EXPECT_EQ(finished(renderer, wish).status.exposure, both);
    ++wish.metering;
    EXPECT_NEAR(finished(renderer, wish).status.exposure, 4 * both, 1e-3 * both);
    wish.radiance.assign(2, Vec3(0));  // dark: nothing to measure, and nothing that is not finite
    ++wish.metering;
    const Frame dark = finished(renderer, wish);
    EXPECT_NEAR(dark.status.exposure, 4 * both, 1e-3 * both);
}

TEST(ProgressiveRenderer, AWindowOfNoSizeShowsNothingAndComesBack) {
    const Room room;
    ProgressiveRenderer renderer(room.lighting());
    Wish wish = room.wish();
    const Frame before = finished(renderer, wish);
    wish.picture.width = wish.picture.height = 0;
    EXPECT_TRUE(finished(renderer, wish).pixels.empty());
    wish.picture = room.settings;
    EXPECT_TRUE(finished(renderer, wish).codes.pixels == before.codes.pixels);
}

void expect_frame(const View& view) {
    EXPECT_TRUE(is_finite(view.eye) && is_finite(view.forward) && is_finite(view.right) && is_finite(view.up));
    EXPECT_NEAR(glm::length(view.forward), 1, 1e-12);
    EXPECT_NEAR(glm::length(view.right), 1, 1e-12);
    EXPECT_NEAR(glm::dot(view.forward, view.right), 0, 1e-12);
    EXPECT_NEAR(glm::length(glm::cross(view.right, view.up) + view.forward), 0, 1e-12);
}

TEST(Orbit, TurnsAboutThePivotAndStopsShortOfThePoles) {
    const Vec3 pivot(0.3, 1, -2);
    for (const double direction : {-1.0, 1.0}) {
        View view = look_at({0, 1.5, 3}, pivot, 1);
        const double distance = glm::distance(view.eye, pivot);
        for (int step = 0; step < 500; ++step) {
            view = orbited(view, pivot, 0.1, 0.05 * direction);
            expect_frame(view);
            ASSERT_NEAR(glm::distance(view.eye, pivot), distance, 1e-9 * distance);
            ASSERT_NEAR(glm::dot(view.forward, pivot - view.eye), distance, 1e-9 * distance);
            ASSERT_GE(view.up.y, 0) << "over the top";
        }
        EXPECT_GT(direction * view.forward.y, 0.999);
        const View back = orbited(view, pivot, 0, -direction);
        EXPECT_LT(direction * back.forward.y, 0.6);
    }
    View view = look_at({0, 1.5, 3}, pivot, 1);
    view = orbited(view, pivot, 1e5, 1e5);  // a wild hand
    expect_frame(view);
    EXPECT_GE(view.up.y, 0);
}

TEST(Orbit, GoesOnFromWhereTheViewIs) {
    for (const Vec3& target : {Vec3(0, -5, 0), Vec3(0, 5, 0), Vec3(1, 0.2, -3)}) {  // straight down, up, along
        const View view = look_at(Vec3(0), target, 1);
        const View still = orbited(view, {0, -2, 0}, 0, 0);
        EXPECT_NEAR(glm::length(still.forward - view.forward) + glm::length(still.right - view.right), 0, 1e-12);
        EXPECT_NEAR(glm::length(still.eye - view.eye), 0, 1e-12);
        expect_frame(orbited(view, {0, -2, 0}, 0.3, 0.2));
        expect_frame(orbited(view, view.eye, 0.3, -0.2));
        EXPECT_EQ(orbited(view, view.eye, 0.3, -0.2).eye, view.eye);
    }
    View rolled = look_at({0, 1, 3}, Vec3(0), 1);  // by a right angle
    std::swap(rolled.right, rolled.up);
    rolled.right = -rolled.right;
    EXPECT_NEAR(orbited(rolled, Vec3(0), 0.5, 0).right.y, rolled.right.y, 1e-12) << "a yaw keeps the roll";
    for (int step = 0; step < 100; ++step) expect_frame(rolled = orbited(rolled, Vec3(0), 0.2, 0.1));
    const View view = look_at({0, 1, 3}, Vec3(0), 1);
    EXPECT_EQ(orbited(view, Vec3(0), NAN, INFINITY), orbited(view, Vec3(0), 0, 0));
}

TEST(Orbit, PansInThePictureAndZoomsToThePivot) {
    const View view = look_at({0, 0, 3}, Vec3(0), 1);
    EXPECT_NEAR(glm::length(moved(view, {1, 2, 0.5}).eye - Vec3(1, 2, 2.5)), 0, 1e-12);
    EXPECT_NEAR(zoomed(view, Vec3(0), 0.5, 0.1).eye.z, 1.5, 1e-12);
    EXPECT_NEAR(zoomed(view, Vec3(0), 1e-9, 0.1).eye.z, 0.1, 1e-12);
    EXPECT_NEAR(zoomed(zoomed(view, Vec3(0), 1e-9, 0.1), Vec3(0), 2, 0.1).eye.z, 0.2, 1e-12);
    EXPECT_EQ(zoomed(view, view.eye, 0.5, 0.1), view);
    EXPECT_EQ(zoomed(view, Vec3(0), NAN, 0.1), view);
    EXPECT_EQ(zoomed(view, Vec3(0), 0, 0.1), view);
}

TEST(Choices, ComeToTheLightsAsTheyAre) {
    Room room;
    room.scene.monitors[0].radiance = {0.1, 1.0 / 3, 0.7};
    room.scene.monitors[1].radiance = Vec3(0);
    Choices choices = choices_for(room.lighting(), room.view);
    EXPECT_FALSE(choices.lamps[1].is_on);
    EXPECT_EQ(choices.lamps[1].radiance, Vec3(0.7));
    EXPECT_EQ(wish_of(choices, 2, 1).radiance[0], Vec3(0.1, 1.0 / 3, 0.7));
    EXPECT_EQ(wish_of(choices, 2, 1).radiance[1], Vec3(0));
    choices.lamps[0].is_on = false;
    EXPECT_EQ(wish_of(choices, 2, 1).radiance[0], Vec3(0));
    const auto hit = room.rays.closest_hit(room.view.eye, room.view.forward);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(glm::distance(choices.pivot, room.view.eye), hit->distance, 1e-9);
    const Scene empty;
    const RayScene no_rays(empty);
    const Choices nothing = choices_for(Lighting(empty, room.pages, no_rays, {}, {}), room.view);
    EXPECT_NEAR(glm::distance(nothing.pivot, room.view.eye), 1, 1e-12);
}

TEST(Choices, AnotherColourIsAsBright) {
    EXPECT_EQ(recolored({1, 4, 2}, {0.5, 0.25, 0}), Vec3(4, 2, 0));
    EXPECT_EQ(recolored({1, 4, 2}, Vec3(0)), Vec3(1, 4, 2));
    EXPECT_EQ(recolored({1, 4, 2}, Vec3(NAN)), Vec3(1, 4, 2));
    EXPECT_EQ(recolored({1, 4, 2}, {1, -3, 0}), Vec3(4.0 / 3, 0, 0));
}

TEST(Lighting, AnotherRadianceIsThatOfANewLighting) {
    Room room;
    Lighting lighting = room.lighting();
    set_radiance(lighting, 0, Vec3(0));
    set_radiance(lighting, 1, {0.2, 3, 1});
    room.scene.monitors[0].radiance = Vec3(0);
    room.scene.monitors[1].radiance = {0.2, 3, 1};
    const Picture changed = render(lighting, room.view, room.settings, {});
    const Picture anew = render(room.lighting(), room.view, room.settings, {});
    EXPECT_TRUE(changed.pixels.pixels == anew.pixels.pixels);
    EXPECT_EQ(changed.counts[0].unseen, changed.counts[0].points);
    set_radiance(lighting, 0, Vec3(1));
    EXPECT_FALSE(render(lighting, room.view, room.settings, {}).pixels.pixels == anew.pixels.pixels);
}

TEST(Lighting, OneRoughnessStandsForThatOfEverySurface) {
    Room room;
    const Picture overridden =
        render(room.lighting({.visibility = VisibilitySource::none, .roughness = 0.25}), room.view, room.settings, {});
    const LightingSettings plain{.visibility = VisibilitySource::none};
    const Picture own = render(room.lighting(plain), room.view, room.settings, {});
    room.scene.materials.assign(1, {});
    room.scene.materials[0].roughness = 0.25;
    for (Surface& surface : room.scene.surfaces) surface.material = 0;
    const Picture made_so = render(room.lighting(plain), room.view, room.settings, {});
    EXPECT_TRUE(overridden.pixels.pixels == made_so.pixels.pixels);
    EXPECT_FALSE(overridden.pixels.pixels == own.pixels.pixels);
}

TEST(Display, QuickCodesAreTheCodes) {
    std::vector<float> values = {0, 1, -1, NAN, INFINITY, 1e-30f, 2};
    for (int i = 0; i <= 200000; ++i) values.push_back(static_cast<float>(i) / 200000);
    for (int code = 0; code < 255; ++code) {  // where one code ends and the next begins
        auto edge = static_cast<float>(linear_from_srgb((code + 0.5) / 255));
        for (int ulp = 0; ulp < 20; ++ulp) edge = std::nextafter(edge, 0.0f);
        for (int ulp = 0; ulp < 40; ++ulp) values.push_back(edge = std::nextafter(edge, 1.0f));
    }
    for (const float value : values) {
        const double x = static_cast<double>(value);
        ASSERT_EQ(codes_of(Vec3f(value), Show::normals, 1), srgb8(Vec3(x))) << value;
        const auto curved = static_cast<double>(static_cast<float>(filmic(3 * x)));
        ASSERT_EQ(codes_of(Vec3f(value), Show::lit, 3), srgb8(Vec3(curved))) << value;
    }
}

}  // namespace
}  // namespace surimi
