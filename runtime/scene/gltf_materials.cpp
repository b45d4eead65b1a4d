// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/gltf_materials.h"

#include "runtime/base/error.h"
#include "runtime/base/parallel.h"
#include "runtime/image/image_file.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace surimi {
namespace {

using nlohmann::json;

// Extensions are optional and unchecked: what has the wrong type counts as not given.
const json& member(const json& object, const char* key) {
    static const json nothing;
    if (!object.is_object()) return nothing;
    const auto found = object.find(key);
    return found == object.end() ? nothing : *found;
}

double number_or(const json& object, const char* key, double fallback) {
    const json& value = member(object, key);
    return value.is_number() ? value.get<double>() : fallback;
}

Vec3 vector_or(const json& object, const char* key, const Vec3& fallback) {
    const json& list = member(object, key);
    if (!list.is_array() || list.size() < 3) return fallback;
    Vec3 result;
    for (int k = 0; k < 3; ++k) {
        const json& item = list[static_cast<size_t>(k)];
        if (!item.is_number()) return fallback;
        result[k] = item.get<double>();
    }
    return result;
}

int whole_or(const json& object, const char* key, int fallback, int limit) {
    const double value = number_or(object, key, -1);
    return value >= 0 && value < limit && value == std::floor(value) ? static_cast<int>(value) : fallback;
}

Wrap wrap_mode(int code) {
    if (code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    if (code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirrored_repeat;
    return Wrap::repeat;
}

/// KHR_texture_transform: translation * rotation * scale, applied to (u, v, 1).
Mat3 uv_transform(const json& extension) {
    const auto pair = [&](const char* key, const Vec2& fallback) {
        const json& list = member(extension, key);
        if (!list.is_array() || list.size() != 2 || !list[0].is_number() || !list[1].is_number()) return fallback;
        return Vec2(list[0].get<double>(), list[1].get<double>());
    };
    const Vec2 offset = pair("offset", Vec2(0));
    const Vec2 scale = pair("scale", Vec2(1));
    const double angle = number_or(extension, "rotation", 0);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return Mat3(Vec3(c * scale.x, -s * scale.x, 0), Vec3(s * scale.y, c * scale.y, 0), Vec3(offset, 1));
}

/// The image that a texture shows: its own source, else that of an extension for other image formats.
int texture_image(const json& texture, size_t image_count) {
    const int limit = static_cast<int>(image_count);
    const int source = whole_or(texture, "source", -1, limit);
    if (source >= 0) return source;
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds"}) {
        const int image = whole_or(member(member(texture, "extensions"), name), "source", -1, limit);
        if (image >= 0) return image;
    }
    return -1;
}

TextureUse read_texture_use(const GltfDocument& document, const json& info) {
    TextureUse use;
    const json& textures = member(document.json, "textures");
    const int index = whole_or(info, "index", -1, static_cast<int>(textures.size()));
    if (index < 0) return use;
    const json& texture = textures[static_cast<size_t>(index)];
    use.image = texture_image(texture, document.model.images.size());
    use.uv_set = whole_or(info, "texCoord", 0, 64);
    const json& samplers = member(document.json, "samplers");
    const int sampler = whole_or(texture, "sampler", -1, static_cast<int>(samplers.size()));
    if (sampler >= 0) {
        use.wrap_s = wrap_mode(whole_or(samplers[static_cast<size_t>(sampler)], "wrapS", 0, 65536));
        use.wrap_t = wrap_mode(whole_or(samplers[static_cast<size_t>(sampler)], "wrapT", 0, 65536));
    }
    const json& transform = member(member(info, "extensions"), "KHR_texture_transform");
    if (!transform.is_object()) return use;
    use.transform = uv_transform(transform);
    use.uv_set = whole_or(transform, "texCoord", use.uv_set, 64);
    return use;
}

void read_visibility_map(const GltfDocument& document, const json& source, Material& material) {
    const json& map = member(member(source, "extras"), "visibilityMap");
    if (!map.is_object()) return;
    const json& channels = member(map, "channels");
    for (size_t c = 0; c < std::min<size_t>(3, channels.size()); ++c)
        if (channels.is_array() && channels[c].is_string())
            material.visibility_channels[c] = channels[c].get<std::string>();
    material.visibility_is_srgb = member(map, "encoding") == "srgb";
    constexpr int most_pages = 1024;  // far more than a bake makes: what is above is damage
    material.visibility_page = whole_or(map, "page", 0, most_pages);
    // Tools renumber textures and UV sets, but only in the carrier: sheen where the material has a clearcoat of its
    // own.
    const json& extensions = member(source, "extensions");
    const json& sheen = member(extensions, "KHR_materials_sheen");
    const json& clearcoat = member(extensions, "KHR_materials_clearcoat");
    const bool is_on_clearcoat =
        number_or(clearcoat, "clearcoatFactor", 0) == 0 && !member(clearcoat, "clearcoatTexture").is_null();
    material.visibility_map = is_on_clearcoat ? read_texture_use(document, member(clearcoat, "clearcoatTexture"))
                                              : read_texture_use(document, member(sheen, "sheenColorTexture"));
}

Material read_material(const GltfDocument& document, const json& source) {
    Material material;
    const json& pbr = member(source, "pbrMetallicRoughness");
    const json& extensions = member(source, "extensions");
    const json& color = member(pbr, "baseColorFactor");
    const Vec3 rgb = glm::clamp(vector_or(pbr, "baseColorFactor", Vec3(1)), Vec3(0), Vec3(1));
    const double alpha = color.is_array() && color.size() == 4 ? color[3].get<double>() : 1;
    material.base_color = Vec4(rgb, std::clamp(alpha, 0.0, 1.0));
    material.base_color_texture = read_texture_use(document, member(pbr, "baseColorTexture"));
    material.roughness = std::clamp(number_or(pbr, "roughnessFactor", 1), 0.0, 1.0);
    material.metallic = std::clamp(number_or(pbr, "metallicFactor", 1), 0.0, 1.0);
    material.metallic_roughness_texture = read_texture_use(document, member(pbr, "metallicRoughnessTexture"));
    const json& normal = member(source, "normalTexture");
    material.normal_texture = read_texture_use(document, normal);
    material.normal_scale = number_or(normal, "scale", 1);
    const double strength = number_or(member(extensions, "KHR_materials_emissive_strength"), "emissiveStrength", 1);
    // A finite ceiling, far above the sun's 1.6e9 nits, keeps sums and products of it finite.
    constexpr double brightest = 1e30;
    const Vec3 factor = glm::clamp(vector_or(source, "emissiveFactor", Vec3(0)), Vec3(0), Vec3(brightest));
    material.emissive = glm::min(factor * std::clamp(strength, 0.0, brightest), Vec3(brightest));
    material.emissive_texture = read_texture_use(document, member(source, "emissiveTexture"));
    const json& mode = member(source, "alphaMode");
    if (mode == "MASK") material.alpha_mode = AlphaMode::mask;
    if (mode == "BLEND") material.alpha_mode = AlphaMode::blend;
    material.alpha_cutoff = number_or(source, "alphaCutoff", 0.5);
    material.double_sided = member(source, "doubleSided") == true;
    material.unlit = extensions.is_object() && extensions.contains("KHR_materials_unlit");
    const double transmission = number_or(member(extensions, "KHR_materials_transmission"), "transmissionFactor", 0);
    material.transmission = std::clamp(transmission, 0.0, 1.0);
    const json& specular = member(extensions, "KHR_materials_specular");
    material.specular = std::clamp(number_or(specular, "specularFactor", 1), 0.0, 1.0);
    material.specular_color = glm::clamp(vector_or(specular, "specularColorFactor", Vec3(1)), Vec3(0), Vec3(100));
    const double ior = number_or(member(extensions, "KHR_materials_ior"), "ior", 1.5);
    material.index_of_refraction = ior == 0 || ior >= 1 ? ior : 1.5;
    read_visibility_map(document, source, material);
    return material;
}

void note_ignored_extensions(const json& extensions, const std::string& place, Scene& scene) {
    static const std::set<std::string> read{
        "KHR_materials_emissive_strength",
        "KHR_materials_unlit",
        "KHR_materials_transmission",
        "KHR_materials_specular",
        "KHR_materials_ior",
        "KHR_materials_clearcoat"};  // clearcoat: ignored where it is not the carrier
    static const std::set<std::string> matters{"KHR_materials_pbrSpecularGlossiness", "KHR_materials_volume",
                                               "KHR_materials_diffuse_transmission", "KHR_materials_displacement"};
    if (!extensions.is_object()) return;
    for (const auto& item : extensions.items())
        if (read.count(item.key()) == 0 && matters.count(item.key()) > 0)
            add_note(scene, "material extension ignored: " + item.key(), place);
}

/// The name tells the decoder the format, so its ending is taken from the bytes, which do not lie. Empty:
/// unknown.
std::string format_ending(std::span<const uint8_t> bytes) {
    const auto starts_with = [&](size_t offset, std::string_view magic) {
        return bytes.size() >= offset + magic.size() &&
               std::equal(magic.begin(), magic.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset),
                          [](char a, uint8_t b) { return static_cast<uint8_t>(a) == b; });
    };
    if (starts_with(0, "\x89PNG")) return ".png";
    if (starts_with(0, "\xFF\xD8")) return ".jpg";
    if (starts_with(8, "WEBP")) return ".webp";
    if (starts_with(1, "KTX 20")) return ".ktx2";
    return "";
}

std::set<size_t> used_images(const Scene& scene) {
    std::set<size_t> used;
    for (const Material& m : scene.materials)
        for (const TextureUse* use : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                                      &m.emissive_texture, &m.visibility_map})
            if (use->image >= 0) used.insert(static_cast<size_t>(use->image));
    return used;
}

}  // namespace

MonitorMark read_monitor_mark(const json& object) {
    MonitorMark mark;
    const json& extras = member(object, "extras");
    mark.is_two_sided = member(extras, "monitor_two_sided") == true || number_or(extras, "monitor_two_sided", 0) == 1;
    const json& value = member(extras, "monitor");
    if (value.is_null() || value == false) return mark;
    mark.is_marked = true;
    const std::string text = value.is_string() ? value.get<std::string>() : "";
    for (int channel = 0; channel < 3; ++channel)
        if (value == channel || text == std::string(1, "RGB"[channel]) || text == std::string(1, "rgb"[channel]) ||
            text == std::string(1, "012"[channel]))
            mark.channel = channel;
    mark.is_unclear = mark.channel < 0 && value != true && text != "true";
    return mark;
}

double read_texel_scale(const json& object, const std::string& place, Scene& scene) {
    const json& value = member(member(object, "extras"), "texel_scale");
    if (value.is_null()) return 1;
    const double scale = value.is_number() ? value.get<double>() : 0;
    if (scale >= least_texel_scale && scale <= largest_texel_scale) return scale;
    add_note(scene, "extras.texel_scale is not a number from 0.001 to 1000; ignored", place);
    return 1;
}

void read_materials(const GltfDocument& document, Scene& scene) {
    for (size_t m = 0; m < document.model.materials.size(); ++m) {
        const json& source = document.json["materials"][m];
        Material material = read_material(document, source);
        material.name = document.model.materials[m].name;
        const std::string place = place_name("material", m, material.name);
        const MonitorMark mark = read_monitor_mark(source);
        material.is_marked_monitor = mark.is_marked;
        material.monitor_channel = mark.channel;
        material.is_two_sided_monitor = mark.is_two_sided;
        if (mark.is_unclear) add_note(scene, "extras.monitor is none of R, G, B, 0, 1, 2, true; taken as true", place);
        material.texel_scale = read_texel_scale(source, place, scene);
        note_ignored_extensions(member(source, "extensions"), place, scene);
        scene.materials.push_back(std::move(material));
    }
}

void read_images(const GltfDocument& document, Scene& scene) {
    scene.images.resize(document.model.images.size());
    const std::set<size_t> used = used_images(scene);
    const std::vector<size_t> wanted(used.begin(), used.end());
    std::vector<std::string> problems(wanted.size());
    parallel_for(wanted.size(), 1, [&](size_t i) {
        const std::span<const uint8_t> bytes = encoded_image(document, wanted[i]);
        if (bytes.empty()) return;  // noted when it was loaded
        const std::string place = place_name("image", wanted[i], document.model.images[wanted[i]].name);
        const std::string ending = format_ending(bytes);
        // Without an ending the decoder would try every format it knows, on bytes that may be hostile.
        if (ending.empty()) problems[i] = place + ": not a PNG, JPEG, WebP or KTX2 file";
        if (ending.empty()) return;
        try {
            scene.images[wanted[i]] = decode_image(bytes, place + ending);
        } catch (const Error& problem) {
            problems[i] = place + ": " + problem.what();
        }
    });
    for (const std::string& problem : problems)
        if (!problem.empty()) add_note(scene, "images that cannot be decoded are left out", problem);
}

}  // namespace surimi
