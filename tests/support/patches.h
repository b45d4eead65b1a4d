// SPDX-License-Identifier: Apache-2.0
// Parallelograms in the world that lie as parallelograms on the pages of a hand-made atlas.
#pragma once

#include <vector>

#include "baker/post/channel.h"
#include "baker/unwrap/atlas.h"
#include "runtime/scene/scene.h"

namespace surimi::test {

/// One chart: `corner + a u + b v` for a, b in [0, 1], seen from the front side of u x v, lies at
/// `texel_corner + a texel_u + b texel_v`.
struct Patch {
    Vec3 corner{0};
    Vec3 u{1, 0, 0};
    Vec3 v{0, 1, 0};
    Vec2 texel_corner{0};
    Vec2 texel_u{16, 0};
    Vec2 texel_v{0, 16};
    int page = 0;
    double offset = 0;  ///< of its visibility, see paint

    /// Where a place of the plane lies on the page, in texels.
    Vec2 texel_at(const Vec3& place) const;
    /// The place of a texel coordinate, also outside the patch.
    Vec3 place_at(const Vec2& texel) const;
};

struct PatchScene {
    Scene scene;
    Atlas atlas;
    std::vector<Patch> patches;
};

/// Each patch is a surface of its own, or all are charts of one surface (then on one page).
PatchScene make_patches(const std::vector<Patch>& patches, bool is_one_surface = false, int size = 64);

/// Channels whose texels hold `of(place) + offset` at their centres: covered on the patches, filled up to two texels
/// around them, empty elsewhere.
std::vector<Channel> paint(const PatchScene& made, double (*of)(const Vec3& place));

/// The largest difference between what the runtime's lookup says on both sides of the segment from a to b, at places
/// that have nothing to do with texels.
double largest_jump(const std::vector<Channel>& pages, const Patch& one, const Patch& other, const Vec3& a,
                    const Vec3& b);

}  // namespace surimi::test
