// SPDX-License-Identifier: Apache-2.0
// Where charts are cut, joined and divided.
#include "baker/unwrap/charts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "baker/unwrap/min_cut.h"
#include "baker/unwrap/seam_cost.h"
#include "baker/unwrap/shorten.h"
#include "baker/unwrap/split.h"
#include "baker/unwrap/try_chart.h"
#include "baker/unwrap/walk.h"
#include "runtime/base/error.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"

namespace surimi {
namespace {

using test::Mesh;

/// cells x rows squares of side `side` in the plane z = 0.
Mesh sheet(int cells, int rows, double side = 1) {
    Mesh mesh;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= cells; ++x) mesh.positions.emplace_back(side * x, side * y, 0);
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < cells; ++x) {
            const auto a = static_cast<uint32_t>(y * (cells + 1) + x);
            const auto b = a + static_cast<uint32_t>(cells) + 1;
            mesh.triangles.push_back({a, a + 1, b + 1});
            mesh.triangles.push_back({a, b + 1, b});
        }
    }
    return mesh;
}

FaceGraph graph_of(const Mesh& mesh) {
    return build_face_graph(test::scene_of({mesh}).surfaces[0]);
}

std::vector<FlatChart> charts_of(const FaceGraph& graph) {
    constexpr double plenty = 1e6;  // texels
    return cut_into_charts(graph, cut_settings({}, plenty), {});
}

TEST(MinCut, IsTheCheapestOfAll) {
    Choice random{{5}};
    for (int round = 0; round < 50; ++round) {
        constexpr uint32_t nodes = 8;
        struct Edge {
            uint32_t a, b;
            int64_t capacity;
        };
        std::vector<Edge> edges;
        MinCut cut(nodes);
        for (int i = 0; i < 18; ++i) {
            const Edge edge{static_cast<uint32_t>(random.between(0, nodes)),
                            static_cast<uint32_t>(random.between(0, nodes)),
                            static_cast<int64_t>(random.between(0, 20))};
            if (edge.a == edge.b) continue;
            edges.push_back(edge);
            cut.add_edge(edge.a, edge.b, edge.capacity);
        }
        const auto cost_of = [&](const auto& stays) {
            int64_t cost = 0;
            for (const Edge& e : edges) cost += stays(e.a) != stays(e.b) ? e.capacity : 0;
            return cost;
        };
        int64_t least = INT64_MAX;
        for (uint32_t set = 0; set < 1u << nodes; ++set)
            if ((set & 1) != 0 && (set & 2) == 0)
                least = std::min(least, cost_of([&](uint32_t n) { return (set >> n & 1) != 0; }));
        const std::vector<bool> stays = cut.separate(0, 1);
        EXPECT_TRUE(stays[0]);
        EXPECT_FALSE(stays[1]);
        EXPECT_EQ(cost_of([&](uint32_t n) { return static_cast<bool>(stays[n]); }), least);
    }
}

TEST(Split, AJaggedBorderBecomesStraight) {
    constexpr int cells = 20;
    const FaceGraph graph = graph_of(sheet(cells, cells));
    SeamFlags seams(graph);
    std::vector<uint32_t> number(graph.corners.size());
    const Patch patch = build_patch(graph, seams, by_rank(graph), number);
    Choice random{{1}};
    std::vector<uint8_t> sides;
    for (const Vec3& p : centroids(patch)) {
        const Vec3 place = p * patch.unit + graph.positions[patch.places[0]];
        sides.push_back(place.x + random.between(-1.5, 1.5) < cells / 2.0 ? 0 : 1);
    }
    straighten(graph, patch, sides);
    cut_between(graph, patch, sides, seams);
    double length = 0;
    for (uint32_t f = 0; f < graph.corners.size(); ++f) {
        for (uint32_t k = 0; k < 3; ++k) {
            if (!seams.is_cut(f, k) || graph.neighbours[f][k] == no_face || graph.neighbours[f][k] < f) continue;
            SeamLength edge;
            add_edge(graph, f, k, edge);
            length += edge.visible;
        }
    }
    EXPECT_NEAR(length, cells, 1e-9);
}

TEST(Split, BothPartsOfAShapeHangTogether) {
    for (const Mesh& mesh : {test::torus(24, 12), test::uv_sphere(16, 8), test::terrain(16)}) {
        const FaceGraph graph = graph_of(mesh);
        SeamFlags seams(graph);
        std::vector<uint32_t> number(graph.corners.size());
        std::vector<uint32_t> faces;
        for (const uint32_t f : by_rank(graph))
            if (!graph.is_sliver[f]) faces.push_back(f);
        const Patch patch = build_patch(graph, seams, faces, number);
        cut_between(graph, patch, split_by_shape(patch), seams);
        EXPECT_EQ(connected_parts(graph, seams, faces, number).size(), 2u);
    }
}

TEST(Walk, GoesAroundWhatIsCutOut) {
    const FaceGraph graph = graph_of(test::arch(1, 100));
    std::vector<uint32_t> number(graph.corners.size());
    const Patch patch = build_patch(graph, SeamFlags(graph), by_rank(graph), number);
    const Walk there = walk_from({0}, patch.neighbours, centroids(patch));
    const Walk back = walk_from({there.last}, patch.neighbours, centroids(patch));
    // From end to end along 270 degrees of a cylinder, not across the gap: its length over the root of its area.
    const double length = 1.5 * pi / patch.unit;
    EXPECT_GT(static_cast<double>(back.distance[back.last]), 0.95 * length);
}

TEST(Charts, ACylinderIsOneChartAndTwoLids) {
    const std::vector<FlatChart> charts = charts_of(graph_of(test::capped_cylinder(64)));
    EXPECT_EQ(charts.size(), 3u);
    for (const FlatChart& chart : charts) EXPECT_NEAR(chart.stretch, 1, 1e-6);
}

TEST(Charts, ABoxIsSixRectangles) {
    const std::vector<FlatChart> charts = charts_of(graph_of(test::box(Vec3(0), Vec3(1, 2, 3))));
    ASSERT_EQ(charts.size(), 6u);
    for (const FlatChart& chart : charts) EXPECT_NEAR(chart.extent.x * chart.extent.y, chart.area, 1e-9);
}

TEST(Charts, NoneOverlapsItself_M43) {
    for (const Mesh& mesh : {test::helix(3, 40), test::torus(32, 16), test::cloth(60, 12), test::book()}) {
        for (const FlatChart& chart : charts_of(graph_of(mesh))) {
            if (chart.is_sliver) continue;
            EXPECT_FALSE(find_overlap(chart));
            for (const auto& t : chart.triangles)
                EXPECT_GT(doubled_area(chart.points[t[0]], chart.points[t[1]], chart.points[t[2]]), 0);
        }
    }
}

TEST(Charts, EveryFaceIsInOneOfThem) {
    const FaceGraph graph = graph_of(test::degenerate_grid());
    std::vector<int> count(graph.corners.size(), 0);
    for (const FlatChart& chart : charts_of(graph))
        for (const uint32_t f : chart.faces) ++count[f];
    EXPECT_TRUE(std::all_of(count.begin(), count.end(), [](int n) { return n == 1; }));
}

TEST(FaceGraph, CountsWhatIsOdd) {
    const MeshCounts sheet_counts = graph_of(sheet(2, 1)).counts;
    EXPECT_EQ(sheet_counts.open_edges, 6u);
    EXPECT_EQ(sheet_counts.components, 1u);
    EXPECT_EQ(sheet_counts.branching_edges + sheet_counts.opposed_edges + sheet_counts.doubled_faces, 0u);
    const MeshCounts book = graph_of(test::book()).counts;
    EXPECT_EQ(book.branching_edges, 1u);  // the spine
    EXPECT_GE(book.components, 2u);
    EXPECT_GT(graph_of(test::moebius()).counts.opposed_edges, 0u);
    Mesh twice = sheet(1, 1);
    twice.triangles.push_back(twice.triangles[0]);
    EXPECT_EQ(graph_of(twice).counts.doubled_faces, 1u);
    EXPECT_EQ(graph_of(test::box(Vec3(0), Vec3(1))).counts.open_edges, 0u);
    EXPECT_GT(graph_of(test::needle_fan()).counts.slivers, 0u);
}

TEST(Charts, StopWhenTold) {
    const FaceGraph graph = graph_of(test::torus(24, 12));
    Progress progress;
    progress.is_cancelled = [] { return true; };
    EXPECT_THROW(cut_into_charts(graph, cut_settings({}, 1e6), progress), Error);
}

TEST(Charts, StretchHasToBeAboveOne) {
    UnwrapSettings settings;
    for (const double stretch : {1.0, 0.5, static_cast<double>(NAN)}) {
        settings.stretch = stretch;
        EXPECT_THROW(unwrap(test::scene_of({sheet(1, 1)}), settings, {}), Error);
    }
}

TEST(Shorten, ALongSheetIsDividedAndASquareOneIsNot_M45) {
    const std::vector<FaceGraph> graphs{graph_of(sheet(64, 4)), graph_of(sheet(16, 16))};
    for (const size_t g : {size_t{0}, size_t{1}}) {
        std::vector<FlatChart> charts = charts_of(graphs[g]);
        ASSERT_EQ(charts.size(), 1u);
        shorten_charts({graphs[g]}, {1.0}, 1, charts);
        EXPECT_EQ(charts.size() > 1, g == 0);
        double area = 0;
        for (const FlatChart& chart : charts) {
            area += chart.area;
            EXPECT_LT(std::max(chart.extent.x, chart.extent.y), 20);
        }
        EXPECT_NEAR(area, 256, 1e-9);
    }
    // The map may be as long as the sheet.
    std::vector<FlatChart> charts = charts_of(graphs[0]);
    shorten_charts({graphs[0]}, {1.0}, 16, charts);
    EXPECT_EQ(charts.size(), 1u);
}

TEST(Shorten, FacesAsLongAsTheChartAreLeftTogether_M45) {
    // Two triangles a strip, 40 strips side by side, each 100 long: no cut across makes any of it shorter.
    Mesh mesh;
    for (int i = 0; i <= 40; ++i)
        for (int j = 0; j < 2; ++j) mesh.positions.emplace_back(0.1 * i, 100 * j, 0);
    for (uint32_t i = 0; i < 40; ++i) {
        mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
        mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
    }
    const FaceGraph graph = graph_of(mesh);
    std::vector<FlatChart> charts = charts_of(graph);
    shorten_charts({graph}, {1.0}, 1, charts);
    EXPECT_EQ(charts.size(), 1u);
}

}  // namespace
}  // namespace surimi
