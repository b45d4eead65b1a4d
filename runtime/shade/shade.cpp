// SPDX-License-Identifier: Apache-2.0
#include "runtime/shade/shade.h"

#include <algorithm>
#include <cassert>

#include "runtime/base/random.h"
#include "runtime/ltc/cone.h"
#include "runtime/visibility/baked.h"
#include "runtime/visibility/stochastic.h"

namespace surimi {
namespace {

/// What of a monitor's light is computed at a point.
enum Wanted : uint8_t { nothing = 0, diffuse_part = 1, specular_part = 2 };

/// Is any of the monitor's light-emitting side above the point's horizon? Cheap, and never false for a lit point.
bool is_seen(const Monitor& monitor, const ShadingPoint& point) {
    for (const Polygon& panel : monitor.panels) {
        const Vec3& first = panel.corners.front();
        const Vec3 front = area_normal(first, panel.corners[1], panel.corners[2]);
        if (!monitor.two_sided && !(glm::dot(point.at.position - first, front) > 0)) continue;
        for (const Vec3& corner : panel.corners)
            if (glm::dot(corner - point.at.position, point.normal) > 0) return true;
    }
    return false;
}

/// The points of one call in the form that batches want.
struct Prepared {
    PointBatch points;
    LobeBatch lobes;
    std::vector<Vec3> visibility;  ///< from the map, by channel
};

Prepared prepare(const Lighting& lighting, std::span<const ShadingPoint> points) {
    Prepared prepared;
    for (const ShadingPoint& point : points) {
        prepared.points.position.push_back(point.at.position);
        prepared.points.normal.push_back(point.normal);
        prepared.points.view.push_back(point.view);
        prepared.points.roughness.push_back(point.roughness);
    }
    place_lobes(prepared.points, prepared.lobes);
    const bool reads_map = lighting.settings.visibility == VisibilitySource::baked &&
                           std::any_of(lighting.plan.monitors.begin(), lighting.plan.monitors.end(),
                                       [](const MonitorPlan& m) { return m.is_lit && m.is_ever_blocked; });
    prepared.visibility.assign(points.size(), Vec3(1));
    if (reads_map)
        for (size_t i = 0; i < points.size(); ++i)
            prepared.visibility[i] = baked_visibility(lighting.scene, lighting.map, points[i].at);
    return prepared;
}

/// What each point wants of monitor m, counted.
std::vector<uint8_t> wanted_of(const Lighting& lighting, size_t m, std::span<const ShadingPoint> points,
                               const Prepared& prepared, MonitorCounts& counts) {
    const Monitor& monitor = lighting.scene.monitors[m];
    const bool reads_map =
        lighting.settings.visibility == VisibilitySource::baked && lighting.plan.monitors[m].is_ever_blocked;
    std::vector<uint8_t> wanted(points.size(), nothing);
    counts.points += points.size();
    for (size_t i = 0; i < points.size(); ++i) {
        const ShadingPoint& point = points[i];
        const Surface& surface = lighting.scene.surfaces[point.at.triangle.surface];
        if (point.is_unlit || !lighting.plan.monitors[m].is_lit || surface.monitor == static_cast<int>(m) ||
            !is_seen(monitor, point)) {
            ++counts.unseen;
            continue;
        }
        counts.map_reads += reads_map;
        if (reads_map && prepared.visibility[i][monitor.channel] == 0) {
            ++counts.dark;
            continue;
        }
        const auto material = static_cast<size_t>(surface.material);
        if (surface.material < 0 || lighting.plan.is_specular[material]) wanted[i] |= specular_part;
        if (surface.material < 0 || lighting.plan.is_diffuse[material]) wanted[i] |= diffuse_part;
        counts.specular += (wanted[i] & specular_part) != 0;
        counts.diffuse += (wanted[i] & diffuse_part) != 0;
    }
    return wanted;
}

/// Adds one piece's shares where they are wanted, each part only where it is.
void add_piece(const Prepared& prepared, const std::vector<Vec3>& corners, bool two_sided,
               const std::vector<uint8_t>& wanted, Precision precision, ShareBatch& shares) {
    std::vector<uint8_t> flags(wanted.size());
    for (const auto& [part, terms] : {std::pair{diffuse_part | specular_part, Terms::both},
                                      {diffuse_part | nothing, Terms::diffuse},
                                      {specular_part | nothing, Terms::specular}}) {
        std::transform(wanted.begin(), wanted.end(), flags.begin(), [part = part](uint8_t w) { return w == part; });
        if (std::find(flags.begin(), flags.end(), 1) != flags.end())
            add_polygon(prepared.points, prepared.lobes, corners, two_sided, terms, precision, flags, shares);
    }
}

Mat3 lobe_space(const Prepared& prepared, size_t i) {
    const LobeBatch& lobes = prepared.lobes;
    const Vec3 normal = prepared.points.normal[i], tangent = lobes.tangent[i];
    const Mat3 inverse(Vec3(lobes.xx[i], 0, lobes.zx[i]), Vec3(0, 1, 0), Vec3(lobes.xz[i], 0, lobes.zz[i]));
    return inverse * glm::transpose(Mat3(tangent, glm::cross(normal, tangent), normal));
}

/// Radiance times share, summed over the pieces of one monitor: what arrives before albedo and visibility.
std::vector<Parts> arriving(const Lighting& lighting, size_t m, const Prepared& prepared,
                            const std::vector<uint8_t>& wanted, MonitorCounts& counts) {
    const Monitor& monitor = lighting.scene.monitors[m];
    const LitMonitor& light = lighting.lights[m];
    std::vector<Parts> sum(wanted.size());
    ShareBatch shares;
    const auto clear = [&] {
        shares.diffuse.assign(wanted.size(), 0);
        shares.specular.assign(wanted.size(), 0);
    };
    clear();
    const std::vector<LightPiece>& pieces = lighting.pieces[m];
    for (size_t piece = 0; piece < pieces.size(); ++piece) {
        const std::vector<Vec3>& corners = pieces[piece].corners;
        add_piece(prepared, corners, monitor.two_sided, wanted, lighting.settings.precision, shares);
        if (!light.picture && piece + 1 < pieces.size()) continue;  // one colour: shares add up
        for (size_t i = 0; i < wanted.size(); ++i) {
            if (wanted[i] == nothing) continue;
            Parts color{Vec3(1), Vec3(1)};
            if (light.picture) {
                const Vec3 point = prepared.points.position[i];
                const auto seen = [&](const Mat3& space) {
                    return picture_seen(*light.picture, pieces[piece].panel, corners, point, space);
                };
                if (shares.diffuse[i] > 0)
                    color.diffuse = seen(glm::transpose(frame_around(prepared.points.normal[i])));
                if (shares.specular[i] > 0) color.specular = seen(lobe_space(prepared, i));
            }
            sum[i] += {light.radiance * color.diffuse * shares.diffuse[i],
                       light.radiance * color.specular * shares.specular[i]};
        }
        clear();
    }
    counts.not_finite += shares.not_finite;
    return sum;
}

void shade_analytically(const Lighting& lighting, std::span<const ShadingPoint> points, std::span<Parts> reflected,
                        std::span<MonitorCounts> counts) {
    const Prepared prepared = prepare(lighting, points);
    for (size_t m = 0; m < lighting.scene.monitors.size(); ++m) {
        const std::vector<uint8_t> wanted = wanted_of(lighting, m, points, prepared, counts[m]);
        const std::vector<Parts> light = arriving(lighting, m, prepared, wanted, counts[m]);
        const int channel = lighting.scene.monitors[m].channel;
        for (size_t i = 0; i < points.size(); ++i) {
            if (wanted[i] == nothing) continue;
            const Vec3 mirrored = specular_albedo(points[i].f0, prepared.lobes.albedo[i], prepared.lobes.fresnel[i]);
            Parts parts{points[i].diffuse_albedo * (1.0 - mirrored) * light[i].diffuse, mirrored * light[i].specular};
            if (lighting.settings.visibility == VisibilitySource::baked)
                parts = Vec3(prepared.visibility[i][channel]) * parts;
            if (lighting.settings.visibility == VisibilitySource::stochastic && parts.sum() != Vec3(0))
                parts = stochastic_visibility(lighting.scene, lighting.rays, m, lighting.lights[m],
                                              lighting.samplers[m], points[i], lighting.settings.samples) *
                        parts;
            reflected[i] += parts;
        }
    }
}

void shade_by_brute_force(const Lighting& lighting, std::span<const ShadingPoint> points, std::span<Parts> reflected,
                          std::span<MonitorCounts> counts) {
    const bool wants_shadows = lighting.settings.visibility != VisibilitySource::none;
    for (size_t m = 0; m < lighting.scene.monitors.size(); ++m) {
        counts[m].points += points.size();
        for (size_t i = 0; i < points.size(); ++i) {
            const Surface& surface = lighting.scene.surfaces[points[i].at.triangle.surface];
            if (points[i].is_unlit || surface.monitor == static_cast<int>(m)) continue;
            reflected[i] += direct_light(lighting.scene, lighting.rays, m, lighting.lights[m], lighting.samplers[m],
                                         points[i], lighting.settings.samples, wants_shadows, hash(points[i].key, m))
                                .shadowed;
        }
    }
}

}  // namespace

Lighting::Lighting(const Scene& scene_, const VisibilityMap& map_, const RayScene& rays_,
                   std::vector<LitMonitor> lights_, const LightingSettings& settings_)
    : scene(scene_),
      map(map_),
      rays(rays_),
      lights(std::move(lights_)),
      settings(settings_),
      plan(plan_shading(scene, lights, map)) {
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        samplers.emplace_back(scene.monitors[m]);
        pieces.push_back(pieces_of(scene.monitors[m], lights[m].picture ? settings.picture_cells : 1));
    }
}

void shade(const Lighting& lighting, std::span<const ShadingPoint> points, std::span<Parts> reflected,
           std::span<MonitorCounts> counts) {
    assert(points.size() == reflected.size() && counts.size() == lighting.scene.monitors.size());
    for (size_t i = 0; i < points.size(); ++i)
        reflected[i] = points[i].is_unlit ? Parts{points[i].diffuse_albedo, Vec3(0)} : Parts{};
    if (lighting.settings.model == ShadingModel::reference)
        shade_by_brute_force(lighting, points, reflected, counts);
    else
        shade_analytically(lighting, points, reflected, counts);
}

}  // namespace surimi
