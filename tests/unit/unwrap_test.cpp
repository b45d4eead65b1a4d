// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/unwrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "runtime/base/error.h"

namespace surimi {
namespace {

Surface quad(const std::string& name, const Vec3& corner, const Vec3& u, const Vec3& v) {
    Surface surface;
    surface.name = name;
    surface.positions = {corner, corner + u, corner + u + v, corner + v};
    surface.triangles = {{0, 1, 2}, {0, 2, 3}};
    surface.uv_sets = {{}, {{0.1, 0.1}, {0.4, 0.1}, {0.4, 0.4}, {0.1, 0.4}}};
    return surface;
}

Scene quads(int count) {
    Scene scene;
    for (int i = 0; i < count; ++i)
        scene.surfaces.push_back(quad("quad" + std::to_string(i), {0, 0, i}, {1, 0, 0}, {0, 1, 0}));
    return scene;
}

/// A sphere of n x n quads of radius 1: many charts, and seams between them.
Scene ball(int n) {
    Scene scene;
    Surface surface;
    surface.name = "ball";
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j < n; ++j) {
            const double a = pi * i / n;
            const double b = 2 * pi * j / n;
            surface.positions.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
        }
    const auto at = [&](int i, int j) { return static_cast<uint32_t>(i * n + j % n); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            if (i + 1 < n) surface.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            if (i > 0) surface.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    scene.surfaces.push_back(surface);
    return scene;
}

UnwrapSettings square(int size) {
    UnwrapSettings settings;
    settings.width = settings.height = size;
    return settings;
}

double uv_area(const SurfaceUv& surface) {
    double sum = 0;
    for (const auto& t : surface.uv) {
        const Vec2 u = Vec2(t[1]) - Vec2(t[0]);
        const Vec2 v = Vec2(t[2]) - Vec2(t[0]);
        sum += 0.5 * std::abs(u.x * v.y - u.y * v.x);
    }
    return sum;
}

template <class Call>
std::string error_of(ErrorKind kind, const Call& call) {
    try {
        call();
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), kind) << e.what();
        return e.what();
    }
    ADD_FAILURE() << "no error";
    return "";
}

TEST(Unwrap, OneSquareFillsTheMap) {
    const Atlas atlas = unwrap(quads(1), square(64), {});
    ASSERT_EQ(atlas.charts.size(), 1u);
    EXPECT_GT(atlas.texels_per_metre, 63.5);
    EXPECT_LE(atlas.texels_per_metre, 64);
    EXPECT_NEAR(uv_area(atlas.surfaces[0]) * 64 * 64, std::pow(atlas.texels_per_metre, 2), 1e-3);
}

TEST(Unwrap, DensityIsAreaTrueOnCurvedCharts) {
    const Scene scene = ball(40);
    const Atlas atlas = unwrap(scene, square(256), {});
    const Surface& ball_surface = scene.surfaces[0];
    std::vector<double> space(atlas.charts.size(), 0);
    std::vector<double> flat(atlas.charts.size(), 0);
    for (size_t t = 0; t < ball_surface.triangles.size(); ++t) {
        const auto& c = ball_surface.triangles[t];
        const uint32_t chart = atlas.surfaces[0].chart[t];
        space[chart] += 0.5 * glm::length(area_normal(ball_surface.positions[c[0]], ball_surface.positions[c[1]],
                                                      ball_surface.positions[c[2]]));
        flat[chart] += uv_area({{atlas.surfaces[0].uv[t]}, {}}) * 256 * 256;
    }
    for (size_t c = 0; c < space.size(); ++c) {
        EXPECT_NEAR(std::sqrt(flat[c] / space[c]), atlas.charts[c].texels_per_metre, 1e-4 * atlas.texels_per_metre);
        EXPECT_DOUBLE_EQ(atlas.charts[c].texels_per_metre, atlas.texels_per_metre);
    }
}

TEST(Unwrap, ThreadsDoNotChangeABit) {
    const Scene scene = ball(60);
    set_thread_count(1);
    const Atlas one = unwrap(scene, square(200), {});
    set_thread_count(4);
    const Atlas four = unwrap(scene, square(200), {});
    set_thread_count(0);
    EXPECT_EQ(one.surfaces[0].uv, four.surfaces[0].uv);
    EXPECT_EQ(one.surfaces[0].chart, four.surfaces[0].chart);
    EXPECT_EQ(one.texels_per_metre, four.texels_per_metre);
}

TEST(Unwrap, FrontsThatDisagreeDoNotShareAChart) {
    Scene scene = quads(1);
    std::swap(scene.surfaces[0].triangles[1][1], scene.surfaces[0].triangles[1][2]);
    const Atlas atlas = unwrap(scene, square(64), {});
    EXPECT_EQ(atlas.charts.size(), 2u);
    EXPECT_NE(atlas.surfaces[0].chart[0], atlas.surfaces[0].chart[1]);
}

TEST(Unwrap, SizeFollowsFromDensity) {
    UnwrapSettings settings;
    settings.texels_per_metre = 10;
    const Atlas atlas = unwrap(quads(9), settings, {});
    // Nine charts of 10 + 1 texels and gutters of 2, three in a row: 37, and 40 is the next multiple of 4.
    EXPECT_EQ(atlas.width, 40);
    EXPECT_EQ(atlas.height, 40);
    EXPECT_EQ(atlas.texels_per_metre, 10);
    settings.texels_per_metre = 1e5;
    error_of(ErrorKind::usage, [&] { unwrap(quads(9), settings, {}); });
}

TEST(Unwrap, TooSmallAMapNamesTheSmallestThatWorks) {
    const std::string message = error_of(ErrorKind::usage, [] { unwrap(quads(100), square(24), {}); });
    // 10 x 10 charts of one texel with gutters of 2: 28.
    EXPECT_NE(message.find("28x28"), std::string::npos) << message;
    EXPECT_EQ(unwrap(quads(100), square(28), {}).charts.size(), 100u);
}

TEST(Unwrap, NothingToUnwrapIsAnError) {
    error_of(ErrorKind::nothing_to_bake, [] { unwrap({}, square(64), {}); });
}

TEST(Unwrap, ReportsItsStagesAndStopsWhenTold) {
    std::set<std::string> stages;
    Progress progress;
    progress.report = [&](std::string_view stage, double fraction) {
        EXPECT_TRUE(fraction >= 0 && fraction <= 1);
        stages.insert(std::string(stage));
    };
    unwrap(quads(1), square(64), progress);
    EXPECT_EQ(stages, (std::set<std::string>{"charts", "packing"}));
    progress.is_cancelled = [] { return true; };
    error_of(ErrorKind::interrupted, [&] { unwrap(quads(1), square(64), progress); });
}

UnwrapSettings existing() {
    UnwrapSettings settings = square(128);
    settings.uv = UvSource::existing;
    return settings;
}

TEST(UnwrapExisting, TakesGoodUvsAsTheyAre) {
    const Scene scene = quads(1);
    const Atlas atlas = unwrap(scene, existing(), {});
    ASSERT_EQ(atlas.charts.size(), 1u);
    EXPECT_EQ(atlas.surfaces[0].uv[1][2], Vec2f(0.1f, 0.4f));
    EXPECT_NEAR(atlas.charts[0].texels_per_metre, 0.3 * 128, 1e-4);
    EXPECT_EQ(atlas.width, 128);
}

TEST(UnwrapExisting, SeparateIslandsAreSeparateCharts) {
    Scene scene = quads(2);
    for (Vec2& uv : scene.surfaces[1].uv_sets[1]) uv += Vec2(0.5, 0);
    const Atlas atlas = unwrap(scene, existing(), {});
    EXPECT_EQ(atlas.charts.size(), 2u);
    EXPECT_EQ(atlas.charts[atlas.surfaces[1].chart[0]].surface, 1u);
}

TEST(UnwrapExisting, RefusesWhatALightmapCannotUse) {
    const auto message = [](const Scene& scene) {
        return error_of(ErrorKind::scene, [&] { unwrap(scene, existing(), {}); });
    };
    Scene scene = quads(1);
    scene.surfaces[0].uv_sets.resize(1);
    EXPECT_NE(message(scene).find("quad0"), std::string::npos);
    scene = quads(1);
    scene.surfaces[0].uv_sets[1][2] = {1.2, 0.4};
    EXPECT_NE(message(scene).find("leaves [0, 1]"), std::string::npos);
    scene.surfaces[0].uv_sets[1][2] = {std::numeric_limits<double>::quiet_NaN(), 0.4};
    EXPECT_NE(message(scene).find("finite"), std::string::npos);
    scene = quads(1);
    scene.surfaces[0].uv_sets[1][3] = {0.35, 0.2};  // folds the second triangle onto the first
    EXPECT_NE(message(scene).find("quad0 with itself: triangles 0 with 1"), std::string::npos);
    const std::string both = message(quads(2));
    EXPECT_NE(both.find("quad0"), std::string::npos);
    EXPECT_NE(both.find("quad1"), std::string::npos);
}

}  // namespace
}  // namespace surimi
