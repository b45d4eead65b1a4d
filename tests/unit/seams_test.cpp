// SPDX-License-Identifier: Apache-2.0
#include "baker/post/seams.h"

#include <gtest/gtest.h>

#include "tests/support/patches.h"

namespace surimi {
namespace {

using test::make_patches;
using test::Patch;

/// Two squares of 1 m side by side, which meet at x = 1.
std::vector<Patch> pair_of_squares() {
    Patch left, right;
    left.texel_corner = Vec2(4, 4);
    right.corner = Vec3(1, 0, 0);
    right.texel_corner = Vec2(30, 7);
    return {left, right};
}

double metres(const Seams& seams) {
    double sum = 0;
    for (const SeamPiece& piece : seams.pieces) sum += piece.length;
    return sum;
}

size_t count_of(const std::vector<Patch>& patches) {
    const auto made = make_patches(patches);
    return find_seams(made.scene, made.atlas).pieces.size();
}

TEST(FindSeams, JoinsChartsSurfacesAndPagesAlongTheirWholeEdge_M60) {
    for (const int way : {0, 1, 2}) {
        auto patches = pair_of_squares();
        if (way == 2) patches[1].page = 1;
        const auto made = make_patches(patches, way == 0);
        const Seams seams = find_seams(made.scene, made.atlas);
        ASSERT_EQ(seams.pieces.size(), 1u) << way;
        const SeamPiece& piece = seams.pieces[0];
        EXPECT_NEAR(piece.length, 1, 1e-12);
        EXPECT_NE(piece.sides[0].chart, piece.sides[1].chart);
        for (const SeamSide& side : piece.sides) {
            const Patch& patch = patches[side.chart];
            EXPECT_EQ(side.page, patch.page);
            for (const size_t end : {0u, 1u}) {  // both sides speak of the same place
                const Vec3 place = patch.place_at(side.texels[end]);
                EXPECT_NEAR(place.x, 1, 1e-6);
                EXPECT_NEAR(place.y, patches[piece.sides[0].chart].place_at(piece.sides[0].texels[end]).y, 1e-6);
            }
            EXPECT_NEAR(glm::length(side.texels[1] - side.texels[0]), 16, 1e-5);
        }
    }
}

TEST(FindSeams, InsideAChartThereAreNone) {
    auto patches = pair_of_squares();
    EXPECT_EQ(count_of({patches[0]}), 0u);
    patches[1].texel_corner = patches[0].texel_corner + patches[0].texel_u;  // the map goes on
    EXPECT_EQ(count_of(patches), 0u);
}

TEST(FindSeams, ACutWithinOneChartIsASeam) {
    auto made = make_patches(pair_of_squares(), true);
    for (uint32_t& chart : made.atlas.surfaces[0].chart) chart = 0;
    const Seams seams = find_seams(made.scene, made.atlas);
    ASSERT_EQ(seams.pieces.size(), 1u);
    EXPECT_EQ(seams.pieces[0].sides[0].chart, seams.pieces[0].sides[1].chart);
}

TEST(FindSeams, EdgesOfDifferentLengthsMeetWhereTheyOverlap) {
    Patch wall;
    wall.corner = Vec3(-1, -0.5, 0);
    wall.u = Vec3(1, 0, 0), wall.v = Vec3(0, 2.5, 0), wall.texel_v = Vec2(0, 40);
    std::vector<Patch> patches = {wall};
    const std::array<double, 4> borders = {0, 0.3, 0.45, 3};  // of tiles; the last goes on beyond the wall
    for (size_t i = 0; i < 3; ++i) {
        Patch tile;
        tile.corner = Vec3(0, borders[i], 0);
        tile.v = Vec3(0, borders[i + 1] - borders[i], 0);
        tile.texel_corner = Vec2(20, 20 * static_cast<double>(i));
        patches.push_back(tile);
    }
    const auto made = make_patches(patches);
    const Seams seams = find_seams(made.scene, made.atlas);
    EXPECT_EQ(seams.pieces.size(), 5u);  // three with the wall, two between the tiles
    EXPECT_NEAR(metres(seams), 2 + 2, 1e-9);
    for (const SeamPiece& piece : seams.pieces)
        for (const size_t end : {0u, 1u})
            EXPECT_NEAR(glm::length(patches[piece.sides[0].chart].place_at(piece.sides[0].texels[end]) -
                                    patches[piece.sides[1].chart].place_at(piece.sides[1].texels[end])),
                        0, 1e-5);
}

TEST(FindSeams, SheetsCopiesAndCornersAreNone) {
    auto patches = pair_of_squares();
    const Patch left = patches[0], right = patches[1];
    Patch back = left;  // the other side of the same sheet
    back.corner = left.corner + left.u, back.u = -left.u, back.texel_corner = Vec2(30, 30);
    EXPECT_EQ(count_of({left, back}), 0u);
    Patch copy = left;
    copy.texel_corner = Vec2(30, 30);
    EXPECT_EQ(count_of({left, copy}), 0u);
    Patch wall = right;
    wall.u = Vec3(0, 0, 1);
    EXPECT_EQ(count_of({left, wall}), 0u);
    EXPECT_EQ(count_of({left, right, copy}), 2u);  // each of the copies meets the other square
}

/// Two squares that bend by `bend` degrees at x = 1, with normals that differ by `between` degrees around the middle.
size_t bent_count(double bend, double between) {
    auto patches = pair_of_squares();
    const double angle = bend * pi / 180;
    patches[1].u = Vec3(std::cos(angle), 0, -std::sin(angle));
    auto made = make_patches(patches);
    for (size_t s = 0; s < 2; ++s) {
        const double turn = (bend / 2 + (s == 0 ? -between / 2 : between / 2)) * pi / 180;
        for (Vec3& normal : made.scene.surfaces[s].normals) normal = Vec3(std::sin(turn), 0, std::cos(turn));
    }
    return find_seams(made.scene, made.atlas).pieces.size();
}

TEST(FindSeams, ShadingNormalsDecideAndFacesMayBendAsFarAsSixSides_M60) {
    EXPECT_EQ(bent_count(60, 0), 1u);
    EXPECT_EQ(bent_count(60, 1.9), 1u);
    EXPECT_EQ(bent_count(60, 2.1), 0u);
    EXPECT_EQ(bent_count(72, 0), 0u);
    EXPECT_EQ(bent_count(0, 5), 0u);
}

/// Squares of a grid, each a surface, scaled, moved and rounded to floats.
test::PatchScene grid(int side, double scale, const Vec3& away) {
    std::vector<Patch> patches;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            Patch patch;
            patch.corner = Vec3(x, y, 0);
            patch.texel_corner = Vec2(20 * x, 20 * y);
            patches.push_back(patch);
        }
    }
    auto made = make_patches(patches, false, 20 * side);
    for (Surface& surface : made.scene.surfaces)  // turned, so that all coordinates round
        for (Vec3& p : surface.positions)
            p = Vec3(Vec3f(away + scale * Vec3(0.8 * p.x - 0.36 * p.y, 0.6 * p.x + 0.48 * p.y, 0.8 * p.y)));
    for (Surface& surface : made.scene.surfaces) {
        const Vec3 normal = glm::normalize(glm::cross(Vec3(0.8, 0.6, 0), Vec3(-0.36, 0.48, 0.8)));
        for (Vec3& n : surface.normals) n = normal;
    }
    return made;
}

TEST(FindSeams, FarAwayAndTinyScenesHaveTheSameSeams) {
    const auto plain = grid(3, 1, Vec3(0));
    const Seams wanted = find_seams(plain.scene, plain.atlas);
    EXPECT_EQ(wanted.pieces.size(), 12u);
    for (const auto& made : {grid(3, 1e-3, Vec3(0)), grid(3, 1e4, Vec3(0)), grid(3, 1, Vec3(1e5, -1e5, 3e4))}) {
        const Seams seams = find_seams(made.scene, made.atlas);
        ASSERT_EQ(seams.pieces.size(), wanted.pieces.size());
    }
}

TEST(FindSeams, VerticesThatRoundingMovedStillMeetAndRealGapsDoNot) {
    auto patches = pair_of_squares();
    patches[1].corner.x += 4e-7;  // 4 steps of float at 1 m
    EXPECT_EQ(count_of(patches), 1u);
    patches[1].corner.x += 1e-5;
    EXPECT_EQ(count_of(patches), 0u);
}

TEST(FindSeams, DenseMeshesPairEachEdgeOnce) {
    const auto made = grid(24, 1e-4, Vec3(20, 0, 0));  // squares of 0.1 mm, where floats are 2 micrometres apart
    EXPECT_EQ(find_seams(made.scene, made.atlas).pieces.size(), 2u * 24 * 23);
}

TEST(FindSeams, SliversAndSurfacesThatAreNotOnTheMapHaveNone) {
    auto made = make_patches(pair_of_squares());
    made.atlas.charts[1].texels_per_metre = 0;
    EXPECT_TRUE(find_seams(made.scene, made.atlas).pieces.empty());
    made.atlas.charts[1].texels_per_metre = 16;
    EXPECT_FALSE(find_seams(made.scene, made.atlas).pieces.empty());
    made.atlas.surfaces[1] = {};
    EXPECT_TRUE(find_seams(made.scene, made.atlas).pieces.empty());
}

}  // namespace
}  // namespace surimi
