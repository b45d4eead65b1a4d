// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/gltf_document.h"

#include "runtime/base/error.h"
#include "runtime/scene/accessor.h"
#include "runtime/scene/compressed.h"
#include "runtime/scene/gltf_check.h"
#include "runtime/scene/uri.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <optional>

namespace surimi {
namespace {

using nlohmann::json;

// glTF nests about ten levels, extras perhaps twenty. The parsers recurse, so that a file of brackets alone
// would overflow the stack.
constexpr int deepest_nesting = 200;

constexpr uint32_t glb_magic = 0x46546C67;     // "glTF"
constexpr uint32_t json_chunk = 0x4E4F534A;    // "JSON"
constexpr uint32_t binary_chunk = 0x004E4942;  // "BIN"

/// The two parts of a file; views into its bytes.
struct Container {
    std::string_view text;
    std::optional<std::span<const uint8_t>> binary;
};

uint32_t little_endian(std::span<const uint8_t> bytes, size_t offset) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) value |= static_cast<uint32_t>(bytes[offset + i]) << (8 * i);
    return value;
}

std::string_view as_text(std::span<const uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Container split_glb(std::span<const uint8_t> file, const std::filesystem::path& path) {
    constexpr size_t header = 12;
    constexpr size_t chunk_header = 8;
    if (file.size() < header + chunk_header) fail(path, "glb header", "the file ends within it");
    if (little_endian(file, 4) != 2)
        fail(path, "glb header", "only version 2 is supported; export the scene as glTF 2.0");
    const size_t length = little_endian(file, 8);
    if (length > file.size())
        fail(path, "glb header",
             "the file is truncated: it has " + std::to_string(file.size()) + " of " + std::to_string(length) +
                 " bytes");
    Container container;
    bool has_json = false;
    for (size_t offset = header; length > offset && length - offset >= chunk_header;) {
        const size_t size = little_endian(file, offset);
        const uint32_t type = little_endian(file, offset + 4);
        offset += chunk_header;
        if (size > length - offset)
            fail(path, "glb chunk", "its " + std::to_string(size) + " bytes reach past the end of the file");
        const std::span<const uint8_t> chunk = file.subspan(offset, size);
        if (!has_json && type != json_chunk) fail(path, "glb chunk", "the first one is not JSON");
        if (!has_json) container.text = as_text(chunk);
        if (has_json && type == binary_chunk && !container.binary) container.binary = chunk;
        has_json = true;
        offset += size;
    }
    return container;
}

/// Brackets outside of strings; runs before the parser, so it does not rely on the text being JSON.
int nesting(std::string_view text) {
    int depth = 0;
    int deepest = 0;
    bool is_in_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (is_in_string) {
            if (c == '\\') ++i;
            if (c == '"') is_in_string = false;
            continue;
        }
        if (c == '"') is_in_string = true;
        if (c == '{' || c == '[') deepest = std::max(deepest, ++depth);
        if (c == '}' || c == ']') --depth;
    }
    return deepest;
}

json parse_json(std::string_view text, const std::filesystem::path& path) {
    if (nesting(text) > deepest_nesting)
        fail(path, "JSON", "it is nested more than " + std::to_string(deepest_nesting) + " levels deep");
    try {
        return json::parse(text);
    } catch (const json::exception& problem) {
        fail(path, "JSON", std::string("not valid: ") + problem.what());
    }
}

/// What tinygltf gets to see. Buffers and images become placeholders, because we load them: it knows neither
/// meshopt's empty buffers nor missing images. Indices are set afterwards: it refuses Draco's, which have no
/// buffer view.
std::string placeholder_json(const json& document) {
    json slim = document;
    if (slim.contains("buffers"))
        for (json& buffer : slim["buffers"]) {
            buffer["uri"] = "data:application/octet-stream;base64,AA==";
            buffer["byteLength"] = 1;
        }
    if (slim.contains("images"))
        for (json& image : slim["images"]) {
            image.erase("bufferView");
            image["uri"] = "placeholder";
        }
    if (slim.contains("meshes"))
        for (json& mesh : slim["meshes"])
            for (json& primitive : mesh["primitives"]) primitive.erase("indices");
    return slim.dump();
}

void parse_model(GltfDocument& document) {
    const std::string text = placeholder_json(document.json);
    if (text.size() > std::numeric_limits<unsigned int>::max()) fail(document.path, "JSON", "it is larger than 4 GB");
    tinygltf::TinyGLTF loader;
    std::string errors;
    std::string warnings;
    const bool is_loaded = loader.LoadASCIIFromString(&document.model, &errors, &warnings, text.c_str(),
                                                      static_cast<unsigned int>(text.size()), "");
    if (!is_loaded) {
        std::replace(errors.begin(), errors.end(), '\n', ' ');
        fail(document.path, "JSON", errors.empty() ? "tinygltf cannot read it" : errors);
    }
    for (size_t m = 0; m < document.model.meshes.size(); ++m) {
        std::vector<tinygltf::Primitive>& primitives = document.model.meshes[m].primitives;
        const json& sources = document.json["meshes"][m]["primitives"];
        if (primitives.size() != sources.size())
            fail(document.path, place_name("mesh", m, ""), "a primitive is not valid");
        for (size_t p = 0; p < primitives.size(); ++p)
            if (sources[p].contains("indices")) primitives[p].indices = sources[p]["indices"].get<int>();
    }
}

/// Do all views into buffer `b` carry a compressed copy of themselves? Then nobody needs its bytes, and files
/// compressed with meshopt leave them out (not all of them say so with "fallback").
bool is_fallback_buffer(const json& document, size_t b) {
    bool is_used = false;
    for (const json& view : document.value("bufferViews", json::array())) {
        if (view["buffer"].get<size_t>() != b) continue;
        const json extensions = view.value("extensions", json::object());
        if (!extensions.contains("EXT_meshopt_compression") && !extensions.contains("KHR_meshopt_compression"))
            return false;
        is_used = true;
    }
    return is_used;
}

/// The bytes of buffer `b`, or why there are none.
std::vector<uint8_t> load_buffer(const GltfDocument& document, size_t b, const Container& container,
                                 std::string& problem) {
    const json& buffer = document.json["buffers"][b];
    if (!buffer.contains("uri")) {
        if (b == 0 && container.binary) return {container.binary->begin(), container.binary->end()};
        problem = "it has neither a URI nor a binary chunk";
        return {};
    }
    const std::string uri = buffer["uri"].get<std::string>();
    if (is_data_uri(uri)) {
        std::optional<std::vector<uint8_t>> bytes = decode_data_uri(uri);
        if (!bytes) problem = "its data URI is malformed";
        return bytes ? std::move(*bytes) : std::vector<uint8_t>{};
    }
    const std::optional<std::filesystem::path> path = resolve_uri(document.path.parent_path(), uri);
    if (!path) {
        problem = "its URI \"" + uri + "\" is absolute or not a file; put the file beside the scene";
        return {};
    }
    std::optional<std::vector<uint8_t>> bytes = read_file(*path);
    if (!bytes) problem = "its file " + path->string() + " cannot be read; put it there or export the scene as .glb";
    return bytes ? std::move(*bytes) : std::vector<uint8_t>{};
}

void load_buffers(GltfDocument& document, const Container& container) {
    for (size_t b = 0; b < document.model.buffers.size(); ++b) {
        tinygltf::Buffer& buffer = document.model.buffers[b];
        const json& source = document.json["buffers"][b];
        const size_t length = source["byteLength"].get<size_t>();
        std::string problem;
        std::vector<uint8_t> bytes = load_buffer(document, b, container, problem);
        if (problem.empty() && bytes.size() < length)
            problem = "it is truncated: " + std::to_string(bytes.size()) + " of " + std::to_string(length) + " bytes";
        if (!problem.empty()) {
            if (!is_fallback_buffer(document.json, b))
                fail(document.path, place_name("buffer", b, buffer.name), problem);
            bytes.clear();  // decoded from the compressed data instead
        } else {
            bytes.resize(length);
        }
        buffer.data = std::move(bytes);
        buffer.uri.clear();
    }
}

/// The bytes of an image outside of the buffers; a note and nothing where it cannot be had: geometry matters
/// more.
std::vector<uint8_t> load_external_image(GltfDocument& document, const std::string& uri, const std::string& place) {
    if (is_data_uri(uri)) {
        if (std::optional<std::vector<uint8_t>> bytes = decode_data_uri(uri)) return std::move(*bytes);
        add_note(document.notes, "images whose data URI is malformed are left out", place);
        return {};
    }
    const std::optional<std::filesystem::path> path = resolve_uri(document.path.parent_path(), uri);
    if (!path) {
        add_note(document.notes, "images with absolute paths or network addresses are left out", place + ": " + uri);
        return {};
    }
    if (std::optional<std::vector<uint8_t>> bytes = read_file(*path)) return std::move(*bytes);
    add_note(document.notes, "images whose file is missing are left out", place + ": " + path->string());
    return {};
}

void load_images(GltfDocument& document) {
    document.external_images.resize(document.model.images.size());
    for (size_t i = 0; i < document.model.images.size(); ++i) {
        tinygltf::Image& image = document.model.images[i];
        const json& source = document.json["images"][i];
        const std::string place = place_name("image", i, image.name);
        const std::string uri = source.value("uri", "");
        image.bufferView = source.contains("bufferView") ? source["bufferView"].get<int>() : -1;
        image.uri = is_data_uri(uri) ? "" : uri;
        image.as_is = true;
        if (is_data_uri(uri) && image.mimeType.empty())
            image.mimeType = uri.substr(5, std::min(uri.find(';'), uri.find(',')) - 5);
        if (image.bufferView >= 0) continue;
        if (uri.empty()) {
            add_note(document.notes, "images without data are left out", place);
            continue;
        }
        document.external_images[i] = load_external_image(document, uri, place);
    }
}

GltfDocument load_parts(const std::filesystem::path& path) {
    GltfDocument document;
    document.path = path;
    const std::optional<std::vector<uint8_t>> file = read_file(path);
    if (!file) fail(path, "file", "it cannot be read; check the path and its permissions");
    const bool is_glb = file->size() >= 4 && little_endian(*file, 0) == glb_magic;
    const Container container = is_glb ? split_glb(*file, path) : Container{as_text(*file), std::nullopt};
    document.json = parse_json(container.text, path);
    check_json(document.json, path);
    parse_model(document);
    load_buffers(document, container);
    load_images(document);
    decode_meshopt(document.model, path);
    check_layout(document.model, path);
    decode_draco(document.model, path);
    check_layout(document.model, path);
    return document;
}

}  // namespace

GltfDocument load_document(const std::filesystem::path& path) {
    try {
        return load_parts(path);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        fail(path, "file", "it asks for more memory than there is");
    } catch (const std::exception& problem) {
        // nlohmann::json and tinygltf throw where a file is odd in a way that was not foreseen.
        fail(path, "file", std::string("it cannot be read: ") + problem.what());
    }
}

std::span<const uint8_t> encoded_image(const GltfDocument& document, size_t index) {
    const tinygltf::Image& image = document.model.images[index];
    if (image.bufferView < 0) return document.external_images[index];
    const tinygltf::BufferView& view = document.model.bufferViews[static_cast<size_t>(image.bufferView)];
    return std::span<const uint8_t>(document.model.buffers[static_cast<size_t>(view.buffer)].data)
        .subspan(view.byteOffset, view.byteLength);
}

std::string place_name(std::string_view kind, size_t index, const std::string& name) {
    return std::string(kind) + " " + std::to_string(index) + (name.empty() ? "" : " (" + name + ")");
}

void fail(const std::filesystem::path& path, const std::string& place, const std::string& what) {
    throw Error(ErrorKind::scene, path.string() + ": " + place + ": " + what);
}

}  // namespace surimi
