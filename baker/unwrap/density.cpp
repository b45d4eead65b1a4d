// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/density.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "baker/unwrap/reach.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

/// Density of charts that no light reaches: 11 to 26 % of the five rooms' area, which then has at most 0.54 % of the
/// texels. A quarter costs the room 1 % of its density, a sixteenth gives it 0.4 %.
constexpr double unreached_density = 0.125;
/// In typical distances. The far wall of a room lies at two to three.
constexpr double far_away = 3;
constexpr double falloff = 4.0 / 3;
/// Only where hardly anything is near: twice the falloff already leaves a plane of 200 m less than a wall of the room.
constexpr double steepest_falloff = 4;

/// A panel, or one that stands for several of them, as a point light.
struct Lamp {
    Vec3 centre{0};
    Vec3 normal{0};  ///< unit
    double area = 0;
    double size = 0;  ///< radius of the disk of the same area: nearer than that, distance means nothing
    int monitor = 0;
    bool is_two_sided = false;
};

/// A curved wall of thousands of panels need not be summed up for every triangle: so many stand for all, evenly by
/// area.
constexpr size_t most_lamps = 64;

void add_lamps(const Monitor& monitor, int number, std::vector<Lamp>& lamps) {
    std::vector<Lamp> all;
    double total = 0;
    for (const Polygon& polygon : monitor.panels) {
        Lamp lamp{Vec3(0), front_normal(polygon), area(polygon), 0, number, monitor.two_sided};
        for (const Vec3& corner : polygon.corners) lamp.centre += corner / static_cast<double>(polygon.corners.size());
        total += lamp.area;
        all.push_back(lamp);
    }
    const size_t count = std::min(all.size(), most_lamps);
    double passed = 0;
    size_t next = 0;
    for (size_t i = 0; i < count; ++i) {
        Lamp lamp = all[i];
        if (all.size() > most_lamps) {
            const double wanted = (static_cast<double>(i) + 0.5) / most_lamps * total;
            while (next + 1 < all.size() && passed + all[next].area < wanted) passed += all[next++].area;
            lamp = all[next];
            lamp.area = total / most_lamps;
        }
        lamp.size = std::sqrt(lamp.area / pi);
        lamps.push_back(lamp);
    }
}

struct Piece {
    double distance = 0;  ///< to the nearest lamp
    double area = 0;
    double light = 0;  ///< about the flux that reaches it, nothing in between
};

/// Collects the area of a chart in pieces no larger than their distance.
class Pieces {
  public:
    Pieces(const std::vector<Lamp>& lamps, int own_monitor, std::vector<Piece>& pieces)
        : lamps_(lamps), own_monitor_(own_monitor), pieces_(pieces) {}

    void add(const Vec3& a, const Vec3& b, const Vec3& c, int depth) {
        const Piece piece = make_piece((a + b + c) / 3.0, area_normal(a, b, c));
        const double longest = std::max(glm::length(b - a), std::max(glm::length(c - b), glm::length(a - c)));
        constexpr int deepest = 6;  // 4096 pieces of one triangle
        if (depth == deepest || longest <= piece.distance) {
            pieces_.push_back(piece);
            return;
        }
        const Vec3 ab = 0.5 * (a + b);
        const Vec3 bc = 0.5 * (b + c);
        const Vec3 ca = 0.5 * (c + a);
        add(a, ab, ca, depth + 1);
        add(ab, b, bc, depth + 1);
        add(ca, bc, c, depth + 1);
        add(ab, bc, ca, depth + 1);
    }

  private:
    Piece make_piece(const Vec3& centre, const Vec3& twice_area) const {
        Piece piece{INFINITY, 0.5 * glm::length(twice_area), 0};
        for (const Lamp& lamp : lamps_) {
            const Vec3 to_lamp = lamp.centre - centre;
            const double length = glm::length(to_lamp);
            const double distance = std::max(lamp.size, length);
            piece.distance = std::min(piece.distance, distance);
            if (!(length > 0) || lamp.monitor == own_monitor_) continue;
            double leaving = -glm::dot(lamp.normal, to_lamp) / length;
            if (lamp.is_two_sided) leaving = std::abs(leaving);
            const double arriving = 0.5 * glm::dot(twice_area, to_lamp) / length;
            if (leaving > 0 && arriving > 0) piece.light += leaving * arriving * lamp.area / (distance * distance);
        }
        return piece;
    }

    const std::vector<Lamp>& lamps_;
    int own_monitor_;
    std::vector<Piece>& pieces_;
};

/// Median distance of all pieces, weighted with their light; 0 when nothing is lit.
double typical_distance(const std::vector<std::vector<Piece>>& charts) {
    std::vector<Piece> all;
    double total = 0;
    for (const auto& pieces : charts) {
        for (const Piece& p : pieces) {
            if (p.light > 0) all.push_back(p);
            total += p.light;
        }
    }
    std::sort(all.begin(), all.end(), [](const Piece& l, const Piece& r) {
        return l.distance != r.distance ? l.distance < r.distance : l.light < r.light;
    });
    double sum = 0;
    for (const Piece& p : all) {
        sum += p.light;
        if (sum >= 0.5 * total) return p.distance;
    }
    return 0;
}

/// Distance from the nearest lamp, averaged over the area.
double mean_distance(const std::vector<Piece>& pieces) {
    double area = 0;
    double sum = 0;
    for (const Piece& p : pieces) {
        area += p.area;
        sum += p.area * p.distance;
    }
    return area > 0 ? sum / area : 0;
}

/// What of the texels charts beyond the far distance may take together.
constexpr double far_share = 0.5;

/// Gives the charts that are far (`excess` > 1 in far distances) their weights: steeper than the falloff where that
/// would leave them too much, so that there is no step where far begins.
void weigh_far(const std::vector<FlatChart>& charts, const std::vector<double>& excess,
               std::vector<ChartWeight>& weights) {
    const auto share_at = [&](double exponent) {
        double near = 0;
        double far = 0;
        for (size_t c = 0; c < charts.size(); ++c) {
            const double texels = charts[c].area * weights[c].unreached * weights[c].unreached;
            if (excess[c] > 1)
                far += texels * std::pow(excess[c], -2 * exponent);
            else
                near += texels;
        }
        return near > 0 ? far / (near + far) : 0;
    };
    double exponent = falloff;
    if (share_at(exponent) > far_share) {
        double low = falloff;
        exponent = steepest_falloff;
        for (int i = 0; i < 10; ++i) {  // to 0.003
            const double middle = 0.5 * (low + exponent);
            (share_at(middle) > far_share ? low : exponent) = middle;
        }
    }
    for (size_t c = 0; c < charts.size(); ++c)
        if (excess[c] > 1) weights[c].far = std::pow(excess[c], -exponent);
}

}  // namespace

double density_factor(const ChartWeight& weight) {
    return weight.unreached * weight.far * weight.scale;
}

std::vector<ChartWeight> wished_weights(const std::vector<FlatChart>& charts, const std::vector<double>& scales) {
    std::vector<ChartWeight> weights(charts.size());
    for (size_t c = 0; c < charts.size(); ++c)
        if (!charts[c].is_sliver) weights[c].scale = scales[charts[c].surface];
    return weights;
}

std::vector<ChartWeight> weigh_charts(const Scene& scene, const std::vector<FlatChart>& charts,
                                      const std::vector<double>& scales) {
    std::vector<ChartWeight> weights = wished_weights(charts, scales);
    std::vector<Lamp> lamps;
    for (size_t m = 0; m < scene.monitors.size(); ++m) add_lamps(scene.monitors[m], static_cast<int>(m), lamps);
    if (lamps.empty()) return weights;
    const PanelPlanes planes = panel_planes(scene);
    std::vector<std::vector<Piece>> pieces(charts.size());
    std::vector<char> is_lit(charts.size(), 1);
    constexpr size_t grain = 16;  // charts: some are one triangle, some thousands
    parallel_for(charts.size(), grain, [&](size_t c) {
        if (charts[c].is_sliver) return;
        const Surface& surface = scene.surfaces[charts[c].surface];
        is_lit[c] = is_reached(planes, surface, charts[c].faces) ? 1 : 0;
        Pieces collector(lamps, surface.monitor, pieces[c]);
        for (const uint32_t f : charts[c].faces) {
            const auto& t = surface.triangles[f];
            collector.add(surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]], 0);
        }
    });
    const double typical = typical_distance(pieces);
    if (!(typical > 0)) return weights;
    std::vector<double> excess(charts.size());
    for (size_t c = 0; c < charts.size(); ++c) {
        if (is_lit[c] == 0) weights[c].unreached = unreached_density;
        excess[c] = mean_distance(pieces[c]) / (far_away * typical);
    }
    weigh_far(charts, excess, weights);
    return weights;
}

std::vector<DensityWeight> list_weights(const std::vector<FlatChart>& charts, const std::vector<ChartWeight>& weights) {
    std::map<std::pair<uint32_t, DensityCause>, DensityWeight> found;
    std::map<uint32_t, double> surface_area;
    double texels = 0;
    for (size_t c = 0; c < charts.size(); ++c) {
        const double factor = density_factor(weights[c]) * weights[c].page;
        const double own_texels = charts[c].area * factor * factor;
        texels += own_texels;
        surface_area[charts[c].surface] += charts[c].area;
        for (const auto& [cause, value] :
             {std::pair{DensityCause::unreached, weights[c].unreached}, std::pair{DensityCause::far, weights[c].far},
              std::pair{DensityCause::texel_scale, weights[c].scale},
              std::pair{DensityCause::full_page, weights[c].page}}) {
            if (value == 1) continue;
            const auto [entry, is_new] =
                found.try_emplace({charts[c].surface, cause}, DensityWeight{charts[c].surface, cause});
            DensityWeight& weight = entry->second;
            weight.charts += 1;
            weight.area += charts[c].area;
            weight.texel_share += own_texels;
            weight.least = is_new ? value : std::min(weight.least, value);
            weight.most = is_new ? value : std::max(weight.most, value);
        }
    }
    std::vector<DensityWeight> list;
    for (auto& [key, weight] : found) {
        weight.area_share = weight.area / surface_area[weight.surface];
        weight.texel_share /= texels;
        list.push_back(weight);
    }
    return list;
}

const char* name_of(DensityCause cause) {
    switch (cause) {
        case DensityCause::unreached:
            return "unreached";
        case DensityCause::far:
            return "far";
        case DensityCause::texel_scale:
            return "texel_scale";
        case DensityCause::full_page:
            return "full_page";
    }
    return "";
}

}  // namespace surimi
