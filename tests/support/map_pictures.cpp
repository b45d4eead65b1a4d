// SPDX-License-Identifier: Apache-2.0
#include "tests/support/map_pictures.h"

#include <cmath>
#include <fstream>

#include "runtime/base/color.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "tests/support/map_judge.h"
#include "tests/support/point_rays.h"

namespace surimi::test {
namespace {

constexpr double yfov = 0.9;

/// Grey for a visibility, as 8-bit maps are encoded.
glm::u8vec3 grey(double visibility) {
    return srgb8(Vec3(visibility));
}

/// Calls `color(point)` for what each pixel sees.
template <class Color>
Image<glm::u8vec3> picture(const Scene& scene, const RayScene& rays, const View& view, const Color& color) {
    Image<glm::u8vec3> image(picture_width, picture_height, glm::u8vec3(0));
    const double aspect = static_cast<double>(picture_width) / picture_height;
    parallel_for(image.pixels.size(), 64, [&](size_t i) {
        const double x = (static_cast<double>(i % picture_width) + 0.5) / picture_width;
        const double y = (static_cast<double>(i / picture_width) + 0.5) / picture_height;
        const auto hit = rays.closest_hit(view.eye, ray_direction(view, x, y, aspect));
        if (!hit || hit->triangle.surface >= scene.surfaces.size()) return;
        const bool is_monitor = scene.surfaces[hit->triangle.surface].monitor >= 0;
        image.pixels[i] =
            is_monitor ? glm::u8vec3(255, 255, 0) : color(surface_point(scene, hit->triangle, hit->barycentric));
    });
    return image;
}

}  // namespace

View view_near(const RayScene& rays, const SurfacePoint& point) {
    const Vec3 n = point.geometric_normal;
    const Vec3 aside = normalize_or(glm::cross(n, std::abs(n.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0)), {1, 0, 0});
    const Vec3 up = glm::cross(aside, n);
    Vec3 best = n;
    double farthest = 0;
    for (int i = 0; i < 9; ++i) {  // straight and leaning eight ways
        const double angle = pi * i / 4, lean = i == 8 ? 0 : 0.8;
        const Vec3 d = glm::normalize(n + lean * (std::cos(angle) * aside + std::sin(angle) * up));
        const auto hit = rays.closest_hit(rays.ray_origin(point), d);
        const double free = std::min(0.7, hit ? 0.9 * hit->distance : 0.7);
        if (free > farthest) farthest = free, best = d;
    }
    return look_at(point.position + farthest * best, point.position, yfov);
}

Image<glm::u8vec3> picture_of_map(const Scene& scene, const RayScene& rays, const Bake& bake, size_t monitor,
                                  const View& view) {
    const int channel = scene.monitors[monitor].channel;
    return picture(scene, rays, view, [&](const SurfacePoint& point) {
        const double value = read_map(bake, point.triangle, point.barycentric, channel);
        return form_factor(scene, monitor, point) > 0 ? grey(value) : glm::u8vec3(0, 0, 90);
    });
}

Image<glm::u8vec3> picture_of_truth(const Scene& scene, const RayScene& rays, size_t monitor, const View& view) {
    const Obstructed panels = panels_alone(scene, rays, monitor);
    return picture(scene, rays, view, [&](const SurfacePoint& point) {
        if (!(form_factor(scene, monitor, point) > 0)) return glm::u8vec3(0, 0, 90);
        return grey(visibility_by_rays(scene, rays, panels, monitor, point, 256).visibility);
    });
}

Image<glm::u8vec3> sheet_of(const std::vector<std::vector<Image<glm::u8vec3>>>& rows) {
    constexpr int line = 2;
    if (rows.empty() || rows[0].empty()) return {};
    const int wide = static_cast<int>(rows[0].size()), high = static_cast<int>(rows.size());
    Image<glm::u8vec3> sheet(wide * (picture_width + line), high * (picture_height + line), glm::u8vec3(255));
    for (int row = 0; row < high; ++row)
        for (int column = 0; column < wide; ++column) {
            const auto& picture = rows[static_cast<size_t>(row)][static_cast<size_t>(column)];
            for (int i = 0; i < picture_width * picture_height; ++i)
                sheet.at(column * (picture_width + line) + i % picture_width,
                         row * (picture_height + line) + i / picture_width) = picture.pixels[static_cast<size_t>(i)];
        }
    return sheet;
}

void write_png(const std::filesystem::path& file, const Image<glm::u8vec3>& image) {
    const std::vector<uint8_t> bytes = encode_png(image);
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!out) throw Error(ErrorKind::cannot_write, "cannot write " + file.string());
}

}  // namespace surimi::test
