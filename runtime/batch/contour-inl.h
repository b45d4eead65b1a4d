// SPDX-License-Identifier: Apache-2.0
// The contour of a polygon above two horizons, the surface's and the lobe's, as edges ready to be integrated (M14).
// Compiled once for each instruction set.

#if defined(SURIMI_RUNTIME_BATCH_CONTOUR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SURIMI_RUNTIME_BATCH_CONTOUR_INL_H
#undef SURIMI_RUNTIME_BATCH_CONTOUR_INL_H
#else
#define SURIMI_RUNTIME_BATCH_CONTOUR_INL_H
#endif

#include "runtime/batch/polygon_job.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace surimi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D64 = hn::ScalableTag<double>;
using V64 = hn::Vec<D64>;
using M64 = hn::Mask<D64>;

struct Vector {
    V64 x, y, z;
};

HWY_INLINE Vector spread(const Vec3& v) {
    const D64 d;
    return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}
HWY_INLINE V64 dot(const Vector& a, const Vector& b) {
    return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
HWY_INLINE Vector subtract(const Vector& a, const Vector& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector scaled(const Vector& a, V64 s) {
    return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
/// a s + b t
HWY_INLINE Vector combined(const Vector& a, V64 s, const Vector& b, V64 t) {
    return {hn::MulAdd(a.x, s, hn::Mul(b.x, t)), hn::MulAdd(a.y, s, hn::Mul(b.y, t)),
            hn::MulAdd(a.z, s, hn::Mul(b.z, t))};
}
HWY_INLINE Vector choose(M64 mask, const Vector& a, const Vector& b) {
    return {hn::IfThenElse(mask, a.x, b.x), hn::IfThenElse(mask, a.y, b.y), hn::IfThenElse(mask, a.z, b.z)};
}

/// How a horizon cuts an edge from a to b, whose ends have these heights above it.
struct Cut {
    M64 is_above_a, is_above_b, is_crossing;
    V64 of_a, of_b;  ///< where it crosses, of_a a + of_b b is a positive multiple of the crossing
    V64 kept;        ///< by it the kept part's cross product is shorter than a x b, in the scale of that multiple
    bool is_needed;  ///< some lane crosses

    HWY_INLINE Cut(V64 height_a, V64 height_b) {
        const D64 d;
        const V64 zero = hn::Zero(d), one = hn::Set(d, 1.0);
        is_above_a = hn::Ge(height_a, zero);
        is_above_b = hn::Ge(height_b, zero);
        is_crossing = hn::Xor(is_above_a, is_above_b);
        is_needed = !hn::AllFalse(d, is_crossing);
        of_a = of_b = kept = one;
        if (!is_needed) return;
        const V64 size_a = hn::Abs(height_a), size_b = hn::Abs(height_b);
        // A power of two near the quotient's denominator takes the place of the division: no rounding, and crossings
        // keep the size of the corners.
        const hn::RebindToUnsigned<D64> bits;
        const auto exponent = hn::And(hn::BitCast(bits, hn::Add(size_a, size_b)), hn::Set(bits, 0x7FF0000000000000u));
        const V64 scale = hn::BitCast(d, hn::Sub(hn::Set(bits, 0x7FE0000000000000u), exponent));
        of_a = hn::Mul(size_b, scale);
        of_b = hn::Mul(size_a, scale);
        kept = hn::IfThenElse(is_crossing, hn::IfThenElse(is_above_a, of_b, of_a), one);
    }
    HWY_INLINE M64 is_visible() const { return hn::Or(is_above_a, is_above_b); }
};

/// Where a contour goes below a horizon and where it comes back; 0 where it never does.
struct Gap {
    Vector left, entered;
};

/// The part of an edge that a cut leaves, and the gap's ends that lie on it.
HWY_INLINE void shorten(const Cut& cut, Vector& a, Vector& b, Gap& gap) {
    const Vector crossing = combined(a, cut.of_a, b, cut.of_b);
    gap.left = choose(hn::And(cut.is_crossing, cut.is_above_a), crossing, gap.left);
    gap.entered = choose(hn::And(cut.is_crossing, cut.is_above_b), crossing, gap.entered);
    a = choose(cut.is_above_a, a, crossing);
    b = choose(cut.is_above_b, b, crossing);
}

/// The points of one block, and what the lobe makes of directions.
struct Receivers {
    Vector position, normal;
    std::array<Vector, 3> row;       ///< of the matrix from world directions to the cosine's space (M23)
    std::array<Vector, 3> cofactor;  ///< rows of its cofactor matrix, which transforms cross products
    V64 level_x, level_z;            ///< of the surface's normal transformed by the cofactors; its y is 0
    M64 is_sound;                    ///< everything is finite
};

/// From the `first` point of `in` on.
HWY_INLINE Receivers load_receivers(const BlockInput& in, size_t first, double scale, bool has_lobe) {
    const D64 d;
    const auto at = [&](Field f) HWY_ATTR { return hn::LoadU(d, in.field[static_cast<size_t>(f)] + first); };
    const V64 zero = hn::Zero(d);
    Receivers r;
    r.position = {at(Field::position_x), at(Field::position_y), at(Field::position_z)};
    r.normal = {at(Field::normal_x), at(Field::normal_y), at(Field::normal_z)};
    // A product with 0 is 0 for all that is finite.
    V64 nothing = hn::Mul(r.position.x, zero);
    for (const V64 v : {r.position.y, r.position.z, r.normal.x, r.normal.y, r.normal.z})
        nothing = hn::MulAdd(v, zero, nothing);
    r.is_sound = hn::Eq(nothing, zero);
    r.position = scaled(r.position, hn::Set(d, scale));
    r.row = r.cofactor = {r.normal, r.normal, r.normal};
    r.level_x = r.level_z = zero;
    if (in.field[static_cast<size_t>(Field::albedo)]) r.is_sound = hn::And(r.is_sound, hn::Gt(at(Field::albedo), zero));
    if (!has_lobe) return r;
    const Vector tangent = {at(Field::tangent_x), at(Field::tangent_y), at(Field::tangent_z)};
    const Vector bitangent = cross(r.normal, tangent);
    const V64 xx = at(Field::xx), xz = at(Field::xz), zx = at(Field::zx), zz = at(Field::zz);
    r.row = {combined(tangent, xx, r.normal, xz), bitangent, combined(tangent, zx, r.normal, zz)};
    r.cofactor = {combined(tangent, zz, r.normal, hn::Neg(zx)), scaled(bitangent, hn::MulSub(xx, zz, hn::Mul(xz, zx))),
                  combined(r.normal, xx, tangent, hn::Neg(xz))};
    r.level_x = hn::Neg(zx);
    r.level_z = xx;
    return r;
}

HWY_INLINE Vector transformed(const std::array<Vector, 3>& rows, const Vector& v) {
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

/// Stores in the precision T.
template <class T>
HWY_INLINE void store_as(V64 v, T* at) {
    const D64 d;
    if constexpr (sizeof(T) == sizeof(double)) {
        hn::StoreU(v, d, at);
    } else {
        const hn::Rebind<float, D64> narrow;
        hn::StoreU(hn::DemoteTo(narrow, v), narrow, at);
    }
}

/// Writes edges as `arc` wants them, in the precision T of the sums.
template <class T>
class ArcWriter {
  public:
    /// Lanes from `first` on, of `lanes` in all. `arcs` has room for 3 x lanes numbers for each arc.
    HWY_INLINE ArcWriter(T* arcs, uint8_t* is_needed, size_t lanes, size_t first)
        : arcs_(arcs + first), is_needed_(is_needed), lanes_(lanes) {}

    HWY_INLINE void write(size_t index, M64 is_visible, V64 sine2, V64 cosine, V64 height) const {
        const D64 d;
        if (!hn::AllFalse(d, is_visible)) is_needed_[index] = 1;
        T* at = arcs_ + 3 * lanes_ * index;
        store_as(hn::IfThenElseZero(is_visible, sine2), at);
        store_as(hn::IfThenElse(is_visible, cosine, hn::Set(d, 1.0)), at + lanes_);
        store_as(hn::IfThenElseZero(is_visible, height), at + 2 * lanes_);
    }

  private:
    T* arcs_;
    uint8_t* is_needed_;
    size_t lanes_;
};

/// The height of an edge that closes the contour along a horizon: the component of its ends' cross product along the
/// horizon's normal, the only one. Of an edge through the point itself it is 0 and the angle half a turn, to either
/// side; any small height stands for that.
HWY_INLINE V64 height_of_closing(V64 cosine, V64 height) {
    const D64 d;
    const V64 zero = hn::Zero(d);
    return hn::IfThenElse(hn::And(hn::Eq(height, zero), hn::Lt(cosine, zero)), hn::Set(d, 1e-100), height);
}

/// One corner as the receivers see it.
struct Corner {
    Vector p, q;  ///< relative to the point, in the world and in the cosine's space
    V64 height, distance2;
};

HWY_INLINE Corner see(const PolygonJob& job, const Receivers& r, size_t i) {
    Corner c;
    c.p = subtract(spread(job.corners[i]), r.position);
    c.height = dot(c.p, r.normal);
    c.distance2 = dot(c.p, c.p);
    c.q = job.has_specular ? transformed(r.row, c.p) : c.p;
    return c;
}

/// The edge's part above the lobe's horizon: ends `a` and `b` in the cosine's space, `product` a multiple of their
/// cross product, which is `kept` times as long as it should be.
template <class T>
HWY_INLINE void write_specular(const ArcWriter<T>& arcs, size_t index, M64 is_visible, Vector a, Vector b, V64 product2,
                               V64 product_z, V64 kept, Gap& gap) {
    const Cut cut(a.z, b.z);
    if (cut.is_needed) {
        Gap here = gap;
        shorten(cut, a, b, here);
        gap.left = choose(is_visible, here.left, gap.left);
        gap.entered = choose(is_visible, here.entered, gap.entered);
        kept = hn::Mul(kept, cut.kept);
    }
    arcs.write(index, hn::And(is_visible, cut.is_visible()), hn::Mul(hn::Mul(kept, kept), product2), dot(a, b),
               hn::Mul(kept, product_z));
}

struct Sight {
    V64 nearest2;  ///< squared distance of the nearest corner
    M64 is_above;  ///< false where the polygon lies below the horizon, or touches it from below
};

/// Writes the edges of the job's polygon as the receivers see them: of the diffuse integral one for each corner and one
/// along the surface's horizon, of the specular one the same and one along the lobe's.
template <class T>
HWY_INLINE Sight write_contour(const PolygonJob& job, const Receivers& r, const ArcWriter<T>& diffuse,
                               const ArcWriter<T>& specular) {
    const D64 d;
    const V64 zero = hn::Zero(d), one = hn::Set(d, 1.0);
    const size_t count = job.corners.size();
    const Vector nowhere{zero, zero, zero};
    Gap gap{nowhere, nowhere}, gap_q{nowhere, nowhere}, gap_lobe{nowhere, nowhere};
    Corner from = see(job, r, count - 1);
    V64 nearest2 = from.distance2, lowest = from.height, highest = from.height;
    for (size_t i = 0; i < count; ++i) {
        const Corner to = see(job, r, i);
        nearest2 = hn::Min(nearest2, to.distance2);
        lowest = hn::Min(lowest, to.height);
        highest = hn::Max(highest, to.height);
        const Cut cut(from.height, to.height);
        // The nearer end times the edge: of two nearly equal vectors only noise would be left.
        const Vector product = cross(choose(hn::Lt(from.distance2, to.distance2), from.p, to.p), spread(job.edges[i]));
        if (job.has_diffuse || cut.is_needed) {
            Vector a = from.p, b = to.p;
            if (cut.is_needed) shorten(cut, a, b, gap);
            if (job.has_diffuse)
                diffuse.write(i, cut.is_visible(), hn::Mul(hn::Mul(cut.kept, cut.kept), dot(product, product)),
                              dot(a, b), hn::Mul(cut.kept, dot(product, r.normal)));
        }
        if (job.has_specular) {
            Vector a = from.q, b = to.q;
            if (cut.is_needed) shorten(cut, a, b, gap_q);
            const Vector product_q = transformed(r.cofactor, product);
            write_specular(specular, i, cut.is_visible(), a, b, dot(product_q, product_q), product_q.z, cut.kept,
                           gap_lobe);
        }
        from = to;
    }
    const V64 cosine = dot(gap.left, gap.entered);
    const V64 height = height_of_closing(cosine, dot(cross(gap.left, gap.entered), r.normal)),
              height2 = hn::Mul(height, height);
    const M64 is_cut = hn::Or(hn::Ne(height, zero), hn::Ne(cosine, zero));
    if (job.has_diffuse) diffuse.write(count, is_cut, height2, cosine, height);
    if (job.has_specular) {
        const V64 level2 = hn::MulAdd(r.level_x, r.level_x, hn::Mul(r.level_z, r.level_z));
        write_specular(specular, count, is_cut, gap_q.left, gap_q.entered, hn::Mul(height2, level2),
                       hn::Mul(height, r.level_z), one, gap_lobe);
        const Vector &a = gap_lobe.left, &b = gap_lobe.entered;
        const V64 cosine_lobe = hn::MulAdd(a.x, b.x, hn::Mul(a.y, b.y));
        const V64 height_lobe = height_of_closing(cosine_lobe, hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x)));
        specular.write(count + 1, hn::Or(hn::Ne(height_lobe, zero), hn::Ne(cosine_lobe, zero)),
                       hn::Mul(height_lobe, height_lobe), cosine_lobe, height_lobe);
    }
    return {nearest2, hn::Or(hn::Gt(highest, zero), hn::Ge(lowest, zero))};
}

}  // namespace HWY_NAMESPACE
}  // namespace surimi
HWY_AFTER_NAMESPACE();

#endif
