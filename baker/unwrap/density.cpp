// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/density.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "runtime/base/parallel.h"

namespace surimi {
namespace {

/// Surfaces on average further than this many typical distances are capped. The far wall of a room lies at
/// two to three.
constexpr double far_away = 3;

struct Panel {
    Vec3 centre{0};
    Vec3 normal{0};  ///< unit
    double area = 0;
    double size = 0;  ///< radius of the disk of the same area: nearer than that, distance means nothing
    bool is_two_sided = false;
};

std::vector<Panel> collect_panels(const Scene& scene) {
    std::vector<Panel> panels;
    for (const Monitor& monitor : scene.monitors) {
        for (const Polygon& polygon : monitor.panels) {
            Panel panel;
            Vec3 twice_area(0);
            for (size_t i = 0; i < polygon.corners.size(); ++i) {
                panel.centre += polygon.corners[i] / static_cast<double>(polygon.corners.size());
                twice_area += glm::cross(polygon.corners[i] - polygon.corners[0],
                                         polygon.corners[(i + 1) % polygon.corners.size()] - polygon.corners[0]);
            }
            panel.area = 0.5 * glm::length(twice_area);
            panel.normal = normalize_or(twice_area, Vec3(0));
            panel.size = std::sqrt(panel.area / pi);
            panel.is_two_sided = monitor.two_sided;
            panels.push_back(panel);
        }
    }
    return panels;
}

struct Piece {
    double distance = 0;  ///< to the nearest panel
    double area = 0;
    double light = 0;  ///< about the flux that reaches it, nothing in between
};

/// Collects the area of a surface in pieces no larger than their distance.
class Pieces {
  public:
    Pieces(const std::vector<Panel>& panels, std::vector<Piece>& pieces) : panels_(panels), pieces_(pieces) {}

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
        for (const Panel& panel : panels_) {
            const Vec3 to_panel = panel.centre - centre;
            const double length = glm::length(to_panel);
            const double distance = std::max(panel.size, length);
            piece.distance = std::min(piece.distance, distance);
            if (!(length > 0)) continue;
            double leaving = -glm::dot(panel.normal, to_panel) / length;
            if (panel.is_two_sided) leaving = std::abs(leaving);
            const double arriving = 0.5 * glm::dot(twice_area, to_panel) / length;
            if (leaving > 0 && arriving > 0) piece.light += leaving * arriving * panel.area / (distance * distance);
        }
        return piece;
    }

    const std::vector<Panel>& panels_;
    std::vector<Piece>& pieces_;
};

/// Median distance of all pieces, weighted with their light; 0 when nothing is lit.
double typical_distance(const std::vector<std::vector<Piece>>& surfaces) {
    std::vector<Piece> all;
    double total = 0;
    for (const auto& pieces : surfaces) {
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

struct Reach {
    double area = 0;
    double distance = 0;  ///< mean over the area
};

void halve_the_largest(const Scene& scene, const std::vector<Reach>& reach, double typical,
                       std::vector<double>& factors, std::vector<DensityCap>& caps) {
    double total = 0;
    for (size_t s = 0; s < reach.size(); ++s) total += reach[s].area * factors[s] * factors[s];
    for (uint32_t s = 0; s < reach.size(); ++s) {
        const double share = reach[s].area * factors[s] * factors[s];
        const double others = total - share;
        if (share <= others || reach[s].distance <= far_away * typical || !(others > 0)) continue;
        factors[s] *= std::sqrt(others / share);
        const std::string reason = fmt::format(
            "{}: {:.3g} m2, on average {:.3g} m from a monitor, would take {:.0f} % of the map; it gets half",
            scene.surfaces[s].name, reach[s].area, reach[s].distance, 100 * share / total);
        const auto known = std::find_if(caps.begin(), caps.end(), [&](const DensityCap& c) { return c.surface == s; });
        if (known != caps.end())
            *known = {s, factors[s], reason};
        else
            caps.push_back({s, factors[s], reason});
        return;  // only one can have more than half
    }
}

}  // namespace

std::vector<double> density_factors(const Scene& scene, std::vector<DensityCap>& caps) {
    std::vector<double> factors(scene.surfaces.size(), 1.0);
    const std::vector<Panel> panels = collect_panels(scene);
    if (panels.empty()) return factors;

    std::vector<std::vector<Piece>> pieces(scene.surfaces.size());
    parallel_for(scene.surfaces.size(), 1, [&](size_t s) {
        const Surface& surface = scene.surfaces[s];
        if (surface.monitor >= 0) return;
        Pieces collector(panels, pieces[s]);
        for (const auto& t : surface.triangles)
            collector.add(surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]], 0);
    });
    const double typical = typical_distance(pieces);
    if (!(typical > 0)) return factors;
    std::vector<Reach> reach(scene.surfaces.size());
    for (uint32_t s = 0; s < reach.size(); ++s) {
        for (const Piece& p : pieces[s]) {
            reach[s].area += p.area;
            reach[s].distance += p.area * p.distance;
        }
        if (!(reach[s].area > 0)) continue;
        reach[s].distance /= reach[s].area;
        const double closeness = far_away * typical / reach[s].distance;
        if (closeness >= 1) continue;
        factors[s] = closeness * closeness;
        caps.push_back({s, factors[s],
                        fmt::format("{}: on average {:.3g} m from a monitor, {:.1f} times the typical {:.3g} m",
                                    scene.surfaces[s].name, reach[s].distance, reach[s].distance / typical, typical)});
    }
    halve_the_largest(scene, reach, typical, factors, caps);
    std::sort(caps.begin(), caps.end(), [](const DensityCap& l, const DensityCap& r) { return l.surface < r.surface; });
    return factors;
}

}  // namespace surimi
