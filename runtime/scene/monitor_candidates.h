// SPDX-License-Identifier: Apache-2.0
// What in a scene could be a monitor, rule by rule; find_monitors chooses.
#pragma once

#include "runtime/scene/monitors.h"

#include <optional>
#include <string>
#include <vector>

namespace surimi {

struct MonitorCandidate {
    Monitor monitor;               ///< its channel is not decided yet
    std::optional<int> channel;    ///< as the user or the file states it
    bool is_number_one = false;    ///< the file states it as 1, which is also how Blender writes true
    std::string label;             ///< where a suffix _R, _G, _B is looked for: the name of the node or the material
    std::vector<size_t> surfaces;  ///< of Scene::surfaces
};

/// Lumen that leave one side: luminance * area * pi.
double flux(const MonitorCandidate& candidate);

/// Collects the candidates of one rule. A surface belongs to one candidate at most: the first that claims it. Excluded
/// surfaces and nodes (roles.h) are candidates only where the user names them.
class CandidateFinder {
  public:
    explicit CandidateFinder(Scene& scene);

    /// Throws Error(usage) for a selector that matches nothing, or nothing with an area.
    std::vector<MonitorCandidate> selected(const std::vector<MonitorSelector>& selectors, const std::string& rule);
    std::vector<MonitorCandidate> from_rectangles(const std::vector<MonitorRectangles>& monitors) const;
    std::vector<MonitorCandidate> area_lights();
    std::vector<MonitorCandidate> marked();
    std::vector<MonitorCandidate> named();
    /// Emissive surfaces that are one rectangle, brightest first; why the others are not goes to the scene's
    /// notes.
    std::vector<MonitorCandidate> emissive();

  private:
    std::optional<MonitorCandidate> from_node(size_t node, const std::string& reason);
    std::vector<MonitorCandidate> from_nodes(const std::vector<size_t>& nodes, const std::string& reason);
    template <class Predicate>
    std::vector<MonitorCandidate> from_materials(const Predicate& is_wanted, const std::string& reason);
    MonitorCandidate from_surfaces(size_t node, std::vector<size_t> surfaces, const std::string& reason);
    void release_excluded(size_t node);
    std::vector<size_t> free_surfaces(size_t node) const;
    std::vector<size_t> free_surfaces_below(size_t node) const;
    void claim_coinciding_quads(size_t light_node, MonitorCandidate& candidate);
    const Material* material_of(size_t surface) const;
    bool is_emissive(size_t surface) const;

    Scene& scene_;
    std::vector<std::vector<size_t>> children_;
    std::vector<std::vector<size_t>> surfaces_;  ///< of each node
    std::vector<bool> is_claimed_;
    std::vector<bool> is_barred_;  ///< excluded and not named
};

}  // namespace surimi
