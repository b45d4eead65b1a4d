// SPDX-License-Identifier: Apache-2.0
#include "tests/support/shading_cases.h"

#include <algorithm>
#include <functional>

#include "runtime/ltc/table.h"
#include "tests/support/quadrature.h"
#include "tests/support/random.h"

namespace surimi::test {
namespace {

using Corners = std::vector<Vec3>;

struct CaseChoice : Choice {
    double one_of(std::initializer_list<double> values) {
        const auto i = static_cast<size_t>(random.next() * static_cast<double>(values.size()));
        return *(values.begin() + std::min(i, values.size() - 1));
    }
    Vec3 above(const Vec3& normal) {
        const Vec3 d = direction();
        return glm::dot(d, normal) < 0 ? -d : d;
    }
};

/// A light, where it is seen from, and what the normal there is to be.
struct Setting {
    Corners corners;
    Vec3 point{0};
    std::function<Vec3(CaseChoice&)> normal = [](CaseChoice& choice) { return choice.direction(); };
    bool is_smooth = false;  ///< H13: the roughness is small, and the light lies around the mirror direction
};

Corners ceiling(double x0, double x1, double y0, double y1, double h) {
    return {{x0, y0, h}, {x0, y1, h}, {x1, y1, h}, {x1, y0, h}};
}

Corners parallelogram(const Vec3& centre, const Vec3& u, const Vec3& v) {
    return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

Setting antipodal(CaseChoice& choice) {
    const double h = choice.one_of({1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6});
    const double x = choice.between(-0.8, 0.8), y = choice.between(-0.8, 0.8);
    return {ceiling(x - 1, x + 1, y - 1, y + 1, h), Vec3(0), [](CaseChoice& c) {
                for (;;)
                    if (const Vec3 n = c.direction(); std::abs(n.z) > 0.05) return n;
            }};
}

Setting edge_through_foot(CaseChoice& choice) {
    const double d = choice.one_of({1e-2, 1e-4, 1e-6});
    const double angle = choice.between(0, 2 * pi), y = choice.between(-0.8, 0.8);
    const double x = d * std::cos(angle);
    return {ceiling(x, x + 2, y - 1, y + 1, d * std::sin(angle))};
}

Setting tiny(CaseChoice& choice) {
    const double size = choice.one_of({1e-1, 1e-2, 1e-3, 1e-4, 1e-5});
    const Vec3 centre(choice.between(-1, 1), choice.between(-1, 1), 1);
    const Vec3 u = size * choice.direction(), v = size * glm::normalize(glm::cross(u, choice.direction()));
    return {parallelogram(centre, u, v)};
}

Setting sliver(CaseChoice& choice) {
    const double aspect = choice.one_of({1e2, 1e4, 1e6});
    const double x = choice.between(-1, 1), y = choice.between(-1, 1);
    return {ceiling(x - 0.5, x + 0.5, y, y + 1 / aspect, 1)};
}

Setting without_area(CaseChoice& choice) {
    const Vec3 p = choice.vector(), q = choice.vector();
    return {choice.between(0, 1) < 0.5 ? Corners{p, q, p, q} : Corners{p, (p + q) * 0.5, q}};
}

Setting in_its_plane(CaseChoice& choice) {
    const double h = choice.one_of({1e-2, 1e-4, 1e-6}), x = choice.between(1.2, 3), y = choice.between(-2, 2);
    return {ceiling(x - 1, x + 1, y - 1, y + 1, h), Vec3(0), [](CaseChoice& c) {
                return normalize_or({1, c.between(-1, 1), c.between(-1, 1)}, {1, 0, 0});
            }};
}

Setting corner_at_the_point(CaseChoice& choice) {
    const Vec3 u = choice.vector(), v = choice.vector();
    const Vec3 off = choice.between(0, 1) < 0.5 ? Vec3(0) : 1e-6 * choice.direction();
    return {{off, u + off, u + v + off, v + off}};
}

Setting touching_the_horizon(CaseChoice& choice) {
    Corners light = parallelogram(choice.vector(), choice.vector(), choice.vector());
    if (choice.between(0, 1) < 0.5) {
        const double lift = -light[0].z;
        for (Vec3& corner : light) corner.z += lift;
        light[0].z = 0;
    }
    return {light, Vec3(0), [](CaseChoice&) { return Vec3(0, 0, 1); }};
}

Setting scaled_or_shifted(CaseChoice& choice) {
    const Vec3 centre = choice.vector(), u = choice.vector(), v = choice.vector();
    Setting setting{parallelogram(centre, u, v)};
    if (choice.between(0, 1) < 0.5) {
        const double scale = choice.one_of({1e-60, 1e-20, 1e20, 1e60});
        for (Vec3& corner : setting.corners) corner *= scale;
    } else {
        setting.point = choice.one_of({1e4, 1e5, 1e6}) * choice.direction();
        const Vec3 away = choice.direction();
        for (Vec3& corner : setting.corners) corner = setting.point + 0.1 * corner + away;
    }
    return setting;
}

Setting smooth(CaseChoice& choice) {
    const Vec3 centre = 2.0 * choice.direction();
    const double size = std::pow(10, choice.between(-3, 0));
    Setting setting{parallelogram(centre, size * choice.direction(), size * choice.direction())};
    setting.is_smooth = true;
    return setting;
}

/// A light on a wall or in the room, seen from anywhere in it.
Setting room(CaseChoice& choice) {
    const Vec3 half(choice.between(1, 5), choice.between(1, 2), choice.between(1, 5));
    const auto place = [&] { return half * choice.vector(); };
    Vec3 u = choice.vector(), v = choice.vector();
    if (choice.between(0, 1) < 0.7) u.y = 0, v = Vec3(0, choice.between(0.2, 1), 0);
    return {parallelogram(place(), u, v), place()};
}

ShadingCase shading_case(const Setting& setting, CaseChoice& choice, int points) {
    ShadingCase made;
    made.corners = setting.corners;
    Vec3 centre(0);
    for (const Vec3& corner : setting.corners) centre += corner / static_cast<double>(setting.corners.size());
    for (int i = 0; i < points; ++i) {
        Vec3 n = setting.normal(choice), v = choice.above(n);
        double roughness = choice.between(0, 1);
        if (setting.is_smooth) {
            roughness = choice.one_of({0, 1e-3, 0.008, 0.024, 0.05});
            // The mirror direction meets the light, or misses it by some lobes.
            const Vec3 aim = normalize_or(centre + 0.4 * (setting.corners[1] - setting.corners[0]) * choice.vector() +
                                              20 * roughness * roughness * choice.vector(),
                                          {0, 0, 1});
            n = choice.above(aim);
            v = normalize_or(2 * glm::dot(n, aim) * n - aim, n);
        }
        made.points.position.push_back(setting.point);
        made.points.normal.push_back(n);
        made.points.view.push_back(v);
        made.points.roughness.push_back(roughness);
        made.diffuse.push_back(exact_diffuse(made.corners, setting.point, n));
        made.specular.push_back(exact_specular(made.corners, setting.point, n, v, roughness));
    }
    return made;
}

}  // namespace

double exact_diffuse(std::span<const Vec3> corners, const Vec3& point, const Vec3& normal) {
    std::vector<Vec3l> seen;
    for (const Vec3& corner : corners) seen.push_back(Vec3l(corner) - Vec3l(point));
    return static_cast<double>(corner_irradiance(seen, Vec3l(normal)) / pi_l);
}

double exact_specular(std::span<const Vec3> corners, const Vec3& point, const Vec3& normal, const Vec3& view,
                      double roughness) {
    const LtcLobe lobe = ltc_lobe(roughness, glm::dot(normal, view));
    const Vec3l z = glm::normalize(Vec3l(normal)), x = glm::normalize(Vec3l(view) - z * glm::dot(z, Vec3l(view)));
    const Vec3l y = glm::cross(z, x);
    std::vector<Vec3l> seen, kept;
    for (const Vec3& corner : corners) {
        const Vec3l p = Vec3l(corner) - Vec3l(point);
        seen.emplace_back(glm::dot(p, x), glm::dot(p, y), glm::dot(p, z));
    }
    const glm::mat<3, 3, Real> inverse(lobe.inverse);
    for (size_t i = 0; i < seen.size(); ++i) {
        const Vec3l &a = seen[i], &b = seen[(i + 1) % seen.size()];
        if (a.z >= 0) kept.push_back(inverse * a);
        if ((a.z > 0 && b.z < 0) || (a.z < 0 && b.z > 0)) kept.push_back(inverse * (a + (b - a) * (a.z / (a.z - b.z))));
    }
    return static_cast<double>(corner_irradiance(kept, Vec3l(0, 0, 1)) / pi_l) / (1 - lobe.leak);
}

std::vector<ShadingFamily> shading_families(int lights, int points) {
    const std::vector<std::pair<std::string, Setting (*)(CaseChoice&)>> kinds = {
        {"H1 antipodal", antipodal},
        {"H2 edge through foot", edge_through_foot},
        {"H3 tiny", tiny},
        {"H4 sliver", sliver},
        {"H5 no area", without_area},
        {"H6 in plane", in_its_plane},
        {"H7 corner", corner_at_the_point},
        {"H8 horizon", touching_the_horizon},
        {"H9 scale", scaled_or_shifted},
        {"H13 low roughness", smooth},
        {"rooms", room}};
    std::vector<ShadingFamily> families;
    for (const auto& [name, make] : kinds) {
        CaseChoice choice{{families.size() + 1}};
        ShadingFamily family{name, {}};
        for (int i = 0; i < lights; ++i) {
            const Setting setting = make(choice);
            family.cases.push_back(shading_case(setting, choice, points));
        }
        families.push_back(std::move(family));
    }
    return families;
}

}  // namespace surimi::test
