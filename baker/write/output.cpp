// SPDX-License-Identifier: Apache-2.0
#include "baker/write/output.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <system_error>
#include <utility>

#include "baker/write/baked_glb.h"
#include "baker/write/file.h"
#include "baker/write/lightmaps.h"
#include "baker/write/manifest.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"
#include "runtime/scene/gltf.h"
#include "runtime/scene/uri.h"

namespace surimi {
namespace {

[[noreturn]] void throw_cannot_write(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorKind::cannot_write, path.string() + ": cannot be written: " + why);
}

void check_targets(const OutputPaths& paths, const std::filesystem::path& input) {
    std::error_code ignored;
    for (const auto& path : paths.all()) {
        if (std::filesystem::equivalent(path, input, ignored))
            throw_cannot_write(path, "it is the input; choose another folder with -o");
        // Renaming onto a folder fails, and only after other files have their names already.
        if (std::filesystem::is_directory(path, ignored))
            throw_cannot_write(path, "it is a folder; remove it or choose another folder with -o");
    }
}

/// Where a file of the bake is while it is unfinished, and what it will be called.
struct Draft {
    std::filesystem::path temporary;
    std::filesystem::path path;

    void require(bool is_as_written, const char* what) const {
        if (is_as_written) return;
        throw_cannot_write(path, std::string("read back, ") + what + "; check the disk's free space and health");
    }
};

bool is_half_of(float stored, float value) {
    // Half has 11 significant bits, and steps of 2^-24 near zero.
    return std::abs(stored - value) <= std::max(std::abs(value) * 0x1p-11f, 0x1p-25f);
}

/// Reads a draft back in rows. `give`: what was written; `is_same`: stored value, value.
template <class IsSame>
void require_channels(const Draft& draft, const ChannelLayout& layout, const GiveRows<float>& give,
                      const IsSame& is_same) {
    std::vector<size_t> place;  // of each channel among those of the file
    const size_t count = layout.names.size();
    const auto compare_layout = [&](const ChannelLayout& back) {
        draft.require(back.width == layout.width && back.height == layout.height && back.names.size() == count,
                      "it has another size");
        for (const std::string& name : layout.names) {
            const auto found = std::find(back.names.begin(), back.names.end(), name);
            draft.require(found != back.names.end(), "it lacks a channel");
            place.push_back(static_cast<size_t>(found - back.names.begin()));
        }
    };
    std::vector<float> written;
    read_rows(draft.temporary, compare_layout, [&](int begin, int end, std::span<const float> stored) {
        written.resize(stored.size());
        give(begin, end, written);
        for (size_t i = 0; i < written.size(); i += count)
            for (size_t c = 0; c < count; ++c)
                draft.require(is_same(stored[i + place[c]], written[i + c]), "it has other values");
    });
}

void write_visibility_exr(const Draft& draft, const VisibilityMap& map) {
    write_map_exr(draft.temporary, map);
    require_channels(
        draft, map_layout(map), [&](int begin, int, std::span<float> values) { give_map(map, begin, values); },
        is_half_of);
}

void write_exact(const Draft& draft, std::span<const uint8_t> bytes) {
    write_bytes(draft.temporary, bytes);
    std::span<const uint8_t> rest = bytes;
    bool is_same = true;
    const bool is_read = read_pieces(draft.temporary, [&](std::span<const uint8_t> piece) {
        is_same = is_same && piece.size() <= rest.size() && std::equal(piece.begin(), piece.end(), rest.begin());
        if (is_same) rest = rest.subspan(piece.size());
    });
    draft.require(is_read && is_same && rest.empty(), "it has other bytes");
}

void write_evidence(const Draft& draft, const Scene& scene, const BakedPage& page) {
    const ChannelLayout layout = lightmap_layout(scene, page);
    const GiveRows<float> give = [&](int begin, int, std::span<float> values) {
        give_lightmaps(scene, page, begin, values);
    };
    write_exr(draft.temporary, layout, ExrDepth::full, give);
    require_channels(draft, layout, give, std::equal_to<float>());
}

/// Triangles of the monitors that the configuration describes; they are surfaces of the baked file only.
size_t new_triangle_count(const Scene& scene) {
    size_t count = 0;
    for (const Monitor& monitor : scene.monitors)
        for (const Polygon& panel : monitor.panels)
            if (monitor.node < 0) count += panel.corners.size() - 2;
    return count;
}

/// Whether the file's surfaces have the atlas' UVs, corner by corner.
bool has_atlas(const Scene& baked, const Atlas& atlas) {
    for (size_t s = 0; s < atlas.surfaces.size(); ++s) {
        const Surface& surface = baked.surfaces[s];
        const auto& uv = atlas.surfaces[s].uv;
        if (uv.empty()) continue;
        if (surface.uv_sets.size() < 2 || surface.triangles.size() != uv.size()) return false;
        for (size_t t = 0; t < uv.size(); ++t)
            for (size_t k = 0; k < 3; ++k)
                if (Vec2f(surface.uv_sets[1][surface.triangles[t][k]]) != uv[t][k]) return false;
    }
    return true;
}

void write_baked_scene(const Draft& draft, const Scene& scene, const Bake& bake, const CarriedMap& map) {
    write_exact(draft, make_baked_glb(scene, bake.atlas, map));
    try {
        const Scene back = read_gltf(draft.temporary);
        draft.require(back.surfaces.size() >= scene.surfaces.size() &&
                          triangle_count(back) == triangle_count(scene) + new_triangle_count(scene),
                      "it has other triangles");
        draft.require(has_atlas(back, bake.atlas), "it has other UVs");
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::cannot_write) throw;
        throw_cannot_write(draft.path, std::string("read back, it is invalid (") + error.what() +
                                           "); this is a fault of Surimi, please report it with the scene");
    }
}

ManifestFile describe(const Draft& draft, const char* role, int page = -1) {
    ContentHash hash;
    size_t size = 0;
    const bool is_read = read_pieces(draft.temporary, [&](std::span<const uint8_t> piece) {
        hash.add(piece);
        size += piece.size();
    });
    draft.require(is_read, "it is gone");
    return {role, draft.path.filename().string(), size, hash.text(), page};
}

}  // namespace

std::vector<std::filesystem::path> OutputPaths::all() const {
    std::vector<std::filesystem::path> paths;
    for (const PagePaths& page : pages)
        paths.insert(paths.end(), {page.visibility_exr, page.visibility_png, page.lightmaps_exr});
    paths.insert(paths.end(), {baked_glb, manifest_json});
    return paths;
}

OutputPaths output_paths(const std::filesystem::path& out, const std::filesystem::path& scene, size_t page_count) {
    const std::string name = scene.stem().string();
    OutputPaths paths{{}, out / (name + ".baked.glb"), out / (name + ".visibility.json")};
    for (size_t page = 0; page < page_count; ++page) {
        const std::string number = page_count > 1 ? "." + std::to_string(page) : "";
        paths.pages.push_back({out / (name + ".visibility" + number + ".exr"),
                               out / (name + ".visibility" + number + ".png"),
                               out / (name + ".lightmaps" + number + ".exr")});
    }
    return paths;
}

OutputPaths write_bake(const std::filesystem::path& out, const Scene& scene, const Bake& bake,
                       const std::string& settings_json) {
    const OutputPaths paths = output_paths(out, scene.path, bake.pages.size());
    check_targets(paths, scene.path);
    make_folder(out);
    ContentHash input;
    if (!read_pieces(scene.path, [&](std::span<const uint8_t> piece) { input.add(piece); }))
        throw Error(ErrorKind::scene, scene.path.string() + ": cannot be read any more; was it moved during the bake?");

    PendingFiles pending;
    const auto draft = [&](const std::filesystem::path& path) { return Draft{pending.add(path), path}; };
    std::vector<ManifestFile> files;
    std::vector<std::vector<uint8_t>> pngs;
    for (size_t p = 0; p < bake.pages.size(); ++p) {
        const BakedPage& page = bake.pages[p];
        const Draft exr = draft(paths.pages[p].visibility_exr);
        write_visibility_exr(exr, page.map);
        pngs.push_back(encode_map_png(page.map));
        const Draft png = draft(paths.pages[p].visibility_png);
        write_exact(png, pngs.back());
        const Draft lightmaps = draft(paths.pages[p].lightmaps_exr);
        write_evidence(lightmaps, scene, page);
        const int number = static_cast<int>(p);
        for (const ManifestFile& file : {describe(exr, "visibility", number), describe(png, "visibility", number),
                                         describe(lightmaps, "lightmaps", number)})
            files.push_back(file);
    }
    const Draft glb = draft(paths.baked_glb);
    write_baked_scene(glb, scene, bake, {{pngs.begin(), pngs.end()}, bake.pages[0].map.monitors});
    files.push_back(describe(glb, "bakedGlb"));

    const std::string manifest = make_manifest(scene, bake, settings_json, input.text(), files);
    write_exact(draft(paths.manifest_json), {reinterpret_cast<const uint8_t*>(manifest.data()), manifest.size()});
    pending.commit();
    return paths;
}

}  // namespace surimi
