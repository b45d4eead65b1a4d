// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/existing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/unit/uv_scenes.h"

namespace surimi::test {
namespace {

UnwrapSettings settings_for(int size, UvSource uv = UvSource::existing) {
    UnwrapSettings settings;
    settings.uv = uv;
    settings.width = settings.height = size;
    return settings;
}

ExistingUv judge(const Scene& scene, int size = uv_map) {
    return judge_existing(scene, settings_for(size));
}

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(ExistingUv, ChartsTwoTexelsApartAreFit) {
    const ExistingUv found = judge(two_quads(2));
    EXPECT_EQ(found.fault, "");
    EXPECT_TRUE(found.bad.empty());
    EXPECT_TRUE(found.shared.empty());
    EXPECT_TRUE(found.atlas.warnings.empty());
    EXPECT_EQ(found.atlas.charts.size(), 2u);
    EXPECT_NEAR(found.atlas.texels_per_metre, 16, 1e-5);
}

TEST(ExistingUv, ChartsOneTexelApartShareItInBilinearReads) {
    const ExistingUv found = judge(two_quads(1));
    // The column between them, a texel longer at both ends.
    EXPECT_EQ(found.shared.size(), 18u);
    for (const uint32_t texel : found.shared) EXPECT_EQ(texel % uv_map, 24u);
    EXPECT_TRUE(says(found.fault, "left with right: triangles")) << found.fault;
    EXPECT_TRUE(says(found.fault, "share 18 texels of a map of 64 x 64")) << found.fault;
    EXPECT_TRUE(says(found.fault, "128 x 128 texels are enough")) << found.fault;
    EXPECT_EQ(judge(two_quads(1), 128).fault, "");
}

TEST(ExistingUv, ChartsThatTouchHaveNoSizeThatHelps) {
    const ExistingUv found = judge(two_quads(0));
    EXPECT_EQ(found.shared.size(), 36u);
    EXPECT_TRUE(says(found.fault, "no larger map")) << found.fault;
}

TEST(ExistingUv, EdgesOnTexelCentresShareNothingButLeaveNoGutter) {
    Scene scene;
    scene.surfaces.push_back(uv_quad("left", unit_square(0), {8.5, 8.5, 23.5, 23.5}));
    scene.surfaces.push_back(uv_quad("right", unit_square(5), {24.5, 8.5, 39.5, 23.5}));
    const ExistingUv found = judge(scene);
    EXPECT_EQ(found.fault, "");
    ASSERT_EQ(found.atlas.warnings.size(), 1u);
    EXPECT_TRUE(says(found.atlas.warnings[0], "leave 0 texels")) << found.atlas.warnings[0];
    EXPECT_EQ(found.atlas.gutter, 0);
}

TEST(ExistingUv, AGutterNarrowerThanAskedIsAWarning) {
    UnwrapSettings settings = settings_for(uv_map);
    settings.gutter = 4;
    const ExistingUv found = judge_existing(two_quads(3), settings);
    EXPECT_EQ(found.fault, "");
    ASSERT_EQ(found.atlas.warnings.size(), 1u);
    EXPECT_TRUE(says(found.atlas.warnings[0], "leave 3 texels")) << found.atlas.warnings[0];
    EXPECT_TRUE(judge_existing(two_quads(4), settings).atlas.warnings.empty());
}

TEST(ExistingUv, AMipLevelThatMixesChartsIsAWarning) {
    UnwrapSettings settings = settings_for(uv_map);
    settings.mips = 1;
    EXPECT_TRUE(judge_existing(two_quads(2), settings).atlas.warnings.empty());  // from 24 to 26: one texel of level 1
    settings.mips = 2;
    const auto warnings = judge_existing(two_quads(2), settings).atlas.warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(says(warnings[0], "mip level 2, 16 x 16")) << warnings[0];
    EXPECT_TRUE(judge_existing(two_quads(4), settings).atlas.warnings.empty());
}

TEST(ExistingUv, AChartMayGoOnAcrossSurfaces) {
    Scene scene = two_quads(0);
    for (Vec3& p : scene.surfaces[1].positions) p.x -= 4;  // now beside the first, in space as on the map
    const ExistingUv found = judge(scene);
    EXPECT_EQ(found.fault, "");
    EXPECT_EQ(found.atlas.charts.size(), 2u);
}

TEST(ExistingUv, UvsThatDifferInTheLastDigitAreJoined) {
    Scene scene = two_quads(0);
    for (Vec3& p : scene.surfaces[1].positions) p.x -= 4;
    for (Vec2& uv : scene.surfaces[1].uv_sets[1]) uv = Vec2(std::nextafter(static_cast<float>(uv.x), 2.0f), uv.y);
    EXPECT_EQ(judge(scene).fault, "");
}

TEST(ExistingUv, AreaWithoutTexelsIsAFaultUnlessNobodySeesIt) {
    Scene scene = two_quads(2);
    for (Vec2& uv : scene.surfaces[1].uv_sets[1]) uv = Vec2(0.9);
    EXPECT_TRUE(says(judge(scene).fault, "gives no area to right: triangles 0, 1")) << judge(scene).fault;
    for (Vec3& p : scene.surfaces[1].positions) p = Vec3(5, 0, 0) + 0.01 * p;  // a tenth of a texel across
    EXPECT_EQ(judge(scene).fault, "");
}

TEST(ExistingUv, NamesEveryKindOfFault) {
    Scene scene = two_quads(2);
    scene.surfaces[0].uv_sets[1][0].x = -0.5;
    scene.surfaces[1].uv_sets[1][2].x = std::nan("");
    const ExistingUv found = judge(scene);
    EXPECT_TRUE(says(found.fault, "leaves [0, 1] on left: triangles 0, 1")) << found.fault;
    EXPECT_TRUE(says(found.fault, "is not finite on right: triangles 0, 1")) << found.fault;
    EXPECT_EQ(found.bad.size(), 4u);
    for (const auto& uv : found.atlas.surfaces[1].uv)
        for (const Vec2f& p : uv) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
}

TEST(ExistingUv, MarksEveryTriangleThatOverlaps) {
    const ExistingUv found = judge(two_quads(-4));
    EXPECT_TRUE(says(found.fault, "left with right: triangles")) << found.fault;
    EXPECT_EQ(found.bad.size(), 4u);
    EXPECT_TRUE(found.shared.empty());
}

TEST(ExistingUv, AHeapIsJudgedInNoTime) {
    Scene scene;
    Surface& surface = scene.surfaces.emplace_back();
    surface.name = "heap";
    surface.uv_sets.resize(2);
    Random random{7};
    constexpr uint32_t triangles = 200000;  // 2e10 pairs: the test would not end if all were looked at
    for (uint32_t i = 0; i < 3 * triangles; ++i) {
        surface.positions.emplace_back(random.next(), random.next(), random.next());
        surface.uv_sets[1].emplace_back(random.next(), random.next());
        if (i % 3 == 2) surface.triangles.push_back({i - 2, i - 1, i});
    }
    const ExistingUv found = judge(scene);
    EXPECT_TRUE(says(found.fault, "heap with itself")) << found.fault;
}

TEST(ExistingUv, AutomaticTakesFitUvsAndSaysSo) {
    const Atlas atlas = unwrap(two_quads(2), settings_for(uv_map, UvSource::automatic), {});
    EXPECT_TRUE(atlas.is_existing);
    EXPECT_NE(atlas.uv_reason, "");
    EXPECT_EQ(atlas.surfaces[0].uv[0][0], Vec2f(0.125f, 0.125f));
}

TEST(ExistingUv, AutomaticMakesChartsWhenUvsAreUnfitAndSaysWhy) {
    Scene scene = two_quads(1);
    Atlas atlas = unwrap(scene, settings_for(uv_map, UvSource::automatic), {});
    EXPECT_FALSE(atlas.is_existing);
    EXPECT_TRUE(says(atlas.uv_reason, "share 18 texels")) << atlas.uv_reason;
    scene.surfaces[1].uv_sets.clear();
    atlas = unwrap(scene, settings_for(uv_map, UvSource::automatic), {});
    EXPECT_FALSE(atlas.is_existing);  // all surfaces or none
    EXPECT_TRUE(says(atlas.uv_reason, "is missing on right")) << atlas.uv_reason;
}

TEST(ExistingUv, AutomaticMakesChartsForSeveralAtlases) {
    UnwrapSettings settings = settings_for(uv_map, UvSource::automatic);
    settings.atlases = 2;
    const Atlas atlas = unwrap(two_quads(2), settings, {});
    EXPECT_FALSE(atlas.is_existing);
    EXPECT_TRUE(says(atlas.uv_reason, "one map")) << atlas.uv_reason;
}

TEST(ExistingUv, OurOwnChartsAreFit) {
    Scene scene;
    scene.surfaces.push_back(uv_quad("quad", unit_square(0), {8, 8, 24, 24}));
    scene.surfaces.push_back(uv_quad("fold", {Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(0, 1, 1)}, {}));
    const Atlas made = unwrap(scene, settings_for(uv_map, UvSource::unwrap), {});
    for (size_t s = 0; s < scene.surfaces.size(); ++s)
        for (size_t t = 0; t < 2; ++t)
            for (size_t k = 0; k < 3; ++k)
                scene.surfaces[s].uv_sets[1][scene.surfaces[s].triangles[t][k]] = Vec2(made.surfaces[s].uv[t][k]);
    const Atlas again = unwrap(scene, settings_for(uv_map), {});
    EXPECT_EQ(again.surfaces[0].uv, made.surfaces[0].uv);
    EXPECT_EQ(again.surfaces[1].uv, made.surfaces[1].uv);
    EXPECT_TRUE(again.warnings.empty());
}

}  // namespace
}  // namespace surimi::test
