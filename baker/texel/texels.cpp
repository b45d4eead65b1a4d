// SPDX-License-Identifier: Apache-2.0
#include "baker/texel/texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "runtime/base/parallel.h"

namespace surimi {
namespace {

using Corners = std::array<Vec2, 3>;

/// Do the closed triangle and the open unit square at (x, y) meet? By separating axes: the square's two, the edges'
/// three.
bool meets_square(const Corners& t, int x, int y) {
    const Vec2 center(x + 0.5, y + 0.5);
    for (int axis = 0; axis < 2; ++axis) {
        const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        if (low >= center[axis] + 0.5 || high <= center[axis] - 0.5) return false;
    }
    for (size_t e = 0; e < 3; ++e) {
        const Vec2 edge = t[(e + 1) % 3] - t[e];
        const Vec2 normal(-edge.y, edge.x);
        const double reach = 0.5 * (std::abs(normal.x) + std::abs(normal.y));
        const double d0 = glm::dot(normal, t[e] - center), d1 = glm::dot(normal, t[(e + 2) % 3] - center);
        if (std::min(d0, d1) >= reach || std::max(d0, d1) <= -reach) return false;
    }
    return true;
}

/// Texel squares, both ends included.
struct Box {
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

/// The squares that the triangle's box meets, within those of `limits`: the nearest ones where it is beside them.
Box box_of(const Corners& t, const Box& limits) {
    const auto range = [&](int axis, int first, int last) {
        const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        return std::pair{std::clamp(static_cast<int>(std::floor(low)), first, last),
                         std::clamp(static_cast<int>(std::floor(high)), first, last)};
    };
    const auto [x0, x1] = range(0, limits.x0, limits.x1);
    const auto [y0, y1] = range(1, limits.y0, limits.y1);
    return {x0, x1, y0, y1};
}

bool meets_some_square(const Corners& t, const Box& box) {
    for (int y = box.y0; y <= box.y1; ++y)
        for (int x = box.x0; x <= box.x1; ++x)
            if (meets_square(t, x, y)) return true;
    return false;
}

/// A triangle of the page.
struct Candidate {
    TriangleRef triangle;
    uint32_t chart = 0;
    bool is_flat = false;  ///< along a texel border: it meets no open square, so the squares of its box stand in
};

/// Whatever the size of the map, this much of it is rasterised at a time: few rows keep what is on the way small.
constexpr int band_rows = 16;
constexpr uint32_t nobody = 0xffffffffu;

/// All triangles of a page, and the numbers of those that reach into each band.
struct Candidates {
    std::vector<Candidate> all;
    std::vector<std::vector<uint32_t>> of_band;
};

Candidates find_candidates(const Scene& scene, const Atlas& atlas, int page) {
    Candidates candidates;
    candidates.of_band.resize(static_cast<size_t>((atlas.height + band_rows - 1) / band_rows));
    const Box map{0, atlas.width - 1, 0, atlas.height - 1};
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        if (atlas.surfaces[s].page != page) continue;
        for (uint32_t t = 0; t < atlas.surfaces[s].uv.size(); ++t) {  // none where it does not receive
            const Corners corners = texel_corners(atlas, {s, t});
            const Box box = box_of(corners, map);
            const auto number = static_cast<uint32_t>(candidates.all.size());
            candidates.all.push_back({{s, t}, atlas.surfaces[s].chart[t], !meets_some_square(corners, box)});
            for (int band = box.y0 / band_rows; band <= box.y1 / band_rows; ++band)
                candidates.of_band[static_cast<size_t>(band)].push_back(number);
        }
    }
    return candidates;
}

/// Texels of one band. Candidates come in the order of their triangles, and counting keeps it in every texel.
Texels texels_of_band(const Atlas& atlas, const Candidates& candidates, size_t band) {
    const int top = static_cast<int>(band) * band_rows, bottom = std::min(top + band_rows, atlas.height);
    const auto width = static_cast<size_t>(atlas.width), places = static_cast<size_t>(bottom - top) * width;
    struct Touch {
        uint32_t place, candidate;
    };
    std::vector<Touch> touches;
    std::vector<uint32_t> chart(places, nobody);
    for (const uint32_t number : candidates.of_band[band]) {
        const Candidate& candidate = candidates.all[number];
        const Corners t = texel_corners(atlas, candidate.triangle);
        const Box box = box_of(t, {0, atlas.width - 1, 0, atlas.height - 1});
        for (int y = std::max(box.y0, top); y <= std::min(box.y1, bottom - 1); ++y)
            for (int x = box.x0; x <= box.x1; ++x) {
                if (!candidate.is_flat && !meets_square(t, x, y)) continue;
                const auto place = static_cast<size_t>(y - top) * width + static_cast<size_t>(x);
                touches.push_back({static_cast<uint32_t>(place), number});
                chart[place] = std::min(chart[place], candidate.chart);
            }
    }
    const auto is_owner = [&](const Touch& touch) {
        return candidates.all[touch.candidate].chart == chart[touch.place];
    };
    std::vector<uint32_t> first(places + 1, 0);  // of each place's triangles
    for (const Touch& touch : touches) first[touch.place + 1] += is_owner(touch);
    Texels result;
    const auto begin = static_cast<uint32_t>(static_cast<size_t>(top) * width);
    for (uint32_t place = 0; place < places; ++place) {
        const uint32_t count = first[place + 1];
        first[place + 1] += first[place];
        if (count > 0) result.texels.push_back({begin + place, chart[place], first[place], count});
    }
    result.triangles.resize(first.back());
    for (const Touch& touch : touches)
        if (is_owner(touch)) result.triangles[first[touch.place]++] = candidates.all[touch.candidate].triangle;
    return result;
}

/// Bit y * factor + x for each subtexel of the texel at (x, y) that the triangle is listed with.
uint32_t subtexels_of(const Corners& t, int x, int y, int factor) {
    const Box all{x * factor, x * factor + factor - 1, y * factor, y * factor + factor - 1};
    const Box box = box_of(t, all);
    const bool is_flat = !meets_some_square(t, box);
    uint32_t bits = 0;
    for (int sy = box.y0; sy <= box.y1; ++sy)
        for (int sx = box.x0; sx <= box.x1; ++sx)
            if (is_flat || meets_square(t, sx, sy)) bits |= 1u << ((sy - all.y0) * factor + sx - all.x0);
    return bits;
}

/// Subdivides the texels of one row, as far as they lie in `rows`.
Texels subdivided_row(const Texels& texels, const Numbers& row, const Atlas& fine, const Rows& rows) {
    const int factor = fine.width / texels.width;
    const auto width = static_cast<uint32_t>(texels.width), step = static_cast<uint32_t>(factor);
    std::vector<uint32_t> bits;  // of all triangles of the row, texel by texel
    for (size_t i = row.begin; i < row.end; ++i) {
        const Texel& texel = texels.texels[i];
        const int x = static_cast<int>(texel.index % width), y = static_cast<int>(texel.index / width);
        for (const TriangleRef& triangle : texels.triangles_of(texel))
            bits.push_back(subtexels_of(texel_corners(fine, triangle), x, y, factor));
    }
    Texels result;
    for (uint32_t sub = 0; sub < step; ++sub) {
        const auto y = static_cast<int>(texels.texels[row.begin].index / width * step + sub);
        if (y < rows.begin || y >= rows.end) continue;
        size_t before = 0;
        for (size_t i = row.begin; i < row.end; before += texels.texels[i++].count) {
            const Texel& texel = texels.texels[i];
            const uint32_t index = static_cast<uint32_t>(y) * (width * step) + texel.index % width * step;
            for (uint32_t x = 0; x < step; ++x) {
                const auto first = static_cast<uint32_t>(result.triangles.size());
                for (uint32_t k = 0; k < texel.count; ++k)
                    if (bits[before + k] >> (sub * step + x) & 1u)
                        result.triangles.push_back(texels.triangles_of(texel)[k]);
                const auto count = static_cast<uint32_t>(result.triangles.size()) - first;
                if (count > 0)
                    result.texels.push_back(
                        {index + x, texel.chart, first, count, texel.free_pieces, texel.may_turn, texel.is_touched});
            }
        }
    }
    return result;
}

/// Puts parts one behind the other.
void append(Texels& whole, const Texels& part) {
    const auto before = static_cast<uint32_t>(whole.triangles.size());
    for (Texel texel : part.texels) {
        texel.first += before;
        whole.texels.push_back(texel);
    }
    whole.triangles.insert(whole.triangles.end(), part.triangles.begin(), part.triangles.end());
}

}  // namespace

std::array<Vec2, 3> texel_corners(const Atlas& atlas, const TriangleRef& triangle) {
    Corners corners;
    const auto& uv = atlas.surfaces[triangle.surface].uv[triangle.triangle];
    for (size_t i = 0; i < 3; ++i) corners[i] = Vec2(uv[i]) * Vec2(atlas.width, atlas.height);
    return corners;
}

// Every band is found twice, so that the result is no larger than it must be and never held twice.
Texels find_texels(const Scene& scene, const Atlas& atlas, int page) {
    const Candidates candidates = find_candidates(scene, atlas, page);
    const size_t bands = candidates.of_band.size();
    std::vector<std::array<size_t, 2>> starts(bands + 1);  // of each band's texels and triangles
    parallel_for(bands, 1, [&](size_t band) {
        const Texels part = texels_of_band(atlas, candidates, band);
        starts[band + 1] = {part.texels.size(), part.triangles.size()};
    });
    for (size_t band = 0; band < bands; ++band)
        for (size_t i = 0; i < 2; ++i) starts[band + 1][i] += starts[band][i];
    Texels result;
    result.page = page;
    result.width = atlas.width;
    result.height = atlas.height;
    result.texels.resize(starts.back()[0]);
    result.triangles.resize(starts.back()[1]);
    parallel_for(bands, 1, [&](size_t band) {
        const Texels part = texels_of_band(atlas, candidates, band);
        const auto& [texel, triangle] = starts[band];
        for (size_t i = 0; i < part.texels.size(); ++i) {
            result.texels[texel + i] = part.texels[i];
            result.texels[texel + i].first += static_cast<uint32_t>(triangle);
        }
        std::ranges::copy(part.triangles, result.triangles.begin() + static_cast<std::ptrdiff_t>(triangle));
    });
    return result;
}

Numbers numbers_in(const Texels& texels, const Rows& rows) {
    const auto number_of = [&](int row) {
        const auto index =
            static_cast<uint64_t>(std::clamp(row, 0, texels.height)) * static_cast<uint64_t>(texels.width);
        const auto found = std::ranges::lower_bound(texels.texels, index, {}, &Texel::index);
        return static_cast<size_t>(found - texels.texels.begin());
    };
    return {number_of(rows.begin), number_of(rows.end)};
}

Texels texels_in(const Texels& texels, const Rows& rows) {
    const Numbers numbers = numbers_in(texels, rows);
    Texels result{texels.page, texels.width, texels.height, {}, {}};
    size_t triangles = 0;
    for (size_t i = numbers.begin; i < numbers.end; ++i) triangles += texels.texels[i].count;
    result.texels.reserve(numbers.count());
    result.triangles.reserve(triangles);
    for (size_t i = numbers.begin; i < numbers.end; ++i) {
        Texel texel = texels.texels[i];
        const auto of_texel = texels.triangles_of(texel);
        texel.first = static_cast<uint32_t>(result.triangles.size());
        result.texels.push_back(texel);
        result.triangles.insert(result.triangles.end(), of_texel.begin(), of_texel.end());
    }
    return result;
}

Texels subdivided(const Texels& texels, const Atlas& fine, const Rows& rows) {
    const auto width = static_cast<uint32_t>(texels.width);
    std::vector<Numbers> numbers;  // of each row that has texels
    for (size_t i = 0; i < texels.texels.size(); ++i) {
        if (i == 0 || texels.texels[i].index / width != texels.texels[i - 1].index / width) numbers.push_back({i, i});
        numbers.back().end = i + 1;
    }
    std::vector<Texels> parts(numbers.size());
    parallel_for(parts.size(), 1, [&](size_t r) { parts[r] = subdivided_row(texels, numbers[r], fine, rows); });
    Texels result{texels.page, fine.width, fine.height, {}, {}};
    size_t texel_count = 0, triangle_count = 0;
    for (const Texels& part : parts) texel_count += part.texels.size(), triangle_count += part.triangles.size();
    result.texels.reserve(texel_count);
    result.triangles.reserve(triangle_count);
    for (Texels& part : parts) append(result, std::exchange(part, {}));
    return result;
}

}  // namespace surimi
