// SPDX-License-Identifier: Apache-2.0
#include "runtime/shade/published.h"

#include <vector>

#include "runtime/ltc/table.h"

namespace surimi::published {

namespace {

constexpr int size = ltc_size;

/// The textures of a shader, row by row.
struct Textures {
    std::vector<Vec4f> entries;  ///< x, y, z, w of the inverse matrix
    std::vector<Vec2f> albedos;  ///< albedo and Fresnel's part
    std::vector<float> sphere;
};

/// Between the texels of a 64 x 64 table, with coordinates in [0, 1] from the first node to the last.
struct Bilinear {
    size_t at;
    float a, b, c, d;  ///< weights of this texel, the one to the right, those below

    Bilinear(float u, float v) {
        // Comparisons that are false for NaN, which a graphics processor clamps, too.
        const float x = (u > 0 ? std::min(u, 1.0F) : 0) * (size - 1), y = (v > 0 ? std::min(v, 1.0F) : 0) * (size - 1);
        const int column = std::min(static_cast<int>(x), size - 2), row = std::min(static_cast<int>(y), size - 2);
        at = static_cast<size_t>(row * size + column);
        const float right = x - static_cast<float>(column), down = y - static_cast<float>(row);
        a = (1 - right) * (1 - down), b = right * (1 - down), c = (1 - right) * down, d = right * down;
    }
    template <class Texel>
    Texel operator()(const std::vector<Texel>& texels) const {
        const Texel* first = texels.data() + at;
        return first[0] * a + first[1] * b + first[size] * c + first[size + 1] * d;
    }
};

Textures make_textures() {
    Textures textures;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const LtcCell cell = ltc_cell(column, row);
            const Mat3 m = inverse_matrix(cell.full, ltc_column_alpha(column), ltc_row_cosine(row));
            textures.entries.emplace_back(m[0].x, m[0].z, m[2].x, m[2].z);
            textures.albedos.emplace_back(cell.albedo, cell.albedo * std::pow(cell.fresnel_root, 5));
            const double length = row / (size - 1.0), cosine = 2 * (column / (size - 1.0)) - 1;
            const double ratio = row == 0 ? std::max(cosine, 0.0) : clipped_sphere(length, cosine) / length;
            textures.sphere.push_back(static_cast<float>(ratio));
        }
    return textures;
}

/// Made when the first point is shaded in this way, not when the program starts.
const Textures& textures() {
    static const Textures made = make_textures();
    return made;
}

struct Placed {
    TabledLobe lobe;
    std::array<Vec3f, 4> in_frame, in_lobe;
};

Placed place(const Vec3f corners[4], Vec3f point, Vec3f normal, Vec3f view, float roughness) {
    Placed placed;
    const float cosine = glm::dot(normal, view);
    const Vec3f tangent = glm::normalize(view - normal * cosine), bitangent = glm::cross(normal, tangent);
    placed.lobe = lobe_at(roughness, std::clamp(cosine, 0.0F, 1.0F));
    for (size_t i = 0; i < 4; ++i) {
        const Vec3f d = corners[i] - point;
        placed.in_frame[i] = {glm::dot(tangent, d), glm::dot(bitangent, d), glm::dot(normal, d)};
        placed.in_lobe[i] = placed.lobe.inverse * placed.in_frame[i];
    }
    return placed;
}

}  // namespace

float tabled_sphere_ratio(float length, float cosine) {
    return Bilinear(cosine * 0.5F + 0.5F, length)(textures().sphere);
}

TabledLobe lobe_at(float roughness, float cosine) {
    const Bilinear between(roughness, std::sqrt(1 - cosine));
    const Vec4f m = between(textures().entries);
    const Vec2f albedo = between(textures().albedos);
    return {glm::mat3(m.x, 0, m.y, 0, 1, 0, m.z, 0, m.w), albedo.x, albedo.y};
}

Shares clipped_quad(const Vec3f corners[4], Vec3f point, Vec3f normal, Vec3f view, float roughness) {
    const Placed placed = place(corners, point, normal, view, roughness);
    return {clipped_polygon<float>(placed.in_frame), clipped_polygon<float>(placed.in_lobe), placed.lobe.albedo,
            placed.lobe.fresnel};
}

Shares clipless_quad(const Vec3f corners[4], Vec3f point, Vec3f normal, Vec3f view, float roughness, Proxy proxy) {
    const Placed placed = place(corners, point, normal, view, roughness);
    return {clipless_polygon<float>(placed.in_frame, proxy), clipless_polygon<float>(placed.in_lobe, proxy),
            placed.lobe.albedo, placed.lobe.fresnel};
}

}  // namespace surimi::published
