// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/existing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "baker/unwrap/coverage.h"
#include "baker/unwrap/uv_edges.h"

namespace surimi {
namespace {

constexpr size_t named_triangles = 5;  ///< in a message
constexpr size_t kept_pairs = 4096;    ///< of triangles that get in each other's way: enough to name some
constexpr size_t pairs_each = 16;      ///< overlaps looked at for each triangle on average: heaps have no end of them
constexpr int largest_size = 16384;    ///< texels on a side
constexpr int widest_gap = 64;         ///< wider ones are not told apart

bool is_before(const TriangleRef& a, const TriangleRef& b) {
    return a.surface != b.surface ? a.surface < b.surface : a.triangle < b.triangle;
}

/// The first surface's triangles by number, and how many more there are.
std::string list_triangles(const Scene& scene, const std::vector<TriangleRef>& refs) {
    std::string text = scene.surfaces[refs.front().surface].name + ": triangles ";
    size_t named = 0;
    for (const TriangleRef& ref : refs) {
        if (ref.surface != refs.front().surface || named == named_triangles) break;
        text += (named++ > 0 ? ", " : "") + std::to_string(ref.triangle);
    }
    return named < refs.size() ? fmt::format("{} and {} more", text, refs.size() - named) : text;
}

/// Pairs of triangles, those of the first pair's two surfaces by number.
std::string list_pairs(const Scene& scene, const std::vector<std::array<TriangleRef, 2>>& pairs) {
    const auto [a, b] = pairs.front();
    const std::string& one = scene.surfaces[a.surface].name;
    std::string text = a.surface == b.surface ? one + " with itself" : one + " with " + scene.surfaces[b.surface].name;
    text += ": triangles ";
    size_t named = 0;
    for (const auto& [first, second] : pairs) {
        if (first.surface != a.surface || second.surface != b.surface || named == named_triangles) break;
        text += fmt::format("{}{} with {}", named++ > 0 ? ", " : "", first.triangle, second.triangle);
    }
    return named < pairs.size() ? text + " and more" : text;
}

void add_fault(ExistingUv& found, const std::string& fault) {
    found.fault += (found.fault.empty() ? "TEXCOORD_1 " : "; it ") + fault;
}

void add_faulty(const Scene& scene, const std::string& what, const std::vector<TriangleRef>& refs, ExistingUv& found) {
    if (refs.empty()) return;
    add_fault(found, what + list_triangles(scene, refs));
    found.bad.insert(found.bad.end(), refs.begin(), refs.end());
}

bool is_missing(const Surface& surface) {
    if (!surface.receives) return false;
    return surface.uv_sets.size() < 2 || surface.uv_sets[1].size() != surface.positions.size();
}

/// Whether every surface has the UVs.
bool has_uv(const Scene& scene, ExistingUv& found) {
    const auto& surfaces = scene.surfaces;
    const auto first = std::find_if(surfaces.begin(), surfaces.end(), is_missing);
    if (first == surfaces.end()) return true;
    const auto others = std::count_if(first + 1, surfaces.end(), is_missing);
    add_fault(found, "is missing on " + first->name);
    if (others > 0) found.fault += fmt::format(" and {} more surfaces", others);
    return false;
}

void read_uv(const Scene& scene, ExistingUv& found) {
    std::vector<TriangleRef> infinite, outside;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        SurfaceUv& read = found.atlas.surfaces.emplace_back();
        if (!surface.receives) continue;
        for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
            std::array<Vec2f, 3> uv{};
            bool is_good = true;
            bool is_inside = true;
            for (size_t k = 0; k < 3; ++k) {
                uv[k] = Vec2f(surface.uv_sets[1][surface.triangles[t][k]]);
                is_good = is_good && std::isfinite(uv[k].x) && std::isfinite(uv[k].y);
                is_inside = is_inside && uv[k].x >= 0 && uv[k].y >= 0 && uv[k].x <= 1 && uv[k].y <= 1;
            }
            if (!is_good) infinite.push_back({s, t});
            if (is_good && !is_inside) outside.push_back({s, t});
            read.uv.push_back(is_good ? uv : std::array<Vec2f, 3>{});
        }
    }
    add_faulty(scene, "is not finite on ", infinite, found);
    add_faulty(scene, "leaves [0, 1] on ", outside, found);
}

/// Numbers the charts of each surface; returns, for each, the number of the chart that it is part of when all surfaces
/// are seen as one.
std::vector<uint32_t> number_charts(const Scene& scene, Atlas& atlas) {
    std::vector<size_t> first;  // triangle of each surface, all being numbered in one go
    size_t count = 0;
    for (const SurfaceUv& surface : atlas.surfaces) first.push_back(count), count += surface.uv.size();
    std::vector<uint32_t> parent(count);
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return static_cast<uint32_t>(i);
    };
    visit_edges(find_edge_uses(scene, atlas.surfaces), [&](std::span<const EdgeUse> edge) {
        for (size_t i = 1; i < edge.size(); ++i) {
            if (!are_joined(edge[i - 1], edge[i])) continue;
            const uint32_t a = root(first[edge[i].triangle.surface] + edge[i].triangle.triangle);
            const uint32_t b = root(first[edge[i - 1].triangle.surface] + edge[i - 1].triangle.triangle);
            parent[std::max(a, b)] = std::min(a, b);
        }
    });
    struct Numbered {
        uint32_t surface = UINT32_MAX;
        uint32_t chart = 0;
    };
    std::vector<Numbered> of_root(count);
    std::vector<uint32_t> joined;
    for (uint32_t s = 0; s < atlas.surfaces.size(); ++s) {
        for (size_t t = 0; t < atlas.surfaces[s].uv.size(); ++t) {
            const uint32_t r = root(first[s] + t);
            if (of_root[r].surface != s) {
                of_root[r] = {s, static_cast<uint32_t>(joined.size())};
                atlas.charts.push_back({s, 0});
                joined.push_back(r);
            }
            atlas.surfaces[s].chart.push_back(of_root[r].chart);
        }
    }
    return joined;
}

struct Areas {
    double space = 0;
    double uv = 0;
};

Areas areas_of(const Surface& surface, const SurfaceUv& uv, uint32_t t) {
    const auto& c = surface.triangles[t];
    const Vec3 normal = area_normal(surface.positions[c[0]], surface.positions[c[1]], surface.positions[c[2]]);
    const FlatTriangle flat{Vec2(uv.uv[t][0]), Vec2(uv.uv[t][1]), Vec2(uv.uv[t][2])};
    return {0.5 * glm::length(normal), 0.5 * std::abs(doubled_area(flat))};
}

/// The map's size and the densities; false when the density asked for needs too large a map.
bool set_size(const Scene& scene, const UnwrapSettings& settings, ExistingUv& found) {
    Atlas& atlas = found.atlas;
    std::vector<Areas> areas(atlas.charts.size());
    Areas all;
    for (size_t s = 0; s < scene.surfaces.size(); ++s)
        for (uint32_t t = 0; t < atlas.surfaces[s].uv.size(); ++t) {
            const Areas some = areas_of(scene.surfaces[s], atlas.surfaces[s], t);
            for (Areas* sum : {&all, &areas[atlas.surfaces[s].chart[t]]}) sum->space += some.space, sum->uv += some.uv;
        }
    if (settings.texels_per_metre > 0 && all.uv > 0) {
        const double side = settings.texels_per_metre * std::sqrt(all.space / all.uv);
        if (side > largest_size) {
            add_fault(found, fmt::format("needs a map of {:.0f} texels for {} texels per metre; the limit is {}", side,
                                         settings.texels_per_metre, largest_size));
            found.kind = ErrorKind::usage;
            return false;
        }
        atlas.width = atlas.height = 4 * static_cast<int>(std::ceil(side / 4));
    }
    const double texels = static_cast<double>(atlas.width) * atlas.height;
    atlas.texels_per_metre = all.space > 0 ? std::sqrt(all.uv * texels / all.space) : 0;
    for (size_t c = 0; c < areas.size(); ++c)
        if (areas[c].space > 0) atlas.charts[c].texels_per_metre = std::sqrt(areas[c].uv * texels / areas[c].space);
    return true;
}

/// Surfaces of which more than a texel's worth has no area on the map. A few slivers that lost theirs to rounding are
/// no fault: nobody sees them.
void find_collapsed(const Scene& scene, ExistingUv& found) {
    std::vector<TriangleRef> collapsed;
    const double density = found.atlas.texels_per_metre;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        double lost = 0;
        std::vector<TriangleRef> some;
        for (uint32_t t = 0; t < found.atlas.surfaces[s].uv.size(); ++t) {
            const Areas areas = areas_of(scene.surfaces[s], found.atlas.surfaces[s], t);
            if (areas.uv > 0) continue;
            lost += areas.space;
            some.push_back({s, t});
        }
        if (!some.empty() && (density == 0 || lost * density * density > 1))
            collapsed.insert(collapsed.end(), some.begin(), some.end());
    }
    add_faulty(scene, "gives no area to ", collapsed, found);
}

/// Overlaps count from here, in square texels: less is a contact that rounding made.
double tolerated_overlap(const FlatTriangle& a, const FlatTriangle& b) {
    const double smaller = 0.5 * std::min(std::abs(doubled_area(a)), std::abs(doubled_area(b)));
    return std::max(1e-9, std::min(1e-3, 1e-2 * smaller));
}

/// Pairs by surface and triangle, sorted, each once.
std::vector<std::array<TriangleRef, 2>> refs_of(std::vector<std::array<uint32_t, 2>> numbers,
                                                const PlacedTriangles& placed) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    std::vector<std::array<TriangleRef, 2>> pairs;
    for (const auto& [i, j] : numbers) pairs.push_back({placed.source[i], placed.source[j]});
    return pairs;
}

void find_overlaps(const Scene& scene, const PlacedTriangles& placed, ExistingUv& found) {
    Vec2 low(INFINITY), high(-INFINITY);
    for (const FlatTriangle& t : placed.texels)
        for (const Vec2& p : t) low = glm::min(low, p), high = glm::max(high, p);
    // Where triangles fill their common box one and a half times, some overlap: no need to look at the rest, which may
    // be a heap.
    const double enough = 1.5 * (high.x - low.x) * (high.y - low.y);
    std::vector<FlatTriangle> some;
    double area = 0;
    for (size_t i = 0; i < placed.texels.size() && area <= enough; ++i) {
        some.push_back(placed.texels[i]);
        area += 0.5 * std::abs(doubled_area(some.back()));
    }
    std::vector<std::array<uint32_t, 2>> numbers;
    std::vector<bool> is_bad(some.size(), false);
    size_t seen = 0;
    visit_close_pairs(some, [&](uint32_t i, uint32_t j) {
        if (overlap_area(some[i], some[j]) <= tolerated_overlap(some[i], some[j])) return true;
        if (numbers.size() < kept_pairs) numbers.push_back({i, j});
        is_bad[i] = is_bad[j] = true;
        return ++seen < kept_pairs + pairs_each * some.size();
    });
    if (numbers.empty()) return;
    for (size_t i = 0; i < some.size(); ++i)
        if (is_bad[i]) found.bad.push_back(placed.source[i]);
    add_fault(found, "overlaps (every placement needs its own texels): " + list_pairs(scene, refs_of(numbers, placed)));
}

/// The atlas' triangles on a map of this size, with their charts as all surfaces together have them.
PlacedTriangles place_joined(const Atlas& atlas, const std::vector<uint32_t>& joined, const glm::ivec2& size) {
    PlacedTriangles placed = place_triangles(atlas, 0, size);
    for (uint32_t& chart : placed.chart) chart = joined[chart];
    return placed;
}

/// The next doubled size at which no two charts share a texel.
std::string fitting_size(const Atlas& atlas, const std::vector<uint32_t>& joined) {
    for (glm::ivec2 size(2 * atlas.width, 2 * atlas.height); std::max(size.x, size.y) <= largest_size; size *= 2) {
        bool is_fine = true;
        visit_shared_texels(place_joined(atlas, joined, size), size,
                            [&](const SharedTexel&) { return is_fine = false; });
        if (is_fine) return fmt::format("; {} x {} texels are enough", size.x, size.y);
    }
    return fmt::format("; no larger map up to {} helps, the charts are too close", largest_size);
}

void find_shared(const Scene& scene, const PlacedTriangles& placed, const std::vector<uint32_t>& joined,
                 ExistingUv& found) {
    const Atlas& atlas = found.atlas;
    std::vector<std::array<uint32_t, 2>> numbers;
    visit_shared_texels(placed, {atlas.width, atlas.height}, [&](const SharedTexel& texel) {
        found.shared.push_back(static_cast<uint32_t>(texel.y) * static_cast<uint32_t>(atlas.width) +
                               static_cast<uint32_t>(texel.x));
        const std::array pair{texel.first, texel.second};
        if (numbers.size() < kept_pairs && (numbers.empty() || numbers.back() != pair)) numbers.push_back(pair);
        return true;
    });
    if (numbers.empty()) return;
    std::sort(found.shared.begin(), found.shared.end());
    found.shared.erase(std::unique(found.shared.begin(), found.shared.end()), found.shared.end());
    add_fault(found, fmt::format("has charts so close that bilinear reads share {} texels of a map of {} x {}, {}{}",
                                 found.shared.size(), atlas.width, atlas.height,
                                 list_pairs(scene, refs_of(numbers, placed)), fitting_size(atlas, joined)));
}

/// Untouched texels between the two charts that are nearest to each other, widest_gap if there are more.
int smallest_gap(const PlacedTriangles& placed, const glm::ivec2& size) {
    int gap = widest_gap;
    visit_borders(nearest_charts(touched_charts(placed, size), widest_gap / 2),
                  [&](uint32_t, uint32_t, int distance) { gap = std::min(gap, distance); });
    return gap;
}

/// Warns where charts are nearer than the gutter asked for, or run into each other on the last mip level asked for.
void check_gutter(const UnwrapSettings& settings, const std::vector<uint32_t>& joined, Atlas& atlas) {
    const glm::ivec2 size(atlas.width, atlas.height);
    const int gap = smallest_gap(place_joined(atlas, joined, size), size);
    atlas.gutter = std::min(gap, settings.gutter);
    if (gap < settings.gutter)
        atlas.warnings.push_back(fmt::format(
            "the existing UVs leave {} texels between two charts at {} x {}, less than the gutter of {} asked for: "
            "mip levels and compressed blocks will mix them",
            gap, size.x, size.y, settings.gutter));
    const glm::ivec2 last = glm::max(size / (1 << settings.mips), glm::ivec2(1));
    if (settings.mips > 0 && smallest_gap(place_joined(atlas, joined, last), last) < 1)
        atlas.warnings.push_back(
            fmt::format("the existing UVs leave no texel between two charts on mip level {}, {} x {}: it will mix them",
                        settings.mips, last.x, last.y));
}

}  // namespace

ExistingUv judge_existing(const Scene& scene, const UnwrapSettings& settings) {
    ExistingUv found;
    found.atlas.is_existing = true;
    found.atlas.gutter = settings.gutter;
    if (!has_uv(scene, found)) return found;
    read_uv(scene, found);
    const std::vector<uint32_t> joined = number_charts(scene, found.atlas);
    found.atlas.width = settings.width;
    found.atlas.height = settings.height;
    if (!found.fault.empty() || !set_size(scene, settings, found)) return found;
    find_collapsed(scene, found);
    if (found.fault.empty()) {
        const auto placed = place_joined(found.atlas, joined, {found.atlas.width, found.atlas.height});
        find_overlaps(scene, placed, found);
        if (found.fault.empty()) find_shared(scene, placed, joined, found);
        if (found.fault.empty()) check_gutter(settings, joined, found.atlas);
    }
    std::sort(found.bad.begin(), found.bad.end(), is_before);
    return found;
}

std::optional<Atlas> take_existing(const Scene& scene, const UnwrapSettings& settings, std::string& why_not) {
    if (settings.uv == UvSource::unwrap) return std::nullopt;
    if (settings.uv == UvSource::automatic && settings.atlases > 1) {
        why_not = fmt::format("existing UVs are those of one map, and {} are asked for", settings.atlases);
        return std::nullopt;
    }
    ExistingUv found = judge_existing(scene, settings);
    if (settings.uv == UvSource::automatic)
        found.atlas.uv_reason = "every surface has them, within [0, 1], without overlaps and shared texels";
    if (found.fault.empty()) return std::move(found.atlas);
    if (settings.uv == UvSource::existing)
        throw Error(found.kind, found.fault + "; fix TEXCOORD_1, or let Surimi make one with --uv unwrap or auto");
    why_not = found.fault;
    return std::nullopt;
}

}  // namespace surimi
