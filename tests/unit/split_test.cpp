// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/split.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/closed_form.h"
#include "tests/support/seen_panel.h"

namespace surimi {
namespace {

using test::SeenPanel;

Segments segments_of(const std::vector<std::pair<Vec2, Vec2>>& places) {
    Segments segments;
    for (const auto& [a, b] : places) {
        segments.x0.push_back(a.x), segments.y0.push_back(a.y);
        segments.x1.push_back(b.x), segments.y1.push_back(b.y);
        segments.jump.push_back(1);
        ++segments.count;
    }
    return segments;
}

/// Splits by segments that hide nothing: how the panel falls into pieces.
struct Pieces {
    SeenPanel seen{test::occluded_scene(0, 0, 0)};
    SplitWorkspace work;

    Pieces() { seen.look_from({0.2, 0.01, 0.1}, {0, 1, 0}); }
    size_t count(const std::vector<std::pair<Vec2, Vec2>>& places) {
        const PointVisibility found = split(seen.view, segments_of(places), seen.rays, 0, work);
        EXPECT_EQ(found.visibility, 1);
        EXPECT_EQ(found.rays, work.fragments.size());
        double sum = 0;
        for (const SplitWorkspace::Fragment& fragment : work.fragments) sum += fragment.weight;
        EXPECT_NEAR(sum, contour_integral(seen.view, seen.view.open), 1e-13) << "the fragments are the panel";
        return work.fragments.size();
    }
};

TEST(Split, CutsAlongTheLinesOfSegmentsUntilNoneIsInside_M53) {
    Pieces pieces;
    EXPECT_EQ(pieces.count({}), 1u);
    EXPECT_EQ(pieces.count({{{-2, 0}, {2, 0}}}), 2u);
    EXPECT_EQ(pieces.count({{{-0.1, 0}, {0.1, 0.01}}}), 2u) << "the line of a short one goes across";
    EXPECT_EQ(pieces.count({{{-2, 0}, {2, 0}}, {{-2, 0}, {2, 0}}}), 2u) << "twice the same";
    EXPECT_EQ(pieces.count({{{-0.5, 0}, {0.4, 0}}, {{-0.3, 0}, {0.6, 0}}}), 2u) << "overlapping in one line";
    EXPECT_EQ(pieces.count({{{-2, 0.1}, {2, 0}}, {{0, -1.5}, {0.1, 1.5}}}), 4u) << "a cross";
    EXPECT_EQ(pieces.count({{{-2, 0}, {2, 0}}, {{0, 0.1}, {0, 0.3}}}), 3u) << "a short one on one side";
    EXPECT_EQ(pieces.count({{{0.1, 0.1}, {0.1, 0.1}}}), 1u) << "without length";
}

TEST(Split, FragmentsAreOfOneKindEach_M53) {
    // Rays to other places of a fragment than its middle agree: towards the middle from every corner of the open part.
    SeenPanel seen(test::occluded_scene(11, 12, 3));
    Choice choice{Random{5}};
    SplitWorkspace work;
    size_t probes = 0;
    for (int i = 0; i < 30; ++i) {
        seen.look_from_below(choice, 0);
        split(seen.view, seen.segments, seen.rays, 0, work);
        for (const SplitWorkspace::Fragment& fragment : work.fragments) {
            if (fragment.weight < 1e-3) continue;
            RayPacket packet;
            packet.add(seen.view.origin, seen.panel.at(fragment.middle), seen.view.end);
            for (int k = 0; k < 4; ++k) {
                // Until the first segment in the way.
                const Vec2 way = 0.01 * Vec2(choice.between(-1, 1), choice.between(-1, 1));
                double least = 1;
                for (size_t j = 0; j < seen.segments.count; ++j) {
                    const Vec2 a(seen.segments.x0[j], seen.segments.y0[j]), b(seen.segments.x1[j], seen.segments.y1[j]);
                    const Vec2 d = b - a, to = a - fragment.middle;
                    const double cross = way.x * d.y - way.y * d.x;
                    if (cross == 0) continue;
                    const double at = (to.x * d.y - to.y * d.x) / cross, along = (to.x * way.y - to.y * way.x) / cross;
                    if (at > 0 && along > -0.01 && along < 1.01) least = std::min(least, 0.5 * at);
                }
                packet.add(seen.view.origin, seen.panel.at(fragment.middle + least * way), seen.view.end);
            }
            const uint32_t hits = seen.rays.occluded(packet, 0);
            EXPECT_TRUE(hits == 0 || hits == 0x1f) << hits;
            ++probes;
        }
    }
    EXPECT_GT(probes, 300u);
}

TEST(Split, AHalfPlaneHidesItsShare_M53) {
    Scene scene = test::occluded_scene(0, 0, 0);
    const std::vector<Vec3> sheet = {{0.05, 1.2, 4}, {5, 1.2, 4}, {5, 1.2, -4}, {0.15, 1.2, -4}};
    test::add_quad(scene, "Half", sheet[0], sheet[1], sheet[2], sheet[3]);
    SeenPanel seen(std::move(scene));
    const test::Occluder occluder{sheet};
    SplitWorkspace work;
    Choice choice{Random{6}};
    int penumbra = 0;
    for (int i = 0; i < 100; ++i) {
        seen.look_from_below(choice, 0);
        const double exact =
            test::exact_visibility(seen.scene.monitors[0].panels[0], seen.view.origin + seen.rays.center(),
                                   seen.view.normal, std::span(&occluder, 1));
        const PointVisibility found = split(seen.view, seen.segments, seen.rays, 0, work);
        EXPECT_NEAR(found.visibility, exact, 1e-6) << "vertices of the sheet are float";
        EXPECT_EQ(found.error, 0);
        penumbra += exact > 0.01 && exact < 0.99;
    }
    EXPECT_GT(penumbra, 20);
}

TEST(Split, APanelBelowTheHorizonIsNotSeen) {
    SeenPanel seen(test::occluded_scene(0, 0, 0));
    seen.look_from({0, 0.01, 0}, {0, -1, 0});
    SplitWorkspace work;
    const PointVisibility found = split(seen.view, seen.segments, seen.rays, 0, work);
    EXPECT_EQ(found.visibility, 0);
    EXPECT_EQ(found.rays, 0u);
}

}  // namespace
}  // namespace surimi
