// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/picture_file.h"

#include "baker/write/file.h"
#include "runtime/image/image_file.h"
#include "runtime/preview/display.h"

namespace surimi {

void write_picture(const std::filesystem::path& path, const Image<Vec3f>& pixels, Show show, double exposure) {
    if (path.extension() == ".exr") {
        Channels channels{pixels.width, pixels.height, {"R", "G", "B"}, {}};
        for (const Vec3f& p : pixels.pixels) channels.values.insert(channels.values.end(), {p.x, p.y, p.z});
        PendingFiles pending;
        write_exr(pending.add(path), channels, ExrDepth::full);
        pending.commit();
    } else {
        write_file(path, encode_png(to_codes(displayed(pixels, show, exposure))));
    }
}

}  // namespace surimi
