// SPDX-License-Identifier: Apache-2.0
// Meshes that break unwrappers, each judged by rules written here, independent of the code under test.
#include "baker/unwrap/unwrap.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

namespace surimi {
namespace {

using Triangle2 = std::array<Vec2, 3>;

double cross2(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// ---- meshes
// -------------------------------------------------------------------------------------------------------

struct Mesh {
    std::vector<Vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;

    uint32_t add(const Vec3& p) {
        positions.push_back(p);
        return static_cast<uint32_t>(positions.size() - 1);
    }
    void triangle(const Vec3& a, const Vec3& b, const Vec3& c) { triangles.push_back({add(a), add(b), add(c)}); }
    void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }
};

/// Grid of n x m cells over [0, 1]^2, bent by `place`. No vertex is shared, as flat shading stores it.
Mesh sheet(int n, int m, const std::function<Vec3(double, double)>& place) {
    Mesh mesh;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            const auto at = [&](int a, int b) { return place(static_cast<double>(a) / n, static_cast<double>(b) / m); };
            mesh.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return mesh;
}

/// cos and sin that close: after a full turn they are what they were, to the bit.
Vec2 turn(double fraction) {
    const double angle = 2 * pi * (fraction - std::floor(fraction));
    return {std::cos(angle), std::sin(angle)};
}

Mesh sphere() {
    return sheet(48, 24, [](double u, double v) {
        const double height = v == 0 ? -1 : v == 1 ? 1 : -std::cos(pi * v);
        const double radius = v == 0 || v == 1 ? 0 : std::sin(pi * v);
        return Vec3(radius * turn(u), height);
    });
}
Mesh arch() {
    return sheet(200, 8, [](double u, double v) { return Vec3(turn(0.75 * u), 2 * v); });
}
Mesh torus() {
    return sheet(60, 30, [](double u, double v) { return Vec3((2 + 0.7 * turn(v).x) * turn(u), 0.7 * turn(v).y); });
}
Mesh height_field() {
    return sheet(40, 40, [](double u, double v) {
        return Vec3(10 * u, 10 * v, std::sin(9 * u) * std::cos(7 * v) + 0.3 * std::sin(20 * u + 15 * v));
    });
}
Mesh helix() {
    return sheet(300, 2, [](double u, double v) { return Vec3((1 + v) * turn(4 * u), 0.4 * u); });
}
Mesh book() {
    Mesh mesh;
    for (int page = 0; page < 3; ++page) {
        const Vec2 way = turn(0.02 + 0.1 * page);
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 2; ++j) {
                const Vec3 across(0.5 * way, 0);
                const Vec3 low(0, 0, i);
                const Vec3 high(0, 0, i + 1);
                mesh.quad(low + across * double(j), low + across * double(j + 1), high + across * double(j + 1),
                          high + across * double(j));
            }
    }
    return mesh;
}
Mesh moebius() {
    const int n = 60;
    Mesh mesh;
    const auto at = [&](int i, int side) {
        const bool has_turned = i == n;  // the strip closes with its sides swapped
        const double u = static_cast<double>(i % n) / n;
        const double w = (side == 1) != has_turned ? 0.4 : -0.4;
        const double half = pi * u;
        return Vec3((2 + w * std::cos(half)) * turn(u), w * std::sin(half));
    };
    for (int i = 0; i < n; ++i) mesh.quad(at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1));
    return mesh;
}
/// A floor of strips cut at different places, so that vertices lie on other strips' edges, and walls on top
/// of it.
Mesh t_junctions() {
    Mesh mesh;
    for (int i = 0; i < 6; ++i) {
        const int cuts = 1 + (i * 5) % 7;
        for (int j = 0; j < cuts; ++j) {
            const double x0 = 7.0 * j / cuts;
            const double x1 = 7.0 * (j + 1) / cuts;
            mesh.quad({x0, i / 3.0, 0}, {x1, i / 3.0, 0}, {x1, (i + 1) / 3.0, 0}, {x0, (i + 1) / 3.0, 0});
        }
        mesh.quad({0, i / 3.0, 0}, {7, i / 3.0, 0}, {7, i / 3.0, 2}, {0, i / 3.0, 2});
    }
    // One polygon whose long side carries the corners of many.
    for (int j = 0; j < 9; ++j) mesh.triangle({7, 0.1, 0}, {8, j / 9.0, 0}, {8, (j + 1) / 9.0, 0});
    return mesh;
}
Mesh needles() {
    Mesh mesh;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 60; ++i) {  // a fan of slim triangles around one point, some hair-thin
        const double from = i / 60.0;
        const double to = i % 5 == 0 ? from + 1e-7 : (i + 1) / 60.0;
        mesh.triangle({0, 0, 0}, Vec3(5.0 * turn(from), 0), Vec3(5.0 * turn(to), 0));
        if (i % 5 == 0) mesh.triangle({0, 0, 0}, Vec3(5.0 * turn(to), 0), Vec3(5.0 * turn((i + 1) / 60.0), 0));
    }
    for (int i = 0; i < 40; ++i) {
        const Vec3 a(unit(random), unit(random), 3 + unit(random));
        mesh.triangle(a, a + Vec3(1, 0, 0), a + Vec3(0.5, std::pow(10.0, -1 - 0.3 * i), 0));
    }
    return mesh;
}
Mesh degenerate() {
    Mesh mesh = sheet(8, 8, [](double u, double v) { return Vec3(u, v, 0.1 * u * v); });
    mesh.triangle({0, 0, 0}, {0, 0, 0}, {1, 1, 1});
    mesh.triangle({2, 2, 2}, {2, 2, 2}, {2, 2, 2});
    mesh.triangle({0, 0, 5}, {1, 0, 5}, {3, 0, 5});
    const size_t half = mesh.triangles.size() / 2;
    for (size_t t = 0; t < half; ++t) mesh.triangles.push_back(mesh.triangles[t]);  // duplicates
    for (size_t t = 0; t < half; ++t) {                                             // and back sides
        const auto c = mesh.triangles[t];
        mesh.triangles.push_back({c[0], c[2], c[1]});
    }
    return mesh;
}
Mesh mixed_winding() {
    Mesh mesh = height_field();
    std::mt19937 random(3);
    for (auto& t : mesh.triangles)
        if (random() % 4 == 0) std::swap(t[1], t[2]);
    return mesh;
}
Mesh signed_zeros() {
    Mesh mesh = sheet(10, 10, [](double u, double v) { return Vec3(u - 0.5, v - 0.5, 0); });
    for (size_t i = 0; i < mesh.positions.size(); i += 2)
        for (int k = 0; k < 3; ++k)
            if (mesh.positions[i][k] == 0) mesh.positions[i][k] = -0.0;
    return mesh;
}
Mesh scaled(Mesh mesh, double factor) {
    for (Vec3& p : mesh.positions) p *= factor;
    return mesh;
}
Mesh shuffled(Mesh mesh, unsigned seed) {
    std::mt19937 random(seed);
    for (size_t i = mesh.triangles.size(); i > 1; --i) std::swap(mesh.triangles[i - 1], mesh.triangles[random() % i]);
    return mesh;
}

Scene scene_of(const std::vector<Mesh>& meshes) {
    Scene scene;
    for (const Mesh& mesh : meshes) {
        Surface surface;
        surface.name = "surface_" + std::to_string(scene.surfaces.size());
        surface.positions = mesh.positions;
        surface.triangles = mesh.triangles;
        scene.surfaces.push_back(surface);
    }
    return scene;
}

// ---- the judge
// ----------------------------------------------------------------------------------------------------

bool is_degenerate(const Surface& surface, size_t t) {
    const auto& c = surface.triangles[t];
    const Vec3& p = surface.positions[c[0]];
    const Vec3& q = surface.positions[c[1]];
    const Vec3& r = surface.positions[c[2]];
    const double longest = std::max(glm::length(q - p), std::max(glm::length(r - q), glm::length(p - r)));
    return !(0.5 * glm::length(glm::cross(q - p, r - p)) > 1e-12 * longest * longest);
}

/// Area of the part of `a` inside `b`, both counter-clockwise.
double shared_area(const Triangle2& a, const Triangle2& b) {
    std::vector<Vec2> polygon(a.begin(), a.end());
    for (size_t e = 0; e < 3; ++e) {
        std::vector<Vec2> next;
        for (size_t i = 0; i < polygon.size(); ++i) {
            const Vec2 p = polygon[i];
            const Vec2 q = polygon[(i + 1) % polygon.size()];
            const double dp = cross2(b[e], b[(e + 1) % 3], p);
            const double dq = cross2(b[e], b[(e + 1) % 3], q);
            if (dp >= 0) next.push_back(p);
            if (dp * dq < 0) next.push_back(p + (q - p) * (dp / (dp - dq)));
        }
        polygon = next;
    }
    double sum = 0;
    for (size_t i = 0; i + 2 < polygon.size(); ++i) sum += 0.5 * cross2(polygon[0], polygon[i + 1], polygon[i + 2]);
    return sum;
}

/// Whether a counter-clockwise triangle meets the open texel (x, y), given that their boxes overlap: no edge
/// of the triangle has all four corners of the texel behind it.
bool touches(const Triangle2& t, int x, int y) {
    for (size_t e = 0; e < 3; ++e) {
        double furthest = -INFINITY;
        for (int corner = 0; corner < 4; ++corner)
            furthest = std::max(furthest, cross2(t[e], t[(e + 1) % 3], Vec2(x + corner % 2, y + corner / 2)));
        if (furthest <= 0) return false;
    }
    return true;
}

struct Judge {
    const Scene& scene;
    const Atlas& atlas;
    std::vector<Triangle2> texels;  ///< triangles with an area in space, in texels
    std::vector<uint32_t> charts;   ///< of those
    std::vector<int> is_mirrored;   ///< of each chart; -1 until known

    void collect() {
        ASSERT_EQ(atlas.surfaces.size(), scene.surfaces.size());
        for (size_t s = 0; s < scene.surfaces.size(); ++s) {
            ASSERT_EQ(atlas.surfaces[s].uv.size(), scene.surfaces[s].triangles.size());
            ASSERT_EQ(atlas.surfaces[s].chart.size(), scene.surfaces[s].triangles.size());
            for (size_t t = 0; t < scene.surfaces[s].triangles.size(); ++t) add(s, t);
        }
    }

    void add(size_t s, size_t t) {
        const auto& uv = atlas.surfaces[s].uv[t];
        const uint32_t chart = atlas.surfaces[s].chart[t];
        ASSERT_LT(chart, atlas.charts.size());
        EXPECT_EQ(atlas.charts[chart].surface, s);
        Triangle2 flat;
        for (size_t k = 0; k < 3; ++k) {
            ASSERT_TRUE(uv[k].x >= 0 && uv[k].x <= 1 && uv[k].y >= 0 && uv[k].y <= 1) << s << "/" << t;
            flat[k] = Vec2(uv[k]) * Vec2(atlas.width, atlas.height);
        }
        EXPECT_FALSE(uv[0] == uv[1] && uv[1] == uv[2]) << "unmapped " << s << "/" << t;
        if (is_degenerate(scene.surfaces[s], t)) return;
        const double longest = std::max(glm::length(flat[1] - flat[0]),
                                        std::max(glm::length(flat[2] - flat[1]), glm::length(flat[0] - flat[2])));
        // A chart may be mirrored as a whole: its first triangle tells.
        const double area = 0.5 * cross2(flat[0], flat[1], flat[2]);
        is_mirrored.resize(atlas.charts.size(), -1);
        if (is_mirrored[chart] < 0) is_mirrored[chart] = area < 0 ? 1 : 0;
        EXPECT_GT(is_mirrored[chart] > 0 ? -area : area, 1e-9 * longest * longest)
            << "flipped or collapsed " << s << "/" << t;
        if (area < 0) std::swap(flat[1], flat[2]);
        texels.push_back(flat);
        charts.push_back(chart);
    }

    void expect_no_overlaps() const {
        std::vector<std::array<Vec2, 2>> boxes;
        for (const Triangle2& t : texels)
            boxes.push_back({glm::min(t[0], glm::min(t[1], t[2])), glm::max(t[0], glm::max(t[1], t[2]))});
        for (size_t i = 0; i < texels.size(); ++i)
            for (size_t j = i + 1; j < texels.size(); ++j) {
                if (boxes[i][0].x >= boxes[j][1].x || boxes[j][0].x >= boxes[i][1].x) continue;
                if (boxes[i][0].y >= boxes[j][1].y || boxes[j][0].y >= boxes[i][1].y) continue;
                // Coordinates are exact; 1e-9 texels^2 is what clipping rounds.
                ASSERT_LE(shared_area(texels[i], texels[j]), 1e-9) << "triangles " << i << " and " << j;
            }
    }

    void expect_gaps() const {
        std::vector<int> owner(static_cast<size_t>(atlas.width) * static_cast<size_t>(atlas.height), -1);
        const auto at = [&](int x, int y) -> int& {
            return owner[static_cast<size_t>(y) * static_cast<size_t>(atlas.width) + static_cast<size_t>(x)];
        };
        for (size_t i = 0; i < texels.size(); ++i) {
            const Triangle2& t = texels[i];
            const Vec2 low = glm::min(t[0], glm::min(t[1], t[2]));
            const Vec2 high = glm::max(t[0], glm::max(t[1], t[2]));
            for (int y = static_cast<int>(low.y); y < std::min<double>(high.y, atlas.height); ++y)
                for (int x = static_cast<int>(low.x); x < std::min<double>(high.x, atlas.width); ++x) {
                    if (!touches(t, x, y)) continue;
                    ASSERT_TRUE(at(x, y) == -1 || at(x, y) == static_cast<int>(charts[i]))
                        << "texel shared at " << x << " " << y;
                    at(x, y) = static_cast<int>(charts[i]);
                }
        }
        for (int y = 0; y < atlas.height; ++y)
            for (int x = 0; x < atlas.width; ++x) {
                if (at(x, y) < 0) continue;
                for (int v = y; v <= std::min(y + atlas.gutter, atlas.height - 1); ++v)
                    for (int u = std::max(0, x - atlas.gutter); u <= std::min(x + atlas.gutter, atlas.width - 1); ++u)
                        ASSERT_TRUE(at(u, v) < 0 || at(u, v) == at(x, y)) << "gutter at " << x << " " << y;
            }
    }

    /// One place of one chart has one uv, to the bit: else the file would need another vertex there.
    void expect_welded() const {
        std::map<std::tuple<uint32_t, double, double, double>, Vec2f> known;
        for (size_t s = 0; s < scene.surfaces.size(); ++s)
            for (size_t t = 0; t < scene.surfaces[s].triangles.size(); ++t)
                for (size_t k = 0; k < 3; ++k) {
                    if (is_degenerate(scene.surfaces[s], t)) continue;
                    const Vec3 p = scene.surfaces[s].positions[scene.surfaces[s].triangles[t][k]] + 0.0;
                    const auto entry = known.emplace(std::make_tuple(atlas.surfaces[s].chart[t], p.x, p.y, p.z),
                                                     atlas.surfaces[s].uv[t][k]);
                    EXPECT_EQ(entry.first->second, atlas.surfaces[s].uv[t][k]);
                }
    }
};

Atlas expect_valid(const Scene& scene, const UnwrapSettings& settings) {
    const Atlas atlas = unwrap(scene, settings, {});
    if (!(settings.texels_per_metre > 0)) {
        EXPECT_EQ(atlas.width, settings.width);
        EXPECT_EQ(atlas.height, settings.height);
    }
    Judge judge{scene, atlas, {}, {}, {}};
    judge.collect();
    EXPECT_FALSE(judge.texels.empty());
    judge.expect_no_overlaps();
    judge.expect_gaps();
    judge.expect_welded();
    return atlas;
}

struct Case {
    const char* name;
    Mesh (*make)();
    size_t most_charts;  ///< slivers not counted: a guard against falling apart, with room for change
};

class UnwrapNasty : public testing::TestWithParam<Case> {};

TEST_P(UnwrapNasty, IsOneToOneAtEverySize) {
    const Mesh mesh = GetParam().make();
    for (const int size : {128, 500}) {
        SCOPED_TRACE(size);
        UnwrapSettings settings;
        settings.width = size;
        settings.height = size == 500 ? 300 : size;
        settings.gutter = size == 500 ? 3 : 2;
        const Atlas atlas = expect_valid(scene_of({mesh}), settings);
        const auto has_shape = [](const Chart& chart) { return chart.texels_per_metre > 0; };
        const auto shaped = std::count_if(atlas.charts.begin(), atlas.charts.end(), has_shape);
        EXPECT_LE(static_cast<size_t>(shaped), GetParam().most_charts);
    }
}

TEST_P(UnwrapNasty, DoesNotDependOnScaleOrFaceOrder) {
    UnwrapSettings settings;
    settings.width = settings.height = 256;
    const Mesh mesh = GetParam().make();
    expect_valid(scene_of({scaled(mesh, 0.002), scaled(mesh, 0.0021)}), settings);
    expect_valid(scene_of({scaled(mesh, 2000)}), settings);
    expect_valid(scene_of({shuffled(mesh, 1)}), settings);
}

INSTANTIATE_TEST_SUITE_P(Meshes, UnwrapNasty,
                         testing::Values(Case{"sphere", sphere, 24}, Case{"arch", arch, 6}, Case{"torus", torus, 48},
                                         Case{"height_field", height_field, 160}, Case{"helix", helix, 16},
                                         Case{"book", book, 4}, Case{"moebius", moebius, 24},
                                         Case{"t_junctions", t_junctions, 60}, Case{"needles", needles, 80},
                                         Case{"degenerate", degenerate, 8}, Case{"mixed_winding", mixed_winding, 1600},
                                         Case{"signed_zeros", signed_zeros, 1}),
                         [](const testing::TestParamInfo<Case>& some) { return some.param.name; });

}  // namespace
}  // namespace surimi
