// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/texel_scale.h"

#include <algorithm>

#include <fmt/format.h>

#include "runtime/base/error.h"
#include "runtime/scene/node_names.h"
#include "runtime/scene/node_order.h"

namespace surimi {
namespace {

/// Which surfaces a wish means by its node.
std::vector<bool> surfaces_below(const Scene& scene, const std::string& node, const std::vector<size_t>& order) {
    std::vector<bool> is_meant(scene.nodes.size(), false);
    for (const size_t n : matching_nodes(scene, node)) is_meant[n] = true;
    const bool has_nodes = std::find(is_meant.begin(), is_meant.end(), true) != is_meant.end();
    for (const size_t n : order)
        if (scene.nodes[n].parent >= 0 && is_meant[static_cast<size_t>(scene.nodes[n].parent)]) is_meant[n] = true;
    std::vector<bool> surfaces;
    for (const Surface& surface : scene.surfaces)
        surfaces.push_back(has_nodes ? is_meant[static_cast<size_t>(surface.node)] : matches_glob(node, surface.name));
    return surfaces;
}

bool has_material(const Scene& scene, const Surface& surface, const std::string& name) {
    if (surface.material < 0) return false;
    const std::string& own = scene.materials[static_cast<size_t>(surface.material)].name;
    return own == name || matches_glob(name, own);
}

[[noreturn]] void refuse(const Scene& scene, const TexelScale& wish) {
    std::string what;
    if (!wish.node.empty()) what = fmt::format("node \"{}\"", wish.node);
    if (!wish.material.empty()) what += fmt::format("{}material \"{}\"", what.empty() ? "" : " with ", wish.material);
    const bool is_known = wish.node.empty() || !matching_nodes(scene, wish.node).empty();
    const std::string hint =
        is_known ? "" : fmt::format("; the nearest node is \"{}\"", nearest_node_name(scene, wish.node));
    throw Error(ErrorKind::usage, fmt::format("{}: texel_scale of {}: no surface of the scene is meant{}. List them: "
                                              "surimi inspect {}",
                                              scene.path.string(), what, hint, scene.path.string()));
}

}  // namespace

std::vector<double> texel_scales(const Scene& scene, const std::vector<TexelScale>& wishes) {
    const std::vector<size_t> order = parents_first(scene);
    std::vector<double> of_node(scene.nodes.size(), 1);
    for (const size_t n : order) {
        const int parent = scene.nodes[n].parent;
        const double above = parent < 0 ? 1 : of_node[static_cast<size_t>(parent)];
        of_node[n] = std::clamp(above * scene.nodes[n].texel_scale, least_texel_scale, largest_texel_scale);
    }
    std::vector<double> scales;
    for (const Surface& surface : scene.surfaces) {
        const auto node = static_cast<size_t>(surface.node);
        scales.push_back(node < of_node.size() ? of_node[node] : 1);
        if (surface.material >= 0) scales.back() *= scene.materials[static_cast<size_t>(surface.material)].texel_scale;
    }
    for (const TexelScale& wish : wishes) {
        std::vector<bool> is_meant(scene.surfaces.size(), true);
        if (!wish.node.empty()) is_meant = surfaces_below(scene, wish.node, order);
        size_t count = 0;
        for (size_t s = 0; s < scales.size(); ++s) {
            if (!is_meant[s]) continue;
            if (!wish.material.empty() && !has_material(scene, scene.surfaces[s], wish.material)) continue;
            scales[s] *= wish.scale;
            ++count;
        }
        if (count == 0) refuse(scene, wish);
    }
    for (double& scale : scales) scale = std::clamp(scale, least_texel_scale, largest_texel_scale);
    return scales;
}

}  // namespace surimi
