// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/gltf_primitive.h"

#include "runtime/scene/accessor.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace surimi {
namespace {

// Files use one or two sets; more are a mistake, and each costs 16 bytes a vertex.
constexpr int most_uv_sets = 8;

// Bounds are written by exporters in decimal, rounded to float: they agree to about 1e-7 of the coordinate.
constexpr double bounds_tolerance = 1e-5;

class PrimitiveReader {
  public:
    PrimitiveReader(const GltfDocument& document, size_t mesh, size_t primitive, std::vector<Note>& notes)
        : document_(document),
          primitive_(document.model.meshes[mesh].primitives[primitive]),
          place_(place_name("mesh", mesh, document.model.meshes[mesh].name) + ", primitive " +
                 std::to_string(primitive)),
          notes_(notes) {}

    PrimitiveData read(const std::vector<double>& weights) {
        PrimitiveData data;
        data.place = place_;
        if (primitive_.mode >= TINYGLTF_MODE_POINTS && primitive_.mode <= TINYGLTF_MODE_LINE_STRIP) {
            add_note(notes_, "primitives of points or lines skipped", place_);
            return data;
        }
        if (primitive_.attributes.count("POSITION") == 0) {
            add_note(notes_, "primitives without positions skipped", place_);
            return data;
        }
        read_positions(data);
        if (primitive_.attributes.count("NORMAL") > 0)
            data.normals = read_vectors<Vec3>("NORMAL", primitive_.attributes.at("NORMAL"), data.positions.size());
        apply_targets(data, weights);
        read_uv_sets(data);
        read_influences(data);
        read_triangles(data);
        return data;
    }

  private:
    [[noreturn]] void refuse(const std::string& attribute, int accessor, const std::string& what) const {
        fail(document_.path, place_ + ", " + attribute + ", " + accessor_name(document_.model, accessor), what);
    }

    const tinygltf::Accessor& accessor(int index) const {
        return document_.model.accessors[static_cast<size_t>(index)];
    }

    /// The accessor as vectors of its very type; `count` 0: however many there are.
    template <class Vector>
    std::vector<Vector> read_vectors(const std::string& attribute, int index, size_t count) const {
        constexpr auto length = static_cast<size_t>(Vector::length());
        const int type = accessor(index).type;
        if (type != static_cast<int>(length)) refuse(attribute, index, "must be VEC" + std::to_string(length));
        if (count > 0 && accessor(index).count != count)
            refuse(attribute, index,
                   "has " + std::to_string(accessor(index).count) + " elements, but the primitive has " +
                       std::to_string(count) + " vertices");
        const std::vector<double> values = read_accessor(document_.model, index);
        std::vector<Vector> vectors(accessor(index).count);
        for (size_t i = 0; i < vectors.size(); ++i)
            for (size_t k = 0; k < length; ++k) vectors[i][static_cast<int>(k)] = values[i * length + k];
        return vectors;
    }

    void read_positions(PrimitiveData& data) {
        const int index = primitive_.attributes.at("POSITION");
        if (accessor(index).componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
            refuse("POSITION", index, "32-bit integers are not allowed");
        data.positions = read_vectors<Vec3>("POSITION", index, 0);
        for (size_t v = 0; v < data.positions.size(); ++v)
            if (!is_finite(data.positions[v]))
                refuse("POSITION", index, "vertex " + std::to_string(v) + " is not finite");
        check_bounds(data, accessor(index));
    }

    /// Wrong bounds harm nobody here, but viewers cull by them.
    void check_bounds(const PrimitiveData& data, const tinygltf::Accessor& positions) {
        if (positions.minValues.size() != 3 || positions.maxValues.size() != 3 || positions.normalized) return;
        Vec3 low{INFINITY};
        Vec3 high{-INFINITY};
        for (const Vec3& p : data.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        bool is_wrong = false;
        for (int k = 0; k < 3; ++k) {
            const double scale = std::max({std::abs(low[k]), std::abs(high[k]), high[k] - low[k]});
            const auto i = static_cast<size_t>(k);
            is_wrong |= std::abs(positions.minValues[i] - low[k]) > bounds_tolerance * scale;
            is_wrong |= std::abs(positions.maxValues[i] - high[k]) > bounds_tolerance * scale;
        }
        if (is_wrong && !data.positions.empty())
            add_note(notes_, "wrong accessor bounds ignored", place_ + ", POSITION");
    }

    void apply_targets(PrimitiveData& data, const std::vector<double>& weights) {
        if (primitive_.targets.empty()) return;
        add_note(notes_, "morph targets taken at their default weights", place_);
        for (size_t t = 0; t < primitive_.targets.size(); ++t) {
            const double weight = t < weights.size() ? weights[t] : 0;
            if (weight == 0) continue;
            add_target(primitive_.targets[t], "POSITION", weight, data.positions);
            if (!data.normals.empty()) add_target(primitive_.targets[t], "NORMAL", weight, data.normals);
        }
    }

    void add_target(const std::map<std::string, int>& target, const std::string& attribute, double weight,
                    std::vector<Vec3>& values) {
        const auto found = target.find(attribute);
        if (found == target.end()) return;
        const std::vector<Vec3> offsets = read_vectors<Vec3>("target " + attribute, found->second, values.size());
        for (size_t v = 0; v < values.size(); ++v) {
            if (attribute == "POSITION" && !is_finite(offsets[v]))
                refuse("target " + attribute, found->second, "vertex " + std::to_string(v) + " is not finite");
            values[v] += weight * offsets[v];
        }
    }

    void read_uv_sets(PrimitiveData& data) {
        int count = 0;
        for (int n = 0; n < most_uv_sets; ++n)
            if (primitive_.attributes.count("TEXCOORD_" + std::to_string(n)) > 0) count = n + 1;
        for (int n = 0; n < count; ++n) {
            const std::string attribute = "TEXCOORD_" + std::to_string(n);
            const auto found = primitive_.attributes.find(attribute);
            if (found == primitive_.attributes.end()) {
                add_note(notes_, "missing UV sets filled with zeros", place_ + ", " + attribute);
                data.uv_sets.emplace_back(data.positions.size(), Vec2(0));
                continue;
            }
            data.uv_sets.push_back(read_vectors<Vec2>(attribute, found->second, data.positions.size()));
            size_t repaired = 0;
            for (Vec2& uv : data.uv_sets.back()) {
                if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
                uv = Vec2(0);
                ++repaired;
            }
            if (repaired > 0)
                add_note(notes_, "UVs that are not finite set to zero", place_ + ", " + attribute, repaired);
        }
    }

    void read_influences(PrimitiveData& data) const {
        size_t sets = 0;
        while (primitive_.attributes.count("JOINTS_" + std::to_string(sets)) > 0 &&
               primitive_.attributes.count("WEIGHTS_" + std::to_string(sets)) > 0)
            ++sets;
        data.influences_per_vertex = 4 * sets;
        data.influences.resize(data.influences_per_vertex * data.positions.size());
        for (size_t set = 0; set < sets; ++set) {
            const std::string joint_name = "JOINTS_" + std::to_string(set);
            const std::string weight_name = "WEIGHTS_" + std::to_string(set);
            const int joint_index = primitive_.attributes.at(joint_name);
            const int component = accessor(joint_index).componentType;
            if (component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
                component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
                refuse(joint_name, joint_index, "joints must be unsigned 8- or 16-bit integers");
            const auto joints = read_vectors<Vec4>(joint_name, joint_index, data.positions.size());
            const auto weights =
                read_vectors<Vec4>(weight_name, primitive_.attributes.at(weight_name), data.positions.size());
            for (size_t v = 0; v < joints.size(); ++v)
                for (int k = 0; k < 4; ++k) {
                    Influence& influence =
                        data.influences[v * data.influences_per_vertex + 4 * set + static_cast<size_t>(k)];
                    influence = {static_cast<uint32_t>(joints[v][k]), weights[v][k]};
                }
        }
    }

    std::vector<uint32_t> read_indices(size_t vertex_count) {
        if (primitive_.indices < 0) {
            std::vector<uint32_t> indices(vertex_count);
            std::iota(indices.begin(), indices.end(), 0u);
            return indices;
        }
        const tinygltf::Accessor& source = accessor(primitive_.indices);
        const bool is_unsigned = source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                 source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                                 source.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        if (source.type != TINYGLTF_TYPE_SCALAR || !is_unsigned || source.normalized)
            refuse("indices", primitive_.indices, "must be unsigned integer scalars");
        std::vector<uint32_t> indices = read_whole_accessor(document_.model, primitive_.indices);
        for (size_t i = 0; i < indices.size(); ++i)
            if (indices[i] >= vertex_count)
                refuse("indices", primitive_.indices,
                       "index " + std::to_string(i) + " is " + std::to_string(indices[i]) + ", but the primitive has " +
                           std::to_string(vertex_count) + " vertices");
        return indices;
    }

    void read_triangles(PrimitiveData& data) {
        if (data.positions.size() > UINT32_MAX) fail(document_.path, place_, "has more than 2^32 vertices");
        const std::vector<uint32_t> indices = read_indices(data.positions.size());
        const size_t n = indices.size();
        if (primitive_.mode == TINYGLTF_MODE_TRIANGLES) {
            for (size_t i = 0; i + 2 < n; i += 3)
                data.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
            if (n % 3 != 0) add_note(notes_, "left-over indices of incomplete triangles dropped", place_, n % 3);
            return;
        }
        const bool is_strip = primitive_.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        for (size_t i = 0; i + 2 < n; ++i) {
            // Every second triangle of a strip runs backwards; swapping its last two corners turns it
            // (glTF 3.7.2.1).
            const size_t odd = i % 2;
            if (is_strip) data.triangles.push_back({indices[i], indices[i + 1 + odd], indices[i + 2 - odd]});
            if (!is_strip) data.triangles.push_back({indices[i + 1], indices[i + 2], indices[0]});
        }
        if (n < 3) add_note(notes_, "strips and fans with fewer than three vertices skipped", place_);
    }

    const GltfDocument& document_;
    const tinygltf::Primitive& primitive_;
    std::string place_;
    std::vector<Note>& notes_;
};

}  // namespace

PrimitiveData read_primitive(const GltfDocument& document, size_t mesh, size_t primitive,
                             const std::vector<double>& weights, std::vector<Note>& notes) {
    return PrimitiveReader(document, mesh, primitive, notes).read(weights);
}

}  // namespace surimi
