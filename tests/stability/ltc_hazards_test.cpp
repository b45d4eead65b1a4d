// SPDX-License-Identifier: Apache-2.0
// Inputs that break published area lights (research/ltc.md, section 2: H1 to H9, H17, H19 to H27), with the tolerance
// stated there: absolute ones for the form factor E / pi.
#include "runtime/ltc/cylinder.h"
#include "runtime/ltc/line.h"
#include "tests/stability/hazard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace surimi {
namespace {

using test::Real;
using test::Vec3l;
using namespace hazard;

TEST(PolygonHazard, H1_EdgesNearlyAntipodal_M1) {
    Choice choice{{1}};
    for (const double h : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        Worst worst;
        for (int i = 0; i < 500; ++i) {
            const double x = choice.between(-0.8, 0.8), y = choice.between(-0.8, 0.8);
            worst.add(absolute_error(ceiling(x - 1, x + 1, y - 1, y + 1, h), steep_normal(choice)));
        }
        worst.expect_below(1e-7, "height " + std::to_string(h));
    }
}

TEST(PolygonHazard, H2_EdgesThroughTheFoot_M4) {
    Choice choice{{2}};
    for (const double d : {1e-2, 1e-4, 1e-6}) {
        Worst worst;
        for (int i = 0; i < 500; ++i) {
            const double angle = choice.between(0, 2 * pi), y = choice.between(-0.8, 0.8);
            const double x = d * std::cos(angle), h = d * std::sin(angle);
            worst.add(absolute_error(ceiling(x, x + 2, y - 1, y + 1, h), choice.direction()));
        }
        worst.expect_below(1e-7, "distance " + std::to_string(d));
    }
}

TEST(PolygonHazard, H3_TinyAndDistant_M1) {
    Choice choice{{3}};
    for (const double size : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
        Worst worst;
        for (int i = 0; i < 300; ++i) {
            const Vec3 centre(choice.between(-1, 1), choice.between(-1, 1), 1);
            const Vec3 u = size * choice.direction(), v = size * glm::normalize(glm::cross(u, choice.direction()));
            const Corners light = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
            const Vec3 n = choice.direction();
            // Well above the horizon and not edge-on (H6, H8).
            if (glm::dot(n, centre) < 0.2 || std::abs(glm::dot(glm::cross(u, v), centre)) < 0.1 * size * size) continue;
            worst.add(relative_error(light, n, 0));
        }
        worst.expect_below(1e-6, "size " + std::to_string(size));
    }
}

TEST(PolygonHazard, H4_Slivers_M1) {
    Choice choice{{4}};
    for (const double aspect : {1e2, 1e4, 1e6}) {
        Worst worst;
        for (int i = 0; i < 300; ++i) {
            const double x = choice.between(-1, 1), y = choice.between(-1, 1);
            const Vec3 n = normalize_or({choice.between(-0.5, 0.5), choice.between(-0.5, 0.5), 1}, {0, 0, 1});
            worst.add(relative_error(ceiling(x - 0.5, x + 0.5, y, y + 1 / aspect, 1), n, 1e-12));
        }
        worst.expect_below(1e-6, "aspect " + std::to_string(aspect));
    }
}

TEST(PolygonHazard, H5_NoArea_M1) {
    const Vec3 p(0.3, 0.2, 1), q(0.7, -0.4, 1.2), n(0, 0, 1);
    for (const Corners& corners :
         {Corners{p, p, p, p}, Corners{p, q, q, p}, Corners{p, q, p, q}, Corners{p, (p + q) * 0.5, q}})
        EXPECT_LT(of(corners, n), 1e-12);
    const Corners quad = ceiling(-1, 1, -1, 1, 1);
    EXPECT_NEAR(of({quad[0], quad[0], quad[1], quad[2], quad[2], quad[3]}, n), of(quad, n), 1e-15);
}

TEST(PolygonHazard, H6_PointInThePlaneOutside_M1) {
    Choice choice{{6}};
    for (const double h : {1e-2, 1e-4, 1e-6}) {
        std::vector<double> errors;
        for (int i = 0; i < 1000; ++i) {
            const double x = choice.between(1.2, 3), y = choice.between(-2, 2);
            const Vec3 n = normalize_or({1, choice.between(-1, 1), choice.between(-1, 1)}, {1, 0, 0});
            errors.push_back(relative_error(ceiling(x - 1, x + 1, y - 1, y + 1, h), n, 1e-12));
        }
        std::sort(errors.begin(), errors.end());
        Worst percentile;
        percentile.add(errors[990]);
        percentile.expect_below(1e-6, "height " + std::to_string(h));
    }
    EXPECT_EQ(of(ceiling(1, 2, -1, 1, 0), {0.8, 0, 0.6}), 0);
}

TEST(PolygonHazard, H7_PointOnTheLight_M1) {
    Choice choice{{7}};
    Worst vertex, near_vertex;
    for (int i = 0; i < 300; ++i) {
        const Vec3 u = choice.vector(), v = choice.vector(), n = choice.direction();
        vertex.add(absolute_error(Corners{Vec3(0), u, u + v, v}, n));
        const Vec3 off = 1e-6 * choice.direction();
        near_vertex.add(absolute_error(Corners{off, u + off, u + v + off, v + off}, n));
    }
    vertex.expect_below(1e-6, "corner");
    near_vertex.expect_below(1e-6, "near corner");
    // On the face the value is that of the limit from the front; on an edge the two sides differ by pi / 2.
    for (const double h : {0.0, 1e-12, 1e-6}) EXPECT_NEAR(of(ceiling(-1, 1, -1, 1, h), {0, 0, 1}, false), pi, 1e-5);
    for (const double side : {-1e-6, 1e-6}) {
        const Corners wall = {{side, -1, 0}, {side, 1, 0}, {side, 1, 1}, {side, -1, 1}};  // on the floor, shines to +x
        EXPECT_NEAR(of(wall, {0, 0, 1}, false), side < 0 ? pi / 2 : 0.0, 1e-5) << side;
        EXPECT_LT(absolute_error(wall, {0, 0, 1}), 1e-7);
    }
}

TEST(PolygonHazard, H8_TouchingTheHorizon_M4) {
    Choice choice{{8}};
    const Vec3 n(0, 0, 1);
    Worst worst, jump;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 centre = choice.vector(), u = choice.vector(), v = choice.vector();
        Corners light = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
        double lift = 0;  // 0: as it is; 1: a corner on the horizon
        if (i % 2 == 1) lift = -light[0].z;
        for (Vec3& corner : light) corner.z += lift;
        if (i % 2 == 1) light[0].z = 0;
        worst.add(absolute_error(light, n));
        if (std::abs(glm::dot(glm::cross(u, v), light[0])) < 0.05) continue;  // towards its own plane: H6
        Corners moved = light;
        for (Vec3& corner : moved) corner.z += 1e-6;
        jump.add(std::abs(of(moved, n) - of(light, n)) / pi);
        Corners negative_zero = light;
        if (i % 2 == 1) negative_zero[0].z = -0.0;
        EXPECT_EQ(of(negative_zero, n), of(light, n));
    }
    worst.expect_below(1e-7, "error");
    jump.expect_below(1e-5, "jump");
    const Corners wall = {{1, -1, 0}, {1, 1, 0}, {1, 1, 1}, {1, -1, 1}};
    EXPECT_LT(absolute_error(wall, n), 1e-15);
    for (const double z : {0.0, -0.0, -1e-300, -1e-9}) EXPECT_EQ(of(ceiling(1, 2, 1, 2, z), n), 0);
}

TEST(PolygonHazard, H9_ScaleAndOffset_M1) {
    Choice choice{{9}};
    Worst scale, offset;
    for (int i = 0; i < 200; ++i) {
        const Vec3 centre = choice.vector(), u = choice.vector(), v = choice.vector(), n = choice.direction();
        const Corners light = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
        for (const double s : {1e-60, 1e-20, 1e20, 1e60}) {
            Corners scaled = light;
            for (Vec3& corner : scaled) corner *= s;
            scale.add(std::abs(of(scaled, n) - of(light, n)));
        }
        for (const double o : {1e4, 1e5, 1e6}) {  // a light of 0.1 m at a distance of 1 m
            Corners shifted, rounded;
            const Vec3 point = o * choice.direction();
            for (const Vec3& corner : light) {
                shifted.push_back(point + 0.1 * corner + n);
                rounded.push_back(shifted.back() - point);
            }
            offset.add(std::abs(irradiance_of_polygon<double>(shifted, point, n, true) - of(rounded, n)));
            offset.add(std::abs(of(rounded, n) / exact(rounded, n) - 1) * 1e-3);
        }
    }
    scale.expect_below(1e-12, "scale");
    offset.expect_below(1e-12, "offset");
}

TEST(EllipseHazard, H17_SidesWindingAndMirrors_M10) {
    Choice choice{{17}};
    for (int i = 0; i < 200; ++i) {
        const Ellipse<double> e{2.0 * choice.vector(), choice.vector(), choice.vector()};
        const Ellipse<double> flipped{e.centre, e.half_v, e.half_u};
        const Vec3 n = choice.direction(), o(0);
        const double both = of(e, n), front = irradiance_of_ellipse(e, o, n),
                     back = irradiance_of_ellipse(flipped, o, n);
        EXPECT_TRUE((front == both && back == 0) || (front == 0 && std::abs(back - both) < 1e-14)) << i;
        EXPECT_NEAR(of(flipped, n), both, 1e-14);
        const Vec3 mirror(-1, 1, 1);  // a node with a negative determinant
        EXPECT_NEAR(of(Ellipse<double>{e.centre * mirror, e.half_u * mirror, e.half_v * mirror}, n * mirror), both,
                    1e-14);
        const Vec3 &c = e.centre, &u = e.half_u, &v = e.half_v;
        const Corners quad = {c - u - v, c + u - v, c + u + v, c - u + v}, turned(quad.rbegin(), quad.rend());
        EXPECT_EQ(of(quad, n, false) > 0 && of(turned, n, false) > 0, false);
        EXPECT_NEAR(of(quad, n, false) + of(turned, n, false), of(quad, n), 1e-14);
    }
}

TEST(EllipseHazard, H19_LongAndSkewedAxes_M10) {
    Choice choice{{19}};
    for (const double ratio : {1e1, 1e2, 1e3, 1e4}) {
        Worst worst;
        for (int i = 0; i < 100; ++i) {
            const Vec3 u = ratio * choice.direction(), v = choice.direction();
            const Vec3 centre = 3.0 * choice.direction(), n = choice.direction();
            worst.add(relative_error(Ellipse<double>{centre, u, v}, n, 1e-10));
        }
        worst.expect_below(1e-6, "ratio " + std::to_string(ratio));
    }
    for (const double sine : {1e-2, 1e-4}) {
        Worst worst;
        for (int i = 0; i < 100; ++i) {
            const Vec3 u = choice.direction(), v = u + sine * choice.direction(), n = choice.direction();
            worst.add(relative_error(Ellipse<double>{2.0 * choice.direction(), u, v}, n, 1e-10));
        }
        worst.expect_below(1e-6, "sine " + std::to_string(sine));
    }
}

TEST(EllipseHazard, H20_FacingCircles_M11) {
    Choice choice{{20}};
    Worst worst;
    for (int i = 0; i < 200; ++i) {
        const Vec3 axis = choice.direction(), u = glm::normalize(glm::cross(axis, choice.direction()));
        const double r = choice.between(0.01, 3);
        worst.add(absolute_error(Ellipse<double>{axis, r * u, r * glm::cross(axis, u)}, choice.direction()));
    }
    worst.expect_below(1e-7, "error");
}

TEST(EllipseHazard, H21_TinyDisks_M10) {
    Choice choice{{21}};
    for (const double size : {1e-1, 1e-2, 1e-3, 1e-4}) {
        Worst above, crossing;
        for (int i = 0; i < 100; ++i) {
            const Vec3 centre = choice.direction(), u = size * choice.direction();
            const Vec3 v = size * glm::normalize(glm::cross(u, choice.direction())), n = choice.direction();
            const Vec3 level = glm::normalize(glm::cross(centre, n)) + 0.5 * size * choice.direction();
            above.add(relative_error(Ellipse<double>{centre, u, v}, n, size * size * 1e-3));
            crossing.add(relative_error(Ellipse<double>{level, u, v}, n, size * size * size * 1e-3));
        }
        above.expect_below(1e-6, "size " + std::to_string(size));
        crossing.expect_below(1e-6, "crossing, size " + std::to_string(size));
    }
}

TEST(EllipseHazard, H22_PlaneThroughThePoint_M10) {
    Choice choice{{22}};
    for (const double h : {1e-2, 1e-4, 1e-6, 1e-8}) {
        Worst worst;
        for (int i = 0; i < 100; ++i) {
            const double x = choice.between(1.2, 3);
            const Vec3 n = normalize_or({1, choice.between(-1, 1), choice.between(-1, 1)}, {1, 0, 0});
            const Ellipse<double> e{{x, choice.between(-1, 1), h}, {1, 0.2, 0}, {0, choice.between(0.3, 1), 0}};
            worst.add(relative_error(e, n, 1e-10));
        }
        worst.expect_below(1e-6, "height " + std::to_string(h));
    }
    EXPECT_EQ(of(Ellipse<double>{{2, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0.8, 0, 0.6}), 0);
}

TEST(EllipseHazard, H23_CloseToTheDisk_M11) {
    Choice choice{{23}};
    for (const double h : {1e-2, 1e-4, 1e-6}) {
        Worst worst;
        for (int i = 0; i < 100; ++i) {
            const double r = choice.between(0, 0.8), angle = choice.between(0, 2 * pi);
            const Ellipse<double> e{{r * std::cos(angle), r * std::sin(angle), h}, {0, 1, 0}, {1, 0, 0}};
            worst.add(absolute_error(e, choice.direction()));
        }
        worst.expect_below(1e-9, "height " + std::to_string(h));
    }
}

/// Exact integral of the line by the antiderivative in long double, for lines above the horizon.
double exact_line(const Vec3& from, const Vec3& to, const Vec3& n) {
    const Vec3l a(from), b(to), t = (b - a) / glm::length(b - a), moment = glm::cross(t, a);
    const Real d = glm::length(moment), n_foot = glm::dot(Vec3l(n), glm::cross(moment, t)) / d;
    // Adaptive in the angle under which the line is seen: l = d tan(angle).
    const Real from_angle = std::atan2(glm::dot(a, t), d), to_angle = std::atan2(glm::dot(b, t), d);
    return static_cast<double>(test::integral(
        [&](Real angle) {
            return std::max(Real(0), n_foot * std::cos(angle) + glm::dot(Vec3l(n), t) * std::sin(angle)) *
                   std::cos(angle) / d;
        },
        from_angle, to_angle));
}

double line_error(const Vec3& from, const Vec3& to, const Vec3& n) {
    const double expected = exact_line(from, to, n);
    return expected > 0 ? std::abs(irradiance_of_line(from, to, Vec3(0), n) / expected - 1) : 0;
}

TEST(LineHazard, H24_AimedAtThePoint_M12) {
    Choice choice{{24}};
    for (const double d : {1e-2, 1e-4, 1e-6}) {
        Worst worst;
        for (int i = 0; i < 200; ++i) {
            const Vec3 t = choice.direction(), n = choice.direction();
            const Vec3 side = d * glm::normalize(glm::cross(t, choice.direction()));
            if (glm::dot(n, t) > 0.05) worst.add(line_error(t + side, 2.0 * t + side, n));
        }
        worst.expect_below(1e-7, "distance " + std::to_string(d));
    }
}

TEST(LineHazard, H25_Short_M12) {
    Choice choice{{25}};
    for (const double length : {1e-2, 1e-3, 1e-4}) {
        Worst worst;
        for (int i = 0; i < 200; ++i) {
            const Vec3 p = choice.direction(), n = choice.direction();
            if (glm::dot(n, p) > 0.05) worst.add(line_error(p, p + length * choice.direction(), n));
        }
        worst.expect_below(1e-6, "length " + std::to_string(length));
    }
}

TEST(LineHazard, H26_AlongTheHorizonVeryLongAndThroughThePoint_M12) {
    Choice choice{{26}};
    Worst level, longest;
    const Vec3 n(0, 0, 1);
    for (int i = 0; i < 200; ++i) {
        const double z = choice.between(0.01, 1), x = choice.between(-1, 1);
        level.add(line_error({x, choice.between(-1, 1), z}, {x + 1, choice.between(-1, 1), z}, n));
        longest.add(line_error({x - 1e4, 0.3, z + 1}, {x + 1e4, choice.between(-1, 1), z}, n));
    }
    level.expect_below(1e-6, "level");
    longest.expect_below(1e-6, "long");
    for (const double at : {-1.0, -0.5, 0.0, 1e-9, 0.5, 1.0, 3.0})  // on the line and on its continuation
        for (const double off : {0.0, 1e-300, 1e-17, 1e-9}) {
            const double e = irradiance_of_line<double>({-1 + at, 0, off}, {1 + at, 0, off}, Vec3(0), n);
            EXPECT_TRUE(std::isfinite(e) && e >= 0) << at << ' ' << off << ' ' << e;
        }
}

TEST(CylinderHazard, H27_NearThickAndAroundThePoint_M13) {
    Choice choice{{27}};
    Worst worst;
    int outside = 0;
    for (const double ratio : {0.2, 0.5, 0.9, 0.99, 0.999, 0.9999})  // radius to the distance from the axis
        for (int i = 0; i < 8; ++i) {
            const Vec3 axis = choice.direction(), n = choice.direction();
            const Vec3 foot = glm::normalize(glm::cross(axis, choice.direction()));
            const Vec3 from = foot + choice.between(-2, 1) * axis, to = from + choice.between(0.2, 3) * axis;
            const double e = irradiance_of_cylinder({from, to, ratio}, Vec3(0), n);
            const Real expected = test::area_irradiance(Vec3l(from), Vec3l(to), ratio, Vec3l(n));
            worst.add(std::abs(e - static_cast<double>(expected)) / pi);
            ++outside;
            const Vec3 inside = from + choice.between(0, 1) * (to - from) - choice.between(0, 0.9 * ratio) * foot;
            EXPECT_EQ(irradiance_of_cylinder({from, to, ratio}, inside, n), pi);
        }
    EXPECT_EQ(outside, 48);
    worst.expect_below(1e-6, "error");
}

TEST(CylinderHazard, H27_TouchingTheMantle_M13) {
    // On the mantle, between the caps, a point sees the cylinder in all of a half space: pi (1 + cos) / 2, with the
    // angle between its normal and the way inwards. At the distance e R from the mantle, two lunes between the half
    // space and the tangent planes are missing, each of the angle sqrt(2 e) and of at most half of that in E / pi, and
    // what the ends leave open, which is of the order e.
    Choice choice{{127}};
    for (const double ratio : {0.999, 0.9999, 0.999999, 1 - 1e-9, 1 - 1e-12}) {
        Worst worst;
        for (int i = 0; i < 50; ++i) {
            const Vec3 axis = choice.direction(), n = choice.direction();
            const Vec3 foot = glm::normalize(glm::cross(axis, choice.direction()));
            const Vec3 from = foot - choice.between(0.5, 2) * axis, to = foot + choice.between(0.5, 2) * axis;
            const double limit = pi * (1 + glm::dot(n, foot)) / 2;
            worst.add(std::abs(irradiance_of_cylinder({from, to, ratio}, Vec3(0), n) - limit) / pi);
        }
        worst.expect_below(2 * std::sqrt(1 - ratio), "1 - ratio, log10 " + std::to_string(std::log10(1 - ratio)));
    }
}

}  // namespace
}  // namespace surimi
