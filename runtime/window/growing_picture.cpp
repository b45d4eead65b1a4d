// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/growing_picture.h"

#include <algorithm>
#include <numeric>

#include "runtime/base/bilinear.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

/// Pixels along a side of a work item: a tile of the usual size, or a smaller one where rays are traced for light. An
/// item must take no more than some hundredths of a second, since a new wish waits for it.
int item_size(const Lighting& lighting) {
    const bool is_traced = lighting.settings.model == ShadingModel::reference ||
                           lighting.settings.visibility == VisibilitySource::stochastic;
    if (!is_traced) return tile_size;
    constexpr double rays_of_item = 20000;
    const double rays_of_pixel =
        2.0 * lighting.settings.samples * static_cast<double>(std::max<size_t>(1, lighting.scene.monitors.size()));
    int size = tile_size;
    while (size > 1 && rays_of_pixel * size * size > rays_of_item) size /= 2;
    return size;
}

/// Tiles from the middle of the picture outwards.
std::vector<size_t> from_the_middle(const std::vector<Tile>& tiles, int width, int height) {
    std::vector<size_t> order(tiles.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto distance = [&](size_t t) {  // squared, in half pixels
        const int64_t x = 2 * tiles[t].x0 + tiles[t].width - width, y = 2 * tiles[t].y0 + tiles[t].height - height;
        return x * x + y * y;
    };
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return distance(a) < distance(b); });
    return order;
}

int blocks_along(int pixels, int block) {
    return (pixels + block - 1) / block;
}

}  // namespace

GrowingPicture::GrowingPicture(const Lighting& lighting, const View& view, const RenderSettings& settings,
                               int first_block)
    : shot_{lighting, view, settings.show, Vec2(settings.width, settings.height)},
      settings_(settings),
      passes_(settings.samples_per_side * settings.samples_per_side),
      block_(std::max(1, first_block)),
      pixels_(settings.width, settings.height, Vec3f(0)) {
    if (pixels_.empty()) pass_ = passes_;
    begin_stage();
}

void GrowingPicture::begin_stage() {
    const int width = blocks_along(settings_.width, block_), height = blocks_along(settings_.height, block_);
    if (block_ > 1) coarse_ = Film(width, height);
    if (block_ == 1 && pass_ == 0) film_ = Film(width, height);
    tiles_ = tiles_of(width, height, item_size(shot_.lighting));
    pending_ = from_the_middle(tiles_, width, height);
    const size_t monitors = shot_.lighting.scene.monitors.size();
    counts_.resize(std::max(counts_.size(), tiles_.size() * monitors));
}

std::vector<Tile> GrowingPicture::advance(size_t samples, const std::function<bool()>& is_cancelled) {
    if (is_done()) return {};
    const bool is_coarse = block_ > 1;
    const Pass pass =
        is_coarse ? Pass{Vec2(0.5), hash(settings_.seed, ~static_cast<uint64_t>(block_))} : pass_of(settings_, pass_);
    Shot shot = shot_;
    shot.pixels /= static_cast<double>(block_);
    Film& film = is_coarse ? coarse_ : film_;
    const auto item = static_cast<size_t>(item_size(shot.lighting));
    const size_t wanted = std::max<size_t>(samples / (item * item), static_cast<size_t>(thread_count()));
    const size_t monitors = shot.lighting.scene.monitors.size(), items = std::min(wanted, pending_.size());
    std::vector<uint8_t> is_finished(items);
    parallel_for(items, 1, [&](size_t i) {
        if (is_cancelled && is_cancelled()) return;
        const size_t t = pending_[i];
        add_tile(shot, pass, tiles_[t], film, std::span(counts_).subspan(t * monitors, monitors));
        is_finished[i] = 1;
        if (is_coarse) return;
        for (int y = tiles_[t].y0; y < tiles_[t].y0 + tiles_[t].height; ++y)
            for (int x = tiles_[t].x0; x < tiles_[t].x0 + tiles_[t].width; ++x)
                pixels_.at(x, y) = Vec3f(film.sum.at(x, y) / static_cast<double>(pass_ + 1));
    });
    std::vector<Tile> fresh;
    std::vector<size_t> left;
    for (size_t i = 0; i < items; ++i) {
        const Tile& tile = tiles_[pending_[i]];
        if (!is_finished[i]) {
            left.push_back(pending_[i]);
            continue;
        }
        samples_ += static_cast<size_t>(tile.width) * static_cast<size_t>(tile.height);
        if (!is_coarse) fresh.push_back(tile);
    }
    left.insert(left.end(), pending_.begin() + static_cast<ptrdiff_t>(items), pending_.end());
    pending_ = std::move(left);
    if (pending_.empty()) {
        if (is_coarse) fresh = tiles_of(settings_.width, settings_.height);
        end_stage();
    }
    return fresh;
}

void GrowingPicture::end_stage() {
    has_first_sight_ = true;
    if (block_ == 1) {
        bright_level_ = develop(film_, ++pass_).bright_level;
    } else {
        const Picture coarse = develop(coarse_, 1);
        bright_level_ = coarse.bright_level;
        const Image<Vec3f>& small = coarse.pixels;
        parallel_for(pixels_.pixels.size(), 4096, [&](size_t i) {
            const auto width = static_cast<size_t>(settings_.width);
            // The coarse picture may reach beyond the right and lower border, by less than a block.
            const Vec2 at(static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5);
            pixels_.pixels[i] =
                Vec3f(look_up_bilinear(small, at / (static_cast<double>(block_) * Vec2(small.width, small.height))));
        });
        // Not through all powers of two: the coarse pictures would take a third of the first pass.
        block_ = block_ >= 16 ? block_ / 4 : 1;
    }
    if (!is_done()) begin_stage();
}

MonitorCounts GrowingPicture::counts() const {
    MonitorCounts sum;
    for (const MonitorCounts& c : counts_) sum += c;
    return sum;
}

}  // namespace surimi
