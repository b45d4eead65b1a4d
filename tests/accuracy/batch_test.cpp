// SPDX-License-Identifier: Apache-2.0
// Batches against exact shares in long double, with every instruction set, over the hazards and in rooms.
#include "runtime/batch/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "runtime/batch/arctangent.h"
#include "runtime/ltc/polygon.h"
#include "runtime/ltc/table.h"
#include "tests/support/random.h"
#include "tests/support/shading_cases.h"

namespace surimi {
namespace {

using test::ShadingCase;

/// Every test leaves the best instruction set in use.
class BatchAccuracy : public testing::Test {
  protected:
    void TearDown() override { use_instruction_set(""); }
};

ShareBatch shares_of(const PointBatch& points, const std::vector<Vec3>& corners, Precision precision,
                     bool two_sided = true) {
    LobeBatch lobes;
    place_lobes(points, lobes);
    ShareBatch shares{std::vector<double>(points.size()), std::vector<double>(points.size()), 0};
    add_polygon(points, lobes, corners, two_sided, Terms::both, precision, {}, shares);
    return shares;
}

PointBatch single(const Vec3& point, const Vec3& normal, const Vec3& view, double roughness) {
    PointBatch batch;
    batch.position.push_back(point);
    batch.normal.push_back(normal);
    batch.view.push_back(view);
    batch.roughness.push_back(roughness);
    return batch;
}

double worst(const std::vector<double>& values, const std::vector<double>& exact) {
    double error = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        const double here = std::abs(values[i] - exact[i]);
        error = here <= error ? error : here;  // a NaN stays
    }
    return error;
}

void expect_families_below(Precision precision, double tolerance) {
    const auto families = test::shading_families(200, 9);
    ASSERT_EQ(families.size(), 11U);
    for (const std::string& set : instruction_sets()) {
        use_instruction_set(set);
        for (const test::ShadingFamily& family : families) {
            double diffuse = 0, specular = 0, lit = 0;
            for (const ShadingCase& c : family.cases) {
                const ShareBatch shares = shares_of(c.points, c.corners, precision);
                diffuse = std::max(diffuse, worst(shares.diffuse, c.diffuse));
                specular = std::max(specular, worst(shares.specular, c.specular));
                lit += std::accumulate(c.specular.begin(), c.specular.end(), 0.0);
                EXPECT_EQ(shares.not_finite, 0U);
            }
            EXPECT_LE(diffuse, tolerance) << set << ' ' << family.name;
            EXPECT_LE(specular, tolerance) << set << ' ' << family.name;
            if (family.name != "H5 no area") {
                EXPECT_GT(lit, 1e-3) << family.name;  // there is something to be wrong about
            }
            char text[64];
            std::snprintf(text, sizeof text, "diffuse %.1e specular %.1e", diffuse, specular);
            testing::Test::RecordProperty(set + " " + family.name, text);
        }
    }
}

// An edge that passes the point, or the lobe's middle, at 1e-6 of its length turns by 1e-16 / 1e-6; the lobe at the
// least roughness narrows directions by another 2e-5, which only few of the random lights meet together.
TEST_F(BatchAccuracy, FullIsExactInEveryHazard_M14) {
    expect_families_below(Precision::full, 1e-9);
}

// 7 roundings of 2^-24 of at most one turn in all: 4.2e-7 (M15).
TEST_F(BatchAccuracy, MixedKeepsSevenDigitsInEveryHazard_M15) {
    expect_families_below(Precision::mixed, 4.2e-7);
}

TEST_F(BatchAccuracy, H3_MixedKeepsDigitsOfTinyLights_M15) {
    Random random{3};
    const auto number = [&] { return 2 * random.next() - 1; };
    for (const std::string& set : instruction_sets()) {
        use_instruction_set(set);
        for (const double size : {1e-1, 2e-2, 1e-3, 1e-5}) {
            double error = 0;
            for (int i = 0; i < 300; ++i) {
                // Facing the point roughly, and above its horizon.
                const Vec3 centre(number(), number(), 2), n = normalize_or({0.3 * number(), 0.3 * number(), 1}, centre);
                const Vec3 view = normalize_or({0.5, 0.2 * number(), 1}, n);
                const Vec3 u = size * Vec3(1, 0.2 * number(), 0.3 * number()), v = size * Vec3(0.2 * number(), 1, 0);
                const std::vector<Vec3> corners = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
                const ShareBatch shares = shares_of(single(Vec3(0), n, view, 1), corners, Precision::mixed);
                error = std::max(error, std::abs(shares.diffuse[0] / test::exact_diffuse(corners, Vec3(0), n) - 1));
                const double specular = test::exact_specular(corners, Vec3(0), n, view, 1);
                error = std::max(error, std::abs(shares.specular[0] / specular - 1));
            }
            // Four edges of angle t, 0.8 size at least, err by up to 7 x 2^-24 of t / 2 pi each; the share is t^2 / pi
            // times the two cosines, 1/3 at least. Below 0.01 rad everything is double.
            EXPECT_LT(error, size < 5e-3 ? 1e-9 : 2.6e-6 / (0.8 * size)) << set << ' ' << size;
            EXPECT_GT(error, 0);
        }
    }
}

TEST_F(BatchAccuracy, DiffuseIsTheScalarPath_M1) {
    const auto families = test::shading_families(40, 5);
    for (const std::string& set : instruction_sets()) {
        use_instruction_set(set);
        for (const test::ShadingFamily& family : families)
            for (const ShadingCase& c : family.cases)
                for (const bool two_sided : {false, true}) {
                    const ShareBatch shares = shares_of(c.points, c.corners, Precision::full, two_sided);
                    for (size_t i = 0; i < c.points.size(); ++i) {
                        const double scalar = irradiance_of_polygon<double>(c.corners, c.points.position[i],
                                                                            c.points.normal[i], two_sided);
                        EXPECT_NEAR(shares.diffuse[i], scalar / pi, 1e-9) << set << ' ' << family.name;
                    }
                }
    }
}

TEST_F(BatchAccuracy, LobesAreThoseOfTheTable_M24) {
    Random random{24};
    PointBatch points;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 n = normalize_or({random.next() - 0.5, random.next() - 0.5, random.next() - 0.5}, {0, 0, 1});
        const Vec3 v = normalize_or({random.next() - 0.5, random.next() - 0.5, random.next() - 0.5}, {0, 0, 1});
        points.position.push_back(Vec3(0));
        points.normal.push_back(n);
        points.view.push_back(v);
        points.roughness.push_back(1.2 * random.next() - 0.1);
    }
    for (const std::string& set : instruction_sets())
        for (const LobePart part : {LobePart::full, LobePart::schlick}) {
            use_instruction_set(set);
            LobeBatch lobes;
            place_lobes(points, lobes, part);
            for (size_t i = 0; i < points.size(); ++i) {
                const Vec3 n = points.normal[i], v = points.view[i], t = lobes.tangent[i];
                const LtcLobe lobe = ltc_lobe(points.roughness[i], glm::dot(n, v), part);
                const double scale = std::max(1.0, std::abs(lobe.inverse[2].z));
                EXPECT_NEAR(lobes.xx[i], lobe.inverse[0].x, 1e-13 * scale);
                EXPECT_NEAR(lobes.xz[i], lobe.inverse[2].x, 1e-13 * scale);
                EXPECT_NEAR(lobes.zx[i], lobe.inverse[0].z, 1e-13 * scale);
                EXPECT_NEAR(lobes.zz[i], lobe.inverse[2].z, 1e-13 * scale);
                EXPECT_NEAR(lobes.share_above[i], 1 - lobe.leak, 1e-13 * scale);
                EXPECT_NEAR(lobes.albedo[i], lobe.albedo, 1e-13);
                EXPECT_NEAR(glm::length(t), 1, 1e-15);
                EXPECT_NEAR(glm::dot(t, n), 0, 1e-15);
                EXPECT_NEAR(glm::dot(glm::cross(n, v), t), 0, 1e-15);
                EXPECT_GE(glm::dot(t, v), 0);
            }
        }
}

TEST_F(BatchAccuracy, PolygonsOfThreeToEightCorners_M14) {
    Random random{14};
    for (const std::string& set : instruction_sets()) {
        use_instruction_set(set);
        for (int count = 3; count <= 8; ++count)
            for (int i = 0; i < 50; ++i) {
                std::vector<Vec3> corners;
                const Vec3 centre(2 * random.next() - 1, 2 * random.next() - 1, random.next() - 0.3);
                const double tilt = random.next() - 0.5;
                for (int k = 0; k < count; ++k) {
                    const double turn = -2 * pi * k / count;
                    corners.push_back(centre +
                                      Vec3(std::cos(turn), std::sin(turn), tilt * std::sin(turn)) * (0.2 + 0.1 * tilt));
                }
                const double roughness = random.next();
                const Vec3 n(0, 0, 1), v = normalize_or({random.next(), random.next() - 0.5, 0.5}, n);
                const PointBatch points = single(Vec3(0), n, v, roughness);
                const double diffuse = test::exact_diffuse(corners, Vec3(0), n);
                const double specular = test::exact_specular(corners, Vec3(0), n, v, roughness);
                const ShareBatch full = shares_of(points, corners, Precision::full);
                EXPECT_NEAR(full.diffuse[0], diffuse, 1e-12);
                EXPECT_NEAR(full.specular[0], specular, 1e-11);
                const ShareBatch mixed = shares_of(points, corners, Precision::mixed);
                EXPECT_NEAR(mixed.diffuse[0], diffuse, 4.2e-7);
                EXPECT_NEAR(mixed.specular[0], specular, 4.2e-7);
            }
    }
}

TEST_F(BatchAccuracy, ArctangentPolynomialsKeepTheirDigits_M15) {
    const auto error = [](auto type) {
        using T = decltype(type);
        const auto& k = arctangent<T>;
        long double most = 0;
        for (int i = 1; i <= 10000; ++i) {
            const long double r = static_cast<long double>(arctangent_end) * i / 10000, r2 = r * r;
            long double sum = 0;
            for (size_t j = k.size(); j-- > 0;) sum = sum * r2 + static_cast<long double>(k[j]);
            most = std::max(most, std::abs((r + r * r2 * sum) / std::atan(r) - 1));
        }
        return static_cast<double>(most);
    };
    EXPECT_LT(error(0.0), 1.0e-15);
    EXPECT_LT(error(0.0f), 4e-9);  // the coefficients' own rounding to float is most of it
    EXPECT_DOUBLE_EQ(arctangent_end, std::tan(pi / 8));
}

TEST_F(BatchAccuracy, H10_ViewsAlongTheNormal_M24) {
    const std::vector<Vec3> light = {{-0.3, -0.4, 2}, {-0.3, 0.5, 2.1}, {0.6, 0.5, 2.1}, {0.6, -0.4, 2}};
    for (const std::string& set : instruction_sets()) {
        use_instruction_set(set);
        for (const Vec3& n : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, -1, 0), normalize_or({1, 2, 3}, {0, 0, 1})})
            for (const double angle : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-14, 1e-17, 0.0}) {
                const Vec3 side = normalize_or(glm::cross(n, Vec3(0.3, 0.9, -0.2)), {1, 0, 0});
                double least = 1, most = 0;
                for (double turn = 0; turn < 6; turn += 0.37) {
                    const Vec3 away = std::cos(turn) * side + std::sin(turn) * glm::cross(n, side);
                    const Vec3 v = normalize_or(n + angle * away, n);
                    const PointBatch points = single(Vec3(0), n, v, 0.3);
                    LobeBatch lobes;
                    place_lobes(points, lobes);
                    EXPECT_NEAR(glm::dot(lobes.tangent[0], n), 0, 1e-15) << set << ' ' << angle;
                    EXPECT_NEAR(glm::length(lobes.tangent[0]), 1, 1e-15) << set << ' ' << angle;
                    const double share = shares_of(points, light, Precision::full).specular[0];
                    least = std::min(least, share);
                    most = std::max(most, share);
                }
                if (angle <= 1e-7) {
                    EXPECT_LT(most - least, 1e-6) << set << ' ' << angle;
                }
            }
        EXPECT_GT(shares_of(single(Vec3(0), {0, 0, 1}, {0, 0, 1}, 0.3), light, Precision::full).specular[0], 0.5);
    }
}

TEST_F(BatchAccuracy, H11_ViewsBelowTheHorizonGoOnFromThoseAbove) {
    const std::vector<Vec3> light = {{-3, -1, 0.5}, {-3, -1, 2}, {-3, 1, 2}, {-3, 1, 0.5}};  // shines to +x
    const Vec3 n(0, 0, 1);
    for (const double roughness : {0.1, 0.5, 1.0}) {
        double before = -1;
        for (double height = 0.002; height >= -0.002; height -= 1e-4) {
            const PointBatch points = single(Vec3(0), n, normalize_or({1, 0, height}, n), roughness);
            const double share = shares_of(points, light, Precision::full, false).specular[0];
            EXPECT_TRUE(share >= 0 && share <= 1);
            if (before >= 0) {
                EXPECT_NEAR(share, before, 1e-2) << roughness << ' ' << height;
            }
            before = share;
        }
        const auto share_of = [&](const Vec3& view) {
            return shares_of(single(Vec3(0), n, view, roughness), light, Precision::full, false).specular[0];
        };
        const Vec3 least = normalize_or({std::sqrt(1 - ltc_least_cosine * ltc_least_cosine), 0, ltc_least_cosine}, n);
        EXPECT_NEAR(share_of(normalize_or({1, 0, -0.4}, n)), share_of(least), 1e-9);
        const double below = share_of(-n);
        EXPECT_TRUE(below >= 0 && below <= 1);
    }
}

TEST_F(BatchAccuracy, H28_LightsBelowTheHorizonAreNotReflected_M25) {
    Random random{28};
    double leaking = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3 n(0, 0, 1), v = normalize_or({random.next(), random.next() - 0.5, 0.2 * random.next()}, n);
        const Vec3 centre(-2 * random.next(), random.next() - 0.5, -0.6 * random.next());
        const double h = -centre.z;  // its upper edge is on the horizon or below it
        const std::vector<Vec3> light = {centre + Vec3(0, -1, -1), centre + Vec3(0, -1, h * (i % 2)),
                                         centre + Vec3(0, 1, h * (i % 2)), centre + Vec3(0, 1, -1)};
        const double roughness = random.next();
        for (const Precision precision : {Precision::full, Precision::mixed}) {
            const ShareBatch shares = shares_of(single(Vec3(0), n, v, roughness), light, precision);
            EXPECT_EQ(shares.specular[0], 0);
            EXPECT_EQ(shares.diffuse[0], 0);
        }
        leaking += ltc_lobe(roughness, v.z).leak;
    }
    EXPECT_GT(leaking, 0.1);  // lobes did reach below
}

TEST_F(BatchAccuracy, TheWholeSkyFillsEveryLobe_M25) {
    const double far = 1e7;
    const std::vector<Vec3> sky = {{-far, -far, 1}, {-far, far, 1}, {far, far, 1}, {far, -far, 1}};
    for (const double roughness : {0.1, 0.5, 1.0})
        for (const double height : {0.05, 0.5, 2.0}) {
            const PointBatch points = single(Vec3(0), {0, 0, 1}, normalize_or({1, 0.3, height}, {0, 0, 1}), roughness);
            for (const Precision precision : {Precision::full, Precision::mixed}) {
                const ShareBatch shares = shares_of(points, sky, precision, false);
                EXPECT_NEAR(shares.diffuse[0], 1, 1e-6);
                EXPECT_NEAR(shares.specular[0], 1, 1e-5) << roughness << ' ' << height;
            }
        }
}

}  // namespace
}  // namespace surimi
