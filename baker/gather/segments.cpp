// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/segments.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "baker/gather/segments.cpp"  // this file again, for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <array>

#ifndef SURIMI_BAKER_GATHER_SEGMENTS_ONCE
#define SURIMI_BAKER_GATHER_SEGMENTS_ONCE
namespace surimi {

/// A plane through the view's origin, on whose positive side the open part of the panel lies; acts on x - origin.
using ConeSide = Vec3;

constexpr size_t padding = 8;  // lanes of double in the widest set

}  // namespace surimi
#endif

HWY_BEFORE_NAMESPACE();
namespace surimi {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, padding>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

HWY_INLINE V dot(const Vec3& row, V x, V y, V z) {
    const D d;
    return hn::MulAdd(hn::Set(d, row.x), x, hn::MulAdd(hn::Set(d, row.y), y, hn::Mul(hn::Set(d, row.z), z)));
}

/// +1 where the place is in front of the plane or in it, else -1.
HWY_INLINE V side_of(const Vec3& place, V nx, V ny, V nz, V distance) {
    const D d;
    const V value = hn::MulAdd(hn::Set(d, place.x), nx,
                               hn::MulAdd(hn::Set(d, place.y), ny, hn::MulSub(hn::Set(d, place.z), nz, distance)));
    return hn::IfThenElse(hn::Ge(value, hn::Zero(d)), hn::Set(d, 1.0), hn::Set(d, -1.0));
}

/// The part [low, high] of each lane's edge that is left, and which side cut its ends.
struct Clip {
    V low, high, low_side, high_side;
    M is_left;
};

/// Keeps the part where the value, affine along the edge from v0 to v1, is not negative.
HWY_INLINE void clip(Clip& part, V v0, V v1, double side) {
    const D d;
    const V zero = hn::Zero(d);
    const M out0 = hn::Lt(v0, zero), out1 = hn::Lt(v1, zero);
    part.is_left = hn::AndNot(hn::And(out0, out1), part.is_left);
    const M crosses = hn::And(part.is_left, hn::Xor(out0, out1));
    if (hn::AllFalse(d, crosses)) return;
    const V at = hn::Div(v0, hn::Sub(v0, v1));
    const M raises = hn::And(crosses, hn::And(out0, hn::Gt(at, part.low)));
    const M lowers = hn::And(crosses, hn::And(out1, hn::Lt(at, part.high)));
    part.low = hn::IfThenElse(raises, at, part.low);
    part.low_side = hn::IfThenElse(raises, hn::Set(d, side), part.low_side);
    part.high = hn::IfThenElse(lowers, at, part.high);
    part.high_side = hn::IfThenElse(lowers, hn::Set(d, side), part.high_side);
    part.is_left = hn::And(part.is_left, hn::Lt(part.low, part.high));
}

struct Projection {
    V x, y;
};

/// The place `at` along an edge, where that end was clipped, and its projection.
HWY_INLINE Projection projected(const PanelView& view, V x, V y, V z) {
    const D d;
    const V inverse = hn::Div(hn::Set(d, 1.0), dot(view.row_w, x, y, z));
    return {hn::Mul(dot(view.row_s, x, y, z), inverse), hn::Mul(dot(view.row_t, x, y, z), inverse)};
}

HWY_INLINE void store(Segments& out, const std::array<V, 7>& values, M mask) {
    const D d;
    const std::array<double*, 7> to = {out.x0.data(),   out.y0.data(),    out.x1.data(),   out.y1.data(),
                                       out.jump.data(), out.side0.data(), out.side1.data()};
    for (size_t i = 0; i < to.size(); ++i) hn::CompressStore(values[i], mask, d, to[i] + out.count);
    const size_t before = out.count;
    out.count += hn::CountTrue(d, mask);
    const M is_on_side = hn::Or(hn::Ge(values[5], hn::Zero(d)), hn::Ge(values[6], hn::Zero(d)));
    if (hn::AllFalse(d, hn::And(mask, is_on_side))) return;
    for (size_t i = before; i < out.count; ++i)
        if (out.side0[i] >= 0 || out.side1[i] >= 0) out.on_sides.push_back(static_cast<uint32_t>(i));
}

void project_all(const Candidates& all, size_t first_cut, const PanelView& view, std::span<const ConeSide> cone,
                 Segments& out) {
    const D d;
    const size_t lanes = hn::Lanes(d);
    const V one = hn::Set(d, 1.0), none = hn::Set(d, -1.0);
    const Vec3& p = view.origin;
    const V px = hn::Set(d, p.x), py = hn::Set(d, p.y), pz = hn::Set(d, p.z);
    out.count = 0;
    out.on_sides.clear();
    for (size_t i = 0; i < all.count; i += lanes) {
        const V first = side_of(p, hn::LoadU(d, &all.nx[i]), hn::LoadU(d, &all.ny[i]), hn::LoadU(d, &all.nz[i]),
                                hn::LoadU(d, &all.nd[i]));
        const V second = side_of(p, hn::LoadU(d, &all.mx[i]), hn::LoadU(d, &all.my[i]), hn::LoadU(d, &all.mz[i]),
                                 hn::LoadU(d, &all.md[i]));
        const V jump = hn::MulAdd(hn::LoadU(d, &all.second[i]), second, first);
        Clip part{hn::Zero(d), one, none, none, hn::Ne(jump, hn::Zero(d))};
        part.is_left = hn::And(part.is_left, hn::FirstN(d, all.count - i));
        if (hn::AllFalse(d, part.is_left)) continue;
        const V ax = hn::Sub(hn::LoadU(d, &all.ax[i]), px), ay = hn::Sub(hn::LoadU(d, &all.ay[i]), py),
                az = hn::Sub(hn::LoadU(d, &all.az[i]), pz);
        const V bx = hn::Sub(hn::LoadU(d, &all.bx[i]), px), by = hn::Sub(hn::LoadU(d, &all.by[i]), py),
                bz = hn::Sub(hn::LoadU(d, &all.bz[i]), pz);
        for (size_t k = 0; k < cone.size(); ++k)
            clip(part, dot(cone[k], ax, ay, az), dot(cone[k], bx, by, bz), static_cast<double>(k));
        if (hn::AllFalse(d, part.is_left)) continue;
        if (i < first_cut) {  // a block of lanes never holds both kinds, see Candidates::append
            const V end = hn::Set(d, view.end);
            clip(part, hn::Sub(end, dot(view.row_w, ax, ay, az)), hn::Sub(end, dot(view.row_w, bx, by, bz)), -2);
        }
        // The cone's apex projects nowhere.
        const V near = hn::Set(d, 1e-9);
        clip(part, hn::Sub(dot(view.row_w, ax, ay, az), near), hn::Sub(dot(view.row_w, bx, by, bz), near), -2);
        if (hn::AllFalse(d, part.is_left)) continue;
        // Ends that were not clipped keep their digits: edges that share a vertex project it alike.
        const auto end_of = [&](V at, M is_clipped, V x, V y, V z) {
            const V cx = hn::MulAdd(at, hn::Sub(bx, ax), ax), cy = hn::MulAdd(at, hn::Sub(by, ay), ay),
                    cz = hn::MulAdd(at, hn::Sub(bz, az), az);
            return projected(view, hn::IfThenElse(is_clipped, cx, x), hn::IfThenElse(is_clipped, cy, y),
                             hn::IfThenElse(is_clipped, cz, z));
        };
        const Projection a = end_of(part.low, hn::Gt(part.low, hn::Zero(d)), ax, ay, az);
        const Projection b = end_of(part.high, hn::Lt(part.high, one), bx, by, bz);
        store(out, {a.x, a.y, b.x, b.y, jump, part.low_side, part.high_side}, part.is_left);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace surimi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surimi {
namespace {

HWY_EXPORT(project_all);

/// Planes through the origin and the sides of view.open, inwards: for a side from u to v the points x of its left have
/// (x_s, x_t, x_w) . (v - u) turned and lifted >= 0.
std::vector<ConeSide>& cone_of(const PanelView& view, std::vector<ConeSide>& cone) {
    cone.clear();
    for (size_t i = 0; i < view.open.size(); ++i) {
        const Vec2 &u = view.open[i], &v = view.open[i + 1 < view.open.size() ? i + 1 : 0];
        const Vec2 inward(u.y - v.y, v.x - u.x);
        cone.push_back(inward.x * view.row_s + inward.y * view.row_t - glm::dot(inward, u) * view.row_w);
    }
    return cone;
}

}  // namespace

void Candidates::add(const Silhouettes& silhouettes, uint32_t index) {
    const Edge& edge = silhouettes.edges[index];
    ax.push_back(edge.a.x), ay.push_back(edge.a.y), az.push_back(edge.a.z);
    bx.push_back(edge.b.x), by.push_back(edge.b.y), bz.push_back(edge.b.z);
    const FacePlane& n = silhouettes.planes[edge.first()];
    const FacePlane& m = edge.has_second() ? silhouettes.planes[edge.second()] : n;
    nx.push_back(n.normal.x), ny.push_back(n.normal.y), nz.push_back(n.normal.z), nd.push_back(n.distance);
    mx.push_back(m.normal.x), my.push_back(m.normal.y), mz.push_back(m.normal.z), md.push_back(m.distance);
    second.push_back(!edge.has_second() ? 0 : edge.runs_alike() ? 1 : -1);
    ++count;
}

void Candidates::assign(const Silhouettes& silhouettes, std::span<const uint32_t> edges) {
    for (auto* numbers : {&ax, &ay, &az, &bx, &by, &bz, &nx, &ny, &nz, &nd, &mx, &my, &mz, &md, &second})
        numbers->clear();
    count = 0;
    for (const uint32_t edge : edges) add(silhouettes, edge);
}

void Candidates::append(const Silhouettes& cuts, std::span<const uint32_t> edges) {
    if (edges.empty()) return;
    finish();
    count = ax.size();
    for (const uint32_t edge : edges) add(cuts, edge);
}

void Candidates::finish() {
    // Equal planes of opposite sense are never a silhouette.
    for (auto* numbers : {&ax, &ay, &az, &bx, &by, &bz, &nx, &ny, &nz, &nd, &mx, &my, &mz, &md})
        numbers->resize((count + padding - 1) / padding * padding, 0.0);
    second.resize(ax.size(), -1.0);
}

void project(const Candidates& candidates, size_t first_cut, const PanelView& view, Segments& segments) {
    const size_t room = candidates.ax.size() + padding;
    if (segments.x0.size() < room)
        for (auto* numbers :
             {&segments.x0, &segments.y0, &segments.x1, &segments.y1, &segments.jump, &segments.side0, &segments.side1})
            numbers->resize(room);
    thread_local std::vector<ConeSide> cone;
    HWY_DYNAMIC_DISPATCH(project_all)(candidates, first_cut, view, cone_of(view, cone), segments);
}

}  // namespace surimi
#endif
