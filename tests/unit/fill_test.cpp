// SPDX-License-Identifier: Apache-2.0
#include "baker/post/fill.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "baker/post/ratio.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

constexpr int size = 32;

/// A rectangle of texels on a page.
struct OnMap {
    int x = 0, y = 0, width = 8, height = 8;
    int page = 0;
};

/// Rectangles in space, each a surface and a chart of its own unless told, of texels that are one metre wide.
struct Sheets {
    Scene scene;
    Atlas atlas;
    std::vector<Texels> pages;
    std::vector<Channel> channels;

    Sheets() { atlas.width = atlas.height = size; }

    /// Its front shows along u x v, the ways along the map's x and y.
    uint32_t add(const Vec3& corner, const Vec3& u, const Vec3& v, const OnMap& on) {
        const auto number = static_cast<uint32_t>(scene.surfaces.size());
        Surface& surface = scene.surfaces.emplace_back();
        const Vec3 along_u = u * static_cast<double>(on.width), along_v = v * static_cast<double>(on.height);
        surface.positions = {corner, corner + along_u, corner + along_u + along_v, corner + along_v};
        surface.normals.assign(4, glm::normalize(glm::cross(u, v)));
        surface.triangles = {{0, 1, 2}, {0, 2, 3}};
        const auto uv = [](int x, int y) { return Vec2f(x, y) / static_cast<float>(size); };
        const Vec2f a = uv(on.x, on.y), b = uv(on.x + on.width, on.y), d = uv(on.x, on.y + on.height);
        const Vec2f c = uv(on.x + on.width, on.y + on.height);
        const auto chart = static_cast<uint32_t>(atlas.charts.size());
        atlas.surfaces.push_back({{{a, b, c}, {a, c, d}}, {chart, chart}, on.page});
        atlas.charts.push_back({number, 1 / glm::length(u)});
        atlas.pages = std::max(atlas.pages, on.page + 1);
        return number;
    }
    uint32_t add_floor(double x, double y, const OnMap& on) { return add({x, y, 0}, {1, 0, 0}, {0, 1, 0}, on); }
    /// Once all sheets are there: all of them measured, each texel 1.
    void measure() {
        for (int p = 0; p < atlas.pages; ++p) {
            pages.push_back(find_texels(scene, atlas, p));
            Channel& channel = channels.emplace_back();
            channel = {Image<float>(size, size, 1.f), Image<TexelState>(size, size, TexelState::empty)};
            for (const Texel& t : pages.back().texels) channel.state.pixels[t.index] = TexelState::covered;
        }
    }
    void set(const OnMap& on, TexelState state, float value) {
        for (int y = on.y; y < on.y + on.height; ++y)
            for (int x = on.x; x < on.x + on.width; ++x) {
                channels[static_cast<size_t>(on.page)].state.at(x, y) = state;
                channels[static_cast<size_t>(on.page)].visibility.at(x, y) = value;
            }
    }
    float at(int x, int y, int page = 0) const { return channels[static_cast<size_t>(page)].visibility.at(x, y); }
    void fill(bool in_space = true, int inside_rings = 255) {
        surimi::fill(scene, atlas, pages, channels, {.fills_in_space = in_space, .inside_rings = inside_rings});
    }
};

/// Two charts of one plane that meet at x = 8 in space; the right one, elsewhere on the map or on another page, is not
/// covered in its first three columns.
Sheets two_charts(int page) {
    Sheets sheets;
    sheets.add_floor(0, 0, {0, 0, 8, 8});
    sheets.add_floor(8, 0, {20, 12, 8, 8, page});
    sheets.measure();
    sheets.set({0, 0, 8, 8}, TexelState::covered, 0.25f);
    sheets.set({20, 12, 8, 8, page}, TexelState::covered, 0.75f);
    sheets.set({20, 12, 3, 8, page}, TexelState::unlit, 1.f);
    return sheets;
}

/// Several sheets, many of whose texels have no value, moved and scaled in space and filled.
Sheets random_sheets(const Vec3& origin, double scale) {
    Sheets sheets;
    for (int i = 0; i < 3; ++i) {
        const double angle = 0.3 * i;
        const Vec3 u(std::cos(angle), 0, std::sin(angle));
        sheets.add(origin + scale * Vec3(8 * i, 0, i * (i - 1)), scale * u, scale * Vec3(0, 1, 0), {10 * i, 3, 8, 20});
    }
    sheets.measure();
    for (const Texel& t : sheets.pages[0].texels) {
        const uint32_t h = t.index * 2654435761u >> 8;
        sheets.channels[0].visibility.pixels[t.index] = static_cast<float>(h % 1000) / 1000.f;
        if (h / 1000 % 3 > 0) continue;
        sheets.channels[0].state.pixels[t.index] = h % 2 ? TexelState::unlit : TexelState::inside;
        sheets.channels[0].visibility.pixels[t.index] = 1.f;
    }
    sheets.fill();
    return sheets;
}

TEST(Fill, TakesFromAnotherChartOfThePlaneThatIsNearerInTheWorld) {
    for (const int page : {0, 1}) {
        Sheets sheets = two_charts(page);
        sheets.fill();
        for (int y = 12; y < 20; ++y) {
            EXPECT_EQ(sheets.at(20, y, page), 0.25f);
            EXPECT_TRUE(sheets.at(21, y, page) > 0.25f && sheets.at(21, y, page) < 0.75f);
            EXPECT_EQ(sheets.at(22, y, page), 0.75f);
            EXPECT_EQ(sheets.channels[static_cast<size_t>(page)].state.at(20, y), TexelState::unlit);
        }
    }
}

TEST(Fill, CanBeToldToStayInTheChart) {
    Sheets sheets = two_charts(0);
    sheets.fill(false);
    for (int x = 20; x < 28; ++x) EXPECT_EQ(sheets.at(x, 15), 0.75f);
}

TEST(Fill, TakesNothingThroughAThinWall) {
    Sheets sheets;  // two rooms back to back, the wall between them a hundredth of a texel
    sheets.add({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 8, 8});
    sheets.add({8, 0.01, 0}, {-1, 0, 0}, {0, 0, 1}, {12, 0, 8, 8});
    sheets.measure();
    sheets.set({0, 0, 8, 8}, TexelState::covered, 0.f);
    sheets.set({2, 2, 5, 5}, TexelState::unlit, 1.f);
    sheets.fill();
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_EQ(sheets.at(x, y), 0.f) << x << " " << y;
}

TEST(Fill, TakesNothingFromTheFloorUnderARug) {
    Sheets sheets;
    sheets.add_floor(0, 0, {0, 0, 12, 12});
    sheets.add({2, 2, 0.1}, {1, 0, 0}, {0, 1, 0}, {16, 0, 8, 8});
    sheets.measure();
    sheets.set({0, 0, 12, 12}, TexelState::covered, 0.f);
    sheets.set({1, 1, 2, 2}, TexelState::inside, 0.f);  // so that the floor has a rim there
    sheets.set({16, 0, 2, 2}, TexelState::inside, 0.f);
    sheets.fill();
    EXPECT_EQ(sheets.at(16, 0), 1.f);
    EXPECT_EQ(sheets.at(17, 1), 1.f);
    EXPECT_EQ(sheets.at(1, 1), 0.f);
}

TEST(Fill, UnderAWallTakesFromBothSidesAndVisibleTexelsKeepTheirs) {
    Sheets sheets;  // a dark room, a wall three texels thick, a bright one, on one floor
    sheets.add_floor(0, 0, {0, 0, 16, 8});
    sheets.measure();
    sheets.set({0, 0, 6, 8}, TexelState::covered, 0.f);
    sheets.set({6, 0, 3, 8}, TexelState::inside, 0.3f);
    sheets.fill();
    for (int y = 2; y < 6; ++y) {
        for (int x = 0; x < 7; ++x) EXPECT_EQ(sheets.at(x, y), 0.f) << x;
        EXPECT_NEAR(sheets.at(7, y), 0.5f, 1e-6f);
        for (int x = 8; x < 16; ++x) EXPECT_EQ(sheets.at(x, y), 1.f) << x;
    }
}

TEST(Fill, InsideABoxThatSinksIntoTheFloorLooksLikeTheFloorAroundIt) {
    Sheets sheets;
    sheets.add_floor(0, 0, {0, 0, 16, 16});
    sheets.add({6, 6, -2}, {1, 0, 0}, {0, 0, 1}, {18, 0, 4, 4});    // a side of the box, half below the floor
    sheets.add({6, 10, -2}, {1, 0, 0}, {0, -1, 0}, {18, 6, 4, 4});  // its bottom, which faces down
    sheets.measure();
    sheets.set({0, 0, 16, 16}, TexelState::covered, 0.75f);
    sheets.set({6, 6, 4, 4}, TexelState::inside, 0.f);
    sheets.set({18, 0, 4, 4}, TexelState::covered, 0.f);
    sheets.set({18, 6, 4, 4}, TexelState::covered, 0.f);
    sheets.fill();
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) EXPECT_EQ(sheets.at(x, y), 0.75f) << x << " " << y;
}

TEST(Fill, BeyondATerminatorTakesTheLitFacetOfACylinder) {
    Sheets sheets;  // two neighbouring facets of a sixteen-sided one
    const double angle = pi / 8;
    sheets.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 6, 8});
    sheets.add({6, 0, 0}, {std::cos(angle), 0, -std::sin(angle)}, {0, 1, 0}, {10, 0, 6, 8});
    sheets.measure();
    sheets.set({0, 0, 6, 8}, TexelState::covered, 0.5f);
    sheets.set({10, 0, 3, 8}, TexelState::unlit, 1.f);
    sheets.fill();
    EXPECT_EQ(sheets.at(10, 4), 0.5f);
}

TEST(Fill, DoesNotGoAroundASquareCorner) {
    Sheets sheets;
    sheets.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 6, 8});
    sheets.add({6, 0, 0}, {0, 0, -1}, {0, 1, 0}, {10, 0, 6, 8});
    sheets.measure();
    sheets.set({0, 0, 6, 8}, TexelState::covered, 0.5f);
    sheets.set({10, 0, 3, 8}, TexelState::unlit, 0.f);
    sheets.fill();
    EXPECT_EQ(sheets.at(10, 4), 1.f);
}

TEST(Fill, FarFromWhatIsCoveredItGrowsThroughTheChart) {
    Sheets sheets;
    sheets.add_floor(0, 0, {0, 0, 30, 4});
    sheets.measure();
    sheets.set({0, 0, 4, 4}, TexelState::covered, 0.25f);
    sheets.set({4, 0, 26, 4}, TexelState::unlit, 1.f);
    sheets.fill();
    EXPECT_EQ(sheets.at(5, 2), 0.25f);
    EXPECT_EQ(sheets.at(29, 2), 0.25f);
}

TEST(Fill, AnUnlitChartTakesItsSurfacesMean) {
    Sheets sheets = two_charts(0);
    sheets.atlas.charts[1].surface = 0;
    sheets.set({20, 12, 8, 8}, TexelState::unlit, 1.f);
    sheets.set({0, 0, 4, 8}, TexelState::covered, 0.75f);
    sheets.fill();
    EXPECT_EQ(sheets.at(24, 15), 0.5f);
}

TEST(Fill, AnUnlitSurfaceIsOneNotZero) {
    Sheets sheets = two_charts(0);
    sheets.set({20, 12, 8, 8}, TexelState::unlit, 0.1f);
    sheets.fill();
    EXPECT_EQ(sheets.at(24, 15), 1.f);
    EXPECT_EQ(sheets.at(4, 4), 0.25f);
}

TEST(Fill, DeepInsideOtherGeometryIsDark) {
    Sheets sheets = two_charts(0);
    sheets.set({20, 12, 2, 8}, TexelState::covered, 0.75f);
    sheets.set({22, 12, 6, 8}, TexelState::inside, 1.f);
    for (const int rings : {1, 2}) {
        Sheets filled = sheets;
        filled.fill(true, rings);
        for (int ring = 0; ring < 4; ++ring) {
            EXPECT_NEAR(filled.at(22 + ring, 16), ring < rings ? 0.75f : 0.f, 1e-6f) << ring;
            EXPECT_EQ(filled.channels[0].state.at(22 + ring, 16), TexelState::inside);
        }
    }
}

TEST(Fill, AMapWithoutASingleMeasuredTexelIsOne) {
    for (const bool in_space : {true, false}) {
        Sheets sheets = two_charts(1);
        sheets.set({0, 0, 8, 8}, TexelState::unlit, 0.f);
        sheets.set({20, 12, 8, 8, 1}, TexelState::unlit, 0.f);
        sheets.fill(in_space);
        for (const Channel& channel : sheets.channels)
            for (const float v : channel.visibility.pixels) EXPECT_EQ(v, 1.f);
    }
}

TEST(Fill, AChartWithoutADensityStaysFinite) {
    Sheets sheets = two_charts(0);
    sheets.atlas.charts[1].texels_per_metre = 0;
    sheets.fill();
    for (int x = 20; x < 28; ++x) EXPECT_EQ(sheets.at(x, 15), 0.75f);
}

TEST(Fill, IsTheSameAtAnyScaleAndFarFromTheOrigin) {
    const Sheets plain = random_sheets({5, 7, 9}, 1);
    const std::pair<Vec3, double> places[] = {
        {{-3.5, -4.5, 0}, 1}, {{5, 7, 9}, 1e-3}, {{5, 7, 9}, 1e4}, {{1e5, 1e5, -1e5}, 1}, {{1e5, 0, 1e5}, 0.01}};
    for (const auto& [origin, scale] : places) {  // the first has a texel at the world's origin
        const Sheets moved = random_sheets(origin, scale);
        for (const Texel& t : plain.pages[0].texels)
            EXPECT_NEAR(moved.channels[0].visibility.pixels[t.index], plain.channels[0].visibility.pixels[t.index],
                        1e-6)
                << scale << " " << origin.x;
    }
}

TEST(Fill, OneThreadAndManyGiveTheSameBytes) {
    const int before = thread_count();
    set_thread_count(1);
    const Sheets one = random_sheets(Vec3(0), 1);
    set_thread_count(8);
    const Sheets many = random_sheets(Vec3(0), 1);
    set_thread_count(before);
    EXPECT_EQ(one.channels[0].visibility.pixels, many.channels[0].visibility.pixels);
}

TEST(Fill, IsMirroredWhenTheMapIs) {  // scan order must not show
    const auto build = [](bool mirrored, bool in_space) {
        Sheets sheets;
        // A mirrored chart on the map, of the same surface in space.
        if (mirrored)
            sheets.add({16, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 16, 8});
        else
            sheets.add({0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, 16, 8});
        sheets.measure();
        for (int i = 0; i < 16 * 8; ++i) {
            const int x = i % 16, y = i / 16;
            const bool is_covered = (x * 7 + y * 3) % 11 <= 2;
            sheets.set({mirrored ? 15 - x : x, y, 1, 1}, is_covered ? TexelState::covered : TexelState::unlit,
                       static_cast<float>(i % 13) / 16.f);
        }
        sheets.fill(in_space);
        return sheets;
    };
    for (const bool in_space : {true, false}) {
        const Sheets plain = build(false, in_space), mirrored = build(true, in_space);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 16; ++x) EXPECT_NEAR(plain.at(x, y), mirrored.at(15 - x, y), 1e-6);
    }
}

TEST(VisibilityChannel, IsShadowedOverUnshadowedAndMarksUnlitTexels_M3) {
    Sheets map = two_charts(0);
    std::vector<IrradianceEstimate> estimates(map.pages[0].texels.size());
    estimates[0] = {2.f, 0.5f, 0.f};
    estimates[1] = {1e-20f, 1e-20f, 0.f};
    const Channel channel = visibility_channel(map.pages[0], estimates);
    EXPECT_EQ(channel.visibility.pixels[map.pages[0].texels[0].index], 0.25f);
    EXPECT_EQ(channel.visibility.pixels[map.pages[0].texels[1].index], 1.f);
    EXPECT_EQ(channel.state.pixels[map.pages[0].texels[1].index], TexelState::covered);
    EXPECT_EQ(channel.state.pixels[map.pages[0].texels[2].index], TexelState::unlit);
    EXPECT_EQ(channel.state.at(31, 31), TexelState::empty);
}

}  // namespace
}  // namespace surimi
