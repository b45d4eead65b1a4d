// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/monte_carlo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "baker/gather/sample_lanes.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr size_t first_round = 64;
// Of eight times as many samples in variance, beyond what independent ones gain: errors that fall as N^-3/4.
constexpr double least_gain = 0.354;  // 8^-1/2
constexpr size_t hopeless = 4096;     // samples without weight after which a texel counts as unlit

/// Sums over a contiguous part of the samples, which is a net of its own, as eight of them are (M52).
struct Part {
    double all = 0, blocked = 0;  // weights
};
constexpr size_t fewest_parts = 64, most_parts = 96, parts_of_run = 8;

/// The samples of one texel so far.
struct Samples {
    std::array<Part, most_parts> parts;
    size_t part_size = 1;
    size_t count = 0;
    size_t rays = 0;
    size_t free = 0;     // samples with weight that nothing blocks
    double squares = 0;  // of weights
};

/// Rays that wait until there are sixteen.
struct Waiting {
    RayPacket packet;
    std::array<float, RayPacket::capacity> weight;
    std::array<uint8_t, RayPacket::capacity> part;
};

void trace(const MonteCarloTask& task, Waiting& waiting, Samples& samples) {
    const uint32_t blocked = task.rays.occluded(waiting.packet, task.monitor);
    for (size_t i = 0; i < waiting.packet.size; ++i) {
        if ((blocked >> i) & 1u)
            samples.parts[waiting.part[i]].blocked += static_cast<double>(waiting.weight[i]);
        else
            ++samples.free;
    }
    samples.rays += waiting.packet.size;
    waiting.packet.size = 0;
}

/// Where the samples of the batch lie, on texel and monitor.
void place(const MonteCarloTask& task, const TexelSurface& surface, SampleLanes& lanes) {
    const Vec3 center = task.rays.center();
    const TexelSurface::Piece* piece = nullptr;
    Vec3 to_origin(0);  // the same all over a piece, and most texels have but one
    for (size_t i = 0; i < SampleLanes::count; ++i) {
        double u = lanes.numbers[2][i], v = lanes.numbers[3][i];
        const TexelSurface::Piece& chosen = surface.choose(u, v);
        const Vec3 position = chosen.position.at(u, v), normal = chosen.unit_normal(u, v);
        const Vec3& horizon = chosen.is_lifted ? normal : chosen.geometric_normal;
        if (piece != &chosen) {
            piece = &chosen;
            const Vec3 barycentric = chosen.barycentric.at(u, v);
            to_origin = task.rays.ray_origin({chosen.triangle, barycentric, position, normal, horizon}) - position;
        }
        const LightPoint light = task.sampler.sample(lanes.numbers[0][i], lanes.numbers[1][i]);
        SampleLanes::set(lanes.position, i, position - center);
        SampleLanes::set(lanes.normal, i, normal);
        SampleLanes::set(lanes.geometric_normal, i, horizon);
        SampleLanes::set(lanes.to_origin, i, to_origin);
        SampleLanes::set(lanes.target, i, light.position - center);
        SampleLanes::set(lanes.panel_normal, i, light.normal);
    }
}

/// Enters the first `count` of the batch's samples, and traces those that need it.
void enter(const MonteCarloTask& task, const SampleLanes& lanes, size_t count, Waiting& waiting, Samples& samples) {
    for (size_t i = 0; i < count; ++i) {
        const auto part = static_cast<uint8_t>(samples.count++ / samples.part_size);
        const float weight = lanes.weight[i];
        if (!(weight > 0)) continue;
        samples.squares += static_cast<double>(weight) * static_cast<double>(weight);
        samples.parts[part].all += static_cast<double>(weight);
        if (lanes.end[i] == SampleLanes::open) {
            ++samples.free;
            continue;
        }
        if (!(lanes.end[i] > 0)) {
            samples.parts[part].blocked += static_cast<double>(weight);
            continue;
        }
        RayPacket& packet = waiting.packet;
        waiting.weight[packet.size] = weight;
        waiting.part[packet.size] = part;
        packet.origin_x[packet.size] = lanes.origin[0][i];
        packet.origin_y[packet.size] = lanes.origin[1][i];
        packet.origin_z[packet.size] = lanes.origin[2][i];
        packet.direction_x[packet.size] = lanes.direction[0][i];
        packet.direction_y[packet.size] = lanes.direction[1][i];
        packet.direction_z[packet.size] = lanes.direction[2][i];
        packet.end[packet.size] = lanes.end[i];
        if (++packet.size == RayPacket::capacity) trace(task, waiting, samples);
    }
}

void extend(const MonteCarloTask& task, const TexelSurface& surface, const Scrambling& seeds, size_t total,
            Samples& samples) {
    Waiting waiting;
    SampleLanes lanes;
    for (size_t first = samples.count; first < total; first += SampleLanes::count) {
        const size_t some = std::min(SampleLanes::count, total - first);
        const auto digits = [&](size_t dimension) { return task.points.digits[dimension].data() + first; };
        scramble({digits(0), digits(1), digits(2), digits(3)}, seeds, lanes);
        place(task, surface, lanes);
        weigh(task.clearance, task.sampler.is_two_sided(), lanes);
        enter(task, lanes, some, waiting, samples);
    }
    if (waiting.packet.size > 0) trace(task, waiting, samples);
}

/// Twice as many samples a part: two parts each become one.
void merge_parts(Samples& samples) {
    samples.part_size *= 2;
    for (size_t i = 0; i < most_parts; ++i) {
        const size_t j = 2 * i;
        samples.parts[i] = j < most_parts ? Part{samples.parts[j].all + samples.parts[j + 1].all,
                                                 samples.parts[j].blocked + samples.parts[j + 1].blocked}
                                          : Part{};
    }
}

/// Variance of the sum of `blocked`, in proportion to `share` of `all`, if runs of `length` parts were independent.
double variance_of_runs(const Samples& samples, double share, size_t length) {
    const size_t parts = (samples.count + samples.part_size - 1) / samples.part_size;
    double squares = 0;
    for (size_t i = 0; i < parts; i += length) {
        double deviation = 0;
        for (size_t k = i; k < std::min(i + length, parts); ++k)
            deviation += samples.parts[k].blocked - samples.parts[k].all * share;
        squares += deviation * deviation;
    }
    const double runs = std::max(2.0, static_cast<double>(parts) / static_cast<double>(length));
    return squares * runs / (runs - 1);
}

MonteCarloEstimate estimate(const Samples& samples) {
    MonteCarloEstimate result;
    result.rays = samples.rays;
    double all = 0, blocked = 0;
    for (const Part& part : samples.parts) all += part.all, blocked += part.blocked;
    if (!(all > 0)) return result;
    result.is_lit = true;
    const double share = samples.free == 0 ? 1 : std::min(1.0, blocked / all);
    result.visibility = 1 - share;
    // Nets eight times as large have a smaller variance than independent samples would have. The next step of eight
    // gains as much again; half of that (of its logarithm) is believed, since eight nets say little.
    const double fine = variance_of_runs(samples, share, 1), coarse = variance_of_runs(samples, share, parts_of_run);
    const double gain = fine > 0 ? std::sqrt(std::clamp(coarse / fine, least_gain, 1.0)) : 1;
    // What no sample has met may be there, about as much as a sample stands for where most light comes from.
    const double unseen = samples.squares / all;
    result.error = std::min(1.0, std::sqrt(coarse * gain + unseen * unseen) / all);
    return result;
}

}  // namespace

SamplePoints::SamplePoints() {
    for (auto& row : digits) row.resize(capacity);
    for (uint32_t i = 0; i < capacity; ++i) {
        const auto point = sobol::point(i);
        for (size_t d = 0; d < 4; ++d) digits[d][i] = sobol::reverse_bits(point[d]);
    }
}

MonteCarloEstimate monte_carlo(const MonteCarloTask& task, const TexelSurface& surface) {
    const Scrambling seeds = scrambling(task.key);
    const auto bounded = [](int count) {
        return std::clamp<size_t>(static_cast<size_t>(std::max(count, 1)), 1, SamplePoints::capacity);
    };
    const size_t most = bounded(task.samples > 0 ? task.samples : task.most_samples);
    Samples samples;
    if (task.samples > 0) {
        while (samples.part_size * fewest_parts < most) samples.part_size *= 2;
        extend(task, surface, seeds, most, samples);
        return estimate(samples);
    }
    // 64, 96, 128, 192 and so on: half as much again, and then to the next power of two.
    for (size_t count = std::min(first_round, most);;) {
        extend(task, surface, seeds, count, samples);
        const MonteCarloEstimate result = estimate(samples);
        const bool is_hopeless = !result.is_lit && count >= hopeless;
        const bool is_full = samples.part_size * most_parts <= count;
        count = samples.part_size * (is_full ? 2 * fewest_parts : most_parts);
        if (result.error <= task.error || count > most || is_hopeless) return result;
        if (is_full) merge_parts(samples);
    }
}

}  // namespace surimi
