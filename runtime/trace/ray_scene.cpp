// SPDX-License-Identifier: Apache-2.0
#include "runtime/trace/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "runtime/base/error.h"
#include "runtime/scene/texture.h"

namespace surimi {
namespace {

constexpr unsigned solid_mask = 1u << 3;  // bits 0 to 2 belong to the monitors
constexpr unsigned sheet_mask = 1u << 4;  // enclose nothing
constexpr unsigned shown_mask = 1u << 5;  // what only pictures show
constexpr unsigned casters = 0x1fu;
constexpr unsigned everything = casters | shown_mask;

}  // namespace

struct RayScene::State {
    struct Cutout {  // what the filter of an alpha-masked geometry needs to know
        const Scene* scene;
        uint32_t surface;
    };

    const Scene& scene;
    Vec3 center{0};  // subtracted from everything: float is most precise near 0
    RTCDevice device = nullptr;
    RTCScene handle = nullptr;
    std::vector<Cutout> cutouts;
    std::vector<Surface> panels;  // of each monitor that has no surface of its own

    explicit State(const Scene& s) : scene(s) {}
    ~State() {
        if (handle) rtcReleaseScene(handle);
        if (device) rtcReleaseDevice(device);
    }

    void attach(const std::vector<Vec3>& positions, const std::vector<std::array<uint32_t, 3>>& triangles,
                unsigned mask, unsigned id);
    void attach_surface(uint32_t index);
    void attach_panels(size_t monitor);
    static void filter(const RTCFilterFunctionNArguments* arguments);
};

/// Lets rays through the holes of alpha-masked materials.
void RayScene::State::filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& cutout = *static_cast<const Cutout*>(arguments->geometryUserPtr);
    const Material& material = material_of(*cutout.scene, cutout.scene->surfaces[cutout.surface]);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const double u = RTCHitN_u(arguments->hit, arguments->N, i), v = RTCHitN_v(arguments->hit, arguments->N, i);
        const TriangleRef where{cutout.surface, RTCHitN_primID(arguments->hit, arguments->N, i)};
        const SurfacePoint point = surface_point(*cutout.scene, where, {1 - u - v, u, v});
        if (alpha_at(*cutout.scene, material, point) < material.alpha_cutoff) arguments->valid[i] = 0;
    }
}

void RayScene::State::attach(const std::vector<Vec3>& positions, const std::vector<std::array<uint32_t, 3>>& triangles,
                             unsigned mask, unsigned id) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), positions.size()));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), triangles.size()));
    if (!vertices || !indices) throw Error(ErrorKind::internal, "Embree could not allocate its buffers");
    for (const Vec3& p : positions)
        for (int c = 0; c < 3; ++c) *vertices++ = static_cast<float>(p[c] - center[c]);
    for (const auto& t : triangles)
        for (const uint32_t corner : t) *indices++ = corner;
    rtcSetGeometryMask(geometry, mask);
    if (id < scene.surfaces.size() && is_cutout(scene, scene.surfaces[id])) {
        cutouts[id] = {&scene, id};
        rtcSetGeometryUserData(geometry, &cutouts[id]);
        rtcSetGeometryOccludedFilterFunction(geometry, filter);
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(handle, geometry, id);
    rtcReleaseGeometry(geometry);
}

void RayScene::State::attach_surface(uint32_t index) {
    const Surface& surface = scene.surfaces[index];
    const unsigned ordinary = surface.is_two_sided || is_cutout(scene, surface) ? sheet_mask : solid_mask;
    const unsigned own_mask = surface.monitor < 0 ? ordinary : 1u << static_cast<unsigned>(surface.monitor);
    const unsigned mask = surface.casts ? own_mask : shown_mask;
    if (!surface.triangles.empty()) attach(surface.positions, surface.triangles, mask, index);
}

/// Monitors that the configuration describes have no surface, but block the light of the others all the same.
void RayScene::State::attach_panels(size_t monitor) {
    Surface& surface = panels[monitor];
    for (const Polygon& panel : scene.monitors[monitor].panels) {
        const auto first = static_cast<uint32_t>(surface.positions.size());
        surface.positions.insert(surface.positions.end(), panel.corners.begin(), panel.corners.end());
        for (uint32_t i = 1; i + 1 < panel.corners.size(); ++i)
            surface.triangles.push_back({first, first + i, first + i + 1});
    }
    if (!surface.triangles.empty())
        attach(surface.positions, surface.triangles, 1u << monitor,
               static_cast<unsigned>(scene.surfaces.size() + monitor));
}

RayScene::RayScene(const Scene& scene, Attach attach) : state_(std::make_unique<State>(scene)) {
    const Bounds box = bounds(scene);
    state_->center = is_finite(box.low) && is_finite(box.high) ? 0.5 * (box.low + box.high) : Vec3(0);
    state_->cutouts.resize(scene.surfaces.size());
    state_->panels.resize(scene.monitors.size());
    state_->device = rtcNewDevice(nullptr);
    if (!state_->device) throw Error(ErrorKind::internal, "Embree could not start");
    state_->handle = rtcNewScene(state_->device);
    // Without ROBUST a ray at a shared vertex leaks in 36 % of cases; spatial splits (HIGH) gain nothing with it.
    rtcSetSceneFlags(state_->handle, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(state_->handle, RTC_BUILD_QUALITY_MEDIUM);
    for (uint32_t i = 0; i < scene.surfaces.size(); ++i)
        if (scene.surfaces[i].casts || (attach == Attach::everything && scene.surfaces[i].is_drawn))
            state_->attach_surface(i);
    for (size_t m = 0; m < scene.monitors.size(); ++m)
        if (std::none_of(scene.surfaces.begin(), scene.surfaces.end(),
                         [&](const Surface& s) { return s.monitor == static_cast<int>(m); }))
            state_->attach_panels(m);
    rtcCommitScene(state_->handle);
    if (rtcGetDeviceError(state_->device) != RTC_ERROR_NONE)
        throw Error(ErrorKind::internal, "Embree could not build its acceleration structure");
}

RayScene::~RayScene() = default;

const Vec3& RayScene::center() const {
    return state_->center;
}

Vec3 RayScene::ray_origin(const SurfacePoint& point) const {
    const Surface& surface = state_->scene.surfaces[point.triangle.surface];
    double magnitude = largest_component(point.position - state_->center);
    for (const uint32_t corner : surface.triangles[point.triangle.triangle])
        magnitude = std::max(magnitude, largest_component(surface.positions[corner] - state_->center));
    // Vertices and origin are each off by up to sqrt(3)/2 ulp, and the signed distance that Embree computes by a few
    // more; 32 half-ulps cover them with a factor of 2 to spare (tests/stability/self_intersection_test).
    constexpr double half_ulp = 0.5 * std::numeric_limits<float>::epsilon();
    return point.position + 32 * half_ulp * magnitude * point.geometric_normal;
}

namespace {

void set_ray(RTCRay& ray, const Vec3& origin, const Vec3& direction, double length, unsigned mask) {
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tnear = 0;
    ray.tfar = static_cast<float>(length);
    ray.time = 0;
    ray.mask = mask;
    ray.id = 0;
    ray.flags = 0;
}

}  // namespace

bool RayScene::is_occluded(const Vec3& origin, const Vec3& target, size_t monitor) const {
    return is_occluded_until(1 - 1e-4, origin - state_->center, target - state_->center, monitor);
}

bool RayScene::is_occluded_until(double end, const Vec3& origin, const Vec3& target, size_t monitor) const {
    RTCRay ray;
    set_ray(ray, origin, target - origin, end, casters & ~(1u << monitor));
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(state_->handle, &context, &ray);
    return ray.tfar < 0;
}

uint32_t RayScene::occluded(const RayPacket& packet, size_t monitor) const {
    constexpr size_t lanes = RayPacket::capacity;
    alignas(64) std::array<int, lanes> valid;
    RTCRay16 rays;
    const auto copy = [](const std::array<float, lanes>& from, float* to) {
        std::memcpy(to, from.data(), sizeof from);
    };
    copy(packet.origin_x, rays.org_x);
    copy(packet.origin_y, rays.org_y);
    copy(packet.origin_z, rays.org_z);
    copy(packet.direction_x, rays.dir_x);
    copy(packet.direction_y, rays.dir_y);
    copy(packet.direction_z, rays.dir_z);
    copy(packet.end, rays.tfar);
    for (size_t i = 0; i < lanes; ++i) {
        valid[i] = i < packet.size ? -1 : 0;
        rays.tnear[i] = 0;
        rays.time[i] = 0;
        rays.mask[i] = casters & ~(1u << monitor);
        rays.id[i] = 0;
        rays.flags[i] = 0;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);  // incoherent: COHERENT hangs with AVX-512 (docs/decisions.md)
    rtcOccluded16(valid.data(), state_->handle, &context, &rays);
    uint32_t hits = 0;
    for (size_t i = 0; i < packet.size; ++i) hits |= rays.tfar[i] < 0 ? 1u << i : 0u;
    return hits;
}

std::optional<TriangleRef> RayScene::closest_occluder(const Vec3& origin, const Vec3& target, double end,
                                                      size_t monitor) const {
    RTCRayHit query;
    set_ray(query.ray, origin, target - origin, end, casters & ~(1u << monitor));
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(state_->handle, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return TriangleRef{query.hit.geomID, query.hit.primID};
}

void RayScene::find_triangles_near(const Vec3& place, double radius, std::vector<TriangleRef>& found) const {
    found.clear();
    RTCPointQuery query;
    query.x = static_cast<float>(place.x);
    query.y = static_cast<float>(place.y);
    query.z = static_cast<float>(place.z);
    // What is rounded to float, the place and the triangles, stays within.
    const double rounding = 4 * std::numeric_limits<float>::epsilon() * (largest_component(place) + radius);
    query.radius = static_cast<float>(radius + rounding);
    query.time = 0;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(
        state_->handle, &query, &context,
        [](RTCPointQueryFunctionArguments* at) {
            static_cast<std::vector<TriangleRef>*>(at->userPtr)->push_back({at->geomID, at->primID});
            return false;  // the radius stays
        },
        &found);
    std::ranges::sort(found, {}, [](const TriangleRef& t) { return std::pair(t.surface, t.triangle); });
}

std::array<Vec3, 3> RayScene::corners_of(const TriangleRef& triangle) const {
    const std::vector<Surface>& surfaces = state_->scene.surfaces;
    const bool is_panel = triangle.surface >= surfaces.size();
    const Surface& surface = is_panel ? state_->panels[triangle.surface - surfaces.size()] : surfaces[triangle.surface];
    std::array<Vec3, 3> corners;
    for (size_t i = 0; i < 3; ++i)
        corners[i] = surface.positions[surface.triangles[triangle.triangle][i]] - state_->center;
    return corners;
}

Way RayScene::follow(const Vec3& origin, const Vec3& direction, bool meets_sheets) const {
    constexpr int most_faces = 64;  // a ray that has met so many is taken to be outside
    Way way;
    int exits = 0;  // less entries
    float start = 0;
    for (int i = 0; i < most_faces && !way.comes_out; ++i) {
        RTCRayHit query;
        set_ray(query.ray, origin - state_->center, direction, INFINITY,
                meets_sheets ? solid_mask | sheet_mask : solid_mask);
        query.ray.tnear = start;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(state_->handle, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
        const Vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
        const bool is_back = glm::dot(normal, direction) > 0;
        if (way.meets_nothing) way = {false, false, is_back, query.hit.geomID, static_cast<double>(query.ray.tfar)};
        exits += is_back ? 1 : -1;
        way.comes_out = exits > 0;
        // Past the face by more than the distance is rounded; faces that lie in one another count once.
        start = std::nextafter(query.ray.tfar * (1 + 4 * std::numeric_limits<float>::epsilon()), INFINITY);
    }
    return way;
}

std::optional<Hit> RayScene::closest_hit(const Vec3& origin, const Vec3& direction) const {
    RTCRayHit query;
    set_ray(query.ray, origin - state_->center, direction, INFINITY, everything);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(state_->handle, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const double u = std::max(0.f, query.hit.u), v = std::max(0.f, query.hit.v);
    const double outside = std::max(1.0, u + v);
    const Vec3 barycentric = Vec3(outside - u - v, u, v) / outside;
    const Vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    return Hit{{query.hit.geomID, query.hit.primID}, barycentric, query.ray.tfar, glm::dot(normal, direction) < 0};
}

std::string tracing_library() {
    const RTCDevice device = rtcNewDevice(nullptr);
    const auto part = [&](RTCDeviceProperty property) {
        return std::to_string(rtcGetDeviceProperty(device, property));
    };
    const std::string version = part(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." +
                                part(RTC_DEVICE_PROPERTY_VERSION_MINOR) + "." + part(RTC_DEVICE_PROPERTY_VERSION_PATCH);
    rtcReleaseDevice(device);
    return "Embree " + version;
}

}  // namespace surimi
