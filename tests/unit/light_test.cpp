// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/base/random.h"
#include "runtime/light/sample.h"

namespace surimi {
namespace {

Monitor monitor_of(std::vector<Polygon> panels) {
    Monitor monitor;
    monitor.panels = std::move(panels);
    return monitor;
}

TEST(MonitorSampler, SpreadsPointsEvenlyOverPanelsOfAllShapes) {
    // A unit square, a triangle of area 2 and a kite of area 1, each in a plane of its own.
    const Monitor monitor = monitor_of({{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
                                        {{{0, 0, 1}, {2, 0, 1}, {0, 2, 1}}},
                                        {{{0, 0, 2}, {1, -0.5, 2}, {2, 0, 2}, {1, 0.5, 2}}}});
    const MonitorSampler sampler(monitor);
    EXPECT_NEAR(sampler.area(), 4, 1e-14);
    EXPECT_NEAR(area(monitor), 4, 1e-14);
    std::array<int, 3> count{};
    std::array<Vec3, 3> sum{};
    constexpr int n = 1 << 14;
    for (uint32_t i = 0; i < n; ++i) {
        const auto r = scrambled(sobol::point(i), scrambling(9));
        const LightPoint p = sampler.sample(r[0], r[1]);
        const auto panel = static_cast<size_t>(std::lround(p.position.z));
        ++count[panel];
        sum[panel] += p.position;
        EXPECT_NEAR(glm::length(p.normal - Vec3(0, 0, 1)), 0, 1e-15);
    }
    EXPECT_NEAR(count[0], n / 4, 2);
    EXPECT_NEAR(count[1], n / 2, 2);
    // Centroids.
    EXPECT_NEAR(glm::length(sum[0] / double(count[0]) - Vec3(0.5, 0.5, 0)), 0, 2e-3);
    EXPECT_NEAR(glm::length(sum[1] / double(count[1]) - Vec3(2 / 3.0, 2 / 3.0, 1)), 0, 4e-3);
    EXPECT_NEAR(glm::length(sum[2] / double(count[2]) - Vec3(1, 0, 2)), 0, 4e-3);
}

TEST(MonitorSampler, EndpointsOfTheUnitSquareStayOnThePanels) {
    const MonitorSampler sampler(
        monitor_of({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}}));
    for (const double u : {0.0, 0.5, std::nextafter(1.0, 0.0)})
        for (const double v : {0.0, std::nextafter(1.0, 0.0)}) {
            const Vec3 p = sampler.sample(u, v).position;
            EXPECT_TRUE(p.x >= 0 && p.y >= 0 && p.x + p.y <= 1 + 1e-15) << u << ' ' << v;
        }
}

TEST(MonitorSampler, AboveAHorizonKeepsAllOfThatAndLittleMore) {
    // A square of 2 m that leans, of which the horizon y = 0.5 leaves a strip, and a triangle below it.
    const MonitorSampler sampler(
        monitor_of({{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 1}, {-1, 1, 1}}}, {{{3, 0, 0}, {4, 0, 0}, {3, 0.4, 0}}}}));
    const MonitorSampler part = sampler.above({0, 1, 0}, 0.5);
    EXPECT_NEAR(part.area(), 0.25 * 2 * std::sqrt(5.0), 1e-12);
    for (uint32_t i = 0; i < 256; ++i) {
        const auto r = scrambled(sobol::point(i), scrambling(4));
        const LightPoint p = part.sample(r[0], r[1]);
        EXPECT_GE(p.position.y, 0.5 - 1e-12);
        EXPECT_EQ(p.panel, 0u);
        EXPECT_NEAR(p.position.z, 0.5 * (p.position.y + 1), 1e-12);
    }
    // Across a corner: the box around what is left.
    const double side = std::sqrt(0.5);
    const MonitorSampler square(monitor_of({{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}));
    const MonitorSampler corner = square.above({side, side, 0}, 1.75 * side);
    EXPECT_NEAR(corner.area(), 0.0625, 1e-12) << "a quarter by a quarter";
    EXPECT_EQ(sampler.above({0, 1, 0}, -5).area(), sampler.area());
    EXPECT_EQ(sampler.above({0, 1, 0}, 5).area(), sampler.area()) << "nothing: the same sampler";
}

}  // namespace
}  // namespace surimi
