// SPDX-License-Identifier: Apache-2.0
#include "baker/write/unwrap_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "baker/unwrap/coverage.h"
#include "baker/unwrap/measure.h"
#include "baker/write/paint.h"
#include "runtime/compare/compare.h"

namespace surimi {
namespace {

using Color = glm::u8vec3;

constexpr Color dark(24, 24, 28);   ///< where there is no chart
constexpr Color slate(70, 80, 90);  ///< the same in heat maps, whose colours have neither grey nor blue-green
constexpr Color white(255, 255, 255);
constexpr Color black(0, 0, 0);
constexpr Color magenta(255, 0, 255);
constexpr Color red(255, 0, 0);
/// Told apart with every kind of colour vision (Okabe and Ito 2008).
constexpr std::array<Color, 7> palette{
    {{230, 159, 0}, {86, 180, 233}, {0, 158, 115}, {240, 228, 66}, {0, 114, 178}, {213, 94, 0}, {204, 121, 167}}};

Color scaled(const Color& color, double factor) {
    return Color(glm::round(Vec3(color) * factor));
}

/// Longest side that a picture has at least, in pixels.
constexpr int least_for_lines = 2048;
constexpr int least_for_heat = 512;

/// Pixels for each texel.
double picture_scale(const Atlas& atlas, int least) {
    constexpr int most = 4096;
    const int longer = std::max({atlas.width, atlas.height, 1});
    if (longer > most) return 1.0 / ((longer + most - 1) / most);
    return longer < least ? (least + longer - 1) / longer : 1;
}

glm::ivec2 picture_size(const Atlas& atlas, int least) {
    return glm::max(glm::ivec2(Vec2(atlas.width, atlas.height) * picture_scale(atlas, least)), glm::ivec2(1));
}

/// Which charts meet when each takes the pixels nearest to it: for each chart the others, sorted.
std::vector<std::vector<uint32_t>> neighbours(const PlacedTriangles& placed, const glm::ivec2& size, size_t count) {
    std::vector<std::array<uint32_t, 2>> pairs;
    const auto nearest = nearest_charts(touched_charts(placed, size), std::max(size.x, size.y));
    visit_borders(nearest, [&](uint32_t a, uint32_t b, int) {
        const std::array pair{std::min(a, b), std::max(a, b)};
        if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);
    });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::vector<std::vector<uint32_t>> result(count);
    for (const auto& [a, b] : pairs) {
        result[a].push_back(b);
        result[b].push_back(a);
    }
    return result;
}

/// A colour for each chart that none of its neighbours has: the first free one, in darker shades when all are taken.
std::vector<Color> chart_colors(const std::vector<std::vector<uint32_t>>& neighbours) {
    constexpr double shade = 0.72;
    constexpr size_t undecided = std::numeric_limits<size_t>::max();
    std::vector<size_t> choice(neighbours.size(), undecided);
    std::vector<Color> colors;
    for (size_t c = 0; c < neighbours.size(); ++c) {
        std::set<size_t> taken;
        for (const uint32_t other : neighbours[c]) taken.insert(choice[other]);
        size_t k = 0;
        // Each chart starts elsewhere in the palette, so that all colours come up.
        const auto nth = [&](size_t n) { return n / palette.size() * palette.size() + (c + n) % palette.size(); };
        while (taken.contains(nth(k))) ++k;
        choice[c] = nth(k);
        colors.push_back(scaled(palette[choice[c] % palette.size()],
                                std::pow(shade, static_cast<double>(choice[c] / palette.size()))));
    }
    return colors;
}

/// The charts alone, in their colours times `brightness`.
Picture8 paint_charts(const PlacedTriangles& placed, const glm::ivec2& size, size_t count, double brightness) {
    Picture8 picture(size.x, size.y, dark);
    const std::vector<Color> colors = chart_colors(neighbours(placed, size, count));
    paint(
        placed, [&](size_t i) { return scaled(colors[placed.chart[i]], brightness); }, picture);
    return picture;
}

/// A heat map of one number for each triangle.
template <class Value>
Picture8 draw_heat(const Atlas& atlas, int page, const Vec2& range, const Value& value) {
    const glm::ivec2 size = picture_size(atlas, least_for_heat);
    const PlacedTriangles placed = place_triangles(atlas, page, size);
    Image<float> values(size.x, size.y, std::numeric_limits<float>::quiet_NaN());
    paint(
        placed, [&](size_t i) { return static_cast<float>(value(placed.source[i])); }, values);
    Picture8 picture = heat_map(values, range.x, range.y);
    for (size_t i = 0; i < values.pixels.size(); ++i)
        if (std::isnan(values.pixels[i])) picture.pixels[i] = slate;
    return picture;
}

}  // namespace

Picture8 draw_charts(const Scene& scene, const Atlas& atlas, int page) {
    const glm::ivec2 size = picture_size(atlas, least_for_lines);
    Picture8 picture = paint_charts(place_triangles(atlas, page, size), size, atlas.charts.size(), 1);
    const std::vector<ChartSide> sides = chart_sides(scene, atlas);
    for (const bool is_smooth : {false, true})  // those that show on top
        for (const ChartSide& side : sides) {
            const SurfaceUv& surface = atlas.surfaces[side.triangle.surface];
            if (side.is_smooth != is_smooth || surface.page != page) continue;
            const auto& uv = surface.uv[side.triangle.triangle];
            draw_line(Vec2(uv[side.corner]) * Vec2(size), Vec2(uv[(side.corner + 1) % 3]) * Vec2(size),
                      is_smooth ? white : black, picture);
        }
    return picture;
}

Picture8 draw_density(const Scene& scene, const Atlas& atlas, int page, double high) {
    return draw_heat(atlas, page, {0, high}, [&](const TriangleRef& ref) {
        const double largest = stretch_of(scene, atlas, ref.surface, ref.triangle).largest;
        return largest > 0 ? 1 / largest : 0;
    });
}

Picture8 draw_stretch(const Scene& scene, const Atlas& atlas, int page, double high) {
    return draw_heat(atlas, page, {1, high}, [&](const TriangleRef& ref) {
        const Stretch stretch = stretch_of(scene, atlas, ref.surface, ref.triangle);
        const double density = atlas.charts[atlas.surfaces[ref.surface].chart[ref.triangle]].texels_per_metre;
        if (!(stretch.smallest > 0) || !(density > 0)) return 1.0;
        return std::max(stretch.largest * density, 1 / (stretch.smallest * density));
    });
}

Picture8 draw_faults(const ExistingUv& found) {
    const glm::ivec2 size = picture_size(found.atlas, least_for_lines);
    const PlacedTriangles on_map = place_triangles(found.atlas, 0, size);
    const auto is_outside = [&](const FlatTriangle& t) {
        return std::any_of(t.begin(), t.end(),
                           [&](const Vec2& p) { return !(p.x >= 0 && p.y >= 0 && p.x <= size.x && p.y <= size.y); });
    };
    const bool has_margin = std::any_of(on_map.texels.begin(), on_map.texels.end(), is_outside);
    const glm::ivec2 margin = has_margin ? size / 4 : glm::ivec2(0);
    const double enough = 4.0 * size.x * size.y;  // of a heap, more would bring nothing new
    PlacedTriangles placed, bad;
    double area = 0;
    size_t next = 0;
    for (size_t i = 0; i < on_map.texels.size() && area < enough; ++i) {
        FlatTriangle pixels = on_map.texels[i];
        for (Vec2& p : pixels) p += Vec2(margin);
        area += 0.5 * std::abs(doubled_area(pixels));
        placed.texels.push_back(pixels);
        placed.chart.push_back(on_map.chart[i]);
        const auto key = [](const TriangleRef& ref) { return std::pair(ref.surface, ref.triangle); };
        while (next < found.bad.size() && key(found.bad[next]) < key(on_map.source[i])) ++next;
        if (next < found.bad.size() && key(found.bad[next]) == key(on_map.source[i])) bad.texels.push_back(pixels);
    }
    constexpr double dimmed = 0.45;
    Picture8 picture = paint_charts(placed, size + 2 * margin, found.atlas.charts.size(), dimmed);
    paint(
        bad, [](size_t) { return magenta; }, picture);
    const double scale = picture_scale(found.atlas, least_for_lines);
    for (const uint32_t texel : found.shared) {
        const auto width = static_cast<uint32_t>(found.atlas.width);
        const glm::ivec2 low(Vec2(texel % width, texel / width) * scale);
        const glm::ivec2 high = glm::max(glm::ivec2(Vec2(texel % width + 1, texel / width + 1) * scale), low + 1);
        for (int y = low.y; y < std::min(high.y, size.y); ++y)
            for (int x = low.x; x < std::min(high.x, size.x); ++x) picture.at(x, y) = red;
    }
    if (!has_margin) return picture;
    const Vec2 low(margin), high(margin + size);
    for (const auto& [a, b] : {std::pair(low, Vec2(high.x, low.y)), std::pair(Vec2(high.x, low.y), high),
                               std::pair(high, Vec2(low.x, high.y)), std::pair(Vec2(low.x, high.y), low)})
        draw_line(a, b, white, picture);
    return picture;
}

}  // namespace surimi
