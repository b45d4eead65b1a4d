// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/gltf.h"

#include "runtime/scene/gltf_document.h"
#include "runtime/scene/gltf_materials.h"
#include "runtime/scene/gltf_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace surimi {
namespace {

using nlohmann::json;

Mat4 local_matrix(const tinygltf::Node& node, const std::string& place, Scene& scene) {
    Mat4 matrix{1};
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
        const bool is_affine = matrix[0][3] == 0 && matrix[1][3] == 0 && matrix[2][3] == 0 && matrix[3][3] == 1;
        if (!is_affine) add_note(scene, "last rows of node matrices that are not 0 0 0 1 ignored", place);
        for (int c = 0; c < 4; ++c) matrix[c][3] = c == 3 ? 1 : 0;
        return matrix;
    }
    Vec4 q(0, 0, 0, 1);
    if (node.rotation.size() == 4) q = Vec4(node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]);
    const double length = glm::length(q);
    if (!(length > 0) || !std::isfinite(length)) {
        add_note(scene, "zero rotations ignored", place);
        q = Vec4(0, 0, 0, 1);
    } else {
        // A quaternion from float is off by 1e-7; one that is off by more was not meant to be.
        if (std::abs(length - 1) > 1e-3) add_note(scene, "rotations that are not unit quaternions renormalised", place);
        q /= length;
    }
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    Mat3 linear(Vec3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)),
                Vec3(2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
                Vec3(2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)));
    for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<size_t>(c);
        if (node.scale.size() == 3) linear[c] *= node.scale[i];
        matrix[c] = Vec4(linear[c], 0);
        if (node.translation.size() == 3) matrix[3][c] = node.translation[i];
    }
    return matrix;
}

/// Width and height from extras.monitor_size; zero when it is not given or makes no sense.
Vec2 monitor_size(const json& source, const std::string& place, Scene& scene) {
    const json::json_pointer pointer("/extras/monitor_size");
    if (!source.contains(pointer)) return Vec2(0);
    const json& size = source.at(pointer);
    const bool is_pair = size.is_array() && size.size() >= 2 && size[0].is_number() && size[1].is_number();
    const Vec2 value = is_pair ? Vec2(size[0].get<double>(), size[1].get<double>()) : Vec2(0);
    if (value.x > 0 && value.y > 0 && value.x < 1e9 && value.y < 1e9) return value;
    add_note(scene, "extras.monitor_size is not two positive numbers; ignored", place);
    return Vec2(0);
}

/// A yes or no from extras; Blender writes 0 and 1.
std::optional<bool> read_truth(const json& extras, const char* key, const std::string& place, Scene& scene) {
    const auto found = extras.find(key);
    if (found == extras.end() || found->is_null()) return std::nullopt;
    if (*found == true || *found == 1) return true;
    if (*found == false || *found == 0) return false;
    add_note(scene, "extras." + std::string(key) + " is none of true, false, 1, 0; ignored", place);
    return std::nullopt;
}

RoleMarks read_roles(const json& source, const std::string& place, Scene& scene) {
    const auto extras = source.find("extras");
    if (extras == source.end() || !extras->is_object()) return {};
    return {read_truth(*extras, "casts", place, scene), read_truth(*extras, "receives", place, scene),
            read_truth(*extras, "two_sided", place, scene), read_truth(*extras, "exclude", place, scene)};
}

double number_or(const json& object, const char* key, double fallback) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : fallback;
}

/// EXT_lights_area, "rect": size is the height, intensity is in nits, color is linear.
void read_area_light(const json& document, const json& source, const std::string& place, Scene& scene, Node& node) {
    const json::json_pointer light_pointer("/extensions/EXT_lights_area/light");
    const json::json_pointer lights_pointer("/extensions/EXT_lights_area/lights");
    if (!source.contains(light_pointer)) return;
    const json& index = source.at(light_pointer);
    const json lights = document.contains(lights_pointer) ? document.at(lights_pointer) : json::array();
    const bool is_valid = index.is_number_integer() && index.get<int64_t>() >= 0 && lights.is_array() &&
                          index.get<size_t>() < lights.size();
    if (!is_valid || !lights[index.get<size_t>()].is_object()) {
        add_note(scene, "EXT_lights_area: lights that do not exist ignored", place);
        return;
    }
    const json& light = lights[index.get<size_t>()];
    if (light.value("/type"_json_pointer, json()) != "rect") {
        add_note(scene, "EXT_lights_area: lights that are not rectangles ignored", place);
        return;
    }
    const auto rect = light.find("rect");
    const double height = number_or(light, "size", 1);
    const double width = height * (rect != light.end() && rect->is_object() ? number_or(*rect, "aspect", 1) : 1);
    if (!(height > 0 && width > 0 && height < 1e9 && width < 1e9)) {
        add_note(scene, "EXT_lights_area: rectangles without a size ignored", place);
        return;
    }
    Vec3 color(1);
    const auto list = light.find("color");
    for (int k = 0; k < 3; ++k)
        if (list != light.end() && list->is_array() && list->size() == 3 && (*list)[static_cast<size_t>(k)].is_number())
            color[k] = (*list)[static_cast<size_t>(k)].get<double>();
    node.area_light_size = Vec2(width, height);
    node.area_light_radiance = glm::clamp(color * number_or(light, "intensity", 1000), Vec3(0), Vec3(1e30));
}

void read_nodes(const GltfDocument& document, Scene& scene) {
    const std::vector<tinygltf::Node>& sources = document.model.nodes;
    scene.nodes.resize(sources.size());
    for (size_t n = 0; n < sources.size(); ++n) {
        Node& node = scene.nodes[n];
        node.name = sources[n].name.empty() ? "node_" + std::to_string(n) : sources[n].name;
        node.mesh = sources[n].mesh;
        for (const int child : sources[n].children)
            scene.nodes[static_cast<size_t>(child)].parent = static_cast<int>(n);
        const json& source = document.json["nodes"][n];
        const std::string place = place_name("node", n, sources[n].name);
        const MonitorMark mark = read_monitor_mark(source);
        node.is_marked_monitor = mark.is_marked;
        node.monitor_channel = mark.channel;
        node.is_two_sided_monitor = mark.is_two_sided;
        if (mark.is_unclear) add_note(scene, "extras.monitor is none of R, G, B, 0, 1, 2, true; taken as true", place);
        node.texel_scale = read_texel_scale(source, place, scene);
        node.roles = read_roles(source, place, scene);
        node.monitor_size = monitor_size(source, place, scene);
        read_area_light(document.json, source, place, scene, node);
        if (source.contains("/extensions/EXT_mesh_gpu_instancing"_json_pointer))
            add_note(scene, "EXT_mesh_gpu_instancing ignored: only one instance is placed", place);
    }
}

/// Parents before children, without recursion: a chain of a million nodes must not overflow the stack.
void place_nodes(const GltfDocument& document, Scene& scene) {
    std::vector<size_t> order;
    for (size_t n = 0; n < scene.nodes.size(); ++n)
        if (scene.nodes[n].parent < 0) order.push_back(n);
    for (size_t i = 0; i < order.size(); ++i) {
        const tinygltf::Node& source = document.model.nodes[order[i]];
        Node& node = scene.nodes[order[i]];
        const Mat4 local = local_matrix(source, place_name("node", order[i], source.name), scene);
        node.to_world = node.parent < 0 ? local : scene.nodes[static_cast<size_t>(node.parent)].to_world * local;
        for (const int child : source.children) order.push_back(static_cast<size_t>(child));
    }
}

/// Marks what the default scene shows; else scene 0; else, in a file without scenes, everything.
void mark_shown(const GltfDocument& document, Scene& scene) {
    std::vector<size_t> shown;
    if (document.model.scenes.empty()) {
        for (size_t n = 0; n < scene.nodes.size(); ++n)
            if (scene.nodes[n].parent < 0) shown.push_back(n);
    } else {
        const int index = std::max(document.model.defaultScene, 0);
        for (const int n : document.model.scenes[static_cast<size_t>(index)].nodes)
            shown.push_back(static_cast<size_t>(n));
    }
    for (size_t i = 0; i < shown.size(); ++i) {
        if (std::exchange(scene.nodes[shown[i]].is_in_scene, true)) continue;
        for (const int child : document.model.nodes[shown[i]].children) shown.push_back(static_cast<size_t>(child));
    }
}

void read_cameras(const GltfDocument& document, Scene& scene) {
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
        const int index = document.model.nodes[n].camera;
        if (index < 0 || !scene.nodes[n].is_in_scene) continue;
        const tinygltf::Camera& source = document.model.cameras[static_cast<size_t>(index)];
        const std::string place = place_name("camera", static_cast<size_t>(index), source.name);
        if (source.type != "perspective") {
            add_note(scene, "cameras that are not perspective skipped", place);
            continue;
        }
        Camera camera;
        camera.name = scene.nodes[n].name;
        camera.to_world = scene.nodes[n].to_world;
        const double yfov = source.perspective.yfov;
        if (yfov > 0 && yfov < pi) camera.yfov = yfov;
        if (!(yfov > 0 && yfov < pi)) add_note(scene, "fields of view outside (0, pi) replaced", place);
        camera.aspect = std::max(source.perspective.aspectRatio, 0.0);
        scene.cameras.push_back(camera);
    }
}

void note_document(const GltfDocument& document, Scene& scene) {
    if (!document.model.animations.empty())
        add_note(scene, "animations ignored", document.model.animations[0].name, document.model.animations.size());
    if (!document.model.lights.empty())
        add_note(scene, "punctual lights ignored", document.model.lights[0].name, document.model.lights.size());
}

}  // namespace

Scene read_gltf(const std::filesystem::path& path) {
    GltfDocument document = load_document(path);
    Scene scene;
    scene.path = path;
    scene.notes = std::move(document.notes);
    read_nodes(document, scene);
    place_nodes(document, scene);
    mark_shown(document, scene);
    read_cameras(document, scene);
    read_materials(document, scene);
    read_images(document, scene);
    make_surfaces(document, scene);
    note_document(document, scene);
    return scene;
}

void add_note(std::vector<Note>& notes, const std::string& what, const std::string& where, size_t count) {
    const auto found = std::find_if(notes.begin(), notes.end(), [&](const Note& note) { return note.what == what; });
    if (found != notes.end()) {
        found->count += count;
    } else {
        notes.push_back({what, count, where});
    }
}

void add_note(Scene& scene, const std::string& what, const std::string& where, size_t count) {
    add_note(scene.notes, what, where, count);
}

size_t triangle_count(const Scene& scene) {
    return std::accumulate(scene.surfaces.begin(), scene.surfaces.end(), size_t{0},
                           [](size_t sum, const Surface& surface) { return sum + surface.triangles.size(); });
}

Bounds bounds(const Scene& scene) {
    Bounds result;
    const bool is_all_excluded =
        std::ranges::all_of(scene.surfaces, [](const Surface& surface) { return surface.is_excluded; });
    for (const Surface& surface : scene.surfaces) {
        if (surface.is_excluded && !is_all_excluded) continue;
        for (const std::array<uint32_t, 3>& corners : surface.triangles)
            for (const uint32_t v : corners) {
                result.low = glm::min(result.low, surface.positions[v]);
                result.high = glm::max(result.high, surface.positions[v]);
            }
    }
    return result;
}

}  // namespace surimi
