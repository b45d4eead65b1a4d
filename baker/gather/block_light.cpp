// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/block_light.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "baker/gather/contacts.h"
#include "baker/gather/exposure.h"
#include "baker/gather/texel_light.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

/// Seconds since the last question.
class Clock {
  public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Does some of it lie behind a panel's plane, or so close before it that nothing counts as an occluder, and some not?
bool meets_clearance(const MonitorSetup& setup, const TexelSurface& surface) {
    return std::ranges::any_of(setup.panels, [&](const Panel& panel) {
        double lowest = INFINITY, highest = -INFINITY;
        surface.for_each_corner([&](const SurfacePoint& corner) {
            const double height = panel.height(corner.position - setup.rays.center());
            lowest = std::min(lowest, height), highest = std::max(highest, height);
        });
        return lowest <= panel.clearance && highest > panel.clearance;
    });
}

class BlockLighter {
  public:
    BlockLighter(const MonitorSetup& setup, const BlockSurfaces& block, std::span<const double> footprints,
                 BlockWorkspace& work, GatherStatistics& statistics)
        : setup_(setup), block_(block), footprints_(footprints), work_(work), statistics_(statistics) {}

    void run(std::span<LitTexel> texels) {
        texels_ = texels;
        rays_of_query_ = look_from(work_.sight, setup_, block_.corners, block_.texel_size);
        statistics_.query_seconds += clock_.lap();
        if (work_.sight.count == 0) return write_unlit();
        if (footprints_.empty()) count_block();
        if (only_rays()) return light_by_rays();
        light_centers();
        refine_texels();
    }

  private:
    /// Cutouts are nothing to silhouettes, and where there are very many of those, looking at them costs more than
    /// rays.
    bool only_rays() const {
        if (work_.sight.is_hidden()) return false;
        if (work_.sight.has_cutouts || setup_.settings.method == Method::monte_carlo) return true;
        return are_rays_cheaper(work_.sight.candidates(), setup_.settings);
    }

    void count_block() {
        ++statistics_.blocks;
        if (work_.sight.is_hidden())
            ++statistics_.shadowed_blocks;
        else if (work_.sight.candidates() == 0)
            ++statistics_.open_blocks;
        statistics_.candidates += work_.sight.candidates();
    }

    uint64_t key(size_t i) const {
        return hash(hash(setup_.settings.seed, static_cast<uint64_t>(setup_.light().channel)), block_.keys[i]);
    }

    void write(size_t i, const TexelLight& texel) {
        const PointLight& light = texel.light;
        const bool is_lit = light.unshadowed > 0;
        const TexelMethod method = is_lit ? light.method : TexelMethod::none;
        texels_[i].estimate = {static_cast<float>(light.unshadowed), static_cast<float>(light.shadowed),
                               static_cast<float>(is_lit ? light.error : 0), method};
        texels_[i].is_by_center = texel.is_by_center;
        GatherStatistics::OfMethod& of = statistics_.methods[static_cast<size_t>(method)];
        of.points += texel.points;
        of.rays += light.rays + (i == 0 ? rays_of_query_ : 0);
        of.seconds += clock_.lap();
        statistics_.segments += light.segments;
        if (texel.points > 1) ++statistics_.refined_texels;
        if (light.has_failed) ++statistics_.failed_checks;
    }

    void write_unlit() {
        for (size_t i = 0; i < texels_.size(); ++i) write(i, {});
    }

    void light_by_rays() {
        const double error = setup_.limits.all_by_rays;
        for (size_t i = 0; i < texels_.size(); ++i) {
            const double unshadowed = unshadowed_at(setup_.panels, setup_.rays, block_.centers[i]);
            if (unshadowed > 0)
                write(i, by_rays(setup_, block_.texels[i], unshadowed, error, key(i)));
            else
                write(i, has_lit_corner(setup_.panels, setup_.rays, block_.texels[i]) ? average_by_rays(i, error)
                                                                                      : TexelLight{});
        }
    }

    /// Of a texel whose centre is not lit: E (M1) on average over its middles of cells.
    double average_unshadowed(size_t i) const {
        constexpr int side = 4;
        double sum = 0;
        for (int k = 0; k < side * side; ++k)
            sum += unshadowed_at(setup_.panels, setup_.rays,
                                 block_.texels[i].sample((k % side + 0.5) / side, (k / side + 0.5) / side));
        return sum / (side * side);
    }

    TexelLight average_by_rays(size_t i, double error) const {
        const double unshadowed = average_unshadowed(i);
        return unshadowed > 0 ? by_rays(setup_, block_.texels[i], unshadowed, error, key(i)) : TexelLight{};
    }

    TexelLight hidden(size_t i) const {
        TexelLight texel{work_.centers[i], 1};
        if (!(texel.light.unshadowed > 0)) texel.light.unshadowed = average_unshadowed(i);
        texel.light.method = TexelMethod::certificate;
        return texel;
    }

    void light_centers() {
        work_.centers.clear();
        work_.visibilities.clear();
        for (size_t i = 0; i < texels_.size(); ++i) {
            work_.centers.push_back(light_at(setup_, work_.sight, block_.centers[i], {key(i)}, work_.point));
            const PointLight& light = work_.centers.back();
            // What is not known makes the differences with it unknown.
            const bool is_known = light.unshadowed > 0 && light.is_usable();
            work_.visibilities.push_back(is_known ? light.visibility() : INFINITY);
        }
    }

    void refine_texels() {
        if (!work_.sight.is_hidden()) around_ = triangles_around(setup_.rays, block_.corners);
        const double half = clock_.lap() / static_cast<double>(texels_.size());
        for (size_t y = 0; y < tile_size; ++y)
            for (size_t x = 0; x < tile_size; ++x) {
                const int member = block_.grid[y * tile_size + x];
                if (member < 0) continue;
                const auto i = static_cast<size_t>(member);
                const int px = static_cast<int>(x), py = static_cast<int>(y);
                const double error = footprints_.empty()
                                         ? footprint_error(second_differences(block_.grid, work_.visibilities, px, py),
                                                           diagonal_difference(block_.grid, work_.visibilities, px, py))
                                         : footprints_[i];
                write(i, finish(i, error));
                statistics_.methods[static_cast<size_t>(texels_[i].estimate.method)].seconds += half;
            }
    }

    TexelLight finish(size_t i, double error) {
        const PointLight& center = work_.centers[i];
        if (work_.sight.is_hidden())
            return center.unshadowed > 0 || has_lit_corner(setup_.panels, setup_.rays, block_.texels[i])
                       ? hidden(i)
                       : TexelLight{center, 1};
        const bool is_center_lit = center.unshadowed > 0;
        if (!is_center_lit && !has_lit_corner(setup_.panels, setup_.rays, block_.texels[i])) return {center, 1};
        TexelSurface surface = block_.texels[i];
        const auto cut = cut_at_contacts(setup_.rays, around_, surface);
        const bool is_cut = cut.is_cut || block_.is_partial[i];
        const bool may_trace = setup_.settings.method == Method::automatic;
        const auto refine = [&] {
            const bool is_unlike_center = is_cut || block_.is_curved[i] || center.has_near || std::isinf(error);
            const bool has_rim = block_.is_border[i] || center.has_near || is_cut;
            const Beginning from{center, error, has_rim, is_unlike_center, is_cut};
            return refined(setup_, work_.sight, surface, from, key(i), work_.point);
        };
        if (!is_center_lit)
            return may_trace && !meets_clearance(setup_, surface) ? average_by_rays(i, setup_.limits.monte_carlo)
                                                                  : refine();
        if (may_trace && (!cut.is_whole || center.is_self_hidden))
            return by_rays(setup_, surface, center.unshadowed, setup_.limits.monte_carlo, key(i));
        if (!center.is_usable() || block_.is_curved[i] || is_cut || center.has_near || center.is_self_hidden ||
            block_.is_border[i])
            return refine();
        if (error > setup_.limits.footprint) return refine();
        TexelLight texel{center, 1};
        texel.light.error = std::hypot(center.error, error);
        texel.is_by_center = true;
        return texel;
    }

    const MonitorSetup& setup_;
    const BlockSurfaces& block_;
    std::span<const double> footprints_;
    BlockWorkspace& work_;
    std::span<LitTexel> texels_;
    GatherStatistics& statistics_;
    std::vector<BoxedTriangle> around_;  // those that may stand on texels
    size_t rays_of_query_ = 0;
    Clock clock_;
};

}  // namespace

void light_block(const MonitorSetup& setup, const BlockSurfaces& block, std::span<const double> footprints,
                 BlockWorkspace& work, std::span<LitTexel> texels, GatherStatistics& statistics) {
    BlockLighter(setup, block, footprints, work, statistics).run(texels);
}

}  // namespace surimi
