// SPDX-License-Identifier: Apache-2.0
// Gathered visibility against the exact penumbra, texel by texel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "baker/gather/gather.h"
#include "tests/support/closed_form.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

using test::Occluder;

constexpr int size = 24;  // texels a side, over a floor of 4 m

/// A floor under a monitor on the ceiling, tilted a little so that nothing is symmetric.
struct Stage {
    Scene scene;
    uint32_t floor = 0;
    std::vector<Occluder> occluders;

    Stage() {
        floor = test::add_quad(scene, "Floor", {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
        test::add_monitor(scene, "Monitor_R", 0, {0.2, 2.5, -0.1}, {0.8, 0.02, 0}, {0, 0.01, 0.45});
    }
    /// A horizontal sheet. Its corners must be nearer to the monitor's tilted plane than any receiver, to be projected.
    void add_sheet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        test::add_quad(scene, "Sheet", a, b, c, d);
        occluders.push_back({{a, b, c, d}});
    }
    void add_block(const Vec3& center, const Vec3& extent) {
        test::add_box(scene, "Block", center, extent);
        Occluder hull;
        for (int i = 0; i < 8; ++i)
            hull.points.push_back(center + 0.5 * extent * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
        occluders.push_back(hull);
    }

    /// Exact V (M3) of a texel: E-weighted average over 16 x 16 midpoints. At the edge of a shadow they are off by up
    /// to 5e-4.
    double exact(int x, int y) const {
        constexpr int side = 16;
        double seen = 0, all = 0;
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                const Vec3 p(-2 + 4 * (x + (i + 0.5) / side) / size, 0, 2 - 4 * (y + (j + 0.5) / side) / size);
                const Polygon& light = scene.monitors[0].panels[0];
                const double e = test::irradiance_by_quadrature(light, p, {0, 1, 0}, 8);
                seen += e * test::exact_visibility(light, p, {0, 1, 0}, occluders);
                all += e;
            }
        }
        return seen / all;
    }
};
constexpr double midpoint_error = 5e-4;

/// The floor of a stage, and what gathering needs.
struct Floor {
    const Stage& stage;
    Atlas atlas;
    Texels texels;
    RayScene rays;
    Silhouettes silhouettes;
    std::vector<double> exact;

    explicit Floor(const Stage& of)
        : stage(of),
          atlas(test::whole_map_atlas(of.scene, of.floor, size)),
          rays(of.scene),
          silhouettes(find_silhouettes(of.scene, rays)) {
        Scene floor_only = of.scene;  // texels of the floor alone
        for (uint32_t s = 0; s < floor_only.surfaces.size(); ++s)
            if (s != of.floor) floor_only.surfaces[s].triangles.clear();
        texels = find_texels(floor_only, atlas);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) exact.push_back(of.exact(x, y));
    }
    std::vector<IrradianceEstimate> gathered(const GatherSettings& settings) const {
        return gather(stage.scene, atlas, texels, rays, silhouettes, 0, settings, {}).estimates;
    }
};

double visibility_of(const IrradianceEstimate& e) {
    return static_cast<double>(e.shadowed) / static_cast<double>(e.unshadowed);
}

/// Every texel against the exact penumbra: the error that was asked for by each method that can keep it, and the
/// standard error that rays state.
void expect_exact_penumbra(const Stage& stage) {
    const Floor floor(stage);
    ASSERT_EQ(floor.texels.texels.size(), static_cast<size_t>(size * size));
    const auto penumbra = std::ranges::count_if(floor.exact, [](double v) { return v > 1e-3 && v < 1 - 1e-3; });
    ASSERT_GT(penumbra, 40);

    const GatherSettings loose{.error = 0.02}, usual, fine{.error = 0.001};
    const GatherSettings split{.is_exact = true}, lines{.error = 0.002, .method = Method::scanline};
    for (const GatherSettings& settings : {loose, usual, fine, split, lines}) {
        SCOPED_TRACE(testing::Message() << "error " << settings.error << (settings.is_exact ? ", exact" : ""));
        // Exact points leave a quarter of the error to the texel's average.
        const double error = settings.is_exact ? settings.error / 4 : settings.error;
        const auto estimates = floor.gathered(settings);
        double squares = 0, largest = 0;
        size_t beyond = 0;
        for (size_t i = 0; i < estimates.size(); ++i) {
            const double off = std::abs(visibility_of(estimates[i]) - floor.exact[i]);
            if (off > error + midpoint_error) ++beyond;
            largest = std::max(largest, off);
            squares += off * off;
        }
        EXPECT_LE(beyond, 1) << "largest error " << largest;
        EXPECT_LE(std::sqrt(squares / static_cast<double>(estimates.size())), error / 2);
    }

    const auto by_rays = floor.gathered({.method = Method::monte_carlo, .samples = 1024, .seed = 3});
    double normalised = 0, worst = 0;
    for (size_t i = 0; i < by_rays.size(); ++i) {
        const double sigma = std::hypot(static_cast<double>(by_rays[i].error), midpoint_error);
        const double off = std::abs(visibility_of(by_rays[i]) - floor.exact[i]) / sigma;
        if (floor.exact[i] > 1e-3 && floor.exact[i] < 1 - 1e-3) normalised += off * off;
        worst = std::max(worst, off);
    }
    EXPECT_LT(std::sqrt(normalised / static_cast<double>(penumbra)), 1);
    EXPECT_LT(worst, 5);
}

TEST(Penumbra, HalfPlaneOverAFloor_M3) {
    Stage stage;
    stage.add_sheet({0.1, 1.1, 4}, {4, 1.1, 4}, {4, 1.1, -4}, {0.3, 1.1, -4});
    expect_exact_penumbra(stage);
}

TEST(Penumbra, BoxOverAFloor_M3) {
    Stage stage;
    stage.add_block({0.15, 0.9, -0.2}, {0.9, 0.4, 0.7});
    expect_exact_penumbra(stage);
}

TEST(Penumbra, SlitOverAFloorIsWithinItsStatedError_M52) {
    Stage stage;
    stage.add_sheet({-4, 1.2, 4}, {-0.1, 1.2, 4}, {-0.1, 1.2, -4}, {-4, 1.2, -4});
    stage.add_sheet({0.1, 1.2, 4}, {4, 1.2, 4}, {4, 1.2, -4}, {0.1, 1.2, -4});
    expect_exact_penumbra(stage);
}

TEST(Penumbra, ErrorFallsFasterThanTheSquareRootOfTheSamples_M6) {
    Stage stage;
    stage.add_block({0.15, 0.9, -0.2}, {0.9, 0.4, 0.7});
    const Floor floor(stage);
    const auto rms = [&](int samples) {
        const GatherSettings settings{.method = Method::monte_carlo, .samples = samples, .seed = 1};
        const auto estimates = floor.gathered(settings);
        double sum = 0;
        for (size_t i = 0; i < estimates.size(); ++i) sum += std::pow(visibility_of(estimates[i]) - floor.exact[i], 2);
        return std::sqrt(sum / static_cast<double>(estimates.size()));
    };
    // Independent samples would give 4; stratified ones N^-0.6 at least in four dimensions: 5.3.
    EXPECT_GT(rms(64) / rms(1024), 5.0);
}

}  // namespace
}  // namespace surimi
