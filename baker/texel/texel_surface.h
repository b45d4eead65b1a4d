// SPDX-License-Identifier: Apache-2.0
// The surface under one lightmap texel.
#pragma once

#include <span>
#include <vector>

#include "baker/texel/texels.h"

namespace surimi {

/// The surface under one texel, ready to be sampled evenly by area.
class TexelSurface {
  public:
    TexelSurface(const Scene& scene, const Atlas& atlas, const Texels& texels, const Texel& texel);

    /// A value that is affine in (u, v).
    struct Affine {
        Vec3 origin{0}, edge_u{0}, edge_v{0};
        Vec3 at(double u, double v) const { return origin + u * edge_u + v * edge_v; }
    };
    struct Piece {              ///< a triangle or the whole texel square
        double cumulative = 0;  ///< area of this and all earlier pieces
        bool is_square = false;
        bool has_one_normal = false;  ///< then normal.origin is it, of unit length
        bool is_lifted = false;       ///< off its triangle, to where only what is below the shading normal is hidden
        TriangleRef triangle;
        Vec3 geometric_normal{0, 0, 1};
        Affine barycentric, position, normal;

        /// Unit shading normal at (u, v).
        Vec3 unit_normal(double u, double v) const {
            return has_one_normal ? normal.origin : normalize_or(normal.at(u, v), geometric_normal);
        }
        /// Coordinates of its centre of area.
        Vec2 middle() const { return is_square ? Vec2(0.5) : Vec2(2.0 / 3, 1.0 / 3); }
        /// Unit normal of the plane that its positions lie in, on the front side.
        Vec3 plane_normal() const;
    };

    /// The piece that (u, v) in [0, 1)^2 chooses; (u, v) become coordinates within it. The place is evenly spread over
    /// the surface's area when (u, v) are (M8). Half the work of `sample` where not all of the point is needed.
    const Piece& choose(double& u, double& v) const;

    /// The point for (u, v) in [0, 1)^2, spread in the same way. Always on a triangle.
    SurfacePoint sample(double u, double v) const;

    std::span<const Piece> pieces() const { return pieces_; }
    /// Share of the texel's area; all shares sum to 1.
    double share_of(const Piece& piece) const;
    /// The point at (u, v) of the piece's own coordinates: (0, 0), (1, 0), (1, 1) are corners, for a square (0, 1) too.
    /// The geometric normal of a lifted piece's is the shading normal.
    static SurfacePoint point_of(const Piece& piece, const Vec2& uv);

    /// The point that stands for the texel best: its centre of area where all of it lies in one plane, else the middle
    /// of the piece whose middle is nearest to that. Always on a triangle or in its plane.
    SurfacePoint center() const;

    /// Calls visit(SurfacePoint) for the corners of all pieces: the surface is their convex hulls.
    template <class Visit>
    void for_each_corner(const Visit& visit) const {
        for (const Piece& piece : pieces_) {
            for (const Vec2& uv : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)}) visit(point_of(piece, uv));
            if (piece.is_square) visit(point_of(piece, {0, 1}));
        }
    }

    /// A segment in a piece's plane, in the coordinates of its places.
    struct Crossing {
        size_t piece = 0;
        Vec3 from{0}, to{0};
    };
    /// Cuts pieces in two along the segments that cross them, each as far as what it crosses reaches, so that either
    /// side is sampled by itself. Parts of less than `least` of the texel's area are not cut off. Does nothing where
    /// there would be more than `most` pieces; was anything cut, and could all be?
    struct CutResult {
        bool is_cut = false, is_whole = true;
    };
    CutResult cut(std::span<const Crossing> crossings, double least, size_t most);

    /// Leaves the pieces whose bits are set, of 32 at most; there must be one. Area and shares become theirs.
    void keep(uint32_t pieces);

    /// Its back becomes its front: normals are reversed.
    void turn_over();

    /// Moves a piece off its triangle (M63, lift.h): from now on its points have the shading normal as their geometric
    /// one as well, since its own triangle is not in the way of what that admits. Areas stay.
    void lift(size_t piece, const Affine& position);

    const Scene& scene() const { return scene_; }

    /// m^2 of surface under the texel; 0 for a texel that is only touched.
    double area() const { return area_; }

  private:
    void add(const TriangleRef& triangle, const Vec2& corner);
    void add_piece(const TriangleRef& triangle, double area, bool is_square, const Affine& barycentric);
    void add_part(const Piece& whole, double area, bool is_square, const std::array<Vec2, 3>& corners);

    const Scene& scene_;
    const Atlas& atlas_;
    std::vector<Piece> pieces_;
    double total_ = 0;  // of the pieces' weights: their areas, unless all of those are 0
    double area_ = 0;
};

}  // namespace surimi
