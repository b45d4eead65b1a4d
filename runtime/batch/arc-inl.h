// SPDX-License-Identifier: Apache-2.0
// What one edge of a polygon adds to a cosine integral, in lanes. Compiled once for each instruction set.

// Highway's guard: open once for every target that foreach_target.h compiles.
#if defined(SURIMI_RUNTIME_BATCH_ARC_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SURIMI_RUNTIME_BATCH_ARC_INL_H
#undef SURIMI_RUNTIME_BATCH_ARC_INL_H
#else
#define SURIMI_RUNTIME_BATCH_ARC_INL_H
#endif

#include "runtime/base/math.h"
#include "runtime/batch/arctangent.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace surimi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// atan2(s, cosine) * height / s with s = sqrt(sine2): the angle of an edge times its plane's normal along the
/// receiver's (M15). All three may have been scaled by any factor, sine2 by its square. |height| is at most s. Where
/// sine2 is below 1e-200, in float least_sine2, the cosine is to be positive and larger by far; else the angle is lost.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V arc(D d, V sine2, V cosine, V height) {
    using T = hn::TFromD<D>;
    // Small sines may be replaced by larger ones: next to 0 the result does not depend on them. These are the least
    // whose cubes do not underflow, which would take a hundred times as long.
    const V least = hn::Set(d, sizeof(T) == sizeof(double) ? static_cast<T>(1e-200) : static_cast<T>(least_sine2));
    const V zero = hn::Zero(d), sine = hn::Sqrt(hn::Max(sine2, least)), size = hn::Abs(cosine);
    const V small = hn::Min(sine, size), large = hn::Max(sine, size);
    const auto is_turned = hn::Gt(small, hn::Mul(hn::Set(d, static_cast<T>(arctangent_end)), large));
    const V over = hn::IfThenElse(is_turned, hn::Sub(small, large), small);
    const V under = hn::IfThenElse(is_turned, hn::Add(small, large), large);
    const V inverse = hn::Div(hn::Set(d, T(1)), hn::Mul(under, sine));  // one division for both quotients
    const V r = hn::Mul(hn::Mul(over, sine), inverse), r2 = hn::Mul(r, r);
    V sum = hn::Set(d, static_cast<T>(arctangent<T>.back()));
    for (size_t k = arctangent<T>.size() - 1; k-- > 0;)
        sum = hn::MulAdd(sum, r2, hn::Set(d, static_cast<T>(arctangent<T>[k])));
    V angle = hn::MulAdd(hn::Mul(r, r2), sum, r);
    angle = hn::Add(angle, hn::IfThenElseZero(is_turned, hn::Set(d, static_cast<T>(pi / 4))));
    angle = hn::IfThenElse(hn::Gt(sine, size), hn::Sub(hn::Set(d, static_cast<T>(pi / 2)), angle), angle);
    angle = hn::IfThenElse(hn::Lt(cosine, zero), hn::Sub(hn::Set(d, static_cast<T>(pi)), angle), angle);
    return hn::Mul(angle, hn::Mul(hn::Mul(height, under), inverse));
}

}  // namespace HWY_NAMESPACE
}  // namespace surimi
HWY_AFTER_NAMESPACE();

#endif
