// SPDX-License-Identifier: Apache-2.0
// The frame of a lobe where implementations fail: views along the normal, and at and below the horizon.
#include <gtest/gtest.h>

#include <string>

#include "runtime/ltc/placed_lobe.h"
#include "tests/stability/hazard.h"

namespace surimi {
namespace {

using namespace hazard;

/// A view at an angle from the normal, turned about it by an azimuth.
Vec3 view_at(const Mat3& frame, double angle, double azimuth) {
    return std::cos(angle) * frame[2] + std::sin(angle) * (std::cos(azimuth) * frame[0] + std::sin(azimuth) * frame[1]);
}

/// A quad to one side of the direction `toward`, so that its edge cuts every lobe around it.
Corners half_light(const Vec3& toward, const Vec3& edge) {
    const Vec3 side = glm::cross(edge, toward);
    return {toward - 2.0 * edge, toward + 2.0 * edge, toward + 2.0 * edge + 1.5 * side,
            toward - 2.0 * edge + 1.5 * side};
}

double reflected(const Vec3& normal, const Vec3& view, double roughness, const Corners& light) {
    const PlacedLobe lobe = place_lobe(normal, view, roughness);
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(is_finite(lobe.to_cosine[k]));
    return lobe.albedo * specular_share_of_polygon(lobe, light, Vec3(0), true);
}

TEST(LobeFrame, H10_IsOrthonormalHoweverNearViewAndNormal_M16) {
    Choice choice{{10}};
    Worst along_normal, skew, length;
    for (int i = 0; i < 200; ++i)
        for (double angle = 0.1; angle > 1e-20; angle *= 0.1) {
            // As files give them: rounded to float, so of length 1 to 6e-8 only.
            const Vec3 normal(Vec3f(choice.direction()));
            const Mat3 around = frame_of_view(normal, choice.direction());
            for (const Vec3& view :
                 {view_at(around, angle, choice.between(0, 6)), Vec3(Vec3f(around[2])), normal, -normal}) {
                const Mat3 frame = frame_of_view(normal, view);
                const Vec3 n = glm::normalize(normal);
                along_normal.add(std::max(std::abs(glm::dot(frame[0], n)), std::abs(glm::dot(frame[1], n))));
                skew.add(std::abs(glm::dot(frame[0], frame[1])));
                length.add(std::max(std::abs(glm::length(frame[0]) - 1), std::abs(glm::length(frame[1]) - 1)));
                EXPECT_NEAR(glm::determinant(frame), 1, 1e-12);
            }
        }
    along_normal.expect_below(1e-15, "tangents along the normal");
    skew.expect_below(1e-15, "tangents along each other");
    length.expect_below(1e-15, "length");
}

TEST(LobeFrame, H10_TheTangentIsTheViewsShadow_M16) {
    Choice choice{{11}};
    for (int i = 0; i < 100; ++i)
        for (const double angle : {1.5, 0.3, 1e-3, 1e-6}) {
            const Mat3 around = frame_of_view(choice.direction(), choice.direction());
            const double azimuth = choice.between(0, 6);
            const Mat3 frame = frame_of_view(around[2], view_at(around, angle, azimuth));
            const Vec3 expected = std::cos(azimuth) * around[0] + std::sin(azimuth) * around[1];
            EXPECT_LT(glm::length(frame[0] - expected), 1e-15 / angle) << angle;
        }
}

TEST(LobeFrame, H10_ParallelViewMayTurn_M16) {
    Choice choice{{12}};
    Worst parallel, nearly;
    for (int i = 0; i < 100; ++i) {
        const Mat3 around = frame_of_view(choice.direction(), choice.direction());
        const Corners light = half_light(around[2], around[0]);
        for (const double roughness : {0.0, 0.01, 0.1, 0.5, 1.0}) {
            const double expected = reflected(around[2], around[2], roughness, light);
            EXPECT_GT(expected, 0.1);
            const double azimuth = choice.between(0, 6);
            // A mirror's edge is 2e-5 wide: 1e-12 moves it by 1e-7, 1e-9 by 1e-4.
            parallel.add(std::abs(reflected(around[2], view_at(around, 1e-12, azimuth), roughness, light) - expected));
            if (roughness > 0.05)
                nearly.add(std::abs(reflected(around[2], view_at(around, 1e-9, azimuth), roughness, light) - expected));
        }
    }
    parallel.expect_below(1e-6, "parallel");
    nearly.expect_below(1e-6, "1e-9");
}

TEST(LobeFrame, H11_ViewsAtAndBelowTheHorizonAreContinuous_M16) {
    Choice choice{{13}};
    Worst jump;
    for (const double roughness : {0.1, 0.25, 0.5, 0.75, 1.0})
        for (int i = 0; i < 20; ++i) {
            const Mat3 around = frame_of_view(choice.direction(), choice.direction());
            const double azimuth = choice.between(0, 6);
            // Some lights on the other side of the normal, where the lobe is, and some anywhere.
            const Vec3 mirror = view_at(around, choice.between(1, 1.5), azimuth + pi);
            const Corners light = half_light(i % 2 ? mirror : choice.direction(), choice.direction());
            double before = -1;
            for (double height = 0.003; height > -0.003; height -= 1e-4) {
                const double value =
                    reflected(around[2], view_at(around, std::acos(height), azimuth), roughness, light);
                EXPECT_TRUE(value >= 0 && value <= 1) << value;
                if (before >= 0) jump.add(std::abs(value - before));
                before = value;
            }
        }
    jump.expect_below(1e-2, "jump");
}

TEST(LobeFrame, H11_BelowTheHorizonEveryViewGivesALobe_M16) {
    Choice choice{{14}};
    for (int i = 0; i < 300; ++i) {
        const Vec3 normal = choice.direction(), view = i < 10 ? -normal : choice.direction();
        const PlacedLobe lobe = place_lobe(normal, view, choice.between(0, 1));
        EXPECT_TRUE(lobe.share_above > 0.5 && lobe.share_above <= 1 && lobe.albedo > 0 && lobe.albedo <= 1);
        EXPECT_GT(glm::determinant(lobe.to_cosine), 0);
        if (glm::dot(normal, view) >= 0 || i < 10) continue;
        const double height = glm::dot(normal, view);
        // The same as of the view that just rises above the horizon.
        const double roughness = choice.between(0, 1);
        const Vec3 level = glm::normalize(view - normal * height);
        const PlacedLobe below = place_lobe(normal, view, roughness), at = place_lobe(normal, level, roughness);
        for (int k = 0; k < 3; ++k) EXPECT_LT(glm::length(below.to_cosine[k] - at.to_cosine[k]), 1e-12);
    }
    EXPECT_EQ(place_lobe(Vec3(0), {0, 0, 1}, 0.5).albedo, 0);
    EXPECT_EQ(place_lobe({0, 0, 1}, Vec3(0), 0.5).albedo, 0);
}

}  // namespace
}  // namespace surimi
