// SPDX-License-Identifier: Apache-2.0
#include "tests/support/disk_families.h"

#include <cmath>
#include <functional>

namespace surimi::test {

namespace {

Vec3 as_float(const Vec3& v) {
    return Vec3(Vec3f(v));
}

DiskCase disk_case(const Ellipse<double>& e, const Vec3& normal) {
    const Mat3 to_frame = glm::transpose(frame_around(normal));
    const Ellipse<double> placed{as_float(to_frame * e.centre), as_float(to_frame * e.half_u),
                                 as_float(to_frame * e.half_v)};
    const auto exact =
        outline_irradiance({Vec3l(placed.centre), Vec3l(placed.half_u), Vec3l(placed.half_v)}, Vec3l(0, 0, 1));
    return {placed, static_cast<double>(exact) / pi, placed.centre.z > std::hypot(placed.half_u.z, placed.half_v.z)};
}

DiskCase upright(const Ellipse<double>& e) {
    return disk_case(e, {0, 0, 1});
}

/// One axis level and `ratio` times as long as the other; all above the horizon.
DiskCase long_disk(Choice& choice, double ratio) {
    const double turn = choice.between(0, 2 * pi);
    const Vec3 centre(choice.between(-1, 1), choice.between(-1, 1), choice.between(1.1, 3));
    return upright({centre, ratio * Vec3(std::cos(turn), std::sin(turn), 0), choice.direction()});
}

DiskCase parallel_axes(Choice& choice, double sine) {
    const Vec3 centre(choice.between(-1, 1), choice.between(-1, 1), choice.between(2.2, 3));
    const Vec3 u = choice.direction();
    return upright({centre, u, u + sine * choice.direction()});
}

DiskCase facing_circle(Choice& choice) {
    const Vec3 axis = choice.direction(), u = glm::normalize(glm::cross(axis, choice.direction()));
    const double radius = choice.between(0.01, 3);
    return disk_case({axis, radius * u, radius * glm::cross(axis, u)}, choice.direction());
}

DiskCase tiny_disk(Choice& choice, double size) {
    const Vec3 centre(choice.between(-1, 1), choice.between(-1, 1), choice.between(0.5, 1));
    const Vec3 u = size * choice.direction();
    return upright({centre, u, size * glm::normalize(glm::cross(u, choice.direction()))});
}

DiskCase through_the_plane(Choice& choice, double height) {
    const Vec3 normal = normalize_or({1, choice.between(-1, 1), choice.between(-1, 1)}, {1, 0, 0});
    const double x = choice.between(1.2, 3);
    return disk_case({{x, choice.between(-1, 1), height}, {1, 0.2, 0}, {0, choice.between(0.3, 1), 0}}, normal);
}

DiskCase near_disk(Choice& choice, double height) {
    const double r = choice.between(0, 0.8), angle = choice.between(0, 2 * pi);
    return disk_case({{r * std::cos(angle), r * std::sin(angle), height}, {0, 1, 0}, {1, 0, 0}}, choice.direction());
}

DiskCase crossing_disk(Choice& choice) {
    for (;;) {
        const Vec3 centre = 1.5 * choice.vector(), u = choice.vector(), v = choice.vector();
        if (std::abs(centre.z) < 0.9 * std::hypot(u.z, v.z)) return upright({centre, u, v});
    }
}

}  // namespace

std::vector<DiskFamily> disk_families(int count) {
    using Make = std::function<DiskCase(Choice&)>;
    std::vector<std::pair<std::string, Make>> makers;
    const auto add = [&](const std::string& name, const std::string& value, const Make& make) {
        makers.emplace_back(name + value, make);
    };
    for (const auto& [text, x] : {std::pair{"1e1", 1e1}, {"1e2", 1e2}, {"1e3", 1e3}, {"1e4", 1e4}})
        add("H19 one axis longer by ", text, [x = x](Choice& c) { return long_disk(c, x); });
    for (const auto& [text, x] : {std::pair{"1e-2", 1e-2}, {"1e-4", 1e-4}})
        add("H19 axes parallel but for ", text, [x = x](Choice& c) { return parallel_axes(c, x); });
    add("H20 facing circles", "", facing_circle);
    for (const auto& [text, x] : {std::pair{"1e-1", 1e-1}, {"1e-2", 1e-2}, {"1e-3", 1e-3}, {"1e-4", 1e-4}})
        add("H21 tiny, radius ", text, [x = x](Choice& c) { return tiny_disk(c, x); });
    for (const auto& [text, x] : {std::pair{"1e-2", 1e-2}, {"1e-4", 1e-4}})
        add("H22 its plane at ", text, [x = x](Choice& c) { return through_the_plane(c, x); });
    for (const auto& [text, x] : {std::pair{"1e-2", 1e-2}, {"1e-4", 1e-4}, {"1e-6", 1e-6}})
        add("H23 above the point by ", text, [x = x](Choice& c) { return near_disk(c, x); });
    add("random, across the horizon", "", crossing_disk);

    std::vector<DiskFamily> families;
    uint64_t key = 100;
    for (const auto& [name, make] : makers) {
        Choice choice{{key++}};
        DiskFamily family{name, {}};
        while (family.cases.size() < static_cast<size_t>(count)) family.cases.push_back(make(choice));
        families.push_back(std::move(family));
    }
    return families;
}

}  // namespace surimi::test
