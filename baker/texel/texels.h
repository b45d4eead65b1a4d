// SPDX-License-Identifier: Apache-2.0
// Atlas -> texels: which triangles each lightmap texel touches.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi {

struct TriangleRef {
    uint32_t surface = 0;
    uint32_t triangle = 0;
};

/// One texel that at least one triangle touches.
struct Texel {
    uint32_t index = 0;  ///< y * width + x; also keys the random numbers
    uint32_t chart = 0;
    uint32_t first = 0;  ///< its triangles are Texels::triangles[first, first + count)
    uint32_t count = 0;
};

/// Sorted by index; each index at most once.
struct Texels {
    int width = 0;
    int height = 0;
    std::vector<Texel> texels;
    std::vector<TriangleRef> triangles;

    std::span<const TriangleRef> triangles_of(const Texel& texel) const {
        return {triangles.data() + texel.first, texel.count};
    }
};

/// Conservative: a texel is listed when the closed triangle and the open texel square meet, and a triangle that meets
/// no open square (it lies on texel borders) is listed with the texels beside it. Where two charts touch one texel
/// (existing UVs only), the chart of the lower number owns it.
Texels find_texels(const Scene& scene, const Atlas& atlas);

/// A piece of surface under one texel, as a convex polygon on the lightmap: triangle clipped by the texel's square.
struct Fragment {
    TriangleRef triangle;
    std::vector<Vec2> corners;  ///< texel units relative to the texel's upper left corner, in [0, 1]^2
    double area = 0;            ///< on the surface, m^2
};

/// A place on a surface.
struct SurfacePoint {
    Vec3 position{0};
    Vec3 normal{0, 0, 1};            ///< unit, interpolated
    Vec3 geometric_normal{0, 0, 1};  ///< unit, of the triangle
};

/// The surface under one texel, ready to be sampled evenly by area.
class TexelSurface {
  public:
    TexelSurface(const Scene& scene, const Atlas& atlas, const Texels& texels, const Texel& texel);

    /// The point for (u, v) in [0, 1)^2; evenly spread over the surface's area when (u, v) are. Always on a triangle.
    SurfacePoint sample(double u, double v) const;

    /// m^2 of surface under the texel; 0 for a texel that is only touched.
    double area() const { return area_; }

  private:
    struct Piece {             // a triangle or parallelogram of points that are affine in (u, v)
        double cumulative = 0;  // area of this and all earlier pieces
        bool is_parallelogram = false;
        Vec2 origin{0}, edge_u{0}, edge_v{0};  // texel units, absolute
        TriangleRef triangle;
    };
    SurfacePoint point(const TriangleRef& triangle, const Vec2& texel_position) const;

    const Scene& scene_;
    const Atlas& atlas_;
    std::vector<Piece> pieces_;
    double area_ = 0;
};

}  // namespace surimi
