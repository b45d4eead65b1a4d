// SPDX-License-Identifier: Apache-2.0
#include "runtime/light/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/base/bilinear.h"

namespace surimi {
namespace {

/// One level half as large in x, or in y after transposing; binomial weights over the inner texels.
Image<Vec3f> halved_and_transposed(const Image<Vec3f>& image) {
    const int width = std::max(1, (image.width + 1) / 2);
    Image<Vec3f> result(image.height, width);
    constexpr std::array<float, 4> weights = {1, 3, 3, 1};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < width; ++x) {
            Vec3f sum(0);
            float total = 0;
            for (int k = 0; k < 4; ++k) {
                const int source = 2 * x - 1 + k;
                if (source < 0 || source >= image.width) continue;
                sum += weights[static_cast<size_t>(k)] * image.at(source, y);
                total += weights[static_cast<size_t>(k)];
            }
            result.at(y, x) = sum / total;
        }
    return result;
}

Vec2 uv_of(const PictureMapping& mapping, const Vec3& position) {
    const Vec3 offset = position - mapping.origin;
    return {glm::dot(offset, mapping.u), glm::dot(offset, mapping.v)};
}

}  // namespace

std::vector<Image<Vec3f>> blurred_levels(Image<Vec3f> image) {
    std::vector<Image<Vec3f>> levels;
    if (image.empty()) return levels;
    Vec3 sum(0);
    for (const Vec3f& p : image.pixels) sum += Vec3(p);
    const Vec3 mean = sum / static_cast<double>(image.pixels.size());
    levels.push_back(std::move(image));
    while (levels.back().pixels.size() > 1)
        levels.push_back(halved_and_transposed(halved_and_transposed(levels.back())));
    levels.back().pixels.front() = Vec3f(mean);  // halving odd sizes weighs the border a little less
    return levels;
}

std::vector<PictureMapping> upright_mappings(const Monitor& monitor) {
    const Vec3 normal = front_normal(monitor.panels.front());
    const Vec3 up = std::abs(normal.y) < 0.999 ? Vec3(0, 1, 0) : Vec3(0, 0, -1);
    const Vec3 right = normalize_or(glm::cross(up, normal), {1, 0, 0});
    const Vec3 down = -glm::cross(normal, right);
    Vec2 low(INFINITY), high(-INFINITY);
    for (const Polygon& panel : monitor.panels)
        for (const Vec3& corner : panel.corners) {
            const Vec2 place(glm::dot(corner, right), glm::dot(corner, down));
            low = glm::min(low, place), high = glm::max(high, place);
        }
    const Vec2 size = glm::max(high - low, Vec2(1e-9));  // metres; a mapping of no size would divide by 0
    const PictureMapping mapping{low.x * right + low.y * down, right / size.x, down / size.y};
    return std::vector<PictureMapping>(monitor.panels.size(), mapping);
}

Vec3 picture_at(const MonitorPicture& picture, size_t panel, const Vec3& position) {
    return look_up_bilinear(picture.levels.front(), uv_of(picture.mappings[panel], position));
}

Vec3 blurred_picture_at(const MonitorPicture& picture, size_t panel, const Vec3& position, double sigma) {
    const PictureMapping& mapping = picture.mappings[panel];
    const Image<Vec3f>& image = picture.levels.front();
    // Texels per metre; level l has a standard deviation of half its texel (the binomials' variances, 3/4 4^l, summed).
    const double density = std::sqrt(glm::length(mapping.u) * image.width * glm::length(mapping.v) * image.height);
    const double wanted = std::log2(std::max(2 * sigma * density, 1e-9));
    const double last = static_cast<double>(picture.levels.size() - 1);
    const double level = wanted > 0 ? std::min(wanted, last) : 0;
    const auto below = static_cast<size_t>(level);
    const size_t above = std::min(below + 1, picture.levels.size() - 1);
    const Vec2 uv = uv_of(mapping, position);
    return glm::mix(look_up_bilinear(picture.levels[below], uv), look_up_bilinear(picture.levels[above], uv),
                    level - static_cast<double>(below));
}

}  // namespace surimi
