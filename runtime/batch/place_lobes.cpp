// SPDX-License-Identifier: Apache-2.0
#include "runtime/batch/batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "runtime/batch/place_lobes.cpp"  // this file again, for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "runtime/ltc/table.h"

HWY_BEFORE_NAMESPACE();
namespace surimi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D64 = hn::ScalableTag<double>;
using V64 = hn::Vec<D64>;
constexpr size_t most_lanes = hn::MaxLanes(D64());

/// Position, normal, view, roughness.
using PointFields = std::array<const double*, 10>;
/// Tangent, xx, xz, zx, zz, share_above, albedo.
using LobeFields = std::array<double*, 9>;

/// The six interpolated numbers of the table for each lane (M27). A cell's numbers lie side by side, so each lane reads
/// four cells whole; gathering number by number would take 24 gathers.
HWY_INLINE std::array<V64, 6> look_up(const float* table, V64 column, V64 row) {
    const D64 d;
    const hn::CappedTag<double, ltc_cell_floats> wide;
    const hn::Rebind<float, decltype(wide)> narrow;
    HWY_ALIGN std::array<double, most_lanes> x, y;
    HWY_ALIGN std::array<std::array<double, most_lanes>, 6> numbers;
    HWY_ALIGN std::array<double, ltc_cell_floats> cell;
    hn::Store(column, d, x.data());
    hn::Store(row, d, y.data());
    for (size_t lane = 0; lane < hn::Lanes(d); ++lane) {
        const int i = std::min(static_cast<int>(x[lane]), ltc_size - 2);
        const int j = std::min(static_cast<int>(y[lane]), ltc_size - 2);
        const double u = x[lane] - i, v = y[lane] - j;
        const float* at = table + static_cast<size_t>(j * ltc_size + i) * ltc_cell_floats;
        for (size_t k = 0; k < numbers.size(); k += hn::Lanes(wide)) {
            const auto number = [&](size_t cells) HWY_ATTR {
                return hn::PromoteTo(wide, hn::Load(narrow, at + cells * ltc_cell_floats + k));
            };
            const auto upper =
                hn::MulAdd(number(1), hn::Set(wide, u * (1 - v)), hn::Mul(number(0), hn::Set(wide, (1 - u) * (1 - v))));
            const auto lower = hn::MulAdd(number(ltc_size + 1), hn::Set(wide, u * v),
                                          hn::Mul(number(ltc_size), hn::Set(wide, (1 - u) * v)));
            hn::Store(hn::Add(upper, lower), wide, cell.data() + k);
        }
        for (size_t k = 0; k < numbers.size(); ++k) numbers[k][lane] = cell[k];
    }
    std::array<V64, 6> result;
    for (size_t k = 0; k < numbers.size(); ++k) result[k] = hn::Load(d, numbers[k].data());
    return result;
}

/// A unit vector at right angles to the normal, towards the view where it has a direction.
struct Tangent {
    V64 x, y, z;
    V64 cosine;  ///< of the angle between normal and view
};

HWY_INLINE Tangent tangent_of(V64 nx, V64 ny, V64 nz, V64 vx, V64 vy, V64 vz) {
    const D64 d;
    const V64 zero = hn::Zero(d), one = hn::Set(d, 1.0);
    const V64 cosine = hn::MulAdd(nz, vz, hn::MulAdd(ny, vy, hn::Mul(nx, vx)));
    V64 x = hn::NegMulAdd(nx, cosine, vx), y = hn::NegMulAdd(ny, cosine, vy), z = hn::NegMulAdd(nz, cosine, vz);
    // Near the normal little is left, and what rounding put along the normal weighs as much.
    const V64 rest = hn::MulAdd(nz, z, hn::MulAdd(ny, y, hn::Mul(nx, x)));
    x = hn::NegMulAdd(nx, rest, x);
    y = hn::NegMulAdd(ny, rest, y);
    z = hn::NegMulAdd(nz, rest, z);
    // Nothing but rounding: any tangent will do, for lobes are round at the normal.
    const auto is_open = hn::Le(hn::MulAdd(z, z, hn::MulAdd(y, y, hn::Mul(x, x))), hn::Set(d, 1e-30));
    const auto is_sideways = hn::Gt(hn::Abs(nx), hn::Abs(nz));
    x = hn::IfThenElse(is_open, hn::IfThenElseZero(is_sideways, hn::Neg(ny)), x);
    y = hn::IfThenElse(is_open, hn::IfThenElse(is_sideways, nx, hn::Neg(nz)), y);
    z = hn::IfThenElse(is_open, hn::IfThenElse(is_sideways, zero, ny), z);
    const V64 inverse = hn::Div(one, hn::Sqrt(hn::MulAdd(z, z, hn::MulAdd(y, y, hn::Mul(x, x)))));
    return {hn::Mul(x, inverse), hn::Mul(y, inverse), hn::Mul(z, inverse), cosine};
}

HWY_INLINE void place_block(LobePart part, const PointFields& in, const LobeFields& out) {
    const D64 d;
    const V64 zero = hn::Zero(d), one = hn::Set(d, 1.0), half = hn::Set(d, 0.5);
    std::array<V64, 10> p;
    for (size_t k = 0; k < p.size(); ++k) p[k] = hn::LoadU(d, in[k]);
    const Tangent tangent = tangent_of(p[3], p[4], p[5], p[6], p[7], p[8]);
    // A product with 0 is 0 for all that is finite.
    V64 nothing = hn::Mul(tangent.x, zero);
    for (const V64 v : {tangent.y, tangent.z, tangent.cosine}) nothing = hn::MulAdd(v, zero, nothing);
    for (const V64 v : p) nothing = hn::MulAdd(v, zero, nothing);
    const auto is_sound = hn::Eq(nothing, zero);

    const V64 u = hn::IfThenElseZero(hn::And(is_sound, hn::Gt(p[9], zero)), hn::Min(p[9], one));
    const V64 c = hn::IfThenElse(hn::And(is_sound, hn::Lt(tangent.cosine, one)),
                                 hn::Max(tangent.cosine, hn::Set(d, ltc_least_cosine)), one);
    const V64 last = hn::Set(d, double{ltc_size - 1});
    const std::array<V64, 6> n = look_up(ltc_cells(part), hn::Mul(u, last), hn::Mul(hn::Sqrt(hn::Sub(one, c)), last));

    // (M24): along the tangent (c, 0, s) of the mirror direction, and the mirror direction (-s, 0, c).
    const V64 alpha = hn::Max(hn::Set(d, ltc_least_alpha), hn::Mul(u, u)), width = hn::Add(alpha, alpha);
    const V64 s = hn::Sqrt(hn::Mul(hn::Sub(one, c), hn::Add(one, c))), side = hn::Mul(alpha, s);
    const V64 scale = hn::Sqrt(hn::MulAdd(c, c, hn::Mul(side, side)));
    const V64 along = hn::Mul(scale, n[0]), tilt = hn::Mul(hn::Mul(scale, width), n[1]);
    const V64 skew = hn::Mul(width, n[2]), depth = hn::Mul(hn::Mul(scale, width), n[3]);
    const V64 xx = hn::MulSub(along, c, hn::Mul(tilt, s)), xz = hn::MulAdd(along, s, hn::Mul(tilt, c));
    const V64 zx = hn::MulSub(skew, c, hn::Mul(depth, s)), zz = hn::MulAdd(skew, s, hn::Mul(depth, c));

    // (M25), where xx > 0 without cancellation.
    const V64 zx2 = hn::Mul(zx, zx), length = hn::Sqrt(hn::MulAdd(xx, xx, zx2));
    const auto is_forward = hn::Gt(xx, zero);
    const V64 over = hn::IfThenElse(is_forward, zx2, hn::Sub(length, xx));
    const V64 under = hn::IfThenElse(is_forward, hn::Mul(length, hn::Add(length, xx)), length);
    const V64 leak = hn::IfThenElseZero(hn::Gt(length, zero), hn::Div(hn::Mul(half, over), under));
    const V64 root2 = hn::Mul(n[5], n[5]), schlick = hn::Mul(hn::Mul(root2, root2), n[5]);
    const V64 albedo = part == LobePart::full ? n[4] : hn::Mul(n[4], schlick);

    const std::array<V64, 9> result = {
        hn::IfThenElse(is_sound, tangent.x, one),
        hn::IfThenElseZero(is_sound, tangent.y),
        hn::IfThenElseZero(is_sound, tangent.z),
        xx,
        xz,
        zx,
        zz,
        hn::IfThenElse(is_sound, hn::Sub(one, leak), one),
        hn::IfThenElseZero(is_sound, albedo),
    };
    for (size_t k = 0; k < result.size(); ++k) hn::StoreU(result[k], d, out[k]);
}

void place_all(LobePart part, const PointFields& in, const LobeFields& out, size_t count) {
    const size_t lanes = hn::Lanes(D64());
    PointFields from = in;
    LobeFields to = out;
    size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        for (size_t k = 0; k < in.size(); ++k) from[k] = in[k] + i;
        for (size_t k = 0; k < out.size(); ++k) to[k] = out[k] + i;
        place_block(part, from, to);
    }
    if (i == count) return;
    // The same kernel for the rest, the last point repeated.
    std::array<std::array<double, most_lanes>, 10> inputs{};
    std::array<std::array<double, most_lanes>, 9> outputs{};
    for (size_t k = 0; k < in.size(); ++k) {
        for (size_t lane = 0; lane < lanes; ++lane) inputs[k][lane] = in[k][std::min(i + lane, count - 1)];
        from[k] = inputs[k].data();
    }
    for (size_t k = 0; k < out.size(); ++k) to[k] = outputs[k].data();
    place_block(part, from, to);
    for (size_t k = 0; k < out.size(); ++k) std::copy_n(outputs[k].begin(), count - i, out[k] + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace surimi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surimi {
namespace {

HWY_EXPORT(place_all);

}  // namespace

void place_lobes(const PointBatch& points, LobeBatch& lobes, LobePart part) {
    const size_t count = points.size();
    std::vector<double>&tx = lobes.tangent.x, &ty = lobes.tangent.y, &tz = lobes.tangent.z;
    const std::array<std::vector<double>*, 9> out = {
        &tx, &ty, &tz, &lobes.xx, &lobes.xz, &lobes.zx, &lobes.zz, &lobes.share_above, &lobes.albedo};
    std::array<double*, 9> to{};
    for (size_t k = 0; k < out.size(); ++k) {
        out[k]->resize(count);
        to[k] = out[k]->data();
    }
    const Vec3Batch &p = points.position, &n = points.normal, &v = points.view;
    HWY_DYNAMIC_DISPATCH(place_all)
    (part,
     {p.x.data(), p.y.data(), p.z.data(), n.x.data(), n.y.data(), n.z.data(), v.x.data(), v.y.data(), v.z.data(),
      points.roughness.data()},
     to, count);
}

}  // namespace surimi
#endif
