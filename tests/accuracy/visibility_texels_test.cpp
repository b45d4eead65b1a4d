// SPDX-License-Identifier: Apache-2.0
// Whole small maps against texel averages of exact visibility.
#include <gtest/gtest.h>

#include <cstring>

#include "baker/texel/texel_surface.h"
#include "tests/support/occlusion_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/visibility_judge.h"

namespace surimi {
namespace {

using test::Deviations;
using test::VisibilityJudge;

constexpr double reference_error = test::is_slow_build ? 4e-3 : 5e-4;
constexpr uint32_t references = test::is_slow_build ? 128 : 1024;  // points of a texel

/// A map of one quad, and the truth of its texels.
struct Map {
    VisibilityJudge judge;
    Atlas atlas;
    Texels texels;
    std::vector<double> truth;  ///< -1: unlit

    Map(Scene scene, uint32_t quad, int size) : judge(std::move(scene)) {
        atlas = test::whole_map_atlas(judge.scene(), quad, size);
        Scene alone = judge.scene();
        for (uint32_t s = 0; s < alone.surfaces.size(); ++s)
            if (s != quad) alone.surfaces[s].triangles.clear();
        texels = find_texels(alone, atlas);
    }
    /// From `count` Sobol points, weighed by their irradiance. A grid of midpoints would be off by a whole row where a
    /// shadow's edge runs along the texel.
    void find_truth(uint32_t count) {
        truth.resize(texels.texels.size());
        parallel_for(truth.size(), 1, [&](size_t i) {
            const TexelSurface surface(judge.scene(), atlas, texels, texels.texels[i]);
            const Scrambling seeds = scrambling(hash(77, i));
            double seen = 0, all = 0;
            for (uint32_t k = 0; k < count; ++k) {
                const auto r = scrambled(sobol::point(k), seeds);
                const test::SubtractedIrradiance at = judge.truth(surface.sample(r[0], r[1]));
                seen += at.shadowed;
                all += at.unshadowed;
            }
            truth[i] = all > 0 ? seen / all : -1;
        });
    }
    Gathered gather_with(const GatherSettings& settings) const {
        return gather(judge.scene(), atlas, texels, judge.rays(), judge.silhouettes(), 0, settings, {});
    }
    Deviations deviations(const GatherSettings& settings) const {
        const Gathered gathered = gather_with(settings);
        Deviations found;
        for (size_t i = 0; i < truth.size(); ++i)
            if (truth[i] >= 0)
                found.add(test::visibility_of(gathered.estimates[i]), truth[i],
                          TexelSurface(judge.scene(), atlas, texels, texels.texels[i]).sample(0.5, 0.5));
        return found;
    }
};

/// A floor with a standing box (a contact shadow), a hovering sheet and a narrow post.
Map furnished_floor(int size) {
    Scene scene;
    const uint32_t floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    test::add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0.02, 0}, {0, 0.01, 0.45});
    test::add_box(scene, "Box", {-0.63, 0.4, 0.41}, {0.7, 0.8, 0.5});
    test::add_box(scene, "Post", {0.91, 0.75, 0.77}, {0.06, 1.5, 0.06});
    test::add_quad(scene, "Sheet", {0.1, 1.1, -0.2}, {0.9, 1.2, -0.3}, {0.8, 1.1, -1.1}, {0.2, 1.0, -1.2});
    return {std::move(scene), floor, size};
}

/// The promise: 99.9 % of texels within E, RMSE within half. `slack` is what the reference itself may be off by.
void expect_promise(const Deviations& found, double error, double slack) {
    EXPECT_LE(found.rmse(), error / 2) << found.worst;
    const auto beyond =
        std::count_if(found.errors.begin(), found.errors.end(), [&](double e) { return e > error + slack; });
    EXPECT_LE(static_cast<double>(beyond), std::max(1.0, 0.001 * static_cast<double>(found.errors.size())))
        << found.worst;
}

TEST(VisibilityTexels, KeepThePromiseOnAFurnishedFloor) {
    Map map = furnished_floor(test::is_slow_build ? 16 : 32);
    map.find_truth(references);
    for (const double error : {0.02, 0.004, 0.001}) {
        SCOPED_TRACE(error);
        GatherSettings settings;
        settings.error = error;
        const Deviations found = map.deviations(settings);
        EXPECT_GT(found.penumbra, test::cases(300));
        expect_promise(found, error, reference_error);
    }
}

TEST(VisibilityTexels, AreWithinAQuarterOfTheErrorWhenExact) {
    Map map = furnished_floor(test::is_slow_build ? 12 : 24);
    map.find_truth(references);
    GatherSettings settings;
    settings.is_exact = true;
    const Deviations found = map.deviations(settings);
    EXPECT_LE(found.rmse(), settings.error / 4) << found.worst;
    EXPECT_LE(found.quantile(0.995), settings.error);
}

TEST(VisibilityTexels, EveryMethodKeepsThePromise) {
    Map map = furnished_floor(test::is_slow_build ? 12 : 24);
    map.find_truth(references);
    for (const Method method : {Method::split, Method::scanline, Method::monte_carlo}) {
        SCOPED_TRACE(static_cast<int>(method));
        GatherSettings settings;
        settings.method = method;
        expect_promise(map.deviations(settings), settings.error, reference_error);
    }
}

TEST(VisibilityTexels, KeepThePromiseOnTheFloorOfTheStudysRoom) {
    Scene scene = test::room_with(test::Contents::low);
    const uint32_t floor =
        test::add_quad(scene, "Receiver", {-4.5, 0.01, 4.5}, {4.5, 0.01, 4.5}, {4.5, 0.01, -4.5}, {-4.5, 0.01, -4.5});
    Map map(std::move(scene), floor, 96);
    std::erase_if(map.texels.texels,
                  [](const Texel& texel) { return texel.index % (test::is_slow_build ? 670 : 67) != 5; });
    map.find_truth(references / 2);
    for (const double error : {0.02, 0.004, 0.001}) {
        SCOPED_TRACE(error);
        GatherSettings settings;
        settings.error = error;
        expect_promise(map.deviations(settings), error, 2 * reference_error);
    }
}

TEST(VisibilityTexels, AreTheSameBytesForOneThreadAndFour) {
    const Map map = furnished_floor(64);
    for (const bool is_exact : {false, true}) {
        GatherSettings settings;
        settings.is_exact = is_exact;
        settings.error = 0.001;
        set_thread_count(1);
        const Gathered one = map.gather_with(settings);
        set_thread_count(4);
        const Gathered four = map.gather_with(settings);
        set_thread_count(0);
        ASSERT_EQ(one.estimates.size(), four.estimates.size());
        for (size_t i = 0; i < one.estimates.size(); ++i) {
            EXPECT_EQ(one.estimates[i].unshadowed, four.estimates[i].unshadowed) << i;
            EXPECT_EQ(one.estimates[i].shadowed, four.estimates[i].shadowed) << i;
            EXPECT_EQ(one.estimates[i].error, four.estimates[i].error) << i;
            EXPECT_EQ(one.estimates[i].method, four.estimates[i].method) << i;
        }
        EXPECT_EQ(one.statistics.rays(), four.statistics.rays());
        EXPECT_EQ(one.statistics.segments, four.statistics.segments);
    }
}

TEST(VisibilityTexels, NothingInTheWayIsExactlyOneAndAClosedBoxExactlyZero) {
    for (const bool is_closed : {false, true}) {
        Scene scene;
        const uint32_t floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        test::add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0.02, 0}, {0, 0.01, 0.45});
        if (is_closed) test::add_box(scene, "Box", {0, 0.5, 0}, {4.5, 1.5, 4.5});
        const Map map(std::move(scene), floor, 32);
        for (const Method method : {Method::automatic, Method::split, Method::scanline, Method::monte_carlo}) {
            GatherSettings settings;
            settings.method = method;
            for (const IrradianceEstimate& e : map.gather_with(settings).estimates) {
                EXPECT_GT(e.unshadowed, 0);
                EXPECT_EQ(e.shadowed, is_closed ? 0 : e.unshadowed);
            }
        }
    }
}

TEST(VisibilityTexels, OneFacetHidesWholeBlocksForOneRayEach_M51) {
    Scene scene;
    const uint32_t floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    test::add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0.02, 0}, {0, 0.01, 0.45});
    test::add_quad(scene, "Ceiling", {-9, 1, 9}, {9, 1.125, 9}, {9, 1.25, -9}, {-9, 1.125, -9});  // in one plane
    const Map map(std::move(scene), floor, 64);
    GatherSettings settings;
    settings.error = 0.001;
    const Gathered gathered = map.gather_with(settings);
    for (const IrradianceEstimate& e : gathered.estimates) {
        EXPECT_EQ(e.method, TexelMethod::certificate);
        EXPECT_EQ(e.shadowed, 0);
    }
    EXPECT_GE(gathered.statistics.blocks, 64u * 64u / 256);
    EXPECT_EQ(gathered.statistics.shadowed_blocks, gathered.statistics.blocks);
    EXPECT_LE(gathered.statistics.rays(), gathered.statistics.blocks);
}

}  // namespace
}  // namespace surimi
