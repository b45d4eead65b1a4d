// SPDX-License-Identifier: Apache-2.0
// Every number that enters runtime/ltc as NaN or infinity gives a defined result and raises FE_INVALID; none that is
// finite does (research/ltc.md, section 2: H15).
#include <gtest/gtest.h>

#include <cfenv>
#include <functional>
#include <limits>
#include <string>

#include "runtime/ltc/line.h"
#include "runtime/ltc/placed_lobe.h"
#include "runtime/ltc/table.h"
#include "tests/stability/hazard.h"

namespace surimi {
namespace {

using namespace hazard;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array<double, 3> bad_numbers = {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity};

/// Takes numbers off a list, one after the other.
struct Numbers {
    const std::vector<double>& list;
    size_t at = 0;
    double number() { return list[at++]; }
    Vec3 vector() {
        const double x = number(), y = number(), z = number();
        return {x, y, z};
    }
    Corners corners() {
        Corners result;
        for (int i = 0; i < 4; ++i) result.push_back(vector());
        return result;
    }
    PlacedLobe lobe() {
        PlacedLobe lobe;
        for (int i = 0; i < 3; ++i) lobe.to_cosine[i] = vector();
        lobe.normal = vector();
        lobe.share_above = number();
        return lobe;
    }
    Ellipse<double> ellipse() {
        const Vec3 centre = vector(), u = vector(), v = vector();
        return {centre, u, v};
    }
    Ellipsoid<double> ellipsoid() {
        const Ellipse<double> e = ellipse();
        return {e.centre, {e.half_u, e.half_v, vector()}};
    }
    Cylinder<double> cylinder() {
        const Vec3 from = vector(), to = vector();
        return {from, to, number()};
    }
};

/// A public function of the room as one of a list of numbers, with an ordinary list for which it is above 0.
struct Function {
    std::string name;
    std::vector<double> numbers;
    std::function<double(Numbers&)> call;
};

double call(const Function& function, const std::vector<double>& numbers) {
    Numbers list{numbers};
    const double value = function.call(list);
    EXPECT_EQ(list.at, numbers.size()) << function.name;
    return value;
}

/// The value, and whether computing it raised FE_INVALID. Written to memory in between, so that the compiler cannot
/// compute it after looking.
std::pair<double, bool> flagged_call(const Function& function, const std::vector<double>& numbers) {
    std::feclearexcept(FE_INVALID);
    volatile double value = call(function, numbers);
    const bool is_flagged = std::fetestexcept(FE_INVALID) != 0;
    return {value, is_flagged};
}

std::vector<double> joined(std::initializer_list<std::vector<double>> parts) {
    std::vector<double> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

const std::vector<double> point = {0.1, -0.2, 0.05}, normal = {0.36, 0.48, 0.8};
const std::vector<double> quad = {-1, -1, 1, -1, 1, 1, 1, 1, 1, 1, -1, 1};
const std::vector<double> disk = {0.2, 0.3, 1, 0, 0.5, 0.1, 0.6, 0, 0};
const std::vector<double> ball = joined({disk, {0, 0.1, 0.3}});
const std::vector<double> lamp = {-1, 0.3, 1, 1, 0.2, 0.8, 0.2};
const std::vector<double> line = {-1, 0.3, 1, 1, 0.2, 0.8};
const std::vector<double> lobe = {0.9, 0.1, 0.05, 0, 1, -0.1, 0.1, 0, 0.7, 0, 0, 1, 0.95};

std::vector<Function> functions() {
    return {
        {"polygon", joined({quad, point, normal}),
         [](Numbers& n) {
             const Corners corners = n.corners();
             const Vec3 p = n.vector();
             return irradiance_of_polygon<double>(corners, p, n.vector(), true);
         }},
        {"ellipse", joined({disk, point, normal}),
         [](Numbers& n) {
             const auto e = n.ellipse();
             const Vec3 p = n.vector();
             return irradiance_of_ellipse(e, p, n.vector(), true);
         }},
        {"ellipsoid", joined({ball, point, normal}),
         [](Numbers& n) {
             const auto e = n.ellipsoid();
             const Vec3 p = n.vector();
             return irradiance_of_ellipsoid(e, p, n.vector());
         }},
        {"cylinder", joined({lamp, point, normal}),
         [](Numbers& n) {
             const auto c = n.cylinder();
             const Vec3 p = n.vector();
             return irradiance_of_cylinder(c, p, n.vector());
         }},
        {"line", joined({line, point, normal}),
         [](Numbers& n) {
             const Vec3 from = n.vector(), to = n.vector(), p = n.vector();
             return irradiance_of_line(from, to, p, n.vector());
         }},
        {"polygon in a lobe", joined({lobe, quad, point}),
         [](Numbers& n) {
             const PlacedLobe l = n.lobe();
             const Corners corners = n.corners();
             return specular_share_of_polygon(l, corners, n.vector(), true);
         }},
        {"ellipse in a lobe", joined({lobe, disk, point}),
         [](Numbers& n) {
             const PlacedLobe l = n.lobe();
             const auto e = n.ellipse();
             return specular_share_of_ellipse(l, e, n.vector(), true);
         }},
        {"ellipsoid in a lobe", joined({lobe, ball, point}),
         [](Numbers& n) {
             const PlacedLobe l = n.lobe();
             const auto e = n.ellipsoid();
             return specular_share_of_ellipsoid(l, e, n.vector());
         }},
        {"cylinder in a lobe", joined({lobe, lamp, point}),
         [](Numbers& n) {
             const PlacedLobe l = n.lobe();
             const auto c = n.cylinder();
             return specular_share_of_cylinder(l, c, n.vector());
         }},
        {"line in a lobe", joined({lobe, line, point}),
         [](Numbers& n) {
             const PlacedLobe l = n.lobe();
             const Vec3 from = n.vector(), to = n.vector();
             return specular_share_of_line(l, from, to, n.vector());
         }},
        {"place_lobe", joined({normal, {0.6, 0, 0.8}, {0.4}}),
         [](Numbers& n) {
             const Vec3 at = n.vector(), view = n.vector();
             const PlacedLobe l = place_lobe(at, view, n.number());
             EXPECT_TRUE(is_finite(l.to_cosine[0]) && is_finite(l.to_cosine[1]) && is_finite(l.to_cosine[2]));
             EXPECT_TRUE(is_finite(l.normal) && l.share_above > 0 && l.share_above <= 1);
             return l.albedo;
         }},
    };
}

TEST(NotFinite, H15_EveryArgumentGivesNothingAndRaisesTheFlag_M17) {
    int checked = 0;
    for (const Function& function : functions()) {
        const auto [ordinary, is_flagged] = flagged_call(function, function.numbers);
        EXPECT_GT(ordinary, 0) << function.name;
        EXPECT_FALSE(is_flagged) << function.name;
        for (size_t i = 0; i < function.numbers.size(); ++i)
            for (const double bad : bad_numbers) {
                std::vector<double> numbers = function.numbers;
                numbers[i] = bad;
                const auto [value, is_raised] = flagged_call(function, numbers);
                EXPECT_EQ(value, 0) << function.name << ", number " << i << ' ' << bad;
                EXPECT_TRUE(is_raised) << function.name << ", number " << i << ' ' << bad;
                ++checked;
            }
        const auto [nothing, is_raised] =
            flagged_call(function, std::vector<double>(function.numbers.size(), bad_numbers[0]));
        EXPECT_EQ(nothing, 0) << function.name;
        EXPECT_TRUE(is_raised) << function.name;
    }
    EXPECT_EQ(checked, 3 * (18 + 15 + 18 + 13 + 12 + 28 + 25 + 28 + 23 + 22 + 7));
}

TEST(NotFinite, H15_LightsThatAreNotSeenAreCheckedToo_M17) {
    // Early answers must not come before the check.
    const Corners corners = ceiling(-1, 1, -1, 1, -1);
    const Ellipse<double> below{{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}, flat{};
    const Vec3 o(0), up(0, 0, 1), bad(infinity, 0, 0);
    const auto expect_flag = [](double value, const char* name) {
        volatile double kept = value;
        EXPECT_EQ(kept, 0) << name;
        EXPECT_TRUE(std::fetestexcept(FE_INVALID)) << name;
        std::feclearexcept(FE_INVALID);
    };
    std::feclearexcept(FE_INVALID);
    expect_flag(irradiance_of_polygon<double>(corners, o, bad), "polygon");
    expect_flag(irradiance_of_polygon<double>(Corners{}, o, bad), "no polygon");
    expect_flag(irradiance_of_ellipse(below, o, bad), "ellipse");
    expect_flag(irradiance_of_ellipse(flat, o, bad), "flat ellipse");
    expect_flag(irradiance_of_ellipsoid({Vec3(0), {Vec3(1, 0, 0), Vec3(0, 1, 0), up}}, o, bad), "around");
    expect_flag(irradiance_of_cylinder({Vec3(0), Vec3(0), 0.0}, o, bad), "cylinder");
    expect_flag(irradiance_of_line(-up, -up, o, bad), "line");
    PlacedLobe broken = place_lobe(up, up, 0.5);
    broken.normal = bad;
    expect_flag(specular_share_of_ellipse(broken, flat, o), "ellipse in a lobe");
    expect_flag(specular_share_of_polygon(broken, Corners{}, o), "polygon in a lobe");
}

TEST(NotFinite, H15_LookupsGiveTheDocumentedLobeAndRaiseTheFlag_M27) {
    for (const double bad : bad_numbers)
        for (const bool is_roughness : {false, true}) {
            std::feclearexcept(FE_INVALID);
            const LtcLobe found = is_roughness ? ltc_lobe(bad, 0.5) : ltc_lobe(0.5, bad);
            volatile double albedo = found.albedo;
            EXPECT_TRUE(std::fetestexcept(FE_INVALID)) << bad;
            EXPECT_TRUE(albedo > 0 && albedo <= 1);
        }
    for (const double bad : bad_numbers)
        for (const bool is_normal : {false, true}) {
            std::feclearexcept(FE_INVALID);
            const Vec3 broken(0, bad, 1), whole(0.6, 0, 0.8);
            const Mat3 frame = is_normal ? frame_of_view(broken, whole) : frame_of_view(whole, broken);
            EXPECT_TRUE(std::fetestexcept(FE_INVALID)) << bad;
            EXPECT_EQ(frame, Mat3(1));
        }
    for (const double roughness : {-1.0, 0.0, 0.3, 1.0, 1e300})
        for (const double cosine : {-1.0, 0.0, 0.3, 1.0, 1e300}) {
            std::feclearexcept(FE_INVALID);
            volatile double albedo = ltc_lobe(roughness, cosine).albedo;
            EXPECT_FALSE(std::fetestexcept(FE_INVALID)) << roughness << ' ' << cosine;
            EXPECT_GT(albedo, 0);
        }
}

TEST(NotFinite, H15_OrdinaryInputLeavesTheFlag_M17) {
    Choice choice{{15}};
    int lit = 0;
    for (int i = 0; i < 3000; ++i)
        for (const Function& function : functions()) {
            std::vector<double> numbers;
            for (size_t k = 0; k < function.numbers.size(); ++k) numbers.push_back(choice.between(-2, 2));
            const auto [value, is_flagged] = flagged_call(function, numbers);
            ASSERT_FALSE(is_flagged) << function.name << ' ' << i;
            ASSERT_TRUE(std::isfinite(value)) << function.name << ' ' << i;
            lit += value > 0;
        }
    EXPECT_GT(lit, 5000);
}

TEST(NotFinite, H15_DegenerateInputLeavesTheFlag_M17) {
    // Points on lights, lights without extent, planes through points: numbers that are often 0 or equal, at any scale.
    Choice choice{{16}};
    const std::array<double, 9> values = {0, 0, 0, -0.0, 1, 1, -1, 0.5, 1e-17};
    const std::array<double, 9> scales = {1, 1, 1, 1e-300, 1e-150, 1e-60, 1e60, 1e150, 1e300};
    for (int i = 0; i < 20000; ++i)
        for (const Function& function : functions()) {
            const double scale = scales[static_cast<size_t>(choice.between(0, 9))];
            std::vector<double> numbers;
            for (size_t k = 0; k < function.numbers.size(); ++k)
                numbers.push_back(values[static_cast<size_t>(choice.between(0, 9))]);
            // Lights and points are scaled; normals, views and lobes have no scale.
            const bool has_lobe = function.name.ends_with("lobe");
            const size_t from = has_lobe ? lobe.size() : 0, to = has_lobe ? numbers.size() : numbers.size() - 3;
            for (size_t k = from; k < to && function.name != "place_lobe"; ++k) numbers[k] *= scale;
            const auto [value, is_flagged] = flagged_call(function, numbers);
            ASSERT_FALSE(is_flagged) << function.name << ' ' << i << ' ' << scale;
            ASSERT_TRUE(std::isfinite(value) && value >= 0)
                << function.name << ' ' << i << ' ' << scale << ' ' << value;
        }
}

TEST(NotFinite, H15_InOtherPrecisionsToo_M1) {
    const std::vector<Vec3f> corners = {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
    const Vec3f o(0), up(0, 0, 1), bad(0, std::numeric_limits<float>::infinity(), 0);
    const Ellipse<float> disk_above{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    std::feclearexcept(FE_INVALID);
    volatile float value = irradiance_of_polygon<float>(corners, o, up) + irradiance_of_ellipse(disk_above, o, up);
    EXPECT_GT(value, 3.f);
    EXPECT_FALSE(std::fetestexcept(FE_INVALID));
    value = irradiance_of_polygon<float>(corners, o, bad);
    EXPECT_TRUE(std::fetestexcept(FE_INVALID));
    EXPECT_EQ(value, 0.f);
    std::feclearexcept(FE_INVALID);
    value = irradiance_of_ellipse(disk_above, bad, up);
    EXPECT_TRUE(std::fetestexcept(FE_INVALID));
    EXPECT_EQ(value, 0.f);
}

}  // namespace
}  // namespace surimi
