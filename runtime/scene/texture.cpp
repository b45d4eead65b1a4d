// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/base/color.h"

namespace surimi {
namespace {

/// Index of texel `i` of `size` under a wrap mode.
int wrapped(int64_t i, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) return static_cast<int>(std::clamp<int64_t>(i, 0, size - 1));
    const int64_t period = wrap == Wrap::mirrored_repeat ? int64_t{2} * size : size;
    const int64_t m = ((i % period) + period) % period;
    return static_cast<int>(m < size ? m : period - 1 - m);
}

/// Linear light of the 256 codes.
const std::array<double, 256>& linear_of_codes() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> values{};
        for (size_t code = 0; code < values.size(); ++code)
            values[code] = linear_from_srgb(static_cast<double>(code) / 255);
        return values;
    }();
    return table;
}

/// Bilinear mean of what `value` makes of the four texels around the point.
template <class Value>
Vec4 filtered(const Scene& scene, const TextureUse& use, const SurfacePoint& at, const Value& value) {
    const Surface& surface = scene.surfaces[at.triangle.surface];
    if (use.image < 0 || scene.images[static_cast<size_t>(use.image)].empty()) return Vec4(1);
    if (static_cast<size_t>(use.uv_set) >= surface.uv_sets.size()) return Vec4(1);
    const auto& uvs = surface.uv_sets[static_cast<size_t>(use.uv_set)];
    const auto& [i, j, k] = surface.triangles[at.triangle.triangle];
    const Vec2 stored = at.barycentric.x * uvs[i] + at.barycentric.y * uvs[j] + at.barycentric.z * uvs[k];
    const Vec2 uv(use.transform * Vec3(stored, 1));
    const auto& image = scene.images[static_cast<size_t>(use.image)];
    const double x = uv.x * image.width - 0.5, y = uv.y * image.height - 0.5;
    if (!(std::abs(x) < 1e15) || !(std::abs(y) < 1e15)) return Vec4(1);  // beyond exact integers no texel is meant
    const double x0 = std::floor(x), y0 = std::floor(y);
    Vec4 sum(0);
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const double weight = (dx ? x - x0 : 1 - (x - x0)) * (dy ? y - y0 : 1 - (y - y0));
            sum += weight * value(image.at(wrapped(static_cast<int64_t>(x0) + dx, image.width, use.wrap_s),
                                           wrapped(static_cast<int64_t>(y0) + dy, image.height, use.wrap_t)));
        }
    }
    return sum;
}

}  // namespace

Vec4 look_up_texture(const Scene& scene, const TextureUse& use, const SurfacePoint& at) {
    return filtered(scene, use, at, [](const glm::u8vec4& texel) { return Vec4(texel) / 255.0; });
}

Vec4 look_up_color_texture(const Scene& scene, const TextureUse& use, const SurfacePoint& at) {
    const auto& linear = linear_of_codes();
    return filtered(scene, use, at, [&](const glm::u8vec4& texel) {
        return Vec4(linear[texel.r], linear[texel.g], linear[texel.b], texel.a / 255.0);
    });
}

double alpha_at(const Scene& scene, const Material& material, const SurfacePoint& at) {
    return material.base_color.a * look_up_texture(scene, material.base_color_texture, at).a;
}

const Material& material_of(const Scene& scene, const Surface& surface) {
    static const Material standard;
    return surface.material < 0 ? standard : scene.materials[static_cast<size_t>(surface.material)];
}

bool is_cutout(const Scene& scene, const Surface& surface) {
    return material_of(scene, surface).alpha_mode == AlphaMode::mask;
}

}  // namespace surimi
