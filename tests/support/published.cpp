// SPDX-License-Identifier: Apache-2.0
#include "tests/support/published.h"

#include <vector>

#include "runtime/ltc/table.h"

namespace surimi::test {

namespace {

constexpr int size = ltc_size;

/// What the two textures of a shader hold.
struct Texel {
    Vec4f entries;  ///< x, y, z, w of the inverse matrix
    Vec4f rest;     ///< albedo, Fresnel's part, unused, sphere
};

/// Between the texels of a 64 x 64 table, with coordinates in [0, 1] from the first node to the last.
struct Bilinear {
    size_t at;
    float right, down;

    Bilinear(float u, float v) {
        const float x = std::clamp(u, 0.0F, 1.0F) * (size - 1), y = std::clamp(v, 0.0F, 1.0F) * (size - 1);
        const int column = std::min(static_cast<int>(x), size - 2), row = std::min(static_cast<int>(y), size - 2);
        at = static_cast<size_t>(row * size + column);
        right = x - static_cast<float>(column);
        down = y - static_cast<float>(row);
    }
    template <class Read>
    auto operator()(const Read& read) const {
        return (read(at) * (1 - right) + read(at + 1) * right) * (1 - down) +
               (read(at + size) * (1 - right) + read(at + size + 1) * right) * down;
    }
};

std::vector<Texel> make_texels() {
    std::vector<Texel> texels;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const LtcCell cell = ltc_cell(column, row);
            const Mat3 m = inverse_matrix(cell.shape, ltc_column_alpha(column), ltc_row_cosine(row));
            const double length = row / (size - 1.0), cosine = 2 * (column / (size - 1.0)) - 1;
            const double sphere = row == 0 ? std::max(cosine, 0.0) : clipped_sphere(length, cosine) / length;
            texels.push_back({Vec4f(m[0].x, m[0].z, m[2].x, m[2].z),
                              Vec4f(cell.albedo, cell.albedo * std::pow(cell.fresnel_root, 5), 0, sphere)});
        }
    return texels;
}

const std::vector<Texel> texels = make_texels();

struct Placed {
    PublishedLobe lobe;
    std::array<Vec3f, 4> in_frame, in_lobe;
};

Placed place(const Vec3f corners[4], Vec3f point, Vec3f normal, Vec3f view, float roughness) {
    Placed placed;
    const float cosine = glm::dot(normal, view);
    const Vec3f tangent = glm::normalize(view - normal * cosine), bitangent = glm::cross(normal, tangent);
    placed.lobe = published_lobe(roughness, std::clamp(cosine, 0.0F, 1.0F));
    for (size_t i = 0; i < 4; ++i) {
        const Vec3f d = corners[i] - point;
        placed.in_frame[i] = {glm::dot(tangent, d), glm::dot(bitangent, d), glm::dot(normal, d)};
        placed.in_lobe[i] = placed.lobe.inverse * placed.in_frame[i];
    }
    return placed;
}

}  // namespace

float tabled_sphere_ratio(float length, float cosine) {
    return Bilinear(cosine * 0.5F + 0.5F, length)([](size_t i) { return texels[i].rest.w; });
}

PublishedLobe published_lobe(float roughness, float cosine) {
    const Bilinear between(roughness, std::sqrt(1 - cosine));
    const Vec4f m = between([](size_t i) { return texels[i].entries; });
    const Vec4f rest = between([](size_t i) { return texels[i].rest; });
    return {glm::mat3(m.x, 0, m.y, 0, 1, 0, m.z, 0, m.w), rest.x, rest.y};
}

Shares published_quad(const Vec3f corners[4], Vec3f point, Vec3f normal, Vec3f view, float roughness) {
    const Placed placed = place(corners, point, normal, view, roughness);
    return {published_polygon<float>(placed.in_frame), published_polygon<float>(placed.in_lobe), placed.lobe.albedo,
            placed.lobe.fresnel};
}

Shares clipless_quad(const Vec3f corners[4], Vec3f point, Vec3f normal, Vec3f view, float roughness, Proxy proxy) {
    const Placed placed = place(corners, point, normal, view, roughness);
    return {clipless_polygon<float>(placed.in_frame, proxy), clipless_polygon<float>(placed.in_lobe, proxy),
            placed.lobe.albedo, placed.lobe.fresnel};
}

}  // namespace surimi::test
