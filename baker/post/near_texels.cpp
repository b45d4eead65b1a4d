// SPDX-License-Identifier: Apache-2.0
#include "baker/post/near_texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <nanoflann.hpp>

namespace surimi {
namespace {

constexpr double least_agreement = 0.5;  // cosine between two normals of one side: a hexagon's corners
constexpr double other_chart = 0.25;     // weight of a source of another chart, which may be another surface in contact
constexpr double thickness = 0.05;       // of a texel: what lies that far above or below is another layer
constexpr double least_reach = 1.5;      // texels; takes in the diagonal neighbours
constexpr size_t most_sources = 12;

/// Does `source` lie on the surface of `place`, on the same side of it? Along a bent surface the way between two
/// points is at right angles to the mean of their normals; for facets that meet, to half the angle between them (M62).
bool is_same_side(const TexelPlace& place, const TexelPlace& source, double cosine) {
    if (!(cosine > least_agreement)) return false;
    if (place.chart == source.chart) return true;  // it hangs together, and only near texels are asked about
    const Vec3 way = source.position - place.position, mean = 0.5 * (place.normal + source.normal);
    const double bend = std::sqrt(std::max(0.0, 0.5 * (1 - cosine)));  // sine of half the angle
    return std::abs(glm::dot(mean, way)) <=
           glm::length(mean) * (bend * glm::length(way) + thickness * std::max(place.size, source.size));
}

/// The nearest of what the tree offers that lies on the same side, by distance and number. In the form that nanoflann
/// wants of a result.
class NearestOnSide {
  public:
    using DistanceType = double;
    using IndexType = uint32_t;

    NearestOnSide(const TexelPlace& place, const std::vector<TexelPlace>& sources, double radius)
        : place_(place), sources_(sources), radius2_(radius * radius) {}

    size_t size() const { return count_; }
    bool full() const { return true; }
    /// The tree asks for what is nearer than this: a hair more, so that among equals the number decides.
    double worstDist() const {
        const double worst = count_ == found_.size() ? found_.back().distance2 : radius2_;
        return std::nextafter(worst, std::numeric_limits<double>::infinity());
    }
    bool addPoint(double distance2, uint32_t index) {
        const TexelPlace& source = sources_[index];
        const Found found{distance2, index, glm::dot(place_.normal, source.normal)};
        const bool is_full = count_ == found_.size();
        if (is_full && !(found < found_.back())) return true;
        if (!is_same_side(place_, source, found.cosine)) return true;
        size_t i = is_full ? count_ - 1 : count_++;
        for (; i > 0 && found < found_[i - 1]; --i) found_[i] = found_[i - 1];
        found_[i] = found;
        return true;
    }

    /// (M62). There is at least one.
    double mean() const {
        const double nearest2 = found_[0].distance2, least = least_reach * place_.size;
        double reach2 = std::max(4 * nearest2, least * least);
        if (count_ == found_.size()) reach2 = std::min(reach2, found_.back().distance2);
        double sum = 0, weights = 0, plain = 0;
        for (size_t i = 0; i < count_; ++i) {
            const TexelPlace& source = sources_[found_[i].index];
            const double falloff = reach2 > 0 ? std::max(0.0, 1 - found_[i].distance2 / reach2) : 1;
            const double agreement = (found_[i].cosine - least_agreement) / (1 - least_agreement);
            const double weight = falloff * falloff * agreement * (source.chart == place_.chart ? 1 : other_chart);
            sum += weight * static_cast<double>(source.visibility);
            weights += weight;
            plain += static_cast<double>(source.visibility);
        }
        return weights > 0 ? sum / weights : plain / static_cast<double>(count_);
    }

  private:
    struct Found {
        double distance2 = 0;  // square metres
        uint32_t index = 0;
        double cosine = 0;  // between the normals
        bool operator<(const Found& b) const { return std::pair(distance2, index) < std::pair(b.distance2, b.index); }
    };

    const TexelPlace& place_;
    const std::vector<TexelPlace>& sources_;
    double radius2_;
    size_t count_ = 0;
    std::array<Found, most_sources + 1> found_{};  // the last only says how far the others reach
};

/// Sources in the form that nanoflann wants of a data set.
struct Positions {
    const std::vector<TexelPlace>& sources;
    size_t kdtree_get_point_count() const { return sources.size(); }
    double kdtree_get_pt(uint32_t index, size_t axis) const {
        return sources[index].position[static_cast<glm::length_t>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using Metric = nanoflann::L2_Simple_Adaptor<double, Positions, double, uint32_t>;
using Index = nanoflann::KDTreeSingleIndexAdaptor<Metric, Positions, 3, uint32_t>;

}  // namespace

struct NearTexels::Tree {
    explicit Tree(std::vector<TexelPlace> places) : sources(std::move(places)), index(3, positions) {}

    std::vector<TexelPlace> sources;
    Positions positions{sources};
    Index index;
};

NearTexels::NearTexels(std::vector<TexelPlace> sources) : tree_(std::make_unique<const Tree>(std::move(sources))) {}

NearTexels::~NearTexels() = default;

std::optional<float> NearTexels::mean(const TexelPlace& place, double radius) const {
    if (tree_->sources.empty()) return std::nullopt;
    NearestOnSide nearest(place, tree_->sources, radius);
    tree_->index.findNeighbors(nearest, &place.position.x, nanoflann::SearchParams());
    if (nearest.size() == 0) return std::nullopt;
    return std::clamp(static_cast<float>(nearest.mean()), 0.f, 1.f);
}

}  // namespace surimi
