// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/line_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "baker/gather/line_lanes.cpp"  // this file again, for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <array>

#include "runtime/batch/arctangent.h"

HWY_BEFORE_NAMESPACE();
namespace surimi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;

void find_crossed(const Segments& in, const Lattice& lattice, LineSegments& out) {
    const D d;
    const size_t lanes = hn::Lanes(d);
    const V c = hn::Set(d, lattice.cosine), s = hn::Set(d, lattice.sine), zero = hn::Zero(d);
    const V inverse = hn::Set(d, 1 / lattice.spacing), bottom = hn::Set(d, lattice.bottom);
    const V shift = hn::Set(d, lattice.shift), most = hn::Set(d, lattice.count - 1.0), one = hn::Set(d, 1.0);
    out.count = 0;
    for (size_t i = 0; i < in.count; i += lanes) {
        const V ax = hn::LoadU(d, &in.x0[i]), ay = hn::LoadU(d, &in.y0[i]);
        const V bx = hn::LoadU(d, &in.x1[i]), by = hn::LoadU(d, &in.y1[i]);
        // In lines: the lower end's crossing is rounded up, the upper one's down to less than it.
        const V a = hn::Sub(hn::Mul(hn::Sub(hn::NegMulAdd(ax, s, hn::Mul(ay, c)), bottom), inverse), shift);
        const V b = hn::Sub(hn::Mul(hn::Sub(hn::NegMulAdd(bx, s, hn::Mul(by, c)), bottom), inverse), shift);
        const V first = hn::Max(hn::Ceil(hn::Min(a, b)), zero);
        const V last = hn::Min(hn::Sub(hn::Ceil(hn::Max(a, b)), one), most);
        const auto meets = hn::And(hn::FirstN(d, in.count - i), hn::Le(first, last));
        if (hn::AllFalse(d, meets)) continue;
        const V x0 = hn::MulAdd(ax, c, hn::Mul(ay, s)), x1 = hn::MulAdd(bx, c, hn::Mul(by, s));
        const V step = hn::Div(hn::Sub(x1, x0), hn::Sub(b, a));
        const V x = hn::MulAdd(hn::Sub(first, a), step, x0);
        const V jump = hn::LoadU(d, &in.jump[i]);
        // Upwards the left side is that of smaller x.
        const V signed_jump = hn::IfThenElse(hn::Lt(a, b), hn::Neg(jump), jump);
        const std::array<V, 5> values = {x, step, signed_jump, first, last};
        const std::array<double*, 5> to = {out.x.data(), out.step.data(), out.jump.data(), out.first.data(),
                                           out.last.data()};
        for (size_t k = 0; k < to.size(); ++k) hn::CompressStore(values[k], meets, d, to[k] + out.count);
        out.count += hn::CountTrue(d, meets);
    }
}

/// Arctangent of any number (M15's polynomial on [0, tan(pi/8)]).
HWY_INLINE V arctan(V t) {
    const D d;
    const V one = hn::Set(d, 1.0), size = hn::Abs(t);
    const auto is_steep = hn::Gt(size, one);
    const V small = hn::IfThenElse(is_steep, one, size), large = hn::IfThenElse(is_steep, size, one);
    const auto is_turned = hn::Gt(small, hn::Mul(hn::Set(d, arctangent_end), large));
    const V over = hn::IfThenElse(is_turned, hn::Sub(small, large), small);
    const V under = hn::IfThenElse(is_turned, hn::Add(small, large), large);
    const V r = hn::Div(over, under), r2 = hn::Mul(r, r);
    V sum = hn::Set(d, arctangent<double>.back());
    for (size_t k = arctangent<double>.size() - 1; k-- > 0;)
        sum = hn::MulAdd(sum, r2, hn::Set(d, arctangent<double>[k]));
    V angle = hn::MulAdd(hn::Mul(r, r2), sum, r);
    angle = hn::Add(angle, hn::IfThenElseZero(is_turned, hn::Set(d, pi / 4)));
    angle = hn::IfThenElse(is_steep, hn::Sub(hn::Set(d, pi / 2), angle), angle);
    return hn::CopySign(angle, t);
}

void integrate(LineEnds& ends) {
    const D d;
    const V one = hn::Set(d, 1.0);
    for (size_t i = 0; i < ends.count; i += hn::Lanes(d)) {
        const V t = hn::LoadU(d, &ends.tangent[i]);
        const V inverse = hn::Div(one, hn::MulAdd(t, t, one));
        const V sum = hn::MulAdd(t, inverse, arctan(t));
        const V light = hn::MulSub(hn::LoadU(d, &ends.weight[i]), sum, hn::Mul(hn::LoadU(d, &ends.offset[i]), inverse));
        hn::StoreU(light, d, &ends.light[i]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace surimi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surimi {
namespace {

HWY_EXPORT(find_crossed);
HWY_EXPORT(integrate);

constexpr size_t widest = 8;  // lanes of double

}  // namespace

void find_crossed_lines(const Segments& segments, const Lattice& lattice, LineSegments& crossed) {
    const size_t room = segments.count + 2 * widest;
    if (crossed.x.size() < room)
        for (auto* numbers : {&crossed.x, &crossed.step, &crossed.jump, &crossed.first, &crossed.last})
            numbers->resize(room);
    HWY_DYNAMIC_DISPATCH(find_crossed)(segments, lattice, crossed);
}

void integrate_to_ends(LineEnds& ends) {
    ends.count = ends.tangent.size();
    const size_t room = ends.count + widest;
    for (auto* numbers : {&ends.tangent, &ends.weight, &ends.offset}) numbers->resize(room, 0.0);
    if (ends.light.size() < room) ends.light.resize(room);
    HWY_DYNAMIC_DISPATCH(integrate)(ends);
}

}  // namespace surimi
#endif
