// SPDX-License-Identifier: Apache-2.0
#include "baker/study/point_sampling.h"

#include <cmath>
#include <vector>

#include "baker/study/shadow_rays.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr size_t probes = 16;

/// The next random number of a receiver.
struct Stream {
    uint64_t key;
    uint64_t counter = 0;
    double next() { return unit_double(hash(key ^ counter++)); }
};

void add_pairs(ShadowRays& rays, const Receiver& receiver, SobolPoints points, const Scrambling& seeds) {
    for (const auto& point : points) {
        const auto r = scrambled(point, seeds);
        rays.add(receiver.surface.sample(r[0], r[1]), receiver.light.sampler.sample(r[2], r[3]));
    }
}

/// The numbers below `count` in random order.
std::vector<uint32_t> shuffled(size_t count, Stream& stream) {
    std::vector<uint32_t> order(count);
    for (size_t i = 0; i < count; ++i) {
        const auto j = static_cast<size_t>(stream.next() * static_cast<double>(i + 1));
        order[i] = order[j];
        order[j] = static_cast<uint32_t>(i);
    }
    return order;
}

}  // namespace

StudyEstimate random_points(const Receiver& receiver, int count) {
    ShadowRays rays(receiver.light);
    Stream stream{hash(receiver.key, 1)};
    for (int i = 0; i < count; ++i) {
        const double u = stream.next(), v = stream.next(), s = stream.next(), t = stream.next();
        rays.add(receiver.surface.sample(u, v), receiver.light.sampler.sample(s, t));
    }
    return rays.estimate();
}

StudyEstimate stratified_points(const Receiver& receiver, int count) {
    const auto n = static_cast<uint32_t>(std::sqrt(count));
    ShadowRays rays(receiver.light);
    Stream stream{hash(receiver.key, 2)};
    const std::vector<uint32_t> partner = shuffled(static_cast<size_t>(n) * n, stream);
    const auto jittered = [&](uint32_t cell) { return (cell + stream.next()) / n; };
    for (uint32_t i = 0; i < n * n; ++i) {
        const double u = jittered(partner[i] % n), v = jittered(partner[i] / n);
        const double s = jittered(i % n), t = jittered(i / n);
        rays.add(receiver.surface.sample(u, v), receiver.light.sampler.sample(s, t));
    }
    return rays.estimate();
}

StudyEstimate sobol_points(const Receiver& receiver, SobolPoints points) {
    ShadowRays rays(receiver.light);
    add_pairs(rays, receiver, points, scrambling(hash(receiver.key, 3)));
    return rays.estimate();
}

StudyEstimate probe_and_refine(const Receiver& receiver, SobolPoints points) {
    ShadowRays rays(receiver.light);
    const Scrambling seeds = scrambling(hash(receiver.key, 4));
    const size_t first = std::min(probes, points.size());
    add_pairs(rays, receiver, points.first(first), seeds);
    // Nothing hidden makes the two sums the same terms in the same order, so they are equal to the last bit.
    if (rays.seen() > 0 && rays.seen() < rays.all()) add_pairs(rays, receiver, points.subspan(first), seeds);
    return rays.estimate();
}

}  // namespace surimi
