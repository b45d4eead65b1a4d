// SPDX-License-Identifier: Apache-2.0
#include "runtime/batch/polygon_job.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "runtime/batch/add_polygon.cpp"  // this file again, for each instruction set
#include <hwy/foreach_target.h>

#include "runtime/batch/arc-inl.h"
#include "runtime/batch/contour-inl.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace surimi {
namespace HWY_NAMESPACE {

/// Numbers of one block's edges and results; T is what the sums are made in.
template <class T>
struct Workspace {
    static constexpr size_t most_lanes = hn::MaxLanes(hn::ScalableTag<T>());
    explicit Workspace(size_t corners)
        : diffuse(hwy::AllocateAligned<T>(3 * most_lanes * (corners + 1))),
          specular(hwy::AllocateAligned<T>(3 * most_lanes * (corners + 2))),
          needs_diffuse(corners + 1),
          needs_specular(corners + 2) {}
    hwy::AlignedFreeUniquePtr<T[]> diffuse, specular;    ///< edges: 3 x lanes each, see ArcWriter
    std::vector<uint8_t> needs_diffuse, needs_specular;  ///< edges that some lane has
    HWY_ALIGN std::array<T, most_lanes> diffuse_share, specular_share, share_above;
    HWY_ALIGN std::array<T, most_lanes> soundness, trust, aboveness;  ///< 1 or 0
};

/// The sum over edges as a share in [0, 1], 0 where it is not finite, by (M1); clears `is_trusted` where an edge's
/// numbers leave the range in which T has all its digits (M15).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V share_of(D d, const hn::TFromD<D>* arcs, std::span<const uint8_t> is_needed, bool is_two_sided, V above,
                      hn::Mask<D>& is_trusted) {
    using T = hn::TFromD<D>;
    const size_t lanes = hn::Lanes(d);
    V sum = hn::Zero(d);
    for (size_t i = 0; i < is_needed.size(); ++i) {
        if (!is_needed[i]) continue;
        const T* at = arcs + 3 * lanes * i;
        const V sine2 = hn::Load(d, at), cosine = hn::Load(d, at + lanes), height = hn::Load(d, at + 2 * lanes);
        sum = hn::Add(sum, arc(d, sine2, cosine, height));
        if constexpr (sizeof(T) == sizeof(float)) {
            const V most = hn::Set(d, 1e36f);
            const auto is_large = hn::Not(hn::And(hn::Lt(sine2, most), hn::Lt(hn::Mul(cosine, cosine), most)));
            const auto is_small =
                hn::And(hn::Lt(sine2, hn::Set(d, least_sine2)), hn::Lt(cosine, hn::Set(d, least_cosine)));
            is_trusted = hn::AndNot(hn::Or(is_large, is_small), is_trusted);
        }
    }
    // Seen from the front, counter-clockwise corners circle the direction to the polygon clockwise.
    const V value = hn::Div(hn::Mul(sum, hn::Set(d, static_cast<T>(-0.5 / pi))), above);
    const V shown = is_two_sided ? hn::Abs(value) : value;
    return hn::IfThenElseZero(hn::Gt(shown, hn::Zero(d)), hn::Min(shown, hn::Set(d, T(1))));
}

/// The shares of one block, as many points from `begin` on as T has lanes.
template <class T>
HWY_INLINE void evaluate_block(const PolygonJob& job, const BlockInput& in, size_t begin, Workspace<T>& work) {
    const hn::ScalableTag<T> d;
    const D64 wide;
    const V64 one = hn::Set(wide, 1.0);
    const size_t lanes = hn::Lanes(d);
    std::fill(work.needs_diffuse.begin(), work.needs_diffuse.end(), uint8_t{0});
    std::fill(work.needs_specular.begin(), work.needs_specular.end(), uint8_t{0});
    // Geometry is double, in as many parts as fill the lanes.
    for (size_t first = 0; first < lanes; first += hn::Lanes(wide)) {
        const Receivers receivers = load_receivers(in, begin + first, job.scale, job.has_specular);
        const ArcWriter<T> diffuse(work.diffuse.get(), work.needs_diffuse.data(), lanes, first);
        const ArcWriter<T> specular(work.specular.get(), work.needs_specular.data(), lanes, first);
        const Sight sight = write_contour(job, receivers, diffuse, specular);
        const auto is_near = hn::Lt(sight.nearest2, hn::Set(wide, job.far2));
        store_as(hn::IfThenElseZero(receivers.is_sound, one), &work.soundness[first]);
        store_as(hn::IfThenElseZero(is_near, one), &work.trust[first]);
        store_as(hn::IfThenElseZero(sight.is_above, one), &work.aboveness[first]);
        if (job.has_specular)
            store_as(hn::LoadU(wide, in.field[static_cast<size_t>(Field::share_above)] + begin + first),
                     &work.share_above[first]);
    }
    const auto all = hn::Set(d, T(1));
    auto is_trusted = hn::Gt(hn::Load(d, work.trust.data()), hn::Zero(d));
    const auto is_above = hn::Gt(hn::Load(d, work.aboveness.data()), hn::Zero(d));
    if (job.has_diffuse) {
        const auto share = share_of(d, work.diffuse.get(), work.needs_diffuse, job.is_two_sided, all, is_trusted);
        hn::Store(hn::IfThenElseZero(is_above, share), d, work.diffuse_share.data());
    }
    if (job.has_specular) {
        const auto above = hn::Load(d, work.share_above.data());
        const auto share = share_of(d, work.specular.get(), work.needs_specular, job.is_two_sided, above, is_trusted);
        hn::Store(hn::IfThenElseZero(is_above, share), d, work.specular_share.data());
    }
    hn::Store(hn::IfThenElseZero(is_trusted, all), d, work.trust.data());
}

/// Points that do not fill a block, or do not lie side by side, copied side by side; the last one fills the rest.
template <size_t N>
class GatheredPoints {
  public:
    BlockInput gather(const BlockInput& all, std::span<const uint32_t> indices) {
        BlockInput block{};
        for (size_t f = 0; f < numbers_.size(); ++f) {
            if (!all.field[f]) continue;
            for (size_t i = 0; i < N; ++i) numbers_[f][i] = all.field[f][indices[std::min(i, indices.size() - 1)]];
            block.field[f] = numbers_[f].data();
        }
        return block;
    }

  private:
    std::array<std::array<double, N>, static_cast<size_t>(Field::count)> numbers_{};
};

/// Adds a block's results to those of its points; the ones that T cannot be trusted with go to `again`.
template <class T>
HWY_INLINE void add_block(const PolygonJob& job, const Workspace<T>& work, std::span<const uint32_t> indices,
                          ShareBatch& shares, std::vector<uint32_t>* again) {
    for (size_t i = 0; i < indices.size(); ++i) {
        const uint32_t index = indices[i];
        if (!job.is_wanted.empty() && !job.is_wanted[index]) continue;
        if (!(work.soundness[i] > 0)) {
            ++shares.not_finite;
        } else if (again && !(work.trust[i] > 0)) {
            again->push_back(index);
        } else {
            if (job.has_diffuse) shares.diffuse[index] += static_cast<double>(work.diffuse_share[i]);
            if (job.has_specular) shares.specular[index] += static_cast<double>(work.specular_share[i]);
        }
    }
}

/// The points of `indices`, in any order, in T.
template <class T>
void evaluate_listed(const PolygonJob& job, const BlockInput& all, std::span<const uint32_t> indices,
                     ShareBatch& shares, std::vector<uint32_t>* again) {
    const size_t lanes = hn::Lanes(hn::ScalableTag<T>());
    Workspace<T> work(job.corners.size());
    GatheredPoints<Workspace<T>::most_lanes> gathered;
    for (size_t i = 0; i < indices.size(); i += lanes) {
        const auto block = indices.subspan(i, std::min(lanes, indices.size() - i));
        evaluate_block(job, gathered.gather(all, block), 0, work);
        add_block(job, work, block, shares, again);
    }
}

/// All points in T.
template <class T>
void evaluate_all(const PolygonJob& job, const BlockInput& all, size_t count, ShareBatch& shares,
                  std::vector<uint32_t>* again) {
    const size_t lanes = hn::Lanes(hn::ScalableTag<T>());
    Workspace<T> work(job.corners.size());
    std::array<uint32_t, Workspace<T>::most_lanes> indices{};
    size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        if (!job.is_wanted.empty() && std::ranges::count(job.is_wanted.subspan(i, lanes), 0) == std::ptrdiff_t(lanes))
            continue;
        evaluate_block(job, all, i, work);
        for (size_t k = 0; k < lanes; ++k) indices[k] = static_cast<uint32_t>(i + k);
        add_block<T>(job, work, {indices.data(), lanes}, shares, again);
    }
    for (size_t k = 0; k < count - i; ++k) indices[k] = static_cast<uint32_t>(i + k);
    evaluate_listed<T>(job, all, {indices.data(), count - i}, shares, again);
}

void run_polygon_job(const PolygonJob& job, const BlockInput& all, size_t count, Precision precision,
                     ShareBatch& shares) {
    if (precision == Precision::full) return evaluate_all<double>(job, all, count, shares, nullptr);
    std::vector<uint32_t> again;
    evaluate_all<float>(job, all, count, shares, &again);
    evaluate_listed<double>(job, all, again, shares, nullptr);
}

}  // namespace HWY_NAMESPACE
}  // namespace surimi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surimi {
namespace {

HWY_EXPORT(run_polygon_job);

/// Lights of less than this angle (extent over distance, rad) keep more digits than the sums of `mixed` have.
constexpr double tiny_angle = 1e-2;

/// False where a corner is not finite.
bool prepare(PolygonJob& job, std::span<const Vec3> corners) {
    double extent = 0;
    for (const Vec3& corner : corners) {
        if (!is_finite(corner)) return false;
        const Vec3 offset = glm::abs(corner - corners[0]);
        extent = std::max({extent, offset.x, offset.y, offset.z});
    }
    if (extent > 0 && std::isfinite(extent)) job.scale = std::ldexp(1.0, std::clamp(-std::ilogb(extent), -1000, 1000));
    job.far2 = std::pow(extent * job.scale / tiny_angle, 2);
    for (size_t i = 0; i < corners.size(); ++i) {
        job.corners.push_back(corners[i] * job.scale);
        job.edges.push_back((corners[i] - corners[i > 0 ? i - 1 : corners.size() - 1]) * job.scale);
    }
    return true;
}

BlockInput fields_of(const PointBatch& points, const LobeBatch& lobes) {
    const Vec3Batch &p = points.position, &n = points.normal, &t = lobes.tangent;
    BlockInput in{{p.x.data(), p.y.data(), p.z.data(), n.x.data(), n.y.data(), n.z.data()}};
    if (lobes.albedo.empty()) return in;
    const std::array<const std::vector<double>*, 9> rest = {
        &t.x, &t.y, &t.z, &lobes.xx, &lobes.xz, &lobes.zx, &lobes.zz, &lobes.share_above, &lobes.albedo};
    for (size_t i = 0; i < rest.size(); ++i) in.field[6 + i] = rest[i]->data();
    return in;
}

}  // namespace

void add_polygon(const PointBatch& points, const LobeBatch& lobes, std::span<const Vec3> corners, bool two_sided,
                 Terms terms, Precision precision, std::span<const uint8_t> is_wanted, ShareBatch& shares) {
    if (points.size() == 0 || corners.size() < 3) return;
    PolygonJob job;
    job.is_two_sided = two_sided;
    job.has_diffuse = terms != Terms::specular;
    job.has_specular = terms != Terms::diffuse;
    job.is_wanted = is_wanted;
    if (!prepare(job, corners)) {
        shares.not_finite += is_wanted.empty() ? points.size() : points.size() - std::ranges::count(is_wanted, 0);
        return;
    }
    HWY_DYNAMIC_DISPATCH(run_polygon_job)(job, fields_of(points, lobes), points.size(), precision, shares);
}

}  // namespace surimi
#endif
