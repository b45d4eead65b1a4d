// SPDX-License-Identifier: Apache-2.0
// The stored table of lobes against GGX itself, against a new fit, and against the published table.
#include "runtime/ltc/table.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <limits>

#include "runtime/ltc/fit/fit_cell.h"
#include "runtime/ltc/polygon.h"
#include "tests/support/published_fit.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

FitCell fit_cell(int column, int row, LobePart part = LobePart::full) {
    return {ltc_column_alpha(column), ltc_row_cosine(row), {}, part};
}

TEST(LtcTable, RefittedCellsAreTheStoredOnes_M26) {
    // The simplex ends when the objective agrees to 1e-7; near the minimum that fixes the numbers to the root, 3e-4,
    // times the condition of the quadratic form (below 30 for these roughnesses).
    for (const auto& [column, row] : {std::pair{20, 20}, {32, 0}, {32, 40}, {45, 55}, {63, 30}, {50, 62}}) {
        const FitCell cell = fit_cell(column, row);
        const LtcCell stored = ltc_cell(column, row);
        const LobeShape fresh = cell.fit({1, 0, 0.3, 0.8}, stored.full);
        EXPECT_NEAR(fresh.along, stored.full.along, 1e-2) << column << ' ' << row;
        EXPECT_NEAR(fresh.lift, stored.full.lift, 1e-2) << column << ' ' << row;
        EXPECT_NEAR(fresh.skew, stored.full.skew, 1e-2) << column << ' ' << row;
        EXPECT_NEAR(fresh.depth, stored.full.depth, 1e-2) << column << ' ' << row;
        EXPECT_NEAR(cell.error(fresh).objective / cell.error(stored.full).objective, 1, 1e-4) << column << ' ' << row;
        EXPECT_NEAR(cell.albedo.full, stored.albedo, 1e-7);
        EXPECT_NEAR(cell.albedo.fresnel, stored.albedo * std::pow(stored.fresnel_root, 5), 1e-7);
    }
}

TEST(LtcTable, LobesAreCloserToGgxThanThePublishedTables_M26) {
    constexpr auto columns = test::compared_columns, rows = test::compared_rows;
    constexpr auto published = test::published_total_variation;
    for (size_t i = 0; i < 8; ++i)
        for (size_t j = 0; j < 8; ++j) {
            const double error =
                fit_cell(columns[j], rows[i]).error(ltc_cell(columns[j], rows[i]).full).total_variation;
            // The figures are rounded. At normal incidence both have one free number and differ in the exponent of the
            // error only, and the published albedo there is 1 % off in the direction that lowers this error; fully
            // rough lobes hardly differ either.
            const double rounding = i == 7 ? 0.005 : 0.001;
            const double slack = i == 0 ? 0.002 : 0;
            EXPECT_LE(error, published[i][j] + rounding + slack) << "row " << rows[i] << " column " << columns[j];
            const bool is_hard = i > 0 && j >= 2 && j < 7;
            const double bar = is_hard ? 0.92 * published[i][j] : std::numeric_limits<double>::infinity();
            EXPECT_LT(error, bar) << "row " << rows[i] << " column " << columns[j];
        }
}

/// A light of random place and size around the mirror direction, all above the horizon.
std::vector<Vec3> light_near(const Vec3& mirror, Random& random) {
    const double elevation = std::max(0.15, std::asin(mirror.z) + 0.6 * (random.next() - 0.5));
    const double azimuth = 0.8 * (random.next() - 0.5);
    const Vec3 d(-std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                 std::sin(elevation));
    const Vec3 u = normalize_or(glm::cross(Vec3(0, 0, 1), d), {0, 1, 0}), v = glm::cross(d, u);
    const double a = 0.1 + 0.3 * random.next(), b = std::min(0.1 + 0.2 * random.next(), 0.9 * d.z / v.z);
    return {d - a * u - b * v, d + a * u - b * v, d + a * u + b * v, d - a * u + b * v};
}

bool is_seen_through(const std::vector<Vec3>& light, const Vec3& w) {
    bool is_left = true, is_right = true;
    for (size_t i = 0; i < 4; ++i) {
        const double side = glm::dot(glm::cross(light[i], light[(i + 1) % 4]), w);
        is_left = is_left && side >= 0;
        is_right = is_right && side <= 0;
    }
    return (is_left || is_right) && glm::dot(w, light[0] + light[2]) > 0;
}

double share_of(const LtcLobe& lobe, const std::vector<Vec3>& light) {
    std::vector<Vec3> corners;
    for (const Vec3& corner : light) corners.push_back(lobe.inverse * corner);
    return irradiance_of_polygon<double>(corners, Vec3(0), {0, 0, 1}, true) / pi / (1 - lobe.leak);
}

TEST(LtcTable, TwoLobesShowDielectricsThatOneDoesNot_M30) {
    // A dielectric (F0 0.04) in the light of random quads, against GGX with Schlick's reflectance inside the integral.
    Random random{30};
    for (const double roughness : {0.2, 0.3, 0.4, 0.5, 0.7})
        for (const double degrees : {45.0, 60.0, 70.0, 80.0}) {
            const double cosine = std::cos(degrees * pi / 180), alpha = roughness * roughness;
            const std::vector<GgxNode> nodes = ggx_nodes(alpha, cosine, 256, 256);
            const LtcLobe full = ltc_lobe(roughness, cosine), schlick = ltc_lobe(roughness, cosine, LobePart::schlick);
            double one = 0, two = 0, norm = 0;
            for (int k = 0; k < 40; ++k) {
                const auto light = light_near({-std::sin(degrees * pi / 180), 0, cosine}, random);
                double truth = 0;
                for (const GgxNode& node : nodes)
                    for (const double side : {1.0, -1.0})
                        if (is_seen_through(light, {node.light.x, side * node.light.y, node.light.z}))
                            truth += node.value * node.weight / 2 * (0.04 + 0.96 * std::pow(1 - node.half_cosine, 5));
                const double share = share_of(full, light);
                const double by_one = (0.04 * full.albedo + 0.96 * schlick.albedo) * share;
                const double by_two = 0.04 * full.albedo * share + 0.96 * schlick.albedo * share_of(schlick, light);
                one += (by_one - truth) * (by_one - truth);
                two += (by_two - truth) * (by_two - truth);
                norm += truth * truth;
            }
            one = std::sqrt(one / norm), two = std::sqrt(two / norm);
            std::printf("roughness %.1f, %.0f degrees: error with one lobe %.3f, with two %.3f\n", roughness, degrees,
                        one, two);
            EXPECT_LT(two, 0.5 * one) << roughness << ' ' << degrees;
            EXPECT_LT(two, 0.1) << roughness << ' ' << degrees;
        }
}

TEST(LtcTable, SchlicksLobeIsFittedWhereItIsSeen_M26) {
    // Where it carries more than a tenth of a dielectric's highlight its own lobe is never worse than the full part's,
    // and leaves a third of that one's error on the mean.
    int checked = 0;
    double sum_own = 0, sum_by_full = 0;
    for (const int row : {24, 32, 40, 48, 56, 60, 62})
        for (const int column : {8, 16, 24, 32, 40, 48, 56, 63}) {
            const FitCell cell = fit_cell(column, row, LobePart::schlick);
            if (cell.albedo.fresnel < 0.004 * cell.albedo.full) continue;
            const double own = cell.error(ltc_cell(column, row).schlick).total_variation;
            const double by_full = cell.error(ltc_cell(column, row).full).total_variation;
            EXPECT_LT(own, std::max(0.02, by_full)) << column << ' ' << row;
            sum_own += own;
            sum_by_full += by_full;
            EXPECT_LT(own, 0.3) << column << ' ' << row;
            ++checked;
        }
    EXPECT_GT(checked, 30);
    EXPECT_LT(sum_own, sum_by_full / 3);
    const LtcCell stored = ltc_cell(32, 48);
    const FitCell cell = fit_cell(32, 48, LobePart::schlick);
    const LobeShape fresh = cell.fit({1, 0.3, -0.3, 0.6}, stored.schlick);
    EXPECT_NEAR(cell.error(fresh).objective / cell.error(stored.schlick).objective, 1, 5e-3);
}

TEST(LtcTable, NodesAreExactAndTheirNeighboursBlend_M27) {
    for (const auto& [column, row] : {std::pair{1, 0}, {17, 31}, {40, 50}, {63, 62}}) {
        const double roughness = column / 63.0;
        const LtcLobe lobe = ltc_lobe(roughness, ltc_row_cosine(row));
        const LtcCell cell = ltc_cell(column, row);
        const Mat3 expected = inverse_matrix(cell.full, ltc_column_alpha(column), ltc_row_cosine(row));
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(glm::length(lobe.inverse[k] - expected[k]), 1e-12) << column << ' ' << row;
        EXPECT_NEAR(lobe.albedo, cell.albedo, 1e-12);
        EXPECT_NEAR(lobe.leak, lobe_below_horizon(expected), 1e-12);
    }
}

TEST(LtcTable, AlbedoBetweenNodesIsGgxs_M27) {
    // Linear interpolation leaves an eighth of the second difference; the worst is in the last rows, where the albedo
    // turns within N.V = alpha.
    Random random{27};
    for (int i = 0; i < 150; ++i) {
        const double roughness = random.next(), cosine = i % 3 ? random.next() : 0.15 * random.next();
        const GgxAlbedo truth = ggx_albedo(std::max(ltc_least_alpha, roughness * roughness), cosine);
        const LtcLobe lobe = ltc_lobe(roughness, cosine);
        const double tolerance = cosine > 0.1 ? 2e-3 : 0.04;
        EXPECT_NEAR(lobe.albedo, truth.full, tolerance) << roughness << ' ' << cosine;
        EXPECT_NEAR(ltc_lobe(roughness, cosine, LobePart::schlick).albedo, truth.fresnel, tolerance)
            << roughness << ' ' << cosine;
    }
}

TEST(LtcTable, LobesBetweenNodesAreAsCloseAsThoseAtNodes_M27) {
    // Half-way between four nodes, the total variation exceeds the worst of the four by less than 0.005 (below 0.02 in
    // the last row, where lobes change within N.V = alpha).
    int checked = 0;
    for (int row = 0; row < 63; row += 6)
        for (int column = 1; column < 63; column += 7) {
            double worst = 0;
            for (int i = 0; i < 2; ++i)
                for (int j = 0; j < 2; ++j) {
                    const FitCell cell = fit_cell(column + i, row + j);
                    worst = std::max(worst, cell.error(ltc_cell(column + i, row + j).full).total_variation);
                }
            const double u = (column + 0.5) / 63, v = (row + 0.5) / 63, cosine = 1 - v * v;
            const FitCell middle(u * u, cosine, {});
            const LtcLobe lobe = ltc_lobe(u, cosine);
            EXPECT_LT(middle.error(lobe.inverse).total_variation, worst + 0.005) << column << ' ' << row;
            ++checked;
        }
    EXPECT_GT(checked, 90);
}

}  // namespace
}  // namespace surimi
