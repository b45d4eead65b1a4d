// SPDX-License-Identifier: Apache-2.0
#include "tests/support/map_judge.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "baker/texel/texel_surface.h"
#include "tests/support/random.h"

namespace surimi::test {
namespace {

/// Weights of the corners a, b, c at p, in the plane.
Vec3 weights_at(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
    const auto cross = [](const Vec2& u, const Vec2& v) { return u.x * v.y - u.y * v.x; };
    const double whole = cross(b - a, c - a);
    const double wb = cross(p - a, c - a) / whole, wc = cross(b - a, p - a) / whole;
    return {1 - wb - wc, wb, wc};
}

bool is_within(const Vec3& weights, double slack) {
    return std::min({weights.x, weights.y, weights.z}) >= -slack;  // false for NaN
}

std::string place_of(const Scene& scene, const SurfacePoint& point) {
    std::ostringstream text;
    text << scene.surfaces[point.triangle.surface].name << " at " << point.position.x << ", " << point.position.y
         << ", " << point.position.z;
    return text.str();
}

Vec2 uv_at(const Atlas& atlas, const TriangleRef& where, const Vec3& barycentric) {
    const auto& uv = atlas.surfaces[where.surface].uv[where.triangle];
    return barycentric.x * Vec2(uv[0]) + barycentric.y * Vec2(uv[1]) + barycentric.z * Vec2(uv[2]);
}

/// Weights of a triangle's corners at a place, projected to its plane.
Vec3 weights_in_space(const Surface& surface, uint32_t triangle, const Vec3& place) {
    const auto& [i, j, k] = surface.triangles[triangle];
    const Vec3 &a = surface.positions[i], &b = surface.positions[j], &c = surface.positions[k];
    const Vec3 normal = area_normal(a, b, c);
    return Vec3(glm::dot(area_normal(place, b, c), normal), glm::dot(area_normal(a, place, c), normal),
                glm::dot(area_normal(a, b, place), normal)) /
           glm::dot(normal, normal);
}

/// A place of a joint on one of its sides.
struct JointPlace {
    TriangleRef triangle;
    Vec3 barycentric{0};
};

/// The judged triangle that has `place` on its border or in it and whose middle lies towards `side`.
std::optional<JointPlace> place_beside(const CutPlane& stage, const Vec3& place, const Vec3& side) {
    for (const uint32_t s : stage.surfaces) {
        const Surface& surface = stage.scene.surfaces[s];
        for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
            const auto& [i, j, k] = surface.triangles[t];
            const Vec3 middle = (surface.positions[i] + surface.positions[j] + surface.positions[k]) / 3.0;
            if (glm::dot(middle - place, side) <= 0) continue;
            const Vec3 weights = weights_in_space(surface, t, place);
            if (is_within(weights, 1e-9)) return JointPlace{{s, t}, weights};
        }
    }
    return {};
}

}  // namespace

BakeSettings of_size(int size) {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = size;
    return settings;
}

double read_map(const Bake& bake, const TriangleRef& where, const Vec3& barycentric, int channel) {
    const auto page = static_cast<size_t>(bake.atlas.surfaces[where.surface].page);
    return look_up(bake.pages[page].map, uv_at(bake.atlas, where, barycentric))[channel];
}

std::vector<TexelPlace> places_of(const Scene& scene, const Atlas& atlas, const Texels& texels, const Texel& texel,
                                  int side) {
    std::vector<TexelPlace> places;
    const double left = texel.index % static_cast<uint32_t>(texels.width);
    const double top = texel.index / static_cast<uint32_t>(texels.width);
    for (int i = 0; i < side * side; ++i) {
        const Vec2 p(left + (i % side + 0.5) / side, top + (i / side + 0.5) / side);
        for (const TriangleRef& triangle : texels.triangles_of(texel)) {
            const auto corners = texel_corners(atlas, triangle);
            const Vec3 weights = weights_at(corners[0], corners[1], corners[2], p);
            if (!is_within(weights, 0)) continue;
            const auto& [a, b, c] = scene.surfaces[triangle.surface].triangles[triangle.triangle];
            const auto& positions = scene.surfaces[triangle.surface].positions;
            const Vec2 u = corners[1] - corners[0], v = corners[2] - corners[0];
            const double on_map = std::abs(u.x * v.y - u.y * v.x);
            const double area = glm::length(area_normal(positions[a], positions[b], positions[c])) / on_map;
            places.push_back({surface_point(scene, triangle, weights), area});
            break;
        }
    }
    return places;
}

void Misses::add(double value, double expected, double tolerance, const std::string& where) {
    const double off = std::abs(value - expected);
    ++checked;
    if (!(off <= tolerance)) ++wrong;
    if (!(off > largest)) return;
    largest = off;
    std::ostringstream text;
    text << value << " instead of " << expected << ", " << where;
    worst = text.str();
}

std::string Misses::text() const {
    std::ostringstream text;
    text << wrong << " of " << checked << " wrong; at worst " << (worst.empty() ? "none" : worst);
    return text.str();
}

MapJudge::MapJudge(const ArtefactScene& stage, const Bake& bake)
    : stage_(stage), bake_(bake), exact_(stage.equal ? *stage.equal : stage.scene) {
    for (int page = 0; page < bake.atlas.pages; ++page) texels_.push_back(find_texels(stage.scene, bake.atlas, page));
}

std::optional<double> MapJudge::truth(const SurfacePoint& point) const {
    if (is_enclosed(stage_, point.triangle.surface, point.position)) return {};
    const SubtractedIrradiance light = exact_.truth(point);
    if (!(light.unshadowed > 0)) return {};
    return light.visibility();
}

MapJudge::Average MapJudge::average(const Texels& texels, const Texel& texel, int side) const {
    double light = 0, seen = 0, lowest = 1, highest = 0;
    bool is_whole = true;
    for (const TexelPlace& place : places_of(stage_.scene, bake_.atlas, texels, texel, side)) {
        if (is_enclosed(stage_, place.point.triangle.surface, place.point.position)) {
            is_whole = false;
            continue;
        }
        const SubtractedIrradiance here = exact_.truth(place.point);
        light += place.area * here.unshadowed;
        seen += place.area * here.shadowed;
        if (!(here.unshadowed > 0)) continue;
        lowest = std::min(lowest, here.visibility());
        highest = std::max(highest, here.visibility());
    }
    return {light > 0 ? seen / light : 0, light, std::max(0.0, highest - lowest), is_whole};
}

Misses MapJudge::compare_texels(double error) const {
    struct Measured {
        const Texels* texels = nullptr;
        const Texel* texel = nullptr;
        Average coarse, fine;
        double cells = 0;  // what the finer grid may be off by
    };
    std::vector<Measured> all;
    for (const Texels& texels : texels_)
        for (const Texel& texel : texels.texels) {
            const uint32_t surface = bake_.atlas.charts[texel.chart].surface;
            const auto& state = bake_.pages[static_cast<size_t>(texels.page)].state[0];
            if (state.pixels[texel.index] != TexelState::covered) continue;
            if (std::count(stage_.surfaces.begin(), stage_.surfaces.end(), surface) == 0) continue;
            all.push_back({&texels, &texel, {}, {}, 0});
        }
    if (is_slow_build) std::erase_if(all, [](const Measured& m) { return hash(m.texel->index) % 10 != 0; });
    parallel_for(all.size(), 16, [&](size_t i) {
        // Finer where borders of solids or of shadows cross the texel: two grids may agree on them by chance.
        for (const int side : {4, 16, 64}) {
            all[i].coarse = average(*all[i].texels, *all[i].texel, side);
            all[i].fine = average(*all[i].texels, *all[i].texel, 2 * side);
            // A border lies anywhere in its row of cells: half a cell of the finer grid.
            all[i].cells = all[i].fine.spread / (4 * side);
            if (all[i].fine.is_whole && all[i].cells < error) break;
        }
    });
    Misses misses;
    for (const auto& [texels, texel, coarse, fine, cells] : all) {
        if (!(coarse.light > 0) || !(fine.light > 0)) continue;
        const BakedPage& page = bake_.pages[static_cast<size_t>(texels->page)];
        const TexelSurface surface(stage_.scene, bake_.atlas, *texels, *texel);
        misses.add(static_cast<double>(page.map.visibility.pixels[texel->index].x), fine.visibility,
                   error + std::abs(fine.visibility - coarse.visibility) + cells,
                   place_of(stage_.scene, surface.center()));
    }
    return misses;
}

std::vector<Image<MapJudge::Tone>> MapJudge::tones() const {
    std::vector<Image<Tone>> pages;
    for (const Texels& texels : texels_) {
        Image<Tone>& page = pages.emplace_back(texels.width, texels.height, Tone::none);
        parallel_for(texels.texels.size(), 16, [&](size_t i) {
            const Texel& texel = texels.texels[i];
            const uint32_t surface = bake_.atlas.charts[texel.chart].surface;
            if (std::count(stage_.surfaces.begin(), stage_.surfaces.end(), surface) == 0) return;
            for (const TexelPlace& place : places_of(stage_.scene, bake_.atlas, texels, texel, 4)) {
                const std::optional<double> value = truth(place.point);
                if (!value) continue;
                const Tone tone = tone_of(*value);
                if (page.pixels[texel.index] == Tone::none) page.pixels[texel.index] = tone;
                if (page.pixels[texel.index] != tone) page.pixels[texel.index] = Tone::mixed;
            }
        });
    }
    return pages;
}

MapJudge::Tone MapJudge::tone_of(double visibility) {
    constexpr double rounding = 1e-9;
    if (visibility < rounding) return Tone::black;
    return visibility > 1 - rounding ? Tone::white : Tone::mixed;
}

Misses MapJudge::compare_plain_reads(size_t tries, double tolerance) const {
    constexpr double rounding = 1e-6;
    const std::vector<Image<Tone>> tones = this->tones();
    Misses misses;
    Choice choice{Random{17}};
    for (size_t i = 0; i < tries; ++i) {
        const uint32_t s = stage_.surfaces[i % stage_.surfaces.size()];
        const double triangles = static_cast<double>(stage_.scene.surfaces[s].triangles.size());
        const TriangleRef where{s, static_cast<uint32_t>(choice.between(0, triangles))};
        const double root = std::sqrt(choice.between(0, 1)), r = choice.between(0, 1);
        const Vec3 weights(1 - root, root * (1 - r), root * r);
        const SurfacePoint point = surface_point(stage_.scene, where, weights);
        const std::optional<double> value = truth(point);
        if (!value || tone_of(*value) == Tone::mixed) continue;
        const Image<Tone>& page = tones[static_cast<size_t>(bake_.atlas.surfaces[s].page)];
        if (!is_plain(page, uv_at(bake_.atlas, where, weights), tone_of(*value))) continue;
        misses.add(read_map(bake_, where, weights), std::round(*value), std::max(rounding, tolerance),
                   place_of(stage_.scene, point));
    }
    return misses;
}

bool MapJudge::is_plain(const Image<Tone>& page, const Vec2& uv, Tone tone) {
    const int x0 = static_cast<int>(std::floor(uv.x * page.width - 0.5)) - 1;
    const int y0 = static_cast<int>(std::floor(uv.y * page.height - 0.5)) - 1;
    for (int y = std::max(y0, 0); y < std::min(y0 + 4, page.height); ++y)
        for (int x = std::max(x0, 0); x < std::min(x0 + 4, page.width); ++x)
            if (page.at(x, y) != tone && page.at(x, y) != Tone::none) return false;
    return true;
}

Misses MapJudge::compare_with(uint32_t surface, double value, double tolerance) const {
    Misses misses;
    for (const Texels& texels : texels_) {
        const BakedPage& page = bake_.pages[static_cast<size_t>(texels.page)];
        for (const Texel& texel : texels.texels) {
            if (bake_.atlas.charts[texel.chart].surface != surface) continue;
            if (page.state[0].pixels[texel.index] != TexelState::covered) continue;
            const TexelSurface under(stage_.scene, bake_.atlas, texels, texel);
            misses.add(static_cast<double>(page.map.visibility.pixels[texel.index].x), value, tolerance,
                       place_of(stage_.scene, under.center()));
        }
    }
    return misses;
}

size_t MapJudge::count(uint32_t surface, TexelState state) const {
    size_t count = 0;
    for (const Texels& texels : texels_)
        for (const Texel& texel : texels.texels)
            if (bake_.atlas.charts[texel.chart].surface == surface &&
                bake_.pages[static_cast<size_t>(texels.page)].state[0].pixels[texel.index] == state)
                ++count;
    return count;
}

std::vector<double> joint_jumps(const CutPlane& stage, const Bake& bake, int count) {
    std::vector<double> jumps;
    for (int i = 0; i < count; ++i) {
        const Vec3 place = glm::mix(stage.joint.from, stage.joint.to, (i + 0.5) / count);
        const auto first = place_beside(stage, place, -stage.joint.across);
        const auto second = place_beside(stage, place, stage.joint.across);
        if (first && second)
            jumps.push_back(std::abs(read_map(bake, first->triangle, first->barycentric) -
                                     read_map(bake, second->triangle, second->barycentric)));
    }
    return jumps;
}

std::vector<std::pair<int, uint32_t>> texels_at_joint(const CutPlane& stage, const Bake& bake) {
    constexpr int count = 10000;
    constexpr double rounding = 1e-3;  // texels
    std::vector<std::pair<int, uint32_t>> touched;
    const Vec2 size(bake.atlas.width, bake.atlas.height);
    for (int i = 0; i <= count; ++i) {
        const Vec3 place = glm::mix(stage.joint.from, stage.joint.to, static_cast<double>(i) / count);
        for (const double side : {-1.0, 1.0}) {
            const auto found = place_beside(stage, place, side * stage.joint.across);
            if (!found) continue;
            const int page = bake.atlas.surfaces[found->triangle.surface].page;
            const Vec2 at = uv_at(bake.atlas, found->triangle, found->barycentric) * size - 0.5;
            for (double y = std::floor(at.y - rounding); y <= std::floor(at.y + rounding) + 1; ++y)
                for (double x = std::floor(at.x - rounding); x <= std::floor(at.x + rounding) + 1; ++x)
                    touched.emplace_back(page, static_cast<uint32_t>(y * size.x + x));
        }
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    return touched;
}

size_t changed_texels(const Bake& bake, const std::vector<std::pair<int, uint32_t>>& exempt) {
    size_t changed = 0;
    for (size_t p = 0; p < bake.pages.size(); ++p) {
        const BakedPage& page = bake.pages[p];
        for (size_t i = 0; i < page.state[0].pixels.size(); ++i) {
            if (page.state[0].pixels[i] != TexelState::covered) continue;
            const std::pair<int, uint32_t> key(static_cast<int>(p), static_cast<uint32_t>(i));
            if (std::binary_search(exempt.begin(), exempt.end(), key)) continue;
            const IrradianceEstimate& light = page.irradiance[0].pixels[i];
            const float measured = std::clamp(light.shadowed / light.unshadowed, 0.f, 1.f);
            if (page.map.visibility.pixels[i].x != measured) ++changed;
        }
    }
    return changed;
}

}  // namespace surimi::test
