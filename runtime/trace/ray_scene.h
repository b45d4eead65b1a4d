// SPDX-License-Identifier: Apache-2.0
// Rays against a scene. The only room that sees Embree.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/surface_point.h"

namespace surimi {

/// Up to sixteen rays that are traced together. Float, relative to RayScene::center().
struct RayPacket {
    static constexpr size_t capacity = 16;
    alignas(64) std::array<float, capacity> origin_x, origin_y, origin_z, direction_x, direction_y, direction_z, end;
    size_t size = 0;

    /// A ray that ends at `ray_end` times the way from `origin` to `target`, both relative to RayScene::center(). There
    /// must be room.
    void add(const Vec3& origin, const Vec3& target, double ray_end) {
        const Vec3 direction = target - origin;
        origin_x[size] = static_cast<float>(origin.x);
        origin_y[size] = static_cast<float>(origin.y);
        origin_z[size] = static_cast<float>(origin.z);
        direction_x[size] = static_cast<float>(direction.x);
        direction_y[size] = static_cast<float>(direction.y);
        direction_z[size] = static_cast<float>(direction.z);
        end[size] = static_cast<float>(ray_end);
        ++size;
    }
};

struct Hit {
    TriangleRef triangle;  ///< surface == Scene::surfaces.size() + m: a panel of monitor m, which has no surface
    Vec3 barycentric{1, 0, 0};
    double distance = 0;   ///< in lengths of the ray's direction
    bool is_front = true;  ///< the side that the triangle's winding shows
};

/// What a ray tells of the space that it starts in.
struct Way {
    bool comes_out = false;  ///< of something that it never went into: at some place it has met more backs than fronts
    bool meets_nothing = true;   ///< it leaves the scene
    bool meets_back = false;     ///< the first face that it meets shows its back
    uint32_t surface = 0;        ///< of that face; index into Scene::surfaces
    double distance = INFINITY;  ///< to that face, in lengths of the ray's direction
};

/// Which surfaces a RayScene holds.
enum class Attach {
    casters,    ///< those that stand in the way of light
    everything  ///< for pictures: also those that do not, unless engines do not draw them; light passes them all the
                ///< same
};

/// Owns the acceleration structure of one scene; the scene must outlive it. Calls are thread-safe.
class RayScene {
  public:
    explicit RayScene(const Scene& scene, Attach attach = Attach::casters);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    static constexpr size_t no_monitor = 31;

    /// Where rays from the front of `point` start: far enough off its triangle that none of them meets it again, and no
    /// farther (M5). The distance covers the rounding of vertices and origin to float, relative to the scene's centre.
    Vec3 ray_origin(const SurfacePoint& point) const;

    /// What places are relative to before they are rounded to float: the middle of the scene's bounds.
    const Vec3& center() const;

    /// Is anything that casts between `origin` (see ray_origin) and `target`, a point on monitor `monitor`? Surfaces of
    /// that monitor do not count, nor does what lies within 1e-4 of the distance before the target. Alpha-masked holes
    /// let light through; blended and transmissive materials block it.
    bool is_occluded(const Vec3& origin, const Vec3& target, size_t monitor) const;

    /// The same for a ray that ends at `end` times the way, with places relative to center().
    bool is_occluded_until(double end, const Vec3& origin, const Vec3& target, size_t monitor) const;

    /// Bit i: ray i of the packet meets something that is not monitor `monitor` (or anything, with no_monitor).
    /// Alpha-masked holes let light through.
    uint32_t occluded(const RayPacket& packet, size_t monitor) const;

    /// The nearest triangle between `origin` and `end` times the way to `target` (relative to center()) that is not
    /// monitor `monitor`.
    std::optional<TriangleRef> closest_occluder(const Vec3& origin, const Vec3& target, double end,
                                                size_t monitor) const;

    /// All triangles held (see Attach) that come within `radius` of `place` (relative to center()), and some more,
    /// sorted; replaces what is in `found`.
    void find_triangles_near(const Vec3& place, double radius, std::vector<TriangleRef>& found) const;

    /// The corners of a triangle as rays meet it, monitors' panels among them, relative to center().
    std::array<Vec3, 3> corners_of(const TriangleRef& triangle) const;

    /// Follows a ray through everything that casts but monitors and, unless `meets_sheets`, alpha-masked and two-sided
    /// surfaces.
    Way follow(const Vec3& origin, const Vec3& direction, bool meets_sheets = false) const;

    /// Nearest surface along a ray, of all that are held (see Attach); alpha-masked holes are not hit.
    std::optional<Hit> closest_hit(const Vec3& origin, const Vec3& direction) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Name and version of the library that traces, as it was found when the program started.
std::string tracing_library();

}  // namespace surimi
