// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/existing_uv.h"

#include <fmt/format.h>

#include "baker/unwrap/existing.h"
#include "baker/write/file.h"
#include "baker/write/unwrap_pictures.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"

namespace surimi {
namespace {

/// Where to look, in words; the picture is a help, so that a folder that cannot be written hides no fault.
std::string write_picture(const ExistingUv& found, const std::filesystem::path& picture) {
    try {
        if (!picture.parent_path().empty()) make_folder(picture.parent_path());
        write_file(picture, encode_png(draw_faults(found)));
    } catch (const Error& error) {
        return std::string("; no picture: ") + error.what();
    }
    return "; see " + picture.string() + " (magenta: triangles at fault, red: shared texels)";
}

}  // namespace

void with_picture_of_faults(const Scene& scene, const UnwrapSettings& settings, const std::filesystem::path& folder,
                            const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        if (settings.uv != UvSource::existing || error.kind() != ErrorKind::scene) throw;
        const ExistingUv found = judge_existing(scene, settings);
        if (found.fault.empty() || found.atlas.charts.empty()) throw;  // another error, or nothing to draw
        const auto picture = folder / (scene.path.stem().string() + ".uv-faults.png");
        throw Error(error.kind(), error.what() + write_picture(found, picture));
    }
}

void print_uv_choice(const Atlas& atlas) {
    if (!atlas.uv_reason.empty())
        fmt::print(stderr, "note: {}: {}\n", atlas.is_existing ? "the existing UVs are used" : "new charts are made",
                   atlas.uv_reason);
}

}  // namespace surimi
