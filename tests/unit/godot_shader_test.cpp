// SPDX-License-Identifier: Apache-2.0
// The formulae of the shader for Godot, compiled from the very file that exports hand out, against the runtime's.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "baker/export/lobe_tables.h"
#include "runtime/ltc/placed_lobe.h"
#include "runtime/ltc/polygon.h"
#include "runtime/ltc/table.h"
#include "tests/support/random.h"

// The shader's words in C++, in double so that only the formulae are judged.
namespace surimi::shader {
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
using mat3 = glm::dmat3;
using glm::abs, glm::atan, glm::clamp, glm::cross, glm::dot, glm::length, glm::max, glm::min, glm::normalize, glm::sqrt;
#define float double
#define out
#include "samples/godot/surimi_lights.gdshaderinc"
#undef out
#undef float
}  // namespace surimi::shader

namespace surimi {
namespace {

/// What the shader's `between` reads of the file.
Vec4 between(const std::vector<uint8_t>& bytes, double roughness, double cosine, int table) {
    const Vec2 at = Vec2(roughness, std::sqrt(1 - cosine)) * (ltc_size - 1.0);
    const int x = std::min(static_cast<int>(at.x), ltc_size - 2), y = std::min(static_cast<int>(at.y), ltc_size - 2);
    Vec4 sum(0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            std::array<float, 4> texel{};
            const size_t place = static_cast<size_t>((table * ltc_size + y + j) * ltc_size + x + i) * sizeof texel;
            std::memcpy(texel.data(), &bytes.at(place), sizeof texel);
            const double weight = (i ? at.x - x : 1 + x - at.x) * (j ? at.y - y : 1 + y - at.y);
            for (int k = 0; k < 4; ++k) sum[k] += weight * static_cast<double>(texel[static_cast<size_t>(k)]);
        }
    return sum;
}

struct Shaded {
    Vec3 shares{0};
    Vec2 albedos{0};
};

Shaded by_shader(const std::array<Vec3, 4>& c, const Vec3& point, const Vec3& normal, const Vec3& view,
                 double roughness, bool two_sided) {
    static const std::vector<uint8_t> tables = lobe_tables();
    const double cosine = std::clamp(glm::dot(normal, view), 1e-4, 1.0), alpha = roughness * roughness;
    const Mat3 full = shader::surimi_to_cosine(between(tables, roughness, cosine, 0), alpha, cosine);
    const Mat3 schlick = shader::surimi_to_cosine(between(tables, roughness, cosine, 1), alpha, cosine);
    const Vec4 albedo = between(tables, roughness, cosine, 2);
    const Mat3 frame = shader::surimi_frame(normal, view);
    return {shader::surimi_quad(c[0], c[1], c[2], c[3], point, frame, full, schlick, two_sided),
            Vec2(albedo.x, albedo.x * std::pow(albedo.y, 5))};
}

Shaded by_runtime(const std::array<Vec3, 4>& corners, const Vec3& point, const Vec3& normal, const Vec3& view,
                  double roughness, bool two_sided) {
    const PlacedLobe full = place_lobe(normal, view, roughness);
    const PlacedLobe schlick = place_lobe(normal, view, roughness, LobePart::schlick);
    const std::span<const Vec3> polygon(corners);
    return {Vec3(irradiance_of_polygon<double>(polygon, point, normal, two_sided) / pi,
                 specular_share_of_polygon(full, polygon, point, two_sided),
                 specular_share_of_polygon(schlick, polygon, point, two_sided)),
            Vec2(full.albedo, schlick.albedo)};
}

TEST(GodotShader, LightsAsTheRuntimeDoes) {
    Random random{17};
    const auto number = [&] { return 2 * random.next() - 1; };
    const auto direction = [&] { return normalize_or(Vec3(number(), number(), number()), Vec3(0, 0, 1)); };
    int lit = 0, cut = 0, highlights = 0;
    for (int n = 0; n < 20000; ++n) {
        const Vec3 centre = 2.0 * Vec3(number(), number(), number()), u = direction();
        const Vec3 v = glm::normalize(glm::cross(u, direction()));
        const std::array<Vec3, 4> corners = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
        const Vec3 normal = direction(), point = 0.5 * Vec3(number(), number(), number());
        Vec3 view = direction();
        if (glm::dot(view, normal) < 0) view = -view;
        const double roughness = 0.03 + 0.97 * random.next();
        const bool two_sided = n % 4 == 0;
        const Shaded shaded = by_shader(corners, point, normal, view, roughness, two_sided);
        const Shaded expected = by_runtime(corners, point, normal, view, roughness, two_sided);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(shaded.shares[k], expected.shares[k], 1e-6) << n << ' ' << k << " roughness " << roughness;
        EXPECT_NEAR(shaded.albedos.x, expected.albedos.x, 1e-7);
        EXPECT_NEAR(shaded.albedos.y, expected.albedos.y, 1e-7);
        const auto is_above = [&](const Vec3& corner) { return glm::dot(corner - point, normal) > 0; };
        const auto above = std::count_if(corners.begin(), corners.end(), is_above);
        lit += expected.shares.x > 0;
        cut += expected.shares.x > 0 && above < 4;
        highlights += expected.shares.y > 0.1;
    }
    EXPECT_GT(lit, 5000);
    EXPECT_GT(cut, 2000);
    EXPECT_GT(highlights, 1000);
}

TEST(GodotShader, HardPlacesGiveNumbers) {
    const std::array<Vec3, 4> corners = {Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 1, 1), Vec3(1, 0, 1)};
    const Vec3 up(0, 0, 1);
    for (const Vec3& point : {Vec3(0), Vec3(0, 0, 1), Vec3(0.5, 0.5, 1), Vec3(1, 0, 1), Vec3(5, 0, 1), Vec3(0.5)})
        for (const Vec3& normal : {up, -up, Vec3(1, 0, 0)})
            for (const double roughness : {0.03, 1.0}) {
                const Shaded shaded = by_shader(corners, point, normal, normal, roughness, false);
                for (int k = 0; k < 3; ++k) {
                    EXPECT_GE(shaded.shares[k], 0.0);
                    EXPECT_LE(shaded.shares[k], 1.0);
                }
            }
}

TEST(GodotShader, ReflectsAsMuchAsTheRuntime_M30) {
    const Vec3 shares(0.3, 0.2, 0.1), albedo(0.5, 0.4, 0.3), f0(0.04, 0.5, 1);
    const Vec2 albedos(0.9, 0.05);
    const Vec3 reflected = shader::surimi_reflected(shares, albedo, f0, albedos);
    for (int k = 0; k < 3; ++k) {
        const double full = f0[k] * albedos.x, schlick = (1 - f0[k]) * albedos.y;
        EXPECT_NEAR(reflected[k], albedo[k] * (1 - full - schlick) * 0.3 + full * 0.2 + schlick * 0.1, 1e-15);
    }
}

}  // namespace
}  // namespace surimi
