// SPDX-License-Identifier: Apache-2.0
#include "runtime/light/sample.h"

#include <algorithm>
#include <array>

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
        this->add({0, whole, origin, u, v, normal, panel});
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

void MonitorSampler::add(Piece piece) {
    const double area = glm::length(glm::cross(piece.edge_u, piece.edge_v)) * (piece.is_parallelogram ? 1 : 0.5);
    if (!(area > 0)) return;
    area_ += area;
    piece.cumulative = area_;
    pieces_.push_back(piece);
}

MonitorSampler MonitorSampler::above(const Vec3& normal, double height) const {
    MonitorSampler part(*this);
    part.pieces_.clear();
    part.area_ = 0;
    for (const Piece& piece : pieces_) {
        // The height over the plane is affine in (u, v): what is kept reaches as far as the corners above it, and the
        // places where sides cross it.
        const auto over = [&](const Vec2& at) {
            return glm::dot(normal, piece.origin + at.x * piece.edge_u + at.y * piece.edge_v) - height;
        };
        const std::array<Vec2, 4> corners = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
        const size_t count = piece.is_parallelogram ? 4 : 3;
        Vec2 low(1), high(0);
        const auto keep = [&](const Vec2& at) { low = glm::min(low, at), high = glm::max(high, at); };
        for (size_t i = 0; i < count; ++i) {
            const Vec2 &a = corners[i], &b = corners[(i + 1) % count];
            const double from = over(a), to = over(b);
            if (from >= 0) keep(a);
            if ((from < 0) != (to < 0)) keep(glm::clamp(a + (b - a) * (from / (from - to)), 0.0, 1.0));
        }
        if (low.x > high.x) continue;
        Piece kept = piece;
        if (piece.is_parallelogram) {
            kept.origin += low.x * piece.edge_u + low.y * piece.edge_v;
            kept.edge_u *= high.x - low.x;
            kept.edge_v *= high.y - low.y;
        }
        part.add(kept);
    }
    return part.pieces_.empty() ? *this : part;
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
