// SPDX-License-Identifier: Apache-2.0
// Judges a baked map against what can be known of its scene without the baker: exact points, what lies under a texel,
// and what a shader reads on both sides of a joint.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "baker/bake.h"
#include "tests/scenes/artefact_scene.h"
#include "tests/scenes/seams.h"
#include "tests/support/visibility_judge.h"

namespace surimi::test {

/// New charts on a map of size x size.
BakeSettings of_size(int size);

/// The map's value at a point, as a shader reads it, bilinearly.
double read_map(const Bake& bake, const TriangleRef& where, const Vec3& barycentric, int channel = 0);

/// A place of a texel's surface with the area for which it stands.
struct TexelPlace {
    SurfacePoint point;
    double area = 0;
};

/// `side` x `side` places over a texel, those that are on no triangle of it left out.
std::vector<TexelPlace> places_of(const Scene& scene, const Atlas& atlas, const Texels& texels, const Texel& texel,
                                  int side);

/// What differs from what is expected.
struct Misses {
    size_t checked = 0;
    size_t wrong = 0;
    double largest = 0;  ///< difference of all that was checked
    std::string worst;   ///< where

    void add(double value, double expected, double tolerance, const std::string& where);
    /// For a message: "14 of 300 wrong, by 0.21 at most: ..."
    std::string text() const;
};

/// Holds a bake of an artefact's scene against exact points of it.
class MapJudge {
  public:
    MapJudge(const ArtefactScene& stage, const Bake& bake);

    /// Exact visibility of monitor 0 where a shading point can be; nothing where solids enclose it or it is unlit.
    std::optional<double> truth(const SurfacePoint& point) const;

    /// Every measured texel of the judged surfaces, against the average over those of its places that can be seen.
    /// Texels without such places are not counted; with sanitizers, nine in ten are not. The tolerance is `error` and
    /// what a coarser grid of places differs.
    Misses compare_texels(double error) const;

    /// Reads at random places that can be seen where all that can be seen of the texels that are read, and of those
    /// around them, is exactly lit, or exactly dark: there a read must be that, to the rounding of a float or to
    /// `tolerance`.
    Misses compare_plain_reads(size_t tries, double tolerance = 0) const;

    /// All measured texels of a judged surface against one value.
    Misses compare_with(uint32_t surface, double value, double tolerance) const;

    /// How many texels of a surface are in this state.
    size_t count(uint32_t surface, TexelState state) const;

  private:
    struct Average {
        double visibility = 0;
        double light = 0;      ///< 0: nothing can be seen
        double spread = 0;     ///< of the visibility of what can be seen
        bool is_whole = true;  ///< all of it can be seen
    };
    Average average(const Texels& texels, const Texel& texel, int side) const;
    /// What can be seen of a texel.
    enum class Tone : uint8_t { none, black, white, mixed };
    static Tone tone_of(double visibility);
    std::vector<Image<Tone>> tones() const;  ///< by page
    /// Have the texels of a bilinear read and a ring around them this tone, or none?
    static bool is_plain(const Image<Tone>& page, const Vec2& uv, Tone tone);

    const ArtefactScene& stage_;
    const Bake& bake_;
    VisibilityJudge exact_;
    std::vector<Texels> texels_;  ///< by page
};

/// Differences of the two reads at `count` places along a joint.
std::vector<double> joint_jumps(const CutPlane& stage, const Bake& bake, int count);

/// Texels (page, index) that bilinear reads at a joint touch, on both sides, and those beside them by rounding.
std::vector<std::pair<int, uint32_t>> texels_at_joint(const CutPlane& stage, const Bake& bake);

/// Measured texels whose value is not that of their irradiance, bit for bit, the sorted `exempt` left out.
size_t changed_texels(const Bake& bake, const std::vector<std::pair<int, uint32_t>>& exempt);

}  // namespace surimi::test
