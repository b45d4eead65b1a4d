// SPDX-License-Identifier: Apache-2.0
// Which parts of a scene are monitors: the rules of the product, in their order; the first that yields one
// wins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/scene.h"

namespace surimi {

/// A monitor that the user names: a node (shell globs * and ? allowed), and its channel if stated.
struct MonitorSelector {
    std::string node;
    std::optional<int> channel;
};

/// A monitor that the user describes: one or more rectangles; the front is the side of cross(half_u, half_v).
struct MonitorRectangles {
    struct Rectangle {
        Vec3 center{0};
        Vec3 half_u{1, 0, 0};
        Vec3 half_v{0, 1, 0};
    };
    std::string name;
    std::optional<int> channel;
    Vec3 radiance{1};
    std::vector<Rectangle> rectangles;
};

struct MonitorRequest {
    std::vector<MonitorSelector> command_line;         ///< rule 1
    std::vector<MonitorSelector> config_nodes;         ///< rule 2
    std::vector<MonitorRectangles> config_rectangles;  ///< rule 2
};

/// "TV=G" -> {TV, 1}; "TV" -> {TV, none}. Throws Error(usage) for another channel than R, G, B.
MonitorSelector parse_monitor_selector(const std::string& text);

/// Fills scene.monitors (one to three, sorted by channel) and Surface::monitor, and adds notes (a candidate
/// that was rejected and why; a monitor that faces a wall closer than its own height is judged later, with
/// rays). Throws Error(nothing_to_bake) when there is none, more than three, or two claim a channel: the
/// message lists every candidate with its flux and the --monitor line to paste. Throws Error(usage) when a
/// name matches nothing.
void find_monitors(Scene& scene, const MonitorRequest& request);

}  // namespace surimi
