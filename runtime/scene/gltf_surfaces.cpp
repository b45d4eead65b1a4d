// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/gltf_surfaces.h"

#include "runtime/scene/accessor.h"
#include "runtime/scene/gltf_primitive.h"

#include <algorithm>
#include <map>

namespace surimi {
namespace {

// A few nodes can multiply one mesh without end. A triangle costs about 100 bytes in memory, so this is 20
// GB.
constexpr size_t most_triangles = 200'000'000;

// Exporters write float: unit normals come with errors of about 1e-7, quantised ones of 1e-2 (8 bits); both
// are meant.
constexpr double unit_tolerance = 0.02;

/// How the vertices of one placement get into the world.
struct Placement {
    Mat4 to_world{1};
    std::vector<Mat4> joints;  ///< joint world matrices times inverse bind matrices; empty: not skinned
};

double determinant_sign(const Mat4& m) {
    return glm::determinant(Mat3(m)) < 0 ? -1 : 1;
}

class Placer {
  public:
    Placer(const GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}

    void place_all() {
        for (size_t n = 0; n < scene_.nodes.size(); ++n) {
            const Node& node = scene_.nodes[n];
            if (!node.is_in_scene || node.mesh < 0) continue;
            const size_t count = document_.model.meshes[static_cast<size_t>(node.mesh)].primitives.size();
            for (size_t p = 0; p < count; ++p) place(n, p, count);
        }
    }

  private:
    /// Meshes are shared by many nodes; each is read once, except where a node sets morph weights of its own.
    const PrimitiveData& primitive_data(const tinygltf::Node& source, size_t mesh, size_t p) {
        if (!source.weights.empty()) {
            own_ = read_primitive(document_, mesh, p, source.weights, scene_.notes);
            return own_;
        }
        const auto [entry, is_new] = shared_.try_emplace({mesh, p});
        if (is_new)
            entry->second = read_primitive(document_, mesh, p, document_.model.meshes[mesh].weights, scene_.notes);
        return entry->second;
    }

    void place(size_t n, size_t p, size_t primitive_count) {
        const tinygltf::Node& source = document_.model.nodes[n];
        const Node& node = scene_.nodes[n];
        const auto mesh = static_cast<size_t>(node.mesh);
        const PrimitiveData& data = primitive_data(source, mesh, p);
        if (data.triangles.empty()) return;
        triangle_total_ += data.triangles.size();
        if (triangle_total_ > most_triangles)
            fail(document_.path, place_name("node", n, node.name),
                 "with it the scene has more than " + std::to_string(most_triangles) + " triangles; split the scene");
        Surface surface;
        surface.name = node.name + (primitive_count > 1 ? "/" + std::to_string(p) : "");
        surface.node = static_cast<int>(n);
        surface.mesh = node.mesh;
        surface.primitive = static_cast<int>(p);
        surface.material = document_.model.meshes[mesh].primitives[p].material;
        place_ = place_name("node", n, node.name) + ", " + data.place;
        Placement placement{node.to_world, {}};
        if (source.skin >= 0 && data.influences_per_vertex > 0)
            placement.joints = joint_matrices(static_cast<size_t>(source.skin));
        place_vertices(data, placement, surface);
        if (data.normals.empty()) make_flat(surface);
        if (surface.triangles.empty()) return;
        repair_normals(surface);
        scene_.surfaces.push_back(std::move(surface));
    }

    std::vector<Mat4> joint_matrices(size_t s) {
        const tinygltf::Skin& skin = document_.model.skins[s];
        add_note(scene_, "skinned meshes taken in the pose of the file", place_);
        std::vector<double> inverse_bind;
        const std::string place = place_name("skin", s, skin.name) + ", inverseBindMatrices";
        if (skin.inverseBindMatrices >= 0) {
            const tinygltf::Accessor& accessor =
                document_.model.accessors[static_cast<size_t>(skin.inverseBindMatrices)];
            if (accessor.type != TINYGLTF_TYPE_MAT4 || accessor.count < skin.joints.size())
                fail(document_.path, place, "must be one MAT4 for each joint");
            inverse_bind = read_accessor(document_.model, skin.inverseBindMatrices);
        }
        std::vector<Mat4> matrices;
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            Mat4 bind{1};
            if (!inverse_bind.empty())
                for (int c = 0; c < 16; ++c) bind[c / 4][c % 4] = inverse_bind[j * 16 + static_cast<size_t>(c)];
            matrices.push_back(scene_.nodes[static_cast<size_t>(skin.joints[j])].to_world * bind);
        }
        return matrices;
    }

    /// The node's matrix, or the joints' matrices mixed by the vertex' weights: glTF ignores the node then.
    Mat4 vertex_matrix(const PrimitiveData& data, const Placement& placement, size_t v) {
        if (placement.joints.empty()) return placement.to_world;
        Mat4 mixed{0};
        double sum = 0;
        for (size_t k = 0; k < data.influences_per_vertex; ++k) {
            const Influence& influence = data.influences[v * data.influences_per_vertex + k];
            if (!(influence.weight > 0) || !std::isfinite(influence.weight)) continue;
            if (influence.joint >= placement.joints.size())
                fail(document_.path, place_,
                     "vertex " + std::to_string(v) + " names joint " + std::to_string(influence.joint) +
                         " of a skin with " + std::to_string(placement.joints.size()));
            mixed += influence.weight * placement.joints[influence.joint];
            sum += influence.weight;
        }
        if (sum > 0) return mixed / sum;
        add_note(scene_, "vertices without skin weights follow the first joint", place_);
        return placement.joints[0];
    }

    void place_vertices(const PrimitiveData& data, const Placement& placement, Surface& surface) {
        std::vector<double> sign(data.positions.size());
        Mat4 matrix = placement.to_world;
        Mat3 for_normals = normal_matrix(Mat3(matrix));
        double matrix_sign = determinant_sign(matrix);
        for (size_t v = 0; v < data.positions.size(); ++v) {
            if (!placement.joints.empty()) {
                matrix = vertex_matrix(data, placement, v);
                for_normals = normal_matrix(Mat3(matrix));
                matrix_sign = determinant_sign(matrix);
            }
            sign[v] = matrix_sign;
            surface.positions.emplace_back(matrix * Vec4(data.positions[v], 1));
            if (!is_finite(surface.positions.back()))
                fail(document_.path, place_,
                     "vertex " + std::to_string(v) +
                         " is not finite in the world; check the scales of the node and its parents");
            if (!data.normals.empty()) surface.normals.push_back(place_normal(for_normals, data.normals[v]));
            surface.source_vertex.push_back(static_cast<uint32_t>(v));
        }
        surface.uv_sets = data.uv_sets;
        size_t degenerate = 0;
        for (size_t t = 0; t < data.triangles.size(); ++t) {
            std::array<uint32_t, 3> corners = data.triangles[t];
            if (is_degenerate(surface.positions[corners[0]], surface.positions[corners[1]],
                              surface.positions[corners[2]])) {
                ++degenerate;
                continue;
            }
            if (sign[corners[0]] < 0) std::swap(corners[1], corners[2]);
            surface.triangles.push_back(corners);
            surface.source_triangle.push_back(static_cast<uint32_t>(t));
        }
        if (degenerate > 0) add_note(scene_, "zero-area triangles dropped", place_, degenerate);
    }

    /// The unit normal in the world; zero where the file's is of no use, for repair_normals.
    Vec3 place_normal(const Mat3& for_normals, const Vec3& normal) {
        if (!is_finite(normal) || glm::length(normal) == 0) return Vec3(0);
        if (std::abs(glm::length(normal) - 1) > unit_tolerance) ++stretched_normals_;
        return normalize_or(for_normals * normalize_or(normal, Vec3(0)), Vec3(0));
    }

    /// glTF: without normals a primitive is flat, so no two triangles share a vertex.
    static void make_flat(Surface& surface) {
        Surface flat;
        flat.uv_sets.resize(surface.uv_sets.size());
        for (std::array<uint32_t, 3>& corners : surface.triangles) {
            const auto first = static_cast<uint32_t>(flat.positions.size());
            const Vec3 normal = area_normal(surface.positions[corners[0]], surface.positions[corners[1]],
                                            surface.positions[corners[2]]);
            for (const uint32_t v : corners) {
                flat.positions.push_back(surface.positions[v]);
                flat.normals.push_back(normalize_or(normal, Vec3(0)));
                flat.source_vertex.push_back(surface.source_vertex[v]);
                for (size_t set = 0; set < flat.uv_sets.size(); ++set)
                    flat.uv_sets[set].push_back(surface.uv_sets[set][v]);
            }
            corners = {first, first + 1, first + 2};
        }
        surface.positions = std::move(flat.positions);
        surface.normals = std::move(flat.normals);
        surface.source_vertex = std::move(flat.source_vertex);
        surface.uv_sets = std::move(flat.uv_sets);
    }

    /// Zero normals become the average of the triangles around them, by area. Vertices of no triangle point
    /// up: their normal is never seen, but must be one.
    void repair_normals(Surface& surface) {
        if (stretched_normals_ > 0)
            add_note(scene_, "normals that are not unit vectors renormalised", place_, stretched_normals_);
        stretched_normals_ = 0;
        std::map<uint32_t, Vec3> sums;
        for (const std::array<uint32_t, 3>& corners : surface.triangles)
            for (const uint32_t v : corners)
                if (surface.normals[v] == Vec3(0))
                    sums[v] += area_normal(surface.positions[corners[0]], surface.positions[corners[1]],
                                           surface.positions[corners[2]]);
        for (const auto& [v, sum] : sums) surface.normals[v] = normalize_or(sum, Vec3(0, 0, 1));
        if (!sums.empty())
            add_note(scene_, "zero or infinite normals replaced by those of the triangles", place_, sums.size());
        for (Vec3& normal : surface.normals)
            if (normal == Vec3(0)) normal = Vec3(0, 0, 1);
    }

    const GltfDocument& document_;
    Scene& scene_;
    std::map<std::pair<size_t, size_t>, PrimitiveData> shared_;
    PrimitiveData own_;
    std::string place_;
    size_t triangle_total_ = 0;
    size_t stretched_normals_ = 0;
};

/// Textures on UV sets that a surface does not have read (0, 0); said once, because it looks like a bug of
/// ours.
void note_missing_uv_sets(Scene& scene) {
    for (const Surface& surface : scene.surfaces) {
        if (surface.material < 0) continue;
        const Material& m = scene.materials[static_cast<size_t>(surface.material)];
        for (const TextureUse* use :
             {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emissive_texture})
            if (use->image >= 0 && static_cast<size_t>(use->uv_set) >= surface.uv_sets.size())
                add_note(scene, "textures on a UV set that the mesh lacks",
                         surface.name + ", TEXCOORD_" + std::to_string(use->uv_set));
    }
}

}  // namespace

bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a;
    const Vec3 bc = c - b;
    const Vec3 ca = a - c;
    const double longest = std::max({glm::dot(ab, ab), glm::dot(bc, bc), glm::dot(ca, ca)});
    const double area = 0.5 * glm::length(glm::cross(ab, ca));
    return !(area > 0) || area <= 1e-14 * longest;
}

Mat3 normal_matrix(const Mat3& linear) {
    double scale = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) scale = std::max(scale, std::abs(linear[c][r]));
    if (!(scale > 0) || !std::isfinite(scale)) return Mat3(0);
    const Mat3 m = linear / scale;
    const Mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::determinant(m) < 0 ? -cofactors : cofactors;
}

void make_surfaces(const GltfDocument& document, Scene& scene) {
    Placer(document, scene).place_all();
    note_missing_uv_sets(scene);
}

}  // namespace surimi
