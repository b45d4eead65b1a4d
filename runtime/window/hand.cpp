// SPDX-License-Identifier: Apache-2.0
// Mouse and keyboard over the picture.
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>

#include "runtime/window/controls.h"
#include "runtime/window/orbit.h"

namespace surimi {
namespace {

constexpr double turn_of_height = pi;  // radians: a drag over the picture's height turns the eye to the other side
constexpr double wheel_factor = 0.85;  // of the distance, for a notch of the wheel
constexpr double key_speed = 1.0;      // radians a second for arrows; pivot distances a second for walking

double distance_of(const Choices& choices) {
    return std::max(glm::distance(choices.view.eye, choices.pivot), 1e-6);
}

/// Pans eye and pivot, so that the place under the pointer stays there.
void pan(const Vec3& by, Choices& choices) {
    const View before = choices.view;
    choices.view = moved(before, by);
    choices.pivot += choices.view.eye - before.eye;
}

void drag(const Area& area, Choices& choices) {
    const ImVec2 moved_by = ImGui::GetIO().MouseDelta;
    const double x = static_cast<double>(moved_by.x / area.height), y = static_cast<double>(moved_by.y / area.height);
    if (x == 0 && y == 0) return;
    if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) || ImGui::GetIO().KeyShift) {
        const double height = 2 * std::tan(0.5 * choices.view.yfov) * distance_of(choices);
        pan({-x * height, y * height, 0}, choices);
    } else if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
        // As if the picture were pulled along: the look goes the other way.
        choices.view = orbited(choices.view, choices.view.eye, x * choices.view.yfov, y * choices.view.yfov);
    } else {
        choices.view = orbited(choices.view, choices.pivot, -x * turn_of_height, -y * turn_of_height);
    }
}

void hold_keys(Choices& choices) {
    const auto axis = [](int minus, int plus) {
        return static_cast<double>(ImGui::IsKeyDown(plus)) - static_cast<double>(ImGui::IsKeyDown(minus));
    };
    // A frame after a pause counts as a short one: nothing jumps.
    const double step = key_speed * std::min(static_cast<double>(ImGui::GetIO().DeltaTime), 0.1);
    const double yaw = axis(GLFW_KEY_LEFT, GLFW_KEY_RIGHT), pitch = axis(GLFW_KEY_DOWN, GLFW_KEY_UP);
    if (yaw != 0 || pitch != 0) choices.view = orbited(choices.view, choices.pivot, yaw * step, -pitch * step);
    const Vec3 walk(axis(GLFW_KEY_A, GLFW_KEY_D), axis(GLFW_KEY_Q, GLFW_KEY_E), axis(GLFW_KEY_S, GLFW_KEY_W));
    if (walk != Vec3(0)) pan(walk * (step * distance_of(choices)), choices);
    const double nearer = axis(GLFW_KEY_MINUS, GLFW_KEY_EQUAL) + axis(GLFW_KEY_KP_SUBTRACT, GLFW_KEY_KP_ADD);
    if (nearer != 0) choices.view = zoomed(choices.view, choices.pivot, std::exp(-nearer * step), choices.nearest);
}

void next_shadows(bool has_map, LightingSettings& lighting) {
    lighting.model = lighting.model == ShadingModel::reference ? ShadingModel::exact : lighting.model;
    switch (lighting.visibility) {
        case VisibilitySource::none:
            lighting.visibility = has_map ? VisibilitySource::baked : VisibilitySource::stochastic;
            break;
        case VisibilitySource::baked:
            lighting.visibility = VisibilitySource::stochastic;
            break;
        case VisibilitySource::stochastic:
            lighting.visibility = VisibilitySource::none;
            break;
    }
}

Requests press_keys(bool has_map, const WindowSettings& settings, Choices& choices) {
    Requests requests;
    const auto is_pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
    for (size_t m = 0; m < std::min<size_t>(3, choices.lamps.size()); ++m)
        if (is_pressed(GLFW_KEY_1 + static_cast<int>(m)) || is_pressed(GLFW_KEY_KP_1 + static_cast<int>(m)))
            choices.lamps[m].is_on = !choices.lamps[m].is_on;
    if (is_pressed(GLFW_KEY_V)) next_shadows(has_map, choices.lighting);
    if (is_pressed(GLFW_KEY_M)) choices.exposure.reset(), ++choices.metering;
    if (is_pressed(GLFW_KEY_HOME) && !settings.views.empty()) choices.view = settings.views.front().view;
    if (is_pressed(GLFW_KEY_P)) requests.save_as = ".png";
    if (is_pressed(GLFW_KEY_X)) requests.save_as = ".exr";
    requests.wants_help = is_pressed(GLFW_KEY_H);
    requests.wants_close = is_pressed(GLFW_KEY_ESCAPE);
    return requests;
}

}  // namespace

Requests use_hand(const Area& area, const Sight& sight, const WindowSettings& settings, Choices& choices) {
    ImGui::SetCursorScreenPos({area.x, area.y});
    ImGui::InvisibleButton(
        "picture", {area.width, area.height},
        ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemActive()) drag(area, choices);
    if (ImGui::IsItemHovered()) {
        if (io.MouseWheel != 0)
            choices.view = zoomed(choices.view, choices.pivot,
                                  std::pow(wheel_factor, static_cast<double>(io.MouseWheel)), choices.nearest);
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            const Vec2 at((io.MousePos.x - area.x) / area.width, (io.MousePos.y - area.y) / area.height);
            const double aspect = static_cast<double>(area.width / area.height);
            choices.pivot = place_in_view(sight.rays, choices.view, at, aspect).value_or(choices.pivot);
        }
    }
    // A number is being typed into a slider, or a colour picked, which Escape leaves.
    if (io.WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return {};
    hold_keys(choices);
    return press_keys(sight.has_map, settings, choices);
}

}  // namespace surimi
