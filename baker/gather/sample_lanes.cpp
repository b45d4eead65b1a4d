// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/sample_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "baker/gather/sample_lanes.cpp"  // this file again, for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace surimi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D64 = hn::CappedTag<double, SampleLanes::count>;
using V64 = hn::Vec<D64>;
using D32 = hn::CappedTag<uint32_t, SampleLanes::count>;
using V32 = hn::Vec<D32>;

// Products and sums are rounded one by one, so that every instruction set gives the same bytes.

HWY_INLINE V32 reverse_bits(V32 x) {
    const D32 d;
    const auto swap = [&](auto shifted_right, auto shifted_left, uint32_t mask) HWY_ATTR {
        return hn::Or(hn::And(shifted_right, hn::Set(d, mask)), hn::AndNot(hn::Set(d, mask), shifted_left));
    };
    x = swap(hn::ShiftRight<1>(x), hn::ShiftLeft<1>(x), 0x55555555u);
    x = swap(hn::ShiftRight<2>(x), hn::ShiftLeft<2>(x), 0x33333333u);
    x = swap(hn::ShiftRight<4>(x), hn::ShiftLeft<4>(x), 0x0f0f0f0fu);
    x = swap(hn::ShiftRight<8>(x), hn::ShiftLeft<8>(x), 0x00ff00ffu);
    return hn::Or(hn::ShiftRight<16>(x), hn::ShiftLeft<16>(x));
}

/// sobol::scramble_reversed.
HWY_INLINE V32 scramble_reversed(V32 x, uint32_t seed) {
    const D32 d;
    const auto mix = [&](V32 y, uint32_t factor) HWY_ATTR { return hn::Xor(y, hn::Mul(y, hn::Set(d, factor))); };
    x = hn::Add(mix(x, 0x3d20adeau), hn::Set(d, seed));
    x = hn::Mul(x, hn::Set(d, (seed >> 16) | 1u));
    return reverse_bits(mix(mix(x, 0x05526c56u), 0x53a22864u));
}

void scramble_all(const std::array<const uint32_t*, 4>& digits, const Scrambling& seeds, SampleLanes& lanes) {
    const D32 d32;
    const D64 d64;
    const hn::Rebind<int32_t, D64> half;
    HWY_ALIGN std::array<int32_t, SampleLanes::count> below_half;
    for (size_t k = 0; k < 4; ++k) {
        for (size_t i = 0; i < SampleLanes::count; i += hn::Lanes(d32)) {
            // Signed, since only such are converted by all processors; 1/2 is added again. Nothing of this rounds.
            const V32 bits = scramble_reversed(hn::LoadU(d32, digits[k] + i), seeds[k]);
            hn::Store(hn::BitCast(hn::RebindToSigned<D32>(), hn::Xor(bits, hn::Set(d32, 0x80000000u))),
                      hn::RebindToSigned<D32>(), below_half.data() + i);
        }
        for (size_t i = 0; i < SampleLanes::count; i += hn::Lanes(d64)) {
            const V64 number = hn::PromoteTo(d64, hn::LoadU(half, below_half.data() + i));
            hn::Store(hn::Add(hn::Mul(number, hn::Set(d64, 0x1p-32)), hn::Set(d64, 0.5)), d64,
                      lanes.numbers[k].data() + i);
        }
    }
}

struct Three {
    V64 x, y, z;
};

HWY_INLINE Three load(const SampleLanes::Vectors& vectors, size_t i) {
    const D64 d;
    return {hn::Load(d, vectors[0].data() + i), hn::Load(d, vectors[1].data() + i), hn::Load(d, vectors[2].data() + i)};
}
HWY_INLINE Three sum(const Three& a, const Three& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Three difference(const Three& a, const Three& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V64 dot(const Three& a, const Three& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE void store(V64 value, float* to) {
    const hn::Rebind<float, D64> narrow;
    hn::StoreU(hn::DemoteTo(narrow, value), narrow, to);
}
HWY_INLINE void store(const Three& value, std::array<SampleLanes::Lanes<float>, 3>& to, size_t i) {
    store(value.x, to[0].data() + i);
    store(value.y, to[1].data() + i);
    store(value.z, to[2].data() + i);
}

void weigh_all(double clearance, bool is_two_sided, SampleLanes& lanes) {
    const D64 d;
    const V64 zero = hn::Zero(d), one = hn::Set(d, 1.0), margin = hn::Set(d, clearance);
    for (size_t i = 0; i < SampleLanes::count; i += hn::Lanes(d)) {
        const Three position = load(lanes.position, i), target = load(lanes.target, i);
        const Three panel_normal = load(lanes.panel_normal, i);
        const Three way = difference(target, position);
        const V64 receiver = dot(way, load(lanes.normal, i)), over_panel = hn::Neg(dot(way, panel_normal));
        const V64 emitter = is_two_sided ? hn::Abs(over_panel) : over_panel;
        const V64 square = dot(way, way);
        const auto is_lit = hn::And(hn::Gt(receiver, zero), hn::Gt(emitter, zero));
        const V64 weight = hn::Div(hn::Mul(receiver, emitter), hn::Mul(square, square));
        store(hn::IfThenElseZero(is_lit, weight), lanes.weight.data() + i);

        const Three origin = sum(position, load(lanes.to_origin, i));
        const Three direction = difference(target, origin);
        const V64 height = hn::Abs(dot(direction, panel_normal));
        const V64 end = hn::IfThenElseZero(hn::Gt(height, margin), hn::Sub(one, hn::Div(margin, height)));
        const auto leaves_surface = hn::Gt(dot(way, load(lanes.geometric_normal, i)), zero);
        store(hn::IfThenElse(leaves_surface, end, hn::Set(d, double{SampleLanes::shadowed})), lanes.end.data() + i);
        store(origin, lanes.origin, i);
        store(direction, lanes.direction, i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace surimi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surimi {
namespace {

HWY_EXPORT(scramble_all);
HWY_EXPORT(weigh_all);

}  // namespace

void scramble(const std::array<const uint32_t*, 4>& digits, const Scrambling& seeds, SampleLanes& lanes) {
    HWY_DYNAMIC_DISPATCH(scramble_all)(digits, seeds, lanes);
}

void weigh(double clearance, bool is_two_sided, SampleLanes& lanes) {
    HWY_DYNAMIC_DISPATCH(weigh_all)(clearance, is_two_sided, lanes);
}

}  // namespace surimi
#endif
