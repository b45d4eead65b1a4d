// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/monitor_candidates.h"

#include "runtime/base/error.h"
#include "runtime/scene/monitor_shapes.h"
#include "runtime/scene/node_names.h"

#include <algorithm>
#include <map>
#include <regex>
#include <utility>

namespace surimi {
namespace {

bool is_monitor_name(const std::string& name) {
    static const std::regex pattern(
        R"(^(monitor|screen|display|tv)s?([ ._-]?(r|g|b|[0-9]+|left|right|center))?(\.\d{3})?$)",
        std::regex::ECMAScript | std::regex::icase);
    // The longest name that can mean something; std::regex recurses once for each character.
    constexpr size_t longest = 64;
    return name.size() <= longest && std::regex_match(name, pattern);
}

}  // namespace

double flux(const MonitorCandidate& candidate) {
    return luminance(candidate.monitor.radiance) * area(candidate.monitor) * pi;
}

CandidateFinder::CandidateFinder(Scene& scene)
    : scene_(scene),
      children_(scene.nodes.size()),
      surfaces_(scene.nodes.size()),
      is_claimed_(scene.surfaces.size(), false) {
    for (size_t n = 0; n < scene.nodes.size(); ++n)
        if (scene.nodes[n].parent >= 0) children_[static_cast<size_t>(scene.nodes[n].parent)].push_back(n);
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        surfaces_[static_cast<size_t>(scene.surfaces[s].node)].push_back(s);
        is_barred_.push_back(scene.surfaces[s].is_excluded);
    }
}

const Material* CandidateFinder::material_of(size_t surface) const {
    const int material = scene_.surfaces[surface].material;
    return material < 0 ? nullptr : &scene_.materials[static_cast<size_t>(material)];
}

bool CandidateFinder::is_emissive(size_t surface) const {
    const Material* material = material_of(surface);
    return material != nullptr && luminance(material->emissive) > 0;
}

/// For a node that the user names: its own excluded surfaces, or all below it where nothing else is.
void CandidateFinder::release_excluded(size_t node) {
    std::vector<size_t> nodes{node};
    for (size_t i = 0; i < nodes.size(); ++i) {
        for (const size_t s : surfaces_[nodes[i]]) is_barred_[s] = false;
        if (i == 0 && !free_surfaces_below(node).empty()) return;
        nodes.insert(nodes.end(), children_[nodes[i]].begin(), children_[nodes[i]].end());
    }
}

std::vector<size_t> CandidateFinder::free_surfaces(size_t node) const {
    std::vector<size_t> free;
    std::copy_if(surfaces_[node].begin(), surfaces_[node].end(), std::back_inserter(free),
                 [&](size_t s) { return !is_claimed_[s] && !is_barred_[s]; });
    return free;
}

std::vector<size_t> CandidateFinder::free_surfaces_below(size_t node) const {
    std::vector<size_t> nodes{node};
    std::vector<size_t> free;
    for (size_t i = 0; i < nodes.size(); ++i) {
        const std::vector<size_t> own = free_surfaces(nodes[i]);
        free.insert(free.end(), own.begin(), own.end());
        nodes.insert(nodes.end(), children_[nodes[i]].begin(), children_[nodes[i]].end());
    }
    return free;
}

/// A screen is often one mesh with its case; then the part that shines is meant.
MonitorCandidate CandidateFinder::from_surfaces(size_t node, std::vector<size_t> surfaces, const std::string& reason) {
    const std::string& name = scene_.nodes[node].name;
    const auto dark = std::stable_partition(surfaces.begin(), surfaces.end(), [&](size_t s) { return is_emissive(s); });
    if (dark != surfaces.begin() && dark != surfaces.end()) {
        add_note(scene_, "parts of a monitor's mesh that do not shine are not part of it", name,
                 static_cast<size_t>(surfaces.end() - dark));
        surfaces.erase(dark, surfaces.end());
    }
    MonitorCandidate candidate;
    candidate.monitor.name = name;
    candidate.monitor.node = static_cast<int>(node);
    candidate.monitor.reason = reason + " " + name;
    candidate.monitor.panels = make_polygons(triangles_of(scene_, surfaces));
    candidate.monitor.two_sided = scene_.nodes[node].is_two_sided_monitor;
    candidate.label = name;
    Vec3 power(0);
    double total = 0;
    for (const size_t s : surfaces) {
        is_claimed_[s] = true;
        double surface_area = 0;
        for (const Triangle& t : triangles_of(scene_, {s}))
            surface_area += 0.5 * glm::length(area_normal(t[0], t[1], t[2]));
        total += surface_area;
        const Material* material = material_of(s);
        if (material == nullptr) continue;
        power += surface_area * material->emissive;
        candidate.monitor.two_sided = candidate.monitor.two_sided || material->is_two_sided_monitor;
    }
    candidate.monitor.radiance = total > 0 ? power / total : Vec3(0);
    candidate.surfaces = std::move(surfaces);
    return candidate;
}

std::optional<MonitorCandidate> CandidateFinder::from_node(size_t n, const std::string& reason) {
    const Node& node = scene_.nodes[n];
    const bool is_rectangle_node = node.mesh < 0 && (node.monitor_size.x > 0 || node.area_light_size.x > 0);
    MonitorCandidate candidate;
    if (is_rectangle_node) {
        const bool is_light = node.area_light_size.x > 0 && !(node.monitor_size.x > 0);
        const Polygon polygon = is_light ? light_rectangle(node) : sized_rectangle(node);
        if (!(area(polygon) > 0) || !std::isfinite(area(polygon))) return std::nullopt;
        candidate = from_surfaces(n, {}, reason);
        candidate.monitor.panels = {polygon};
        candidate.monitor.radiance = node.area_light_radiance;
    } else {
        std::vector<size_t> surfaces = node.mesh >= 0 ? free_surfaces(n) : free_surfaces_below(n);
        if (surfaces.empty()) return std::nullopt;
        candidate = from_surfaces(n, std::move(surfaces), reason);
    }
    if (node.is_marked_monitor && node.monitor_channel >= 0) candidate.channel = node.monitor_channel;
    candidate.is_number_one = candidate.channel == 1;
    return candidate;
}

/// Nodes with a mesh first: a group called "Monitors" must not swallow the "Monitor_R" in it.
std::vector<MonitorCandidate> CandidateFinder::from_nodes(const std::vector<size_t>& nodes, const std::string& reason) {
    std::vector<MonitorCandidate> candidates;
    for (const bool has_mesh : {true, false})
        for (const size_t n : nodes) {
            if ((scene_.nodes[n].mesh >= 0) != has_mesh) continue;
            if (std::optional<MonitorCandidate> candidate = from_node(n, reason))
                candidates.push_back(std::move(*candidate));
        }
    return candidates;
}

/// One candidate for each material on each node.
template <class Predicate>
std::vector<MonitorCandidate> CandidateFinder::from_materials(const Predicate& is_wanted, const std::string& reason) {
    std::vector<MonitorCandidate> candidates;
    for (size_t n = 0; n < scene_.nodes.size(); ++n) {
        std::map<int, std::vector<size_t>> by_material;
        for (const size_t s : free_surfaces(n))
            if (material_of(s) != nullptr && is_wanted(*material_of(s)))
                by_material[scene_.surfaces[s].material].push_back(s);
        for (auto& [index, surfaces] : by_material) {
            const Material& material = scene_.materials[static_cast<size_t>(index)];
            MonitorCandidate candidate = from_surfaces(n, std::move(surfaces), reason);
            candidate.monitor.reason = reason + " " + material.name;
            candidate.label = material.name;
            if (by_material.size() > 1) candidate.monitor.name += "/" + material.name;
            if (material.is_marked_monitor && material.monitor_channel >= 0)
                candidate.channel = material.monitor_channel;
            candidate.is_number_one = candidate.channel == 1;
            candidates.push_back(std::move(candidate));
        }
    }
    return candidates;
}

std::vector<MonitorCandidate> CandidateFinder::selected(const std::vector<MonitorSelector>& selectors,
                                                        const std::string& rule) {
    std::vector<MonitorCandidate> all;
    for (const MonitorSelector& selector : selectors) {
        const std::vector<size_t> nodes = matching_nodes(scene_, selector.node);
        for (const size_t n : nodes)
            if (scene_.nodes[n].is_excluded) release_excluded(n);
        std::vector<MonitorCandidate> found = from_nodes(nodes, rule);
        for (size_t s = 0; s < scene_.surfaces.size() && nodes.empty(); ++s) {
            if (is_claimed_[s] || !matches_glob(selector.node, scene_.surfaces[s].name)) continue;
            found.push_back(from_surfaces(static_cast<size_t>(scene_.surfaces[s].node), {s}, rule));
            found.back().monitor.name = scene_.surfaces[s].name;
        }
        const std::string where = scene_.path.string() + ": monitor \"" + selector.node + "\": ";
        if (found.empty() && nodes.empty())
            throw Error(ErrorKind::usage, where + "no node of the scene has this name; the nearest is \"" +
                                              nearest_node_name(scene_, selector.node) +
                                              "\". List them: surimi inspect " + scene_.path.string());
        if (found.empty())
            throw Error(ErrorKind::usage,
                        where +
                            "the node has no surface of its own (no mesh, no area, or already another "
                            "monitor); give it a mesh or extras.monitor_size = [width, height]");
        for (MonitorCandidate& candidate : found) {
            if (selector.channel) candidate.channel = selector.channel;
            if (selector.channel) candidate.is_number_one = false;
            all.push_back(std::move(candidate));
        }
    }
    return all;
}

std::vector<MonitorCandidate> CandidateFinder::from_rectangles(const std::vector<MonitorRectangles>& monitors) const {
    std::vector<MonitorCandidate> candidates;
    for (size_t m = 0; m < monitors.size(); ++m) {
        const MonitorRectangles& source = monitors[m];
        MonitorCandidate candidate;
        candidate.monitor.name = source.name.empty() ? "monitor_" + std::to_string(m) : source.name;
        candidate.monitor.radiance = source.radiance;
        candidate.monitor.reason = "rectangles of the configuration";
        candidate.channel = source.channel;
        candidate.label = candidate.monitor.name;
        for (const MonitorRectangles::Rectangle& r : source.rectangles) {
            candidate.monitor.panels.push_back(
                make_rectangle(r.center, r.half_u, r.half_v, glm::cross(r.half_u, r.half_v)));
            const double size = area(candidate.monitor.panels.back());
            if (!is_finite(r.center) || !std::isfinite(size) || !(size > 0))
                throw Error(ErrorKind::usage, "monitor \"" + candidate.monitor.name +
                                                  "\" of the configuration: half_u and half_v must span an area");
        }
        if (candidate.monitor.panels.empty())
            throw Error(ErrorKind::usage,
                        "monitor \"" + candidate.monitor.name + "\" of the configuration has no rectangle");
        candidates.push_back(std::move(candidate));
    }
    return candidates;
}

/// The quad that shows the light stands on the light's own node, its parent, a child or a sibling. It is part
/// of the monitor, or it would shadow it; and it gives the monitor its name, because tools drop the light but
/// keep the quad.
void CandidateFinder::claim_coinciding_quads(size_t light, MonitorCandidate& candidate) {
    std::vector<size_t> family{light};
    family.insert(family.end(), children_[light].begin(), children_[light].end());
    const int parent = scene_.nodes[light].parent;
    if (parent >= 0) family.push_back(static_cast<size_t>(parent));
    for (size_t n = 0; n < scene_.nodes.size(); ++n)
        if (n != light && scene_.nodes[n].is_in_scene && scene_.nodes[n].parent == parent) family.push_back(n);
    for (const size_t n : family)
        for (const size_t s : free_surfaces(n)) {
            // A rectangle has two triangles, a finely modelled one perhaps hundreds; whole rooms need not be
            // tried.
            constexpr size_t most_triangles = 4096;
            if (scene_.surfaces[s].triangles.size() > most_triangles) continue;
            const std::optional<Polygon> quad = one_polygon(triangles_of(scene_, {s}));
            if (!quad || !do_coincide(candidate.monitor.panels[0], *quad)) continue;
            is_claimed_[s] = true;
            const Node& node = scene_.nodes[n];
            if (candidate.surfaces.empty()) {
                candidate.monitor.name = candidate.label = node.name;
                candidate.monitor.node = static_cast<int>(n);
                if (!candidate.channel && node.is_marked_monitor && node.monitor_channel >= 0)
                    candidate.channel = node.monitor_channel;
                candidate.is_number_one = candidate.channel == 1;
                candidate.monitor.two_sided = candidate.monitor.two_sided || node.is_two_sided_monitor;
            }
            candidate.surfaces.push_back(s);
        }
}

std::vector<MonitorCandidate> CandidateFinder::area_lights() {
    std::vector<MonitorCandidate> candidates;
    for (size_t n = 0; n < scene_.nodes.size(); ++n) {
        const Node& node = scene_.nodes[n];
        if (!node.is_in_scene || node.is_excluded || !(node.area_light_size.x > 0)) continue;
        const Polygon polygon = light_rectangle(node);
        if (!(area(polygon) > 0) || !std::isfinite(area(polygon))) continue;
        MonitorCandidate candidate = from_surfaces(n, {}, "EXT_lights_area on node");
        candidate.monitor.panels = {polygon};
        candidate.monitor.radiance = node.area_light_radiance;
        if (node.is_marked_monitor && node.monitor_channel >= 0) candidate.channel = node.monitor_channel;
        candidate.is_number_one = candidate.channel == 1;
        claim_coinciding_quads(n, candidate);
        candidates.push_back(std::move(candidate));
    }
    return candidates;
}

std::vector<MonitorCandidate> CandidateFinder::marked() {
    std::vector<size_t> nodes;
    for (size_t n = 0; n < scene_.nodes.size(); ++n) {
        const Node& node = scene_.nodes[n];
        const bool is_sized = node.monitor_size.x > 0 && node.mesh < 0;
        if (node.is_in_scene && !node.is_excluded && (node.is_marked_monitor || is_sized)) nodes.push_back(n);
    }
    std::vector<MonitorCandidate> candidates = from_nodes(nodes, "extras.monitor on node");
    std::vector<MonitorCandidate> others =
        from_materials([](const Material& m) { return m.is_marked_monitor; }, "extras.monitor on material");
    std::move(others.begin(), others.end(), std::back_inserter(candidates));
    return candidates;
}

std::vector<MonitorCandidate> CandidateFinder::named() {
    std::vector<size_t> nodes;
    for (size_t n = 0; n < scene_.nodes.size(); ++n)
        if (scene_.nodes[n].is_in_scene && !scene_.nodes[n].is_excluded && is_monitor_name(scene_.nodes[n].name))
            nodes.push_back(n);
    std::vector<MonitorCandidate> candidates = from_nodes(nodes, "node name");
    if (!candidates.empty()) return candidates;
    return from_materials([](const Material& m) { return is_monitor_name(m.name); }, "material name");
}

std::vector<MonitorCandidate> CandidateFinder::emissive() {
    std::vector<MonitorCandidate> candidates;
    for (size_t s = 0; s < scene_.surfaces.size(); ++s) {
        if (is_barred_[s] || !is_emissive(s)) continue;
        const Surface& surface = scene_.surfaces[s];
        const std::vector<Triangle> triangles = triangles_of(scene_, {s});
        const std::optional<Polygon> polygon = one_polygon(triangles);
        if (!polygon || !is_rectangle(*polygon)) {
            const char* why = is_planar(triangles) ? "planar, but no rectangle" : "not planar";
            add_note(scene_, "emissive, but no monitor: " + surface.name,
                     std::to_string(triangles.size()) + " triangles, " + why);
            continue;
        }
        candidates.push_back(from_surfaces(static_cast<size_t>(surface.node), {s}, "emissive rectangle"));
        candidates.back().monitor.name = candidates.back().label = surface.name;
        candidates.back().monitor.reason = "emissive rectangle " + surface.name;
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const MonitorCandidate& a, const MonitorCandidate& b) { return flux(a) > flux(b); });
    return candidates;
}

}  // namespace surimi
