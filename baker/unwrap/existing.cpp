// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/existing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "baker/unwrap/check.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

/// A triangle of the scene by surface and number.
struct TriangleId {
    uint32_t surface = 0;
    uint32_t triangle = 0;
};

constexpr size_t named_triangles = 5;  ///< in an error message

std::string list_numbers(const std::vector<uint32_t>& numbers) {
    std::string text;
    for (size_t i = 0; i < std::min(numbers.size(), named_triangles); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
    if (numbers.size() > named_triangles) text += fmt::format(" and {} more", numbers.size() - named_triangles);
    return text;
}

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorKind::scene, what + "; fix TEXCOORD_1, or let Surimi make one with --uv unwrap");
}

SurfaceUv read_uv(const Surface& surface) {
    if (surface.uv_sets.size() < 2 || surface.uv_sets[1].size() != surface.positions.size())
        refuse(surface.name + " has no TEXCOORD_1");
    SurfaceUv result;
    std::vector<uint32_t> infinite;
    std::vector<uint32_t> outside;
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        std::array<Vec2f, 3> uv;
        bool is_good = true;
        bool is_inside = true;
        for (size_t k = 0; k < 3; ++k) {
            const Vec2& p = surface.uv_sets[1][surface.triangles[t][k]];
            is_good = is_good && std::isfinite(p.x) && std::isfinite(p.y);
            is_inside = is_inside && p.x >= 0 && p.y >= 0 && p.x <= 1 && p.y <= 1;
            uv[k] = Vec2f(p);
        }
        if (!is_good) infinite.push_back(t);
        if (is_good && !is_inside) outside.push_back(t);
        result.uv.push_back(uv);
    }
    if (!infinite.empty())
        refuse(fmt::format("TEXCOORD_1 of {} is not finite in triangles {}", surface.name, list_numbers(infinite)));
    if (!outside.empty())
        refuse(fmt::format("TEXCOORD_1 of {} leaves [0, 1] in triangles {}", surface.name, list_numbers(outside)));
    return result;
}

/// Overlaps count from here, in square texels: less is a contact that rounding made.
double tolerated_overlap(const FlatTriangle& a, const FlatTriangle& b) {
    const double smaller = 0.5 * std::min(std::abs(doubled_area(a)), std::abs(doubled_area(b)));
    return std::max(1e-9, std::min(1e-3, 1e-2 * smaller));
}

void refuse_overlaps(const Scene& scene, const std::vector<FlatTriangle>& texels, const std::vector<TriangleId>& ids) {
    std::vector<std::array<uint32_t, 2>> found;  // of the two surfaces where the first was found
    std::array<uint32_t, 2> surfaces{};
    visit_close_pairs(texels, [&](uint32_t i, uint32_t j) {
        if (overlap_area(texels[i], texels[j]) <= tolerated_overlap(texels[i], texels[j])) return true;
        const std::array<uint32_t, 2> both{ids[i].surface, ids[j].surface};
        if (found.empty()) surfaces = both;
        const std::array<uint32_t, 2> pair{ids[i].triangle, ids[j].triangle};
        const bool is_known = std::find(found.begin(), found.end(), pair) != found.end();
        if (both == surfaces && !is_known) found.push_back(pair);
        return found.size() < named_triangles;
    });
    if (found.empty()) return;
    std::string pairs;
    for (const auto& [a, b] : found) pairs += fmt::format("{}{} with {}", pairs.empty() ? "" : ", ", a, b);
    const std::string& one = scene.surfaces[surfaces[0]].name;
    const std::string& other = scene.surfaces[surfaces[1]].name;
    if (surfaces[0] == surfaces[1]) refuse(fmt::format("TEXCOORD_1 of {} overlaps itself: triangles {}", one, pairs));
    refuse(fmt::format("TEXCOORD_1 of {} and {} overlap (every placement needs its own texels): triangles {}", one,
                       other, pairs));
}

/// Charts are triangles joined by edges whose ends agree in place and uv.
std::vector<uint32_t> connect(const Surface& surface, const SurfaceUv& uv) {
    using End = std::tuple<double, double, double, float, float>;
    struct Use {
        End low;
        End high;
        uint32_t triangle;
    };
    std::vector<Use> uses;
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        std::array<End, 3> ends;
        for (size_t k = 0; k < 3; ++k) {
            const Vec3 p = surface.positions[surface.triangles[t][k]] + 0.0;
            ends[k] = {p.x, p.y, p.z, uv.uv[t][k].x, uv.uv[t][k].y};
        }
        for (size_t k = 0; k < 3; ++k)
            uses.push_back({std::min(ends[k], ends[(k + 1) % 3]), std::max(ends[k], ends[(k + 1) % 3]), t});
    }
    std::sort(uses.begin(), uses.end(), [](const Use& l, const Use& r) {
        return std::tie(l.low, l.high, l.triangle) < std::tie(r.low, r.high, r.triangle);
    });
    std::vector<uint32_t> parent(surface.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (size_t i = 1; i < uses.size(); ++i) {
        if (uses[i].low != uses[i - 1].low || uses[i].high != uses[i - 1].high) continue;
        const uint32_t a = root(uses[i].triangle);
        const uint32_t b = root(uses[i - 1].triangle);
        parent[std::max(a, b)] = std::min(a, b);
    }
    for (uint32_t t = 0; t < parent.size(); ++t) parent[t] = root(t);
    return parent;
}

struct Areas {
    double space = 0;
    double uv = 0;
};

/// Numbers the charts of a surface and adds them, with their areas, to the atlas.
void add_charts(const Surface& surface, uint32_t number, Atlas& atlas, std::vector<Areas>& areas) {
    SurfaceUv& uv = atlas.surfaces[number];
    const std::vector<uint32_t> root = connect(surface, uv);
    uv.chart.resize(root.size());
    for (uint32_t t = 0; t < root.size(); ++t) {
        if (root[t] == t) {
            uv.chart[t] = static_cast<uint32_t>(atlas.charts.size());
            atlas.charts.push_back({number, 0});
            areas.emplace_back();
        } else {
            uv.chart[t] = uv.chart[root[t]];
        }
        const auto& c = surface.triangles[t];
        const Vec3 normal = area_normal(surface.positions[c[0]], surface.positions[c[1]], surface.positions[c[2]]);
        areas[uv.chart[t]].space += 0.5 * glm::length(normal);
        areas[uv.chart[t]].uv +=
            0.5 * std::abs(doubled_area({Vec2(uv.uv[t][0]), Vec2(uv.uv[t][1]), Vec2(uv.uv[t][2])}));
    }
}

}  // namespace

Atlas take_existing(const Scene& scene, const UnwrapSettings& settings) {
    Atlas atlas;
    atlas.gutter = settings.gutter;
    std::vector<Areas> areas;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        atlas.surfaces.push_back(read_uv(scene.surfaces[s]));
        add_charts(scene.surfaces[s], s, atlas, areas);
    }
    Areas all;
    for (const Areas& a : areas) all = {all.space + a.space, all.uv + a.uv};
    atlas.width = settings.width;
    atlas.height = settings.height;
    if (settings.texels_per_metre > 0 && all.uv > 0) {
        const double side = settings.texels_per_metre * std::sqrt(all.space / all.uv);
        constexpr double largest = 16384;
        if (side > largest)
            throw Error(ErrorKind::usage,
                        fmt::format("{} texels per metre on these UVs need a map of {:.0f} texels; the limit is {:.0f}",
                                    settings.texels_per_metre, side, largest));
        atlas.width = atlas.height = 4 * static_cast<int>(std::ceil(side / 4));
    }
    const Vec2 size(atlas.width, atlas.height);
    const double texels = size.x * size.y;
    atlas.texels_per_metre = all.space > 0 ? std::sqrt(all.uv * texels / all.space) : 0;
    for (size_t c = 0; c < areas.size(); ++c)
        if (areas[c].space > 0) atlas.charts[c].texels_per_metre = std::sqrt(areas[c].uv * texels / areas[c].space);

    std::vector<FlatTriangle> flat;
    std::vector<TriangleId> ids;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        for (uint32_t t = 0; t < atlas.surfaces[s].uv.size(); ++t) {
            const auto& uv = atlas.surfaces[s].uv[t];
            const FlatTriangle triangle{Vec2(uv[0]) * size, Vec2(uv[1]) * size, Vec2(uv[2]) * size};
            if (doubled_area(triangle) == 0) continue;  // holds no texel, hides none
            flat.push_back(triangle);
            ids.push_back({s, t});
        }
    }
    refuse_overlaps(scene, flat, ids);
    return atlas;
}

}  // namespace surimi
