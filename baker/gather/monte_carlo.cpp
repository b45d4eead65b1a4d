// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/monte_carlo.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr size_t first_round = 64;
constexpr size_t lanes = RayPacket::capacity;
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
    std::array<size_t, lanes> sample;
};

void trace(const MonteCarloTask& task, Waiting& waiting, Samples& samples) {
    const uint32_t blocked = task.rays.occluded(waiting.packet, task.monitor);
    for (size_t i = 0; i < waiting.packet.size; ++i)
        if (!((blocked >> i) & 1u)) samples.signed_weights[waiting.sample[i]] *= -1;
    samples.rays += waiting.packet.size;
    waiting.packet.size = 0;
}

/// Of one batch of samples, one number for each and each dimension. Sixty-four at a time, since loops of sixteen are
/// unrolled before the compiler thinks of vectors.
constexpr size_t batch = 64;
using Numbers = std::array<std::array<double, batch>, 4>;

/// Numbers in [0, 1) of the samples from `first` on.
void scramble_batch(const SamplePoints& points, const Scrambling& seeds, size_t first, Numbers& numbers) {
    for (size_t d = 0; d < 4; ++d) {
        const uint32_t* digits = points.digits[d].data() + first;
        const uint32_t seed = seeds[d];
        for (size_t i = 0; i < batch; ++i) {
            // Vectors convert signed integers only. Nothing of this rounds.
            const auto below_half = static_cast<int32_t>(sobol::scramble_reversed(digits[i], seed) ^ 0x80000000u);
            numbers[d][i] = static_cast<double>(below_half) * 0x1p-32 + 0.5;
        }
    }
}

/// A place on the texel, as far as rays and weights need it.
struct Place {
    Vec3 position{0};
    Vec3 normal{0, 0, 1};  // unit, for shading
};

/// What stays the same from sample to sample while they fall on one piece of the texel; most texels have but one.
struct OnPiece {
    const TexelSurface::Piece* piece = nullptr;
    Vec3 to_origin{0};  // from a point to where its rays start, relative to RayScene::center()
};

Place place_on(const MonteCarloTask& task, const TexelSurface& surface, double u, double v, OnPiece& on) {
    const TexelSurface::Piece& piece = surface.choose(u, v);
    const Place place{piece.position.at(u, v), piece.unit_normal(u, v)};
    if (on.piece != &piece) {
        const SurfacePoint point{piece.triangle, piece.barycentric.at(u, v), place.position, place.normal,
                                 piece.geometric_normal};
        on = {&piece, task.rays.ray_origin(point) - place.position - task.rays.center()};
    }
    return place;
}

/// Irradiance weight of a monitor point for a surface point, up to the monitor's area: cos cos / r^2. `d` leads from
/// one to the other.
double transfer(const Vec3& d, const Vec3& normal, double emitter) {
    const double r2 = glm::dot(d, d);
    const double receiver = glm::dot(d, normal);
    if (!(receiver > 0) || !(emitter > 0)) return 0;
    return receiver * emitter / (r2 * r2);
}

/// The next `count` samples, at most a batch.
void take(const MonteCarloTask& task, const TexelSurface& surface, const Numbers& numbers, size_t count, OnPiece& on,
          Waiting& waiting, Samples& samples) {
    for (size_t i = 0; i < count; ++i) {
        const Place from = place_on(task, surface, numbers[2][i], numbers[3][i], on);
        const LightPoint to = task.sampler.sample(numbers[0][i], numbers[1][i]);
        const Vec3 d = to.position - from.position;
        const double over_panel = -glm::dot(d, to.normal);
        const double weight = transfer(d, from.normal, task.sampler.is_two_sided() ? std::abs(over_panel) : over_panel);
        const size_t index = samples.count++;
        samples.signed_weights[index] = -static_cast<float>(weight);
        if (!(weight > 0)) continue;
        // Light that the shading normal would admit but the surface itself blocks: occluded without a ray.
        if (!(glm::dot(d, on.piece->geometric_normal) > 0)) continue;
        const Vec3 origin = from.position + on.to_origin;
        const Vec3 target = to.position - task.rays.center();
        const double height = std::abs(glm::dot(target - origin, to.normal));
        if (!(height > task.clearance)) {
            samples.signed_weights[index] *= -1;
            continue;
        }
        waiting.sample[waiting.packet.size] = index;
        waiting.packet.add(origin, target, 1 - task.clearance / height);
        if (waiting.packet.size == lanes) trace(task, waiting, samples);
    }
}

void extend(const MonteCarloTask& task, const TexelSurface& surface, const Scrambling& seeds, size_t count,
            Samples& samples) {
    Waiting waiting;
    Numbers numbers;
    OnPiece on;
    const size_t before = samples.count;
    for (size_t first = before; first < count; first += batch) {
        scramble_batch(task.points, seeds, first, numbers);
        take(task, surface, numbers, std::min(batch, count - first), on, waiting, samples);
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
    std::array<double, 2> sums{};                         // two chains of additions, so that they overlap
    for (size_t first = 0; first < deviations.size(); first += 2 * half)
        for (size_t i = 0; i < half; ++i) {
            // first + i has the bits of a place in its net, and nets start at multiples of their size.
            const float difference = deviations[first + i] - deviations[(first + i) ^ partner];
            sums[i & 1u] += static_cast<double>(difference) * static_cast<double>(difference);
        }
    return sums[0] + sums[1];
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
                      partner_of(m, order.subspan(1, 1))};
}

MonteCarloEstimate monte_carlo(const MonteCarloTask& task, const TexelSurface& surface) {
    const Scrambling seeds = scrambling(task.key);
    const auto bounded = [](int count) {
        return std::clamp<size_t>(static_cast<size_t>(std::max(count, 1)), 1, SamplePoints::capacity);
    };
    const size_t most = bounded(task.samples > 0 ? task.samples : task.most_samples);
    Samples samples;
    size_t count = task.samples > 0 ? most : std::min(first_round, most);
    double error = 1;
    while (true) {
        extend(task, surface, seeds, count, samples);
        error = standard_error(task.points, samples);
        const bool is_hopeless = !(samples.all > 0) && count >= hopeless;
        if (error <= task.error || count == most || is_hopeless) break;
        count = std::min(2 * count, most);
    }
    return {samples.visibility(), error, samples.rays, samples.all > 0};
}

}  // namespace surimi
