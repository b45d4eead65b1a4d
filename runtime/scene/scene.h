// SPDX-License-Identifier: Apache-2.0
// A scene as plain data: what a glTF file says, validated, in world space, with ids instead of pointers.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/base/image.h"
#include "runtime/base/math.h"
#include "runtime/light/monitor.h"

namespace surimi {

enum class Wrap { repeat, mirrored_repeat, clamp };

/// A texture as a material uses it. KHR_texture_transform is folded into `transform`.
struct TextureUse {
    int image = -1;  ///< index into Scene::images; -1: no texture
    int uv_set = 0;  ///< TEXCOORD_n
    Wrap wrap_s = Wrap::repeat;
    Wrap wrap_t = Wrap::repeat;
    Mat3 transform{1};  ///< uv (homogeneous) as stored -> uv to look up
};

enum class AlphaMode { opaque, mask, blend };

struct Material {
    std::string name;
    Vec4 base_color{1};             ///< linear
    TextureUse base_color_texture;  ///< sRGB-encoded colour, linear alpha
    double roughness = 1;           ///< perceptual, in [0, 1]
    double metallic = 1;
    TextureUse metallic_roughness_texture;  ///< G roughness, B metallic, linear
    double specular = 1;                    ///< KHR_materials_specular: 0, the dielectric part does not reflect
    Vec3 specular_color{1};                 ///< of that extension, linear; tints F0 of the dielectric part
    double index_of_refraction = 1.5;       ///< KHR_materials_ior; at least 1, or 0 for a perfect reflector
    TextureUse normal_texture;              ///< tangent space, +y up
    double normal_scale = 1;
    Vec3 emissive{0};             ///< factor times KHR_materials_emissive_strength, nits
    TextureUse emissive_texture;  ///< sRGB-encoded
    AlphaMode alpha_mode = AlphaMode::opaque;
    double alpha_cutoff = 0.5;
    bool double_sided = false;
    bool unlit = false;
    double transmission = 0;            ///< KHR_materials_transmission factor
    bool is_marked_monitor = false;     ///< extras.monitor is there and is not false
    int monitor_channel = -1;           ///< from extras.monitor, when it names one: 0, 1, 2
    bool is_two_sided_monitor = false;  ///< extras.monitor_two_sided
    double texel_scale = 1;             ///< extras.texel_scale: texels a metre over the usual, for lightmaps
    TextureUse visibility_map;          ///< the map that a baked file carries (extras.visibilityMap and its carrier)
    std::array<std::string, 3> visibility_channels;  ///< monitor of R, G, B; empty where unused
    bool visibility_is_srgb = false;                 ///< the carried map is sRGB-encoded
    int visibility_page = 0;                         ///< which of a bake's maps it is (extras.visibilityMap.page)
};

/// What extras.texel_scale may be.
inline constexpr double least_texel_scale = 0.001;
inline constexpr double largest_texel_scale = 1000;

/// What is said of the roles of surfaces; empty: nothing.
struct RoleMarks {
    std::optional<bool> casts, receives, two_sided;  ///< see Surface
    std::optional<bool> exclude;                     ///< neither casts nor receives, and is no monitor unless named
};

struct Node {
    std::string name;  ///< never empty: unnamed nodes are called node_<index>
    int parent = -1;
    int mesh = -1;
    Mat4 to_world{1};
    bool is_in_scene = false;        ///< reached from the scene that is shown
    bool is_marked_monitor = false;  ///< extras.monitor
    int monitor_channel = -1;
    bool is_two_sided_monitor = false;
    double texel_scale = 1;    ///< extras.texel_scale, for this node's and its descendants' meshes
    RoleMarks roles;           ///< extras.casts and so on, for this node's and its descendants' meshes; the nearest win
    bool is_excluded = false;  ///< decided by apply_roles: is no monitor unless the user names it
    Vec2 monitor_size{
        0};  ///< extras.monitor_size: an empty node that is a monitor of this width and height, facing its +z
    Vec2 area_light_size{0};  ///< EXT_lights_area rectangle: width and height before the node's scale, facing its -z
    Vec3 area_light_radiance{0};  ///< of that light: linear RGB, nits
};

/// One primitive of one mesh as one node places it: triangles in world space. Every placement is its own
/// receiver. Triangles run counter-clockwise seen from the front; mirrored nodes are accounted for. None has
/// zero area.
struct Surface {
    std::string name;  ///< node name, and "/primitive" where the mesh has several
    int node = 0;
    int mesh = 0;
    int primitive = 0;
    int material = -1;            ///< index into Scene::materials; -1: glTF's default material
    int monitor = -1;             ///< index into Scene::monitors when this surface is (part of) one
    bool casts = true;            ///< it stands in the way of light
    bool receives = true;         ///< it gets texels of the map
    bool is_two_sided = false;    ///< light on its back counts where none can fall on its front
    bool is_excluded = false;     ///< nothing of it is baked: neither casts nor receives, and the user said so
    bool is_drawn = true;         ///< false: excluded as a collision mesh, which engines do not show
    std::vector<Vec3> positions;  ///< metres; one for each vertex of the primitive, in its order
    std::vector<Vec3> normals;  ///< unit; same length. Flat ones where the file has none: then vertices are not shared
    std::vector<std::vector<Vec2>> uv_sets;          ///< TEXCOORD_0, 1, ...; each of the length of positions
    std::vector<std::array<uint32_t, 3>> triangles;  ///< vertex indices
    std::vector<uint32_t> source_triangle;  ///< for each triangle, its number in the primitive as the file orders them
    std::vector<uint32_t> source_vertex;    ///< for each vertex, its number in the primitive's accessors
};

struct Camera {
    std::string name;
    Mat4 to_world{1};   ///< looks along -z, up is +y
    double yfov = 0.8;  ///< radians
    double aspect = 0;  ///< width / height; 0: not given
};

/// Something that was dropped, repaired or read in a reduced form; shown to the user.
struct Note {
    std::string what;  ///< "zero-area triangles dropped"
    size_t count = 1;
    std::string where;  ///< the first place where it happened
};

struct Scene {
    std::filesystem::path path;
    std::vector<Node> nodes;
    std::vector<Material> materials;
    std::vector<Image<glm::u8vec4>> images;  ///< as stored: not linearised; empty where an image could not be decoded
    std::vector<Surface> surfaces;
    std::vector<Camera> cameras;
    std::vector<Monitor> monitors;  ///< filled by find_monitors, sorted by channel
    std::vector<Note> notes;
};

/// Adds `count` to the note with this text, or makes one that remembers `where`.
void add_note(Scene& scene, const std::string& what, const std::string& where, size_t count = 1);

void add_note(std::vector<Note>& notes, const std::string& what, const std::string& where, size_t count = 1);

size_t triangle_count(const Scene& scene);

struct Bounds {
    Vec3 low{INFINITY};
    Vec3 high{-INFINITY};
};
/// Bounds of all surfaces but the excluded ones, if there are others; metres.
Bounds bounds(const Scene& scene);

}  // namespace surimi
