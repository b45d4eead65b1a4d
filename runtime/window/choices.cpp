// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/choices.h"

namespace surimi {

Vec3 recolored(const Vec3& radiance, const Vec3& color) {
    const double largest = largest_component(color);
    if (!(largest > 0) || !std::isfinite(largest)) return radiance;
    return glm::max(color, Vec3(0)) * (largest_component(radiance) / largest);
}

std::optional<Vec3> place_in_view(const RayScene& rays, const View& view, const Vec2& at, double aspect) {
    const Vec3 direction = ray_direction(view, at.x, at.y, aspect);
    const auto hit = rays.closest_hit(view.eye, direction);
    if (!hit) return std::nullopt;
    return view.eye + hit->distance * direction;
}

Choices choices_for(const Lighting& lighting, const View& view) {
    Choices choices;
    choices.view = view;
    const Bounds box = bounds(lighting.scene);
    const bool has_size = is_finite(box.low);
    const double distance = has_size ? glm::distance(view.eye, 0.5 * (box.low + box.high)) : 1;
    if (has_size) choices.nearest = std::max(1e-4 * glm::distance(box.low, box.high), 1e-9);
    choices.pivot =
        place_in_view(lighting.rays, view, Vec2(0.5), 1).value_or(view.eye + std::max(distance, 1e-3) * view.forward);
    double brightest = 0;
    for (const LitMonitor& light : lighting.lights) brightest = std::max(brightest, largest_component(light.radiance));
    for (size_t m = 0; m < lighting.lights.size(); ++m) {
        const bool is_on = is_lit(lighting.lights[m]);
        choices.lamps.push_back({lighting.scene.monitors[m].name, is_on,
                                 is_on ? lighting.lights[m].radiance : Vec3(brightest > 0 ? brightest : 1)});
    }
    choices.lighting = lighting.settings;
    return choices;
}

Wish wish_of(const Choices& choices, int width, int height) {
    Wish wish;
    wish.view = choices.view;
    wish.picture.width = width;
    wish.picture.height = height;
    wish.picture.samples_per_side = choices.samples_per_side;
    wish.picture.show = choices.show;
    wish.lighting = choices.lighting;
    for (const Lamp& lamp : choices.lamps) wish.radiance.push_back(lamp.is_on ? lamp.radiance : Vec3(0));
    wish.exposure = choices.exposure;
    wish.metering = choices.metering;
    return wish;
}

}  // namespace surimi
