// SPDX-License-Identifier: Apache-2.0
// Lights one point of a glossy floor with a screen, then shadows it with a baked visibility map. Lengths in metres.
#include <cstdio>
#include <vector>

#include "runtime/ltc/placed_lobe.h"
#include "runtime/ltc/polygon.h"
#include "runtime/map/visibility_map.h"

using surimi::Vec2, surimi::Vec3, surimi::Vec3f;

int main() {
    // Corners run counter-clockwise seen from the side that shines, here +z.
    const std::vector<Vec3> screen = {{-1, 0.5, -2}, {1, 0.5, -2}, {1, 1.5, -2}, {-1, 1.5, -2}};
    const double radiance = 5;

    const Vec3 point(0.2, 0, 0), normal(0, 1, 0), eye(-0.3, 1.2, 2);
    const Vec2 lightmap_uv(0.5, 0.25);                            // of the point: TEXCOORD_1 of a baked file
    const double reflectance = 0.5, f0 = 0.04, roughness = 0.35;  // roughness is perceptual, alpha its square

    const double irradiance = surimi::irradiance_of_polygon<double>(screen, point, normal);
    const double diffuse = reflectance / surimi::pi * radiance * irradiance;

    double specular = 0;  // F0 times one lobe, 1 - F0 times another
    for (const auto part : {surimi::LobePart::full, surimi::LobePart::schlick}) {
        const surimi::PlacedLobe lobe = surimi::place_lobe(normal, glm::normalize(eye - point), roughness, part);
        const double albedo = (part == surimi::LobePart::full ? f0 : 1 - f0) * lobe.albedo;
        specular += albedo * radiance * surimi::specular_share_of_polygon(lobe, screen, point);
    }
    std::printf("unshadowed: diffuse %.5f specular %.5f\n", diffuse, specular);

    // A program reads the map from room.visibility.exr; R is the first monitor. This one is twice as bright on the
    // right, and the point lies in the middle.
    surimi::VisibilityMap map;
    map.visibility = surimi::Image<Vec3f>(2, 2, Vec3f(0.4f));
    map.visibility.at(1, 0) = map.visibility.at(1, 1) = Vec3f(0.8f);
    const double visible = surimi::look_up(map, lightmap_uv).r;
    std::printf("visible %.3f: diffuse %.5f specular %.5f\n", visible, visible * diffuse, visible * specular);
}
