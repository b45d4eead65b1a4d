// SPDX-License-Identifier: Apache-2.0
#include "runtime/shade/shade.h"

#include <algorithm>
#include <cassert>

#include "runtime/base/random.h"
#include "runtime/ltc/cone.h"
#include "runtime/shade/published_model.h"
#include "runtime/visibility/baked.h"
#include "runtime/visibility/stochastic.h"

namespace surimi {
namespace {

/// What of a monitor's light is computed at a point.
enum Wanted : uint8_t { nothing = 0, diffuse_part = 1, specular_part = 2, schlick_part = 4 };

/// Share of the specular albedo below which Schlick's part is taken to lie where the full lobe does: the error is less
/// than this share of the highlight.
constexpr double negligible_schlick = 1e-3;

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
    LobeBatch full, schlick;
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
    place_lobes(prepared.points, prepared.full, LobePart::full);
    place_lobes(prepared.points, prepared.schlick, LobePart::schlick);
    const bool reads_map = lighting.settings.visibility == VisibilitySource::baked &&
                           std::any_of(lighting.plan.monitors.begin(), lighting.plan.monitors.end(),
                                       [](const MonitorPlan& m) { return m.is_lit && m.is_ever_blocked; });
    prepared.visibility.assign(points.size(), Vec3(1));
    if (reads_map)
        for (size_t i = 0; i < points.size(); ++i)
            prepared.visibility[i] = baked_visibility(lighting.scene, lighting.pages, points[i].at);
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
        if (surface.material < 0 || lighting.plan.is_specular[material]) {
            wanted[i] |= specular_part;
            const double schlick = luminance(1.0 - point.f0) * prepared.schlick.albedo[i];
            const double all = luminance(point.f0) * prepared.full.albedo[i] + schlick;
            if (schlick > negligible_schlick * all) wanted[i] |= schlick_part;
        }
        if (surface.material < 0 || lighting.plan.is_diffuse[material]) wanted[i] |= diffuse_part;
        counts.specular += (wanted[i] & specular_part) != 0;
        counts.schlick += (wanted[i] & schlick_part) != 0;
        counts.diffuse += (wanted[i] & diffuse_part) != 0;
    }
    return wanted;
}

/// Shares of a monitor's light at the points of a call.
struct Shares {
    ShareBatch main;     ///< diffuse, and of the full lobe
    ShareBatch schlick;  ///< its specular share only
    explicit Shares(size_t count) : main{std::vector<double>(count), std::vector<double>(count), 0}, schlick(main) {}
    void clear() {
        for (std::vector<double>* list : {&main.diffuse, &main.specular, &schlick.specular})
            std::fill(list->begin(), list->end(), 0.0);
    }
};

/// Adds one piece's shares where they are wanted, each part only where it is.
void add_piece(const Prepared& prepared, const std::vector<Vec3>& corners, bool two_sided,
               const std::vector<uint8_t>& wanted, Precision precision, Shares& shares) {
    std::vector<uint8_t> flags(wanted.size());
    const auto add_where = [&](auto is_wanted, const LobeBatch& lobes, Terms terms, ShareBatch& sum) {
        std::transform(wanted.begin(), wanted.end(), flags.begin(), is_wanted);
        if (std::find(flags.begin(), flags.end(), 1) != flags.end())
            add_polygon(prepared.points, lobes, corners, two_sided, terms, precision, flags, sum);
    };
    for (const auto& [parts, terms] : {std::pair{diffuse_part | specular_part, Terms::both},
                                       {diffuse_part | nothing, Terms::diffuse},
                                       {specular_part | nothing, Terms::specular}})
        add_where([parts = parts](uint8_t w) { return (w & (diffuse_part | specular_part)) == parts && w != nothing; },
                  prepared.full, terms, shares.main);
    add_where([](uint8_t w) { return (w & schlick_part) != 0; }, prepared.schlick, Terms::specular, shares.schlick);
}

Mat3 lobe_space(const Prepared& prepared, const LobeBatch& lobes, size_t i) {
    const Vec3 normal = prepared.points.normal[i], tangent = lobes.tangent[i];
    const Mat3 inverse(Vec3(lobes.xx[i], 0, lobes.zx[i]), Vec3(0, 1, 0), Vec3(lobes.xz[i], 0, lobes.zz[i]));
    return inverse * glm::transpose(Mat3(tangent, glm::cross(normal, tangent), normal));
}

/// Radiance times share: what arrives before albedo and visibility.
struct Arriving {
    Vec3 diffuse{0}, full{0}, schlick{0};
};

/// Colours of a piece's light as the parts of a point see them; white where the monitor shows no picture.
Arriving colors_of(const Lighting& lighting, size_t m, const LightPiece& piece, const Prepared& prepared,
                   const Shares& shares, size_t i) {
    const LitMonitor& light = lighting.lights[m];
    if (!light.picture) return {light.radiance, light.radiance, light.radiance};
    const auto seen = [&](double share, const auto& space) {
        if (!(share > 0)) return Vec3(0);
        return light.radiance *
               picture_seen(*light.picture, piece.panel, piece.corners, prepared.points.position[i], space());
    };
    return {
        seen(shares.main.diffuse[i], [&] { return glm::transpose(frame_around(prepared.points.normal[i])); }),
        seen(shares.main.specular[i], [&] { return lobe_space(prepared, prepared.full, i); }),
        seen(shares.schlick.specular[i], [&] { return lobe_space(prepared, prepared.schlick, i); }),
    };
}

/// What arrives of one monitor, summed over its pieces.
std::vector<Arriving> arriving(const Lighting& lighting, size_t m, const Prepared& prepared,
                               const std::vector<uint8_t>& wanted, MonitorCounts& counts) {
    std::vector<Arriving> sum(wanted.size());
    Shares shares(wanted.size());
    const std::vector<LightPiece>& pieces = lighting.pieces[m];
    for (size_t p = 0; p < pieces.size(); ++p) {
        add_piece(prepared, pieces[p].corners, lighting.scene.monitors[m].two_sided, wanted,
                  lighting.settings.precision, shares);
        if (!lighting.lights[m].picture && p + 1 < pieces.size()) continue;  // one colour: shares add up
        for (size_t i = 0; i < wanted.size(); ++i) {
            if (wanted[i] == nothing) continue;
            const Arriving color = colors_of(lighting, m, pieces[p], prepared, shares, i);
            const Vec3 full = color.full * shares.main.specular[i];
            sum[i].diffuse += color.diffuse * shares.main.diffuse[i];
            sum[i].full += full;
            sum[i].schlick += wanted[i] & schlick_part ? color.schlick * shares.schlick.specular[i] : full;
        }
        shares.clear();
    }
    counts.not_finite += shares.main.not_finite;
    return sum;
}

void shade_analytically(const Lighting& lighting, std::span<const ShadingPoint> points, std::span<Parts> reflected,
                        std::span<MonitorCounts> counts) {
    const Prepared prepared = prepare(lighting, points);
    for (size_t m = 0; m < lighting.scene.monitors.size(); ++m) {
        const std::vector<uint8_t> wanted = wanted_of(lighting, m, points, prepared, counts[m]);
        const std::vector<Arriving> light = arriving(lighting, m, prepared, wanted, counts[m]);
        const int channel = lighting.scene.monitors[m].channel;
        for (size_t i = 0; i < points.size(); ++i) {
            if (wanted[i] == nothing) continue;
            const Vec3 full = points[i].f0 * prepared.full.albedo[i];
            const Vec3 schlick = (1.0 - points[i].f0) * prepared.schlick.albedo[i];
            Parts parts{points[i].diffuse_albedo * (1.0 - full - schlick) * light[i].diffuse,
                        full * light[i].full + schlick * light[i].schlick};
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

Lighting::Lighting(const Scene& scene_, const std::vector<VisibilityMap>& pages_, const RayScene& rays_,
                   std::vector<LitMonitor> lights_, const LightingSettings& settings_)
    : scene(scene_),
      pages(pages_),
      rays(rays_),
      lights(std::move(lights_)),
      settings(settings_),
      plan(plan_shading(scene, lights, pages)) {
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        samplers.emplace_back(scene.monitors[m]);
        pieces.push_back(pieces_of(scene.monitors[m], lights[m].picture ? settings.picture_cells : 1));
    }
}

void set_radiance(Lighting& lighting, size_t monitor, const Vec3& radiance) {
    lighting.lights[monitor].radiance = radiance;
    lighting.plan.monitors[monitor].is_lit = is_lit(lighting.lights[monitor]);
}

void shade(const Lighting& lighting, std::span<const ShadingPoint> points, std::span<Parts> reflected,
           std::span<MonitorCounts> counts) {
    assert(points.size() == reflected.size() && counts.size() == lighting.scene.monitors.size());
    for (size_t i = 0; i < points.size(); ++i)
        reflected[i] = points[i].is_unlit ? Parts{points[i].diffuse_albedo, Vec3(0)} : Parts{};
    switch (lighting.settings.model) {
        case ShadingModel::exact:
            return shade_analytically(lighting, points, reflected, counts);
        case ShadingModel::kanikama:
        case ShadingModel::three:
            return shade_as_published(lighting, points, reflected, counts);
        case ShadingModel::reference:
            return shade_by_brute_force(lighting, points, reflected, counts);
    }
}

}  // namespace surimi
