// SPDX-License-Identifier: Apache-2.0
// Which surfaces cast shadows, receive light and count on both sides: as the user, names and materials say.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/scene/scene.h"

namespace surimi {

/// What stands in the way of light where a material is blended or lets some through (KHR_materials_transmission above
/// 0). Visibility is yes or no, so a pane is either a wall or air.
enum class Glass { block, clear };

/// A wish of the configuration: the roles of this node's surfaces and of its descendants'.
struct ObjectRoles {
    std::string node;  ///< a name or a shell glob (* and ?), as --monitor understands it, or the name of a surface
    RoleMarks roles;
};

struct RoleSettings {
    Glass glass = Glass::block;
    std::vector<ObjectRoles> objects{};
};

/// A surface whose roles are not the usual ones (casts, receives, one side), and why, for people.
struct UnusualRoles {
    uint32_t surface = 0;
    std::string why;
};

/// Decides casts, receives, is_two_sided, is_excluded and is_drawn of every surface and is_excluded of every node, and
/// adds notes: what was decided and why, how often, and where first. Goes before find_monitors.
///
/// The configuration's objects win over extras, extras over names (is_collision_name excludes), and those over
/// materials: glass casts or not as `settings` say, alpha-masked double-sided surfaces (foliage) are two-sided. Within
/// one of these the nearest of a node and its ancestors wins, and of objects for one node the later. Each role is
/// decided on its own; excluding stands for casts = receives = false, and `exclude = false` takes back an exclusion,
/// not a casts = false. Throws Error(usage) for an object that names no node and no surface.
std::vector<UnusualRoles> apply_roles(Scene& scene, const RoleSettings& settings);

/// Whether engines take a node of this name as a shape for collisions and do not draw it: *_collider, *_collision;
/// UBX_*, UCP_*, USP_*, UCX_* (Unreal Engine); *-colonly, *-convcolonly, also with _ or $ in place of - (Godot). Upper
/// and lower case count alike, and Blender's .001 at the end does not count.
bool is_collision_name(std::string name);

}  // namespace surimi
