// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/silhouettes.h"

#include <algorithm>

#include "baker/gather/box_tree.h"
#include "baker/gather/facets.h"
#include "runtime/base/error.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/texture.h"

namespace surimi {
namespace {

constexpr size_t grain = 1 << 14;

/// Triangles that rays see as one geometry.
struct Part {
    size_t slot = 0;  ///< in Silhouettes::plane_of
    uint8_t owner = Edge::ordinary;
    const std::vector<Vec3>* positions = nullptr;
    const std::vector<std::array<uint32_t, 3>>* triangles = nullptr;
    size_t first_vertex = 0, first_triangle = 0;  ///< in the welded mesh
};

struct PanelMesh {
    std::vector<Vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
};

PanelMesh panel_mesh(const Monitor& monitor) {
    PanelMesh mesh;
    for (const Polygon& panel : monitor.panels) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), panel.corners.begin(), panel.corners.end());
        for (uint32_t i = 1; i + 1 < panel.corners.size(); ++i)
            mesh.triangles.push_back({first, first + i, first + i + 1});
    }
    return mesh;
}

/// Of every monitor without a surface of its own; empty for the others.
std::vector<PanelMesh> panel_meshes(const Scene& scene) {
    std::vector<PanelMesh> meshes(scene.monitors.size());
    for (size_t m = 0; m < scene.monitors.size(); ++m)
        if (std::none_of(scene.surfaces.begin(), scene.surfaces.end(),
                         [&](const Surface& s) { return s.monitor == static_cast<int>(m); }))
            meshes[m] = panel_mesh(scene.monitors[m]);
    return meshes;
}

std::vector<Part> opaque_parts(const Scene& scene, const std::vector<PanelMesh>& panels) {
    std::vector<Part> parts;
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        if (!surface.casts || is_cutout(scene, surface)) continue;
        const auto owner = surface.monitor < 0 ? Edge::ordinary : static_cast<uint32_t>(surface.monitor);
        parts.push_back({s, static_cast<uint8_t>(owner), &surface.positions, &surface.triangles});
    }
    for (size_t m = 0; m < panels.size(); ++m)
        if (!panels[m].triangles.empty())
            parts.push_back(
                {scene.surfaces.size() + m, static_cast<uint8_t>(m), &panels[m].positions, &panels[m].triangles});
    size_t vertices = 0, triangles = 0;
    for (Part& part : parts) {
        part.first_vertex = vertices;
        part.first_triangle = triangles;
        vertices += part.positions->size();
        triangles += part.triangles->size();
    }
    constexpr size_t most = (1u << 30) - 1;  // what Edge has bits for
    if (vertices > most || triangles > most)
        throw Error(ErrorKind::scene, "the scene has more than 1,073,741,823 triangles or vertices; reduce its meshes");
    return parts;
}

Vec3f relative(const Vec3& position, const Vec3& center) {
    return Vec3f(position - center);
}

WeldedMesh welded_mesh(const std::vector<Part>& parts, const Vec3& center) {
    WeldedMesh mesh;
    if (parts.empty()) return mesh;
    const Part& last = parts.back();
    mesh.places.resize(last.first_vertex + last.positions->size());
    mesh.owners.resize(mesh.places.size());
    for (const Part& part : parts)
        parallel_for(part.positions->size(), grain, [&](size_t i) {
            mesh.places[part.first_vertex + i] = relative((*part.positions)[i], center);
            mesh.owners[part.first_vertex + i] = part.owner;
        });
    const std::vector<uint32_t> first = weld(mesh.places, mesh.owners);
    mesh.corners.resize(last.first_triangle + last.triangles->size());
    mesh.planes.resize(mesh.corners.size());
    for (const Part& part : parts)
        parallel_for(part.triangles->size(), grain, [&](size_t i) {
            std::array<uint32_t, 3>& corners = mesh.corners[part.first_triangle + i];
            for (size_t k = 0; k < 3; ++k) corners[k] = first[part.first_vertex + (*part.triangles)[i][k]];
            mesh.planes[part.first_triangle + i] =
                plane_through(mesh.places[corners[0]], mesh.places[corners[1]], mesh.places[corners[2]]);
        });
    return mesh;
}

/// Numbers the facets in the order of their first triangles. Returns each triangle's plane.
std::vector<uint32_t> number_planes(const WeldedMesh& mesh, const std::vector<uint32_t>& facets,
                                    std::vector<FacePlane>& planes) {
    std::vector<uint32_t> of_triangle(facets.size(), Edge::no_plane), of_facet(facets.size(), Edge::no_plane);
    size_t count = 0;
    for (size_t t = 0; t < facets.size(); ++t)
        if (facets[t] == t && mesh.planes[t].normal != Vec3(0)) ++count;
    planes.reserve(count);
    for (size_t t = 0; t < facets.size(); ++t) {
        if (mesh.planes[t].normal == Vec3(0)) continue;
        uint32_t& number = of_facet[facets[t]];
        if (number == Edge::no_plane) {
            number = static_cast<uint32_t>(planes.size());
            planes.push_back(mesh.planes[facets[t]]);
        }
        of_triangle[t] = number;
    }
    return of_triangle;
}

Edge single_faced(const WeldedMesh& mesh, const std::vector<uint32_t>& plane_of, uint32_t half_edge) {
    const uint32_t start = start_of(mesh, half_edge);
    Edge edge;
    edge.a = mesh.places[start];
    edge.b = mesh.places[end_of(mesh, half_edge)];
    edge.first_and_owner = plane_of[half_edge / 3] | uint32_t{mesh.owners[start]} << 30;
    edge.second_and_sense = Edge::no_plane;
    return edge;
}

/// Writes the records of one edge, unless `edges` is null, and returns how many there are.
size_t write_records(const WeldedMesh& mesh, const std::vector<uint32_t>& plane_of, std::span<const Keyed> faces,
                     Edge* edges) {
    if (faces.size() != 2) {
        for (size_t i = 0; i < faces.size() && edges; ++i) edges[i] = single_faced(mesh, plane_of, faces[i].index);
        return faces.size();
    }
    const uint32_t one = faces[0].index, two = faces[1].index;
    const bool runs_alike = start_of(mesh, one) == start_of(mesh, two);
    if (!runs_alike && plane_of[one / 3] == plane_of[two / 3]) return 0;
    if (edges) {
        *edges = single_faced(mesh, plane_of, one);
        edges->second_and_sense = plane_of[two / 3] | (runs_alike ? 1u << 31 : 0u);
    }
    return 1;
}

std::vector<Edge> edges_of(const WeldedMesh& mesh, const std::vector<Keyed>& half_edges,
                           const std::vector<uint32_t>& plane_of) {
    const size_t ranges = (half_edges.size() + grain - 1) / grain;
    std::vector<size_t> starts(ranges + 1, 0);
    const auto write = [&](size_t from, size_t to, Edge* edges) {
        size_t count = 0;
        for_each_edge(half_edges, from, to, [&](size_t begin, size_t end) {
            const std::span<const Keyed> faces(&half_edges[begin], end - begin);
            count += write_records(mesh, plane_of, faces, edges ? edges + count : nullptr);
        });
        return count;
    };
    parallel_ranges(half_edges.size(), grain,
                    [&](size_t from, size_t to) { starts[from / grain + 1] = write(from, to, nullptr); });
    for (size_t r = 0; r < ranges; ++r) starts[r + 1] += starts[r];
    std::vector<Edge> edges(starts[ranges]);
    parallel_ranges(half_edges.size(), grain,
                    [&](size_t from, size_t to) { write(from, to, edges.data() + starts[from / grain]); });
    return edges;
}

void find_cutouts(const Scene& scene, Silhouettes& silhouettes) {
    for (const Surface& surface : scene.surfaces) {
        if (!surface.casts || !is_cutout(scene, surface)) continue;
        for (const auto& triangle : surface.triangles) {
            std::array<Vec3f, 3>& corners = silhouettes.cutouts.emplace_back();
            for (size_t k = 0; k < 3; ++k) corners[k] = relative(surface.positions[triangle[k]], silhouettes.center);
        }
    }
    silhouettes.cutout_nodes = build_boxes(silhouettes.cutouts);
}

}  // namespace

Silhouettes find_silhouettes(const Scene& scene, const RayScene& rays) {
    Silhouettes silhouettes;
    silhouettes.center = rays.center();
    silhouettes.plane_of.resize(scene.surfaces.size() + scene.monitors.size());
    for (size_t s = 0; s < scene.surfaces.size(); ++s)
        silhouettes.plane_of[s].assign(scene.surfaces[s].triangles.size(), Edge::no_plane);

    const std::vector<PanelMesh> panels = panel_meshes(scene);
    const std::vector<Part> parts = opaque_parts(scene, panels);
    {
        const WeldedMesh mesh = welded_mesh(parts, silhouettes.center);
        const std::vector<Keyed> half_edges = sorted_half_edges(mesh);
        const std::vector<uint32_t> plane_of = number_planes(mesh, find_facets(mesh, half_edges), silhouettes.planes);
        silhouettes.edges = edges_of(mesh, half_edges, plane_of);
        for (const Part& part : parts) {
            const auto first = plane_of.begin() + static_cast<std::ptrdiff_t>(part.first_triangle);
            silhouettes.plane_of[part.slot].assign(first, first + static_cast<std::ptrdiff_t>(part.triangles->size()));
        }
    }
    build_tree(silhouettes);
    find_cutouts(scene, silhouettes);
    return silhouettes;
}

}  // namespace surimi
