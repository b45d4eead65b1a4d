// SPDX-License-Identifier: Apache-2.0
#include "baker/write/unwrap_output.h"

#include <span>
#include <system_error>
#include <utility>

#include "baker/write/baked_glb.h"
#include "baker/write/file.h"
#include "baker/write/unwrap_pictures.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"

namespace surimi {
namespace {

/// The same for all scenes, so that pictures can be compared: beyond twice the stretch nobody looks for degrees.
constexpr double stretch_high = 2;

constexpr size_t pictures_of_page = 3;

/// A file that is still in memory.
struct Draft {
    UnwrapFile file;
    std::vector<uint8_t> bytes;
};

Draft draw(const Scene& scene, const Unwrapped& unwrapped, size_t which) {
    const Atlas& atlas = unwrapped.atlas;
    const int page = static_cast<int>(which / pictures_of_page);
    Draft draft;
    draft.file.page = page;
    Picture8 picture;
    if (which % pictures_of_page == 0) {
        draft.file.role = "charts";
        picture = draw_charts(scene, atlas, page);
    } else if (which % pictures_of_page == 1) {
        draft.file.role = "density";
        draft.file.high = unwrapped.numbers.density_p99;
        draft.file.unit = "texels per metre in the worst direction";
        picture = draw_density(scene, atlas, page, draft.file.high);
    } else {
        draft.file.role = "stretch";
        draft.file.low = 1;
        draft.file.high = stretch_high;
        draft.file.unit = "stretch against the chart's density in the worst direction, 1: none";
        picture = draw_stretch(scene, atlas, page, draft.file.high);
    }
    const std::string number = atlas.pages > 1 ? "." + std::to_string(page) : "";
    draft.file.name = scene.path.stem().string() + "." + draft.file.role + number + ".png";
    draft.bytes = encode_png(picture);
    return draft;
}

void refuse_input(const std::filesystem::path& path, const Scene& scene) {
    std::error_code ignored;
    if (std::filesystem::equivalent(path, scene.path, ignored))
        throw Error(ErrorKind::usage, path.string() + ": is the input; choose another output with -o");
}

}  // namespace

UnwrapOutput write_unwrap(const std::filesystem::path& folder, const Scene& scene, const Unwrapped& unwrapped,
                          const Progress& progress) {
    std::vector<Draft> drafts(pictures_of_page * static_cast<size_t>(unwrapped.atlas.pages));
    parallel_stage("pictures", drafts.size(), 1, progress, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) drafts[i] = draw(scene, unwrapped, i);
    });
    const std::string name = scene.path.stem().string();
    drafts.insert(drafts.begin(),
                  {{"glb", name + ".unwrapped.glb", -1, 0, 0, ""}, make_baked_glb(scene, unwrapped.atlas, {})});

    UnwrapOutput output;
    std::vector<UnwrapFile> files;
    for (const Draft& draft : drafts) files.push_back(draft.file);
    output.report = make_unwrap_report(scene, unwrapped, files);
    make_folder(folder);
    PendingFiles pending;
    const auto add = [&](const std::string& file, std::span<const uint8_t> bytes) {
        output.paths.push_back(folder / file);
        refuse_input(output.paths.back(), scene);
        write_bytes(pending.add(output.paths.back()), bytes);
    };
    for (const Draft& draft : drafts) add(draft.file.name, draft.bytes);
    add(name + ".unwrap.json", {reinterpret_cast<const uint8_t*>(output.report.data()), output.report.size()});
    pending.commit();
    return output;
}

UnwrapOutput write_unwrapped_glb(const std::filesystem::path& file, const Scene& scene, const Unwrapped& unwrapped) {
    refuse_input(file, scene);
    write_file(file, make_baked_glb(scene, unwrapped.atlas, {}));
    return {{file}, make_unwrap_report(scene, unwrapped, {{"glb", file.filename().string(), -1, 0, 0, ""}})};
}

}  // namespace surimi
