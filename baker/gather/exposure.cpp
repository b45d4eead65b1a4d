// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "baker/gather/blocks.h"
#include "baker/gather/contacts.h"
#include "baker/gather/enclosure.h"
#include "baker/gather/footprint.h"
#include "baker/gather/lift_pieces.h"
#include "runtime/base/parallel.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

SurfacePoint turned(SurfacePoint point) {
    point.normal = -point.normal;
    point.geometric_normal = -point.geometric_normal;
    return point;
}

}  // namespace

double unshadowed_at(std::span<const Panel> panels, const RayScene& rays, const SurfacePoint& point) {
    double sum = 0;
    for (const Panel& panel : panels) sum += unshadowed_from(panel, point.position - rays.center(), point.normal);
    return sum;
}

bool has_lit_corner(std::span<const Panel> panels, const RayScene& rays, const TexelSurface& surface) {
    bool is_lit = false;
    surface.for_each_corner(
        [&](const SurfacePoint& corner) { is_lit = is_lit || unshadowed_at(panels, rays, corner) > 0; });
    return is_lit;
}

namespace {

constexpr double slab = 0.1;  // texels over the surface in which edges part what they hide from what they do not

/// Along contacts and under the edges of what lies close over it.
TexelSurface::CutResult cut_where_hidden(const RayScene& rays, std::span<const BoxedTriangle> triangles,
                                         TexelSurface& surface, bool& is_touched) {
    thread_local std::vector<TexelSurface::Crossing> lines;
    find_contacts(rays, triangles, surface, slab * std::sqrt(surface.area()), lines);
    is_touched = !lines.empty();
    return cut_along(lines, surface);
}

/// Corners of the surface, lifted to where rays start from and by the slab.
void add_places(const RayScene& rays, const TexelSurface& surface, std::vector<Vec3>& places) {
    const double height = slab * std::sqrt(surface.area());
    surface.for_each_corner([&](const SurfacePoint& p) {
        places.push_back(rays.ray_origin(p) - rays.center());
        places.push_back(places.back() + height * p.geometric_normal);
    });
}

TexelSurface::CutResult cut_where_hidden(const RayScene& rays, TexelSurface& surface) {
    std::vector<Vec3> places;
    add_places(rays, surface, places);
    bool is_touched = false;
    return cut_where_hidden(rays, triangles_around(rays, places), surface, is_touched);
}

void keep_free_pieces(const RayScene& rays, const Texel& texel, TexelSurface& surface) {
    if (texel.free_pieces == Texel::all_pieces || texel.is_inside()) return;
    cut_where_hidden(rays, surface);
    surface.keep(texel.free_pieces);
}

bool is_lit(std::span<const Panel> panels, const RayScene& rays, const TexelSurface& surface) {
    return unshadowed_at(panels, rays, surface.center()) > 0 || has_lit_corner(panels, rays, surface);
}

}  // namespace

TexelSurface exposed_surface(const Receivers& receivers, const Texel& texel, std::span<const Panel> panels) {
    const RayScene& rays = receivers.rays;
    TexelSurface surface(receivers.scene, receivers.atlas, receivers.texels, texel);
    if (texel.may_turn && !is_lit(panels, rays, surface)) {
        TexelSurface back = surface;
        back.turn_over();
        if (is_lit(panels, rays, back)) return back;
    }
    keep_free_pieces(rays, texel, surface);
    // What a smooth surface touches would be behind what is lifted.
    if (receivers.lifts_smooth && !texel.is_touched) lift_pieces(rays, panels, surface);
    return surface;
}

double exposed_area(const Receivers& receivers, const Texel& texel) {
    if (texel.is_inside()) return 0;
    TexelSurface surface(receivers.scene, receivers.atlas, receivers.texels, texel);
    keep_free_pieces(receivers.rays, texel, surface);
    return surface.area();
}

namespace {

/// All pages' panels of all monitors, and the judge: what the texels of a block are judged by.
struct Judging {
    const Scene& scene;
    const Atlas& atlas;
    const RayScene& rays;
    const EnclosureJudge& judge;
    std::vector<std::vector<Panel>> panels;  // by monitor
    int factor = 1;                          // texels are so much larger than those that are judged

    bool is_two_sided(const Texel& texel) const {
        return scene.surfaces[atlas.charts[texel.chart].surface].is_two_sided;
    }
    /// Does some monitor light the back of what it cannot light from the front, and is the back free?
    bool may_turn(const SurfacePoint& point, double texel_size, uint64_t key) const {
        const SurfacePoint back = turned(point);
        const bool is_called_for = std::ranges::any_of(panels, [&](const std::vector<Panel>& of_monitor) {
            return !(unshadowed_at(of_monitor, rays, point) > 0) && unshadowed_at(of_monitor, rays, back) > 0;
        });
        return is_called_for && judge.judge_back(back, texel_size, hash(key, 1)) != Enclosure::enclosed;
    }

    /// Writes what is free of the texel; adds to `probes`. What is free of a sixteenth of it or less says too little of
    /// what is around it.
    void find_free_pieces(TexelSurface surface, uint64_t key, Texel& texel, size_t& probes) const {
        constexpr double least_share = 1.0 / 16;
        const double texel_size = factor * std::sqrt(surface.area());
        const SurfacePoint center = surface.center();
        const TexelSurface::CutResult cut = cut_where_hidden(rays, surface);
        if (!cut.is_cut || !cut.is_whole) {
            ++probes;
            texel.free_pieces = judge.judge(center, texel_size, key) == Enclosure::enclosed ? 0 : Texel::all_pieces;
            return;
        }
        uint32_t free = 0;
        double share = 0;
        const size_t count = surface.pieces().size();
        for (size_t i = 0; i < count; ++i) {
            const TexelSurface::Piece& piece = surface.pieces()[i];
            const SurfacePoint middle = TexelSurface::point_of(piece, piece.middle());
            if (judge.judge(middle, texel_size, hash(key, i)) == Enclosure::enclosed) continue;
            free |= 1u << i;
            share += surface.share_of(piece);
        }
        probes += count;
        texel.is_mostly_free = share >= 0.5;
        if (!(share > least_share)) free = 0;
        texel.free_pieces = free == (1u << count) - 1 ? Texel::all_pieces : free;
    }
};

/// Of the random numbers of a texel's probes.
uint64_t key_of(const Texels& texels, const Texel& texel) {
    return hash(0x696e73696465, texels.key_of(texel));
}

/// The texels of one block, judged.
class BlockJudge {
  public:
    BlockJudge(const Judging& judging, Texels& texels, std::span<const uint32_t> members)
        : judging_(judging), texels_(texels), members_(members) {
        grid_.fill(-1);
        const auto width = static_cast<uint32_t>(texels.width);
        for (size_t i = 0; i < members.size(); ++i)
            grid_[cell_in_tile(texels.texels[members[i]].index, width)] = static_cast<int16_t>(i);
    }

    /// Returns the number of places judged.
    size_t run() {
        std::vector<char> is_done(members_.size(), 0);
        for (size_t cell = 0; cell < grid_.size(); ++cell) {
            const int member = grid_[cell];
            if (member < 0 || is_done[static_cast<size_t>(member)]) continue;
            if (texel_of(member).is_touched)
                judge_touched(texel_of(member));
            else
                judge_group(group_from(cell, is_done));
        }
        return probes_;
    }

  private:
    Texel& texel_of(int member) { return texels_.texels[members_[static_cast<size_t>(member)]]; }
    const Texel& texel_of(int member) const { return texels_.texels[members_[static_cast<size_t>(member)]]; }

    uint64_t key(const Texel& texel) const { return key_of(texels_, texel); }

    TexelSurface surface_of(const Texel& texel) const {
        return TexelSurface(judging_.scene, judging_.atlas, texels_, texel);
    }

    Enclosure judge(const SurfacePoint& point, double texel_size, uint64_t key) {
        ++probes_;
        return judging_.judge.judge(point, texel_size, key);
    }
    Enclosure judge(const Texel& texel) {
        const TexelSurface surface = surface_of(texel);
        return judge(surface.center(), std::sqrt(surface.area()), key(texel));
    }

    /// Texels without contacts that hang together, side by side; marks them as done.
    std::vector<int> group_from(size_t start, std::vector<char>& is_done) const {
        std::vector<int> group;
        std::vector<size_t> cells{start};
        is_done[static_cast<size_t>(grid_[start])] = 1;
        for (size_t next = 0; next < cells.size(); ++next) {
            const int x = static_cast<int>(cells[next] % tile_size), y = static_cast<int>(cells[next] / tile_size);
            group.push_back(grid_[cells[next]]);
            for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
                if (x + dx < 0 || y + dy < 0 || x + dx >= tile_size || y + dy >= tile_size) continue;
                const auto cell = static_cast<size_t>((y + dy) * tile_size + x + dx);
                const int member = grid_[cell];
                if (member < 0 || texel_of(member).is_touched || is_done[static_cast<size_t>(member)]) continue;
                is_done[static_cast<size_t>(member)] = 1;
                cells.push_back(cell);
            }
        }
        return group;
    }

    /// One place says it, but that it is inside two more have to say too.
    void judge_group(const std::vector<int>& group) {
        const auto judge_place = [&](size_t i) { return judge(texel_of(group[i * group.size() / 4])); };
        const Enclosure middle = judge_place(2);
        const bool is_inside = middle == Enclosure::enclosed && judge_place(1) == middle && judge_place(3) == middle;
        for (const int member : group) {
            Texel& texel = texel_of(member);
            // Near a sheet and far from it may be in one group.
            const bool is_each_judged = middle != Enclosure::free && !is_inside;
            if (is_inside || (is_each_judged && judge(texel) == Enclosure::enclosed)) texel.free_pieces = 0;
            // Cards are small: which of their backs a monitor sees differs from one texel to the next.
            if (!texel.is_inside()) judge_back(texel);
        }
    }

    void judge_back(Texel& texel) const {
        if (!judging_.is_two_sided(texel)) return;
        const TexelSurface surface = surface_of(texel);
        texel.may_turn = judging_.may_turn(surface.center(), std::sqrt(surface.area()), key(texel));
    }

    void judge_touched(Texel& texel) {
        judging_.find_free_pieces(surface_of(texel), key(texel), texel, probes_);
        if (!texel.is_inside()) judge_back(texel);
    }

    const Judging& judging_;
    Texels& texels_;
    std::span<const uint32_t> members_;
    TileGrid grid_{};
    size_t probes_ = 0;
};

constexpr size_t grain = 8;  // blocks; a few milliseconds

/// Says of each texel of a page whether something touches it; returns how many are cut in parts.
size_t find_touched(const Scene& scene, const Atlas& atlas, const RayScene& rays, const Blocks& blocks, Texels& page) {
    std::vector<size_t> crossed(blocks.count(), 0);
    parallel_for(blocks.count(), grain, [&](size_t b) {
        std::vector<TexelSurface> surfaces;
        std::vector<Vec3> places;
        for (const uint32_t number : blocks[b]) {
            surfaces.emplace_back(scene, atlas, page, page.texels[number]);
            add_places(rays, surfaces.back(), places);
        }
        const std::vector<BoxedTriangle> around = triangles_around(rays, places);
        for (size_t i = 0; i < surfaces.size() && !around.empty(); ++i) {
            bool is_touched = false;
            const TexelSurface::CutResult cut = cut_where_hidden(rays, around, surfaces[i], is_touched);
            page.texels[blocks[b][i]].is_touched = is_touched;
            if (cut.is_cut) ++crossed[b];
        }
    });
    return std::accumulate(crossed.begin(), crossed.end(), size_t{0});
}

}  // namespace

ExposureCounts find_exposures(const Scene& scene, const Atlas& atlas, const RayScene& rays, std::span<Texels> pages) {
    ExposureCounts counts;
    std::vector<Blocks> blocks;
    for (Texels& page : pages) {
        blocks.push_back(find_blocks(page));
        counts.crossed += find_touched(scene, atlas, rays, blocks.back(), page);
        counts.touched += static_cast<size_t>(std::ranges::count(page.texels, true, &Texel::is_touched));
    }
    const bool has_two_sided =
        std::ranges::any_of(scene.surfaces, [](const Surface& surface) { return surface.is_two_sided; });
    if (counts.touched == 0 && !has_two_sided) return counts;
    const EnclosureJudge judge(scene, rays);
    if (!judge.is_reliable()) {
        counts.warnings.push_back(
            "monitors stand inside geometry by its normals: most rays from them meet back faces, so that texels inside "
            "other geometry cannot be told; if the room's faces point outwards, flip them");
        return counts;
    }
    Judging judging{scene, atlas, rays, judge, {}, 1};
    for (const Monitor& monitor : scene.monitors) judging.panels.push_back(panels_of(monitor, rays));
    for (size_t p = 0; p < pages.size(); ++p) {
        std::vector<size_t> probes(blocks[p].count(), 0);
        parallel_for(blocks[p].count(), grain,
                     [&](size_t b) { probes[b] = BlockJudge(judging, pages[p], blocks[p][b]).run(); });
        for (const size_t of_block : probes) counts.probes += of_block;
        for (const Texel& texel : pages[p].texels) {
            counts.inside += texel.is_inside() ? 1 : 0;
            counts.partly += !texel.is_inside() && texel.free_pieces != Texel::all_pieces ? 1 : 0;
            counts.turning += texel.may_turn ? 1 : 0;
        }
    }
    return counts;
}

void expose_parts(const Scene& scene, const Atlas& fine, const RayScene& rays, Texels& subtexels, int factor) {
    const auto is_partial = [](const Texel& t) { return t.free_pieces != Texel::all_pieces && !t.is_inside(); };
    if (std::ranges::none_of(subtexels.texels, is_partial)) return;
    const EnclosureJudge judge(scene, rays);
    const Judging judging{scene, fine, rays, judge, {}, factor};
    parallel_for(subtexels.texels.size(), 64, [&](size_t i) {
        Texel& texel = subtexels.texels[i];
        if (!is_partial(texel)) return;
        size_t probes = 0;
        judging.find_free_pieces(TexelSurface(scene, fine, subtexels, texel), key_of(subtexels, texel), texel, probes);
    });
}

}  // namespace surimi
