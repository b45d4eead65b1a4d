// SPDX-License-Identifier: Apache-2.0
// What the user of the window has set, and the wish that it comes to.
#pragma once

#include <string>

#include "runtime/window/progressive.h"

namespace surimi {

/// A monitor with its switch.
struct Lamp {
    std::string name;
    bool is_on = true;
    Vec3 radiance{1};  ///< when it is on: linear, nits; never 0
};

struct Choices {
    View view;
    Vec3 pivot{0};            ///< what the eye turns about
    double nearest = 1e-3;    ///< metres; how near the eye comes to it
    std::vector<Lamp> lamps;  ///< in the order of Scene::monitors
    LightingSettings lighting;
    Show show = Show::lit;
    int samples_per_side = 3;
    std::optional<double> exposure;  ///< stops; empty: automatic
    int metering = 0;                ///< counts the wishes for a new automatic exposure
};

/// Another colour, as bright as before; `color` is linear, of any size. Black is no colour: changes nothing.
Vec3 recolored(const Vec3& radiance, const Vec3& color);

/// The choices of a window that opens with `lighting` as it is seen in `view`: turns about what is in its middle. A
/// monitor that does not shine is off; switched on, it is white and as bright as the brightest.
Choices choices_for(const Lighting& lighting, const View& view);

/// What the eye sees at a place of the picture, x and y in [0, 1] from the upper left corner; empty: nothing.
std::optional<Vec3> place_in_view(const RayScene& rays, const View& view, const Vec2& at, double aspect);

Wish wish_of(const Choices& choices, int width, int height);

}  // namespace surimi
