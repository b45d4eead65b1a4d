// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/monte_carlo.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "baker/gather/sample_lanes.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr size_t first_round = 64;
constexpr size_t hopeless = 4096;  // samples without weight after which a texel counts as unlit

/// Digits of coordinates in the order in which the two points of a pair should agree.
using DigitOrder = std::span<const size_t>;

/// Which index, XORed to that of a point, gives the other point of its cell, among the first 2^m points: the one that
/// shares the longest run of digits, taken in turns from the dimensions of `order`. All points have the same, because
/// digits are linear in the bits of the index.
uint32_t partner_of(uint32_t m, DigitOrder order) {
    // Rows of the system "this digit does not change", in echelon form: pivot[b] has b as its highest bit.
    std::array<uint32_t, 32> pivot{};
    uint32_t rank = 0;
    for (uint32_t turn = 0; rank + 1 < m; ++turn) {
        const size_t dimension = order[turn % order.size()];
        const uint32_t digit = turn / static_cast<uint32_t>(order.size());
        uint32_t row = 0;  // bit b: does bit b of the index flip the digit?
        for (uint32_t b = 0; b < m; ++b) row |= ((sobol::point(1u << b)[dimension] >> (31 - digit)) & 1u) << b;
        while (row != 0 && pivot[static_cast<size_t>(std::bit_width(row)) - 1] != 0)
            row ^= pivot[static_cast<size_t>(std::bit_width(row)) - 1];
        if (row == 0) continue;
        pivot[static_cast<size_t>(std::bit_width(row)) - 1] = row;
        ++rank;
    }
    // One bit is free; the others follow from it, lowest first.
    uint32_t partner = 0;
    for (uint32_t b = 0; b < m; ++b) {
        const uint32_t below = pivot[b] & ((1u << b) - 1);
        const bool is_set = pivot[b] == 0 || std::popcount(below & partner) % 2 == 1;
        partner |= (is_set ? 1u : 0u) << b;
    }
    return partner;
}

/// The samples of one texel so far. On the stack: a texel costs no allocation.
struct Samples {
    /// The weight of each (M6), negative where the light is blocked.
    std::array<float, SamplePoints::capacity> signed_weights;
    size_t count = 0;
    size_t rays = 0;
    double all = 0, seen = 0;  // sums of weights
    float largest = 0;

    double visibility() const { return all > 0 ? seen / all : 0; }
};

/// Rays that wait until there are sixteen.
struct Waiting {
    RayPacket packet;
    std::array<size_t, RayPacket::capacity> sample;
};

void trace(const MonteCarloTask& task, Waiting& waiting, Samples& samples) {
    const uint32_t blocked = task.rays.occluded(waiting.packet, task.monitor);
    for (size_t i = 0; i < waiting.packet.size; ++i)
        if (!((blocked >> i) & 1u)) samples.signed_weights[waiting.sample[i]] *= -1;
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
        if (piece != &chosen) {
            piece = &chosen;
            const Vec3 barycentric = chosen.barycentric.at(u, v);
            to_origin =
                task.rays.ray_origin({chosen.triangle, barycentric, position, normal, chosen.geometric_normal}) -
                position;
        }
        const LightPoint light = task.sampler.sample(lanes.numbers[0][i], lanes.numbers[1][i]);
        SampleLanes::set(lanes.position, i, position - center);
        SampleLanes::set(lanes.normal, i, normal);
        SampleLanes::set(lanes.geometric_normal, i, piece->geometric_normal);
        SampleLanes::set(lanes.to_origin, i, to_origin);
        SampleLanes::set(lanes.target, i, light.position - center);
        SampleLanes::set(lanes.panel_normal, i, light.normal);
    }
}

/// Enters the first `count` of the batch's samples, and traces those that need it.
void enter(const MonteCarloTask& task, const SampleLanes& lanes, size_t count, Waiting& waiting, Samples& samples) {
    for (size_t i = 0; i < count; ++i) {
        const size_t index = samples.count++;
        const bool needs_ray = lanes.weight[i] > 0 && lanes.end[i] > 0;
        samples.signed_weights[index] = lanes.end[i] == SampleLanes::open ? lanes.weight[i] : -lanes.weight[i];
        if (!needs_ray) continue;
        RayPacket& packet = waiting.packet;
        waiting.sample[packet.size] = index;
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

void extend(const MonteCarloTask& task, const TexelSurface& surface, const Scrambling& seeds, size_t count,
            Samples& samples) {
    Waiting waiting;
    SampleLanes lanes;
    const size_t before = samples.count;
    for (size_t first = before; first < count; first += SampleLanes::count) {
        const size_t some = std::min(SampleLanes::count, count - first);
        const auto digits = [&](size_t dimension) { return task.points.digits[dimension].data() + first; };
        scramble({digits(0), digits(1), digits(2), digits(3)}, seeds, lanes);
        place(task, surface, lanes);
        weigh(task.clearance, task.sampler.is_two_sided(), lanes);
        enter(task, lanes, some, waiting, samples);
    }
    if (waiting.packet.size > 0) trace(task, waiting, samples);
    for (size_t i = before; i < count; ++i) {
        const float weight = samples.signed_weights[i];
        samples.all += std::abs(weight);
        samples.seen += std::max(weight, 0.f);
        samples.largest = std::max(samples.largest, std::abs(weight));
    }
}

/// Deviations of the samples from the ratio: w (v - V).
using Deviations = std::array<float, SamplePoints::capacity>;

void find_deviations(const Samples& samples, Deviations& deviations) {
    const auto visibility = static_cast<float>(samples.visibility());
    for (size_t i = 0; i < samples.count; ++i) {
        const float weight = samples.signed_weights[i];
        deviations[i] = std::max(weight, 0.f) - std::abs(weight) * visibility;
    }
}

double sum_of_squares(std::span<const float> deviations) {
    double sum = 0;
    for (const float z : deviations) sum += static_cast<double>(z) * static_cast<double>(z);
    return sum;
}

/// Sum of the squared differences between the samples of a cell.
double paired_differences(std::span<const float> deviations, uint32_t partner) {
    const size_t half = std::bit_floor(size_t{partner});  // the first of a pair has this bit clear
    // A sample's number has the bits of its place in its net, since nets start at multiples of their size.
    const auto squared_difference = [&](size_t i) {
        const auto difference = static_cast<double>(deviations[i] - deviations[i ^ partner]);
        return difference * difference;
    };
    double even = 0, odd = 0;  // two chains of additions, so that they overlap
    for (size_t first = 0; first < deviations.size(); first += 2 * half) {
        for (size_t i = 0; i + 1 < half; i += 2) {
            even += squared_difference(first + i);
            odd += squared_difference(first + i + 1);
        }
        if (half == 1) even += squared_difference(first);
    }
    return even + odd;
}

/// Variance of the sum of all deviations: the smallest of what independent samples would have (M7) and what each way to
/// cut space into cells says (M52).
double variance_of_sum(const SamplePoints& points, const Samples& samples) {
    if (!(samples.seen > 0) || !(samples.seen < samples.all)) return 0;
    Deviations all;
    find_deviations(samples, all);
    const auto deviations = std::span<const float>(all).first(samples.count);
    double variance = sum_of_squares(deviations);
    // A count that is no power of two is a row of smaller nets.
    const size_t net = samples.count & (~samples.count + 1);
    if (net == 1) return variance;
    for (const uint32_t partner : points.partner[static_cast<size_t>(std::countr_zero(net))])
        variance = std::min(variance, paired_differences(deviations, partner));
    return variance;
}

/// Standard error of the ratio (M52).
double standard_error(const SamplePoints& points, const Samples& samples) {
    if (!(samples.all > 0)) return 1;
    // What no sample has met may be there, about as large as one sample stands for.
    const double unseen = samples.largest;
    return std::min(1.0, std::sqrt(variance_of_sum(points, samples) + unseen * unseen) / samples.all);
}

}  // namespace

SamplePoints::SamplePoints() {
    for (auto& row : digits) row.resize(capacity);
    for (uint32_t i = 0; i < capacity; ++i) {
        const auto point = sobol::point(i);
        for (size_t d = 0; d < 4; ++d) digits[d][i] = sobol::reverse_bits(point[d]);
    }
    constexpr std::array<size_t, 4> all{0, 1, 2, 3};
    const std::span<const size_t> order(all);
    for (uint32_t m = 1; m < partner.size(); ++m)
        partner[m] = {partner_of(m, order.first(2)), partner_of(m, order), partner_of(m, order.first(1)),
                      partner_of(m, order.subspan(1, 1)), partner_of(m, order.last(2))};
}

namespace {

/// Exactly so many samples of one sequence.
MonteCarloEstimate fixed(const MonteCarloTask& task, const TexelSurface& surface) {
    Samples samples;
    const auto count = std::clamp<size_t>(static_cast<size_t>(task.samples), 1, SamplePoints::capacity);
    extend(task, surface, scrambling(task.key), count, samples);
    return {samples.visibility(), standard_error(task.points, samples), samples.rays, samples.all > 0};
}

}  // namespace

MonteCarloEstimate monte_carlo(const MonteCarloTask& task, const TexelSurface& surface) {
    if (task.samples > 0) return fixed(task, surface);
    constexpr size_t replicates = 8;
    constexpr size_t most_of_one = SamplePoints::capacity / replicates;
    static thread_local std::array<Samples, replicates> all;  // half a megabyte each
    for (Samples& samples : all) samples.count = samples.rays = 0, samples.all = samples.seen = 0, samples.largest = 0;
    MonteCarloEstimate result;
    for (size_t count = first_round / replicates;; count *= 2) {
        double weight = 0, seen = 0, largest = 0;
        result.rays = 0;
        for (size_t r = 0; r < replicates; ++r) {
            extend(task, surface, scrambling(hash(task.key, r)), count, all[r]);
            weight += all[r].all;
            seen += all[r].seen;
            largest = std::max(largest, static_cast<double>(all[r].largest));
            result.rays += all[r].rays;
        }
        result.is_lit = weight > 0;
        result.visibility = weight > 0 ? seen / weight : 0;
        double squares = 0;
        for (const Samples& samples : all) {
            const double deviation = samples.seen - samples.all * result.visibility;
            squares += deviation * deviation;
        }
        // Sum of R deviations: variance R / (R - 1) of the sum of squares.
        const double variance = squares * replicates / (replicates - 1.0);
        result.error = weight > 0 ? std::min(1.0, std::sqrt(variance + largest * largest) / weight) : 1;
        const bool is_hopeless = !(weight > 0) && count * replicates >= hopeless;
        if (result.error <= task.error || count >= most_of_one || is_hopeless) return result;
    }
}

}  // namespace surimi
