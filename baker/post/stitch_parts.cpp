// SPDX-License-Identifier: Apache-2.0
#include "baker/post/stitch_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "baker/unwrap/union_find.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

// Eight values that are each off by half a step of float below 1, which is half an epsilon.
constexpr double rounding = 4 * static_cast<double>(std::numeric_limits<float>::epsilon());
constexpr size_t grain = 1024;
constexpr uint32_t nobody = std::numeric_limits<uint32_t>::max();

/// Sorts, and leaves one of each.
template <class Item>
void make_unique(std::vector<Item>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

std::vector<uint64_t> joined(std::vector<std::vector<uint64_t>>& lists) {
    std::vector<uint64_t> all;
    for (auto& list : lists) {
        all.insert(all.end(), list.begin(), list.end());
        list = {};
    }
    make_unique(all);
    return all;
}

/// The texels that may move, increasing.
std::vector<uint64_t> find_unknowns(const Atlas& atlas, const Seams& seams, std::span<const Channel> pages) {
    std::vector<std::vector<uint64_t>> found((seams.pieces.size() + grain - 1) / grain);
    parallel_ranges(seams.pieces.size(), grain, [&](size_t begin, size_t end) {
        std::vector<uint64_t>& texels = found[begin / grain];
        for (size_t p = begin; p < end; ++p)
            for_each_place(atlas, seams.pieces[p], [&](const SeamSample& sample, size_t) {
                if (!(std::abs(jump(pages, sample)) > rounding) || !is_seen(pages, sample)) return;
                for (size_t k = 0; k < sample.count; ++k)
                    if (state_of(pages, sample.texels[k]) != TexelState::empty) texels.push_back(sample.texels[k]);
            });
        make_unique(texels);
    });
    return joined(found);
}

/// Numbers of texels, found by their row on the map.
class TexelNumbers {
  public:
    TexelNumbers(const std::vector<uint64_t>& texels, const Atlas& atlas)
        : texels_(texels), width_(static_cast<uint64_t>(atlas.width)) {
        rows_.assign(static_cast<size_t>(atlas.pages) * static_cast<size_t>(atlas.height) + 1, 0);
        for (const uint64_t texel : texels) ++rows_[texel / width_ + 1];
        std::partial_sum(rows_.begin(), rows_.end(), rows_.begin());
    }

    uint32_t number_of(uint64_t texel) const {
        const uint64_t row = texel / width_;
        const auto begin = texels_.begin() + rows_[row], end = texels_.begin() + rows_[row + 1];
        const auto at = std::lower_bound(begin, end, texel);
        return at != end && *at == texel ? static_cast<uint32_t>(at - texels_.begin()) : nobody;
    }

  private:
    const std::vector<uint64_t>& texels_;
    uint64_t width_;
    std::vector<uint32_t> rows_;  // where each begins in texels_
};

/// Two numbers that belong together: of texels, or of a piece and a texel.
using Link = std::pair<uint32_t, uint32_t>;

struct Links {
    std::vector<Link> texels;           ///< read at one place of a seam
    std::vector<Link> piece_and_texel;  ///< one texel for each place
};

void add_links(Links& links, const SeamSample& sample, uint32_t piece, const TexelNumbers& numbers) {
    uint32_t first = nobody;
    for (size_t k = 0; k < sample.count; ++k) {
        const uint32_t number = numbers.number_of(sample.texels[k]);
        if (number == nobody) continue;
        if (first == nobody) {
            first = number;
            links.piece_and_texel.push_back({piece, number});
        }
        links.texels.push_back({first, number});
    }
}

/// By range of pieces, so that the order is always the same.
std::vector<Links> find_links(const Atlas& atlas, const Seams& seams, const TexelNumbers& numbers) {
    std::vector<Links> found((seams.pieces.size() + grain - 1) / grain);
    parallel_ranges(seams.pieces.size(), grain, [&](size_t begin, size_t end) {
        Links& links = found[begin / grain];
        for (size_t p = begin; p < end; ++p)
            for_each_place(atlas, seams.pieces[p], [&](const SeamSample& sample, size_t) {
                add_links(links, sample, static_cast<uint32_t>(p), numbers);
            });
        make_unique(links.texels);
        make_unique(links.piece_and_texel);
    });
    return found;
}

}  // namespace

size_t steps_of(const SeamPiece& piece) {
    return static_cast<size_t>(std::max(1.0, std::ceil(2 * texels_along(piece))));
}

std::vector<StitchPart> find_stitch_parts(const Atlas& atlas, const Seams& seams, std::span<const Channel> pages) {
    const std::vector<uint64_t> unknowns = find_unknowns(atlas, seams, pages);
    const std::vector<Links> links = find_links(atlas, seams, TexelNumbers(unknowns, atlas));
    std::vector<uint32_t> parent(unknowns.size());
    std::iota(parent.begin(), parent.end(), 0u);
    for (const Links& some : links)
        for (const auto& [a, b] : some.texels) unite(parent, a, b);

    std::vector<StitchPart> parts;
    std::vector<uint32_t> part_of(unknowns.size(), 0);
    for (uint32_t i = 0; i < unknowns.size(); ++i) {
        const uint32_t root = find_root(parent, i);
        if (root == i) parts.emplace_back();
        part_of[i] = root == i ? static_cast<uint32_t>(parts.size()) - 1 : part_of[root];
        parts[part_of[i]].texels.push_back(unknowns[i]);
    }
    for (const Links& some : links) {
        for (const auto& [piece, texel] : some.piece_and_texel) {
            std::vector<uint32_t>& pieces = parts[part_of[texel]].pieces;
            if (pieces.empty() || pieces.back() != piece) pieces.push_back(piece);
        }
    }
    return parts;
}

}  // namespace surimi
