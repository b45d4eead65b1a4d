// SPDX-License-Identifier: Apache-2.0
#include "runtime/light/sample.h"

#include <algorithm>

namespace surimi {
namespace {

/// Do the corners form a parallelogram, to the rounding of float coordinates?
bool is_parallelogram(const std::vector<Vec3>& c) {
    if (c.size() != 4) return false;
    const double size = std::max(glm::length(c[2] - c[0]), glm::length(c[3] - c[1]));
    return glm::length(c[0] + c[2] - c[1] - c[3]) <= 1e-5 * size;
}

}  // namespace

MonitorSampler::MonitorSampler(const Monitor& monitor) : two_sided_(monitor.two_sided) {
    size_t panel = 0;
    const auto add = [&](const Vec3& origin, const Vec3& u, const Vec3& v, const Vec3& normal, bool whole) {
        const double area = glm::length(glm::cross(u, v)) * (whole ? 1 : 0.5);
        if (!(area > 0)) return;
        area_ += area;
        pieces_.push_back({area_, whole, origin, u, v, normal, panel});
    };
    for (; panel < monitor.panels.size(); ++panel) {
        const std::vector<Vec3>& c = monitor.panels[panel].corners;
        const Vec3 normal = front_normal(monitor.panels[panel]);
        if (is_parallelogram(c)) {
            add(c[0], c[1] - c[0], c[3] - c[0], normal, true);
        } else {
            for (size_t i = 1; i + 1 < c.size(); ++i) add(c[0], c[i] - c[0], c[i + 1] - c[i], normal, false);
        }
    }
}

LightPoint MonitorSampler::sample(double u, double v) const {
    const Piece* piece = pieces_.data();
    if (pieces_.size() > 1) {
        // The number that chooses the piece is stretched to serve again within it: strata survive.
        const double target = u * area_;
        auto chosen = std::upper_bound(pieces_.begin(), pieces_.end(), target,
                                       [](double t, const Piece& p) { return t < p.cumulative; });
        if (chosen == pieces_.end()) --chosen;
        const double before = chosen == pieces_.begin() ? 0 : std::prev(chosen)->cumulative;
        u = std::clamp((target - before) / (chosen->cumulative - before), 0.0, 1.0);
        piece = &*chosen;
    }
    if (!piece->is_parallelogram) {
        u = std::sqrt(u);  // edge_u runs to the second corner, edge_v from there to the third
        v *= u;
    }
    return {piece->origin + u * piece->edge_u + v * piece->edge_v, piece->normal, piece->panel};
}

}  // namespace surimi
