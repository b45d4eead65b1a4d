// SPDX-License-Identifier: Apache-2.0
// The stored table of lobes against GGX itself, against a new fit, and against the published table.
#include "runtime/ltc/table.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "runtime/ltc/fit/fit_cell.h"
#include "runtime/ltc/polygon.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

FitCell fit_cell(int column, int row) {
    return {ltc_column_alpha(column), ltc_row_cosine(row), {}};
}

TEST(LtcTable, RefittedCellsAreTheStoredOnes_M26) {
    // The simplex ends when the objective agrees to 1e-7; near the minimum that fixes the numbers to the root, 3e-4,
    // times the condition of the quadratic form (below 30 for these roughnesses).
    for (const auto& [column, row] : {std::pair{20, 20}, {32, 0}, {32, 40}, {45, 55}, {63, 30}, {50, 62}}) {
        const FitCell cell = fit_cell(column, row);
        const LtcCell stored = ltc_cell(column, row);
        const LobeShape fresh = cell.fit({1, 0, 0.3, 0.8}, stored.shape);
        EXPECT_NEAR(fresh.along, stored.shape.along, 1e-2) << column << ' ' << row;
        EXPECT_NEAR(fresh.lift, stored.shape.lift, 1e-2) << column << ' ' << row;
        EXPECT_NEAR(fresh.skew, stored.shape.skew, 1e-2) << column << ' ' << row;
        EXPECT_NEAR(fresh.depth, stored.shape.depth, 1e-2) << column << ' ' << row;
        EXPECT_NEAR(cell.error(fresh).objective / cell.error(stored.shape).objective, 1, 1e-4) << column << ' ' << row;
        EXPECT_NEAR(cell.albedo.full, stored.albedo, 1e-7);
        EXPECT_NEAR(cell.albedo.fresnel, stored.albedo * std::pow(stored.fresnel_root, 5), 1e-7);
    }
}

TEST(LtcTable, LobesAreCloserToGgxThanThePublishedTables_M26) {
    // Total variation of the published table (Heitz et al. 2016) in these cells, measured with its own albedo: columns
    // of roughness .063 to 1, rows of 0 to 90 degrees. Its last row was fitted at 89.95 degrees, ours at 89.994.
    constexpr std::array<int, 8> columns = {4, 8, 16, 24, 32, 40, 48, 63}, rows = {0, 24, 40, 48, 56, 60, 62, 63};
    constexpr std::array<std::array<double, 8>, 8> published = {{{.000, .000, .005, .008, .017, .017, .014, .015},
                                                                 {.000, .001, .007, .018, .036, .054, .050, .017},
                                                                 {.002, .006, .027, .063, .101, .114, .089, .023},
                                                                 {.003, .013, .055, .119, .160, .152, .113, .029},
                                                                 {.008, .034, .135, .228, .243, .202, .137, .045},
                                                                 {.020, .082, .255, .314, .297, .238, .161, .070},
                                                                 {.061, .220, .360, .371, .334, .264, .180, .092},
                                                                 {.75, .67, .44, .41, .36, .28, .19, .12}}};
    for (size_t i = 0; i < 8; ++i)
        for (size_t j = 0; j < 8; ++j) {
            const double error =
                fit_cell(columns[j], rows[i]).error(ltc_cell(columns[j], rows[i]).shape).total_variation;
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

using Quad = std::array<Vec3, 4>;

/// What the table says that a quad of radiance 1 reflects: cut at the horizon, transformed, normalised again.
double reflected(const Quad& quad, const LtcLobe& lobe) {
    std::vector<Vec3> above;
    for (size_t i = 0; i < 4; ++i) {
        const Vec3 a = quad[i], b = quad[(i + 1) % 4];
        if (a.z >= 0) above.push_back(lobe.inverse * a);
        if ((a.z >= 0) != (b.z >= 0)) above.push_back(lobe.inverse * (a + (b - a) * (a.z / (a.z - b.z))));
    }
    if (above.size() < 3) return 0;
    const double share = irradiance_of_polygon<double>(above, Vec3(0), {0, 0, 1}, true) / pi;
    return lobe.albedo * share / (1 - lobe.leak);
}

bool is_hit(const Quad& q, const Vec3& w) {
    const Vec3 u = q[1] - q[0], v = q[3] - q[0], normal = glm::cross(u, v);
    const double t = glm::dot(normal, q[0]) / glm::dot(normal, w);
    if (!(t > 0)) return false;
    const Vec3 p = t * w - q[0];
    const double a = glm::dot(glm::cross(p, v), normal), b = glm::dot(glm::cross(u, p), normal);
    const double size = glm::dot(normal, normal);
    return a >= 0 && a <= size && b >= 0 && b <= size;
}

/// A parallelogram in front of the point, around where the lobe is or anywhere above the horizon.
Quad random_quad(Random& random, double alpha, const Vec3& view) {
    const auto some = [&] { return 2 * random.next() - 1; };
    const bool is_aimed = random.next() < 0.7;
    Vec3 toward = sample_ggx(alpha, view, random.next(), random.next());
    if (!is_aimed || toward.z < 0) toward = normalize_or({some(), some(), random.next()}, {0, 0, 1});
    const double size = 0.1 + 0.9 * random.next();
    const Vec3 u = size * normalize_or({some(), some(), some()}, {1, 0, 0});
    const Vec3 v = size * (0.3 + random.next()) * normalize_or(glm::cross(u, Vec3(some(), some(), some())), {0, 1, 0});
    return {toward - u - v, toward + u - v, toward + u + v, toward - u + v};
}

TEST(LtcTable, RandomQuadLightsAreReflectedAsByGgx_M26) {
    // Root mean square errors of random quads that research found for the published table and for its own fit with the
    // same exponent. Its quads are not ours, so the second is a bar with a margin of 1.5; the first must be beaten.
    struct Case {
        double roughness, degrees, published, fitted;
    };
    for (const Case& c : {Case{.15, 80, .0175, .0061},
                          {.25, 65, .0147, .0057},
                          {.25, 80, .0420, .0252},
                          {.40, 45, .0062, .0033},
                          {.40, 65, .0243, .0091},
                          {.40, 80, .0810, .0201},
                          {.60, 45, .0075, .0022},
                          {.60, 65, .0263, .0054},
                          {.60, 80, .0377, .0103},
                          {.80, 65, .0054, .0034}}) {
        const double alpha = c.roughness * c.roughness, cosine = std::cos(c.degrees * pi / 180);
        const Vec3 view(std::sqrt(1 - cosine * cosine), 0, cosine);
        const LtcLobe lobe = ltc_lobe(c.roughness, cosine);
        const std::vector<GgxNode> nodes = ggx_nodes(alpha, cosine, 160, 160);
        Random random{31};
        double squares = 0, sum = 0;
        constexpr int count = 100;
        for (int i = 0; i < count; ++i) {
            const Quad quad = random_quad(random, alpha, view);
            double truth = 0;
            for (const GgxNode& node : nodes) {
                const Vec3 mirror(node.light.x, -node.light.y, node.light.z);
                truth += node.value * node.weight * 0.5 * (is_hit(quad, node.light) + is_hit(quad, mirror));
            }
            const double error = reflected(quad, lobe) - truth;
            squares += error * error;
            sum += truth;
        }
        const double rms = std::sqrt(squares / count);
        EXPECT_GT(sum / count, 0.02);
        EXPECT_LT(rms, 1.5 * c.fitted) << c.roughness << ' ' << c.degrees << ", mean " << sum / count;
        EXPECT_LT(rms, c.published) << c.roughness << ' ' << c.degrees;
        RecordProperty("rms_" + std::to_string(c.roughness) + '_' + std::to_string(c.degrees), std::to_string(rms));
    }
}

TEST(LtcTable, NodesAreExactAndTheirNeighboursBlend_M27) {
    for (const auto& [column, row] : {std::pair{1, 0}, {17, 31}, {40, 50}, {63, 62}}) {
        const double roughness = column / 63.0;
        const LtcLobe lobe = ltc_lobe(roughness, ltc_row_cosine(row));
        const LtcCell cell = ltc_cell(column, row);
        const Mat3 expected = inverse_matrix(cell.shape, ltc_column_alpha(column), ltc_row_cosine(row));
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
        EXPECT_NEAR(lobe.fresnel, truth.fresnel, tolerance) << roughness << ' ' << cosine;
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
                    worst = std::max(worst, cell.error(ltc_cell(column + i, row + j).shape).total_variation);
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
