// SPDX-License-Identifier: Apache-2.0
#include "runtime/preview/render.h"

#include <algorithm>
#include <vector>

#include "runtime/image/image_file.h"
#include "runtime/preview/shade.h"

namespace surimi {
namespace {

/// Value below which 95 % of `values` lie; 0 when there are none.
double percentile_95(std::vector<float>& values) {
    if (values.empty()) return 0;
    const auto place = values.begin() + static_cast<ptrdiff_t>(values.size() * 95 / 100);
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place);
}

}  // namespace

Picture render(const Scene& scene, const VisibilityMap& map, const RayScene& rays, const View& view,
               const RenderSettings& settings, const Progress& progress) {
    Picture picture;
    picture.pixels = Image<Vec3f>(settings.width, settings.height);
    std::vector<float> levels(picture.pixels.pixels.size(), -1);  // luminance of pixels that show a surface, else -1
    const double aspect = static_cast<double>(settings.width) / settings.height;
    const int side = settings.samples_per_side;
    const auto width = static_cast<size_t>(settings.width);
    parallel_stage("picture", picture.pixels.pixels.size(), width, progress, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            Vec3 sum(0);
            bool is_surface = false;
            for (int s = 0; s < side * side; ++s) {
                const double x = static_cast<double>(i % width) + (s % side + 0.5) / side;
                const double y = static_cast<double>(i / width) + (s / side + 0.5) / side;
                const Vec3 direction = ray_direction(view, x / settings.width, y / settings.height, aspect);
                const Seen seen = see(scene, map, rays, view.eye, direction, settings.show);
                sum += seen.color;
                is_surface = is_surface || seen.is_surface;
            }
            const Vec3 mean = sum / static_cast<double>(side * side);
            picture.pixels.pixels[i] = Vec3f(mean);
            if (is_surface) levels[i] = static_cast<float>(luminance(mean));
        }
    });
    std::erase_if(levels, [](float level) { return !(level > 0); });
    picture.lit_share = static_cast<double>(levels.size()) / static_cast<double>(picture.pixels.pixels.size());
    picture.bright_level = percentile_95(levels);
    return picture;
}

double filmic(double x) {
    if (!(x > 0)) return 0;
    x = std::min(x, 1e6);  // beyond, the quotient is 1 to rounding
    return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

double automatic_exposure(const Picture& picture) {
    return picture.bright_level > 0 && std::isfinite(picture.bright_level) ? 0.7 / picture.bright_level : 1;
}

Image<glm::u8vec3> to_display(const Picture& picture, Show show, double exposure) {
    Image<glm::u8vec3> display(picture.pixels.width, picture.pixels.height);
    for (size_t i = 0; i < display.pixels.size(); ++i) {
        const Vec3 color(picture.pixels.pixels[i]);
        const auto curve = [&](double x) { return show == Show::lit ? filmic(x * exposure) : x; };
        display.pixels[i] = srgb8({curve(color.x), curve(color.y), curve(color.z)});
    }
    return display;
}

}  // namespace surimi
