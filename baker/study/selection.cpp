// SPDX-License-Identifier: Apache-2.0
#include "baker/study/selection.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "baker/texel/texel_surface.h"
#include "runtime/base/parallel.h"
#include "runtime/base/random.h"
#include "runtime/ltc/polygon.h"

namespace surimi {
namespace {

constexpr uint32_t side = 8;          // of a block, texels; the engine's
constexpr size_t texels_a_block = 4;  // that get a reference

/// Does any light of the monitor reach the texel, if nothing is in the way? By one point in each quarter.
bool is_lit(const TexelSurface& surface, const Monitor& monitor) {
    for (const Vec2& place : {Vec2(0.25, 0.25), Vec2(0.75, 0.25), Vec2(0.25, 0.75), Vec2(0.75, 0.75)}) {
        const SurfacePoint point = surface.sample(place.x, place.y);
        for (const Polygon& panel : monitor.panels)
            if (irradiance_of_polygon<double>(panel.corners, point.position, point.normal, monitor.two_sided) > 0)
                return true;
    }
    return false;
}

/// A pair in the whole map, with its place in the draw.
struct Candidate {
    uint64_t draw = 0;
    size_t monitor = 0, page = 0, texel = 0;
    auto order() const { return std::tie(draw, monitor, page, texel); }
};

using Block = std::tuple<size_t, size_t, uint32_t, uint32_t>;  // monitor, page, column, row

Block block_of(const Candidate& pair, const Texels& page) {
    const uint32_t index = page.texels[pair.texel].index, width = static_cast<uint32_t>(page.width);
    return {pair.monitor, pair.page, index % width / side, index / width / side};
}

std::vector<Candidate> lit_pairs(const Scene& scene, const Atlas& atlas, const std::vector<Texels>& pages,
                                 uint64_t seed) {
    std::vector<Candidate> pairs;
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        for (size_t p = 0; p < pages.size(); ++p) {
            const Texels& page = pages[p];
            std::vector<uint8_t> lit(page.texels.size());
            parallel_for(lit.size(), 1024, [&](size_t i) {
                lit[i] = is_lit(TexelSurface(scene, atlas, page, page.texels[i]), scene.monitors[m]) ? 1 : 0;
            });
            for (size_t i = 0; i < lit.size(); ++i)
                if (lit[i] != 0) pairs.push_back({hash(hash(seed, m), hash(p, page.texels[i].index)), m, p, i});
        }
    }
    return pairs;
}

Texels empty_page(const Texels& page) {
    Texels empty;
    empty.page = page.page;
    empty.width = page.width;
    empty.height = page.height;
    return empty;
}

void append(Texels& subset, const Texels& page, const Texel& texel) {
    Texel copy = texel;
    copy.first = static_cast<uint32_t>(subset.triangles.size());
    for (const TriangleRef& triangle : page.triangles_of(texel)) subset.triangles.push_back(triangle);
    subset.texels.push_back(copy);
}

}  // namespace

Selection choose_texels(const Scene& scene, const Atlas& atlas, const std::vector<Texels>& pages, size_t count,
                        uint64_t seed) {
    std::vector<Candidate> pairs = lit_pairs(scene, atlas, pages, seed);
    std::ranges::sort(pairs, [](const Candidate& a, const Candidate& b) { return a.order() < b.order(); });

    Selection result;
    result.lit = pairs.size();
    std::map<Block, size_t> lit_texels;
    for (const Candidate& pair : pairs) ++lit_texels[block_of(pair, pages[pair.page])];
    // The first pairs of the draw choose the blocks; the next of the same blocks are the other texels.
    std::set<Block> chosen;
    size_t room = 0;
    for (size_t i = 0; i < pairs.size() && room < count; ++i) {
        const Block block = block_of(pairs[i], pages[pairs[i].page]);
        if (chosen.insert(block).second) room += std::min(texels_a_block, lit_texels[block]);
    }
    result.block_count = chosen.size();

    std::vector<Candidate> inside;
    for (const Candidate& pair : pairs)
        if (chosen.contains(block_of(pair, pages[pair.page]))) inside.push_back(pair);
    result.lit_in_blocks = inside.size();
    std::map<Block, size_t> taken;
    std::set<std::array<size_t, 3>> measured;
    for (const Candidate& pair : inside) {
        const Block block = block_of(pair, pages[pair.page]);
        if (measured.size() < count && taken[block]++ < texels_a_block)
            measured.insert({pair.monitor, pair.page, pair.texel});
    }

    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        auto& of_monitor = result.blocks.emplace_back();
        for (size_t p = 0; p < pages.size(); ++p) {
            Texels& subset = of_monitor.emplace_back(empty_page(pages[p]));
            for (size_t i = 0; i < pages[p].texels.size(); ++i) {
                if (!chosen.contains(block_of({0, m, p, i}, pages[p]))) continue;
                if (measured.contains({m, p, i})) result.texels.push_back({m, p, subset.texels.size()});
                append(subset, pages[p], pages[p].texels[i]);
            }
        }
    }
    return result;
}

}  // namespace surimi
