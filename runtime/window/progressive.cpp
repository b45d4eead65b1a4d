// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/progressive.h"

#include <algorithm>
#include <array>
#include <chrono>

#include "runtime/preview/display.h"
#include "runtime/preview/see.h"

namespace surimi {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr double first_seconds = 0.05;    // for the first picture of a wish: twenty of them a second while a hand moves
constexpr double between_seconds = 0.04;  // from one frame to the next while a picture grows
constexpr int unknown_block = 16;         // before anything is known about the time that a sample takes
constexpr std::array<int, 5> blocks = {1, 2, 4, 8, 16};

/// Do two wishes make the same samples?
bool is_same_picture(Wish a, const Wish& b) {
    a.exposure = b.exposure;
    a.metering = b.metering;
    return a == b;
}

bool is_same_but_size(const Wish& a, Wish b) {
    b.picture.width = a.picture.width;
    b.picture.height = a.picture.height;
    return is_same_picture(a, b);
}

/// Does a sample of both take about the same time?
bool is_same_cost(const Wish& a, const Wish& b) {
    return a.lighting == b.lighting && a.picture.show == b.picture.show;
}

size_t light_samples_of(const Lighting& lighting, const MonitorCounts& counts) {
    const auto each = static_cast<size_t>(2 * lighting.settings.samples);  // as many by the light as by the BRDF
    if (lighting.settings.model == ShadingModel::reference) return each * counts.points;
    if (lighting.settings.visibility != VisibilitySource::stochastic) return 0;
    return each * (counts.points - counts.unseen - counts.dark);
}

}  // namespace

/// What only the renderer's thread touches.
struct ProgressiveRenderer::Work {
    Wish wish;
    size_t number = 0;
    std::unique_ptr<GrowingPicture> picture;
    Image<glm::u8vec3> codes;
    RenderStatus status;
    Clock::time_point wished, pass_began;
    double seconds_per_sample = 0;  // wall time, all threads; 0: not known
    double automatic = 1;           // exposure
    bool is_metered = false;        // it is known
    size_t metered_wish = 0;        // the one that it is measured on

    /// The finest first picture that comes in time.
    int first_block() const {
        if (!(seconds_per_sample > 0)) return unknown_block;
        const double pixels = static_cast<double>(wish.picture.width) * wish.picture.height;
        for (const int block : blocks)
            if (seconds_per_sample * pixels / (block * block) <= first_seconds) return block;
        return blocks.back();
    }

    void begin(const Wish& next, size_t next_number, Lighting& lighting) {
        const bool is_new = number == 0 || !is_same_picture(next, wish);
        if (!is_same_cost(next, wish)) seconds_per_sample = 0;
        if (next.metering != wish.metering) is_metered = false;
        // Once measured it stays, whatever changes: else lights that are switched off would not make it dark. But it is
        // measured better and better while the picture stays, in whatever size.
        if (!is_metered || (metered_wish == number && is_same_but_size(next, wish))) metered_wish = next_number;
        wish = next;
        number = next_number;
        wished = Clock::now();
        if (is_new) {
            lighting.settings = wish.lighting;
            for (size_t m = 0; m < wish.radiance.size(); ++m) set_radiance(lighting, m, wish.radiance[m]);
            picture = std::make_unique<GrowingPicture>(lighting, wish.view, wish.picture, first_block());
            codes = Image<glm::u8vec3>(wish.picture.width, wish.picture.height, glm::u8vec3(0));
            status = RenderStatus{};
            status.exposure = wish.exposure ? std::exp2(*wish.exposure) : automatic;
            pass_began = Clock::now();
        }
        if (!is_new) expose();
    }

    /// All of the picture for the screen, with the exposure that is wanted now.
    void expose() {
        if (is_lit_view(wish.picture.show) && metered_wish == number && picture->bright_level() > 0) {
            Picture measured;
            measured.bright_level = picture->bright_level();
            automatic = automatic_exposure(measured);
            is_metered = true;
        }
        status.exposure = wish.exposure ? std::exp2(*wish.exposure) : automatic;
        encode(tiles_of(wish.picture.width, wish.picture.height));
    }

    void encode(const std::vector<Tile>& tiles) {
        const Image<Vec3f>& pixels = picture->pixels();
        parallel_for(tiles.size(), 1, [&](size_t t) {
            for (int y = tiles[t].y0; y < tiles[t].y0 + tiles[t].height; ++y)
                for (int x = tiles[t].x0; x < tiles[t].x0 + tiles[t].width; ++x)
                    codes.at(x, y) = codes_of(pixels.at(x, y), wish.picture.show, status.exposure);
        });
    }

    /// Goes on for about the time between two frames.
    void advance(const std::function<bool()>& is_cancelled) {
        const int passes = picture->passes(), block = picture->block();
        const bool is_first = picture->is_first_sight();
        const Clock::time_point start = Clock::now();
        const size_t before = picture->samples();
        const double in_time = seconds_per_sample > 0 ? between_seconds / seconds_per_sample : 0;
        const std::vector<Tile> fresh =
            picture->advance(is_first ? SIZE_MAX : static_cast<size_t>(std::min(in_time, 1e9)), is_cancelled);
        if (const size_t samples = picture->samples() - before; samples > 0) {
            const double measured = seconds_since(start) / static_cast<double>(samples);
            seconds_per_sample = seconds_per_sample > 0 ? 0.5 * (seconds_per_sample + measured) : measured;
        }
        if (is_first) status.first_seconds = seconds_since(wished);
        if (picture->passes() > passes) status.seconds_per_pass = seconds_since(pass_began);
        const bool is_new_stage = picture->passes() > passes || picture->block() != block;
        if (is_new_stage) pass_began = Clock::now();
        if (is_new_stage && metered_wish == number)
            expose();
        else
            encode(fresh);
    }

    RenderStatus state(const Lighting& lighting) const {
        RenderStatus result = status;
        result.wish = number;
        result.is_done = picture->is_done();
        result.block = picture->block();
        result.passes = picture->passes();
        result.passes_wanted = picture->passes_wanted();
        result.camera_rays = picture->samples();
        result.light_samples = light_samples_of(lighting, picture->counts());
        return result;
    }
};

ProgressiveRenderer::ProgressiveRenderer(Lighting lighting, std::function<void()> on_news)
    : lighting_(std::move(lighting)), on_news_(std::move(on_news)), thread_([this] { run(); }) {}

ProgressiveRenderer::~ProgressiveRenderer() {
    {
        const std::lock_guard lock(mutex_);
        stops_ = true;
    }
    has_changed_.notify_one();
    thread_.join();
}

size_t ProgressiveRenderer::show(const Wish& wish) {
    const std::lock_guard lock(mutex_);
    if (number_ > 0 && wish == wish_) return number_;
    wish_ = wish;
    has_changed_.notify_one();
    return ++number_;
}

bool ProgressiveRenderer::take(Frame& frame) {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    if (!has_news_) return false;
    std::swap(frame, ready_);
    has_news_ = false;
    return true;
}

void ProgressiveRenderer::run() try {
    Work work;
    for (;;) {
        {
            std::unique_lock lock(mutex_);
            has_changed_.wait(
                lock, [&] { return stops_ || number_ != work.number || (work.picture && !work.picture->is_done()); });
            if (stops_) return;
            if (number_ != work.number) {
                const Wish next = wish_;
                const size_t number = number_;
                lock.unlock();
                work.begin(next, number, lighting_);
            }
        }
        const bool is_first = work.picture->is_first_sight();
        work.advance([&] { return stops_ || (!is_first && number_ != work.number); });
        if (!stops_) publish(work);
    }
} catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    if (on_news_) on_news_();
}

void ProgressiveRenderer::publish(const Work& work) {
    const RenderStatus status = work.state(lighting_);
    {
        const std::lock_guard lock(mutex_);
        ready_.pixels = work.picture->pixels();
        ready_.codes = work.codes;
        ready_.show = work.wish.picture.show;
        ready_.status = status;
        has_news_ = true;
    }
    if (on_news_) on_news_();
}

}  // namespace surimi
