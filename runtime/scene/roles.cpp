// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/roles.h"

#include <algorithm>
#include <cctype>
#include <span>

#include "runtime/base/error.h"
#include "runtime/scene/node_names.h"
#include "runtime/scene/node_order.h"
#include "runtime/scene/texture.h"

namespace surimi {
namespace {

enum class Source { usual, object, extras, name, glass, foliage };

struct Stated {
    std::optional<bool> value;
    uint32_t origin = 0;  ///< the node or the object that states it
};

/// RoleMarks with where they come from.
struct Marks {
    Stated casts, receives, two_sided, exclude;
};

Marks marks_of(const RoleMarks& roles, size_t origin) {
    const auto from = static_cast<uint32_t>(origin);
    return {{roles.casts, from}, {roles.receives, from}, {roles.two_sided, from}, {roles.exclude, from}};
}

/// What the nearer marks say, and what those further away say of the rest.
Marks over(const Marks& nearer, Marks further) {
    if (nearer.exclude.value == true) further.casts = further.receives = {};
    for (const auto role : {&Marks::casts, &Marks::receives, &Marks::two_sided, &Marks::exclude})
        if ((nearer.*role).value) further.*role = nearer.*role;
    return further;
}

/// All that is said of a node or surface by one source.
struct Layer {
    Source source;
    Marks marks;
};

struct Ruling {
    bool value = true;
    Source source = Source::usual;
    uint32_t origin = 0;
    bool is_exclusion = false;
};

/// Whether it casts, or receives. `layers`: what wins comes first.
Ruling rule(std::span<const Layer> layers, Stated Marks::*role) {
    bool is_taken_back = false;
    for (const Layer& layer : layers) {
        const Stated& stated = layer.marks.*role;
        const Stated& exclude = layer.marks.exclude;
        if (stated.value) return {*stated.value, layer.source, stated.origin, false};
        if (exclude.value == true && !is_taken_back) return {false, layer.source, exclude.origin, true};
        is_taken_back = is_taken_back || exclude.value == false;
    }
    return {};
}

bool is_glass(const Material& material) {
    return material.alpha_mode == AlphaMode::blend || material.transmission > 0;
}

bool is_foliage(const Material& material) {
    return material.alpha_mode == AlphaMode::mask && material.double_sided;
}

/// What is decided of one surface.
struct Decided {
    Ruling casts, receives, two_sided;
    bool is_excluded() const { return casts.is_exclusion && receives.is_exclusion; }
};

class RoleBook {
  public:
    RoleBook(const Scene& scene, const RoleSettings& settings)
        : scene_(scene),
          settings_(settings),
          by_object_(scene.nodes.size()),
          by_extras_(scene.nodes.size()),
          by_name_(scene.nodes.size()),
          of_surface_(scene.surfaces.size()) {
        for (size_t i = 0; i < settings.objects.size(); ++i) add_object(i);
        for (size_t n = 0; n < scene.nodes.size(); ++n) {
            by_extras_[n] = marks_of(scene.nodes[n].roles, n);
            if (is_collision_name(scene.nodes[n].name)) by_name_[n].exclude = {true, static_cast<uint32_t>(n)};
        }
        for (const size_t n : parents_first(scene)) {
            if (scene.nodes[n].parent < 0) continue;
            const auto parent = static_cast<size_t>(scene.nodes[n].parent);
            for (std::vector<Marks>* marks : {&by_object_, &by_extras_, &by_name_})
                (*marks)[n] = over((*marks)[n], (*marks)[parent]);
        }
    }

    bool excludes_node(size_t node) const {
        const std::array layers = layers_of(node, {});
        return rule(layers, &Marks::casts).is_exclusion && rule(layers, &Marks::receives).is_exclusion;
    }

    Decided decide(size_t s) const {
        const Surface& surface = scene_.surfaces[s];
        const Material& material = material_of(scene_, surface);
        const std::array layers = layers_of(static_cast<size_t>(surface.node), of_surface_[s]);
        Decided decided{rule(layers, &Marks::casts),
                        rule(layers, &Marks::receives),
                        {is_foliage(material), Source::foliage, 0, false}};
        const auto stated =
            std::ranges::find_if(layers, [](const Layer& layer) { return layer.marks.two_sided.value.has_value(); });
        if (stated != layers.end()) {
            const Stated& said = stated->marks.two_sided;
            decided.two_sided = {*said.value, stated->source, said.origin, false};
        }
        if (is_glass(material) && decided.casts.source == Source::usual)
            decided.casts = {settings_.glass == Glass::block, Source::glass, 0, false};
        return decided;
    }

    /// Who says so, for people.
    std::string why(const Ruling& ruling) const {
        switch (ruling.source) {
            case Source::object:
                return "[[object]] \"" + settings_.objects[ruling.origin].node + "\"";
            case Source::extras:
                return "extras of " + scene_.nodes[ruling.origin].name;
            case Source::name:
                return "collision mesh by the name of " + scene_.nodes[ruling.origin].name;
            case Source::glass:
                return "glass";
            default:
                return "alpha-masked and double-sided";
        }
    }

  private:
    void add_object(size_t index) {
        const std::string& name = settings_.objects[index].node;
        const Marks marks = marks_of(settings_.objects[index].roles, index);
        const std::vector<size_t> nodes = matching_nodes(scene_, name);
        for (const size_t n : nodes) by_object_[n] = over(marks, by_object_[n]);
        bool is_known = !nodes.empty();
        for (size_t s = 0; s < scene_.surfaces.size() && nodes.empty(); ++s) {
            if (!matches_glob(name, scene_.surfaces[s].name)) continue;
            of_surface_[s] = over(marks, of_surface_[s]);
            is_known = true;
        }
        if (is_known) return;
        const std::string file = scene_.path.string();
        throw Error(ErrorKind::usage, file + ": object \"" + name + "\": no node of the scene has this name; the " +
                                          "nearest is \"" + nearest_node_name(scene_, name) +
                                          "\". List them: surimi inspect " + file);
    }

    std::array<Layer, 4> layers_of(size_t node, const Marks& of_surface) const {
        return {{{Source::object, of_surface},
                 {Source::object, by_object_[node]},
                 {Source::extras, by_extras_[node]},
                 {Source::name, by_name_[node]}}};
    }

    const Scene& scene_;
    const RoleSettings& settings_;
    std::vector<Marks> by_object_, by_extras_, by_name_;  ///< of each node, from its ancestors as well
    std::vector<Marks> of_surface_;                       ///< by objects that name surfaces
};

std::string by_source(const std::string& what, const char* key, const Ruling& ruling) {
    switch (ruling.source) {
        case Source::object:
            return what + " by [[object]]";
        case Source::name:
            return what + " by their names";
        default:
            return what + " by extras." + (ruling.is_exclusion ? "exclude" : key);
    }
}

/// The notes that one surface gives cause to.
std::vector<std::string> notes_of(const Decided& decided) {
    if (decided.is_excluded() && decided.casts.source == Source::name)
        return {
            "collision meshes, by their names, left out of the bake (exclude = false in extras or [[object]] takes "
            "one back)"};
    if (decided.is_excluded()) return {by_source("surfaces left out of the bake", "exclude", decided.casts)};
    std::vector<std::string> notes;
    const Ruling& casts = decided.casts;
    if (casts.source == Source::glass && casts.value)
        notes.emplace_back("blended or transmissive surfaces block light like walls (--glass clear lets it through)");
    else if (casts.source == Source::glass)
        notes.emplace_back("blended or transmissive surfaces cast no shadow (--glass block makes walls of them)");
    else if (!casts.value)
        notes.push_back(by_source("surfaces that cast no shadow", "casts", casts));
    if (!decided.receives.value)
        notes.push_back(by_source("surfaces that get no texels", "receives", decided.receives));
    if (decided.two_sided.value && decided.two_sided.source == Source::foliage)
        notes.emplace_back("alpha-masked double-sided surfaces count on both sides (two_sided = false takes one back)");
    else if (decided.two_sided.value)
        notes.push_back(by_source("surfaces that count on both sides", "two_sided", decided.two_sided));
    return notes;
}

/// What is unusual, and why; empty: nothing.
std::string reasons_of(const RoleBook& book, const Decided& decided) {
    if (decided.is_excluded()) return "left out of the bake (" + book.why(decided.casts) + ")";
    std::string text;
    const auto add = [&](bool is_unusual, const char* what, const Ruling& ruling) {
        if (is_unusual) text += (text.empty() ? "" : ", ") + std::string(what) + " (" + book.why(ruling) + ")";
    };
    add(!decided.casts.value, "casts no shadow", decided.casts);
    add(!decided.receives.value, "gets no texels", decided.receives);
    add(decided.two_sided.value, "counts on both sides", decided.two_sided);
    return text;
}

}  // namespace

std::vector<UnusualRoles> apply_roles(Scene& scene, const RoleSettings& settings) {
    const RoleBook book(scene, settings);
    for (size_t n = 0; n < scene.nodes.size(); ++n) scene.nodes[n].is_excluded = book.excludes_node(n);
    std::vector<UnusualRoles> unusual;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        const Decided decided = book.decide(s);
        Surface& surface = scene.surfaces[s];
        surface.casts = decided.casts.value;
        surface.receives = decided.receives.value;
        surface.is_two_sided = decided.two_sided.value;
        surface.is_excluded = decided.is_excluded();
        surface.is_drawn = !surface.is_excluded || decided.casts.source != Source::name;
        for (const std::string& note : notes_of(decided)) add_note(scene, note, surface.name);
        const std::string why = reasons_of(book, decided);
        if (!why.empty()) unusual.push_back({s, why});
    }
    return unusual;
}

bool is_collision_name(std::string name) {
    const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    const size_t dot = name.rfind('.');
    if (dot != std::string::npos && name.size() - dot > 3 &&
        std::all_of(name.begin() + static_cast<std::ptrdiff_t>(dot) + 1, name.end(), is_digit))
        name.resize(dot);  // Blender's copies
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const char* prefix : {"ubx_", "ucp_", "usp_", "ucx_"})
        if (name.starts_with(prefix)) return true;
    for (const char* suffix : {"_collider", "_collision"})
        if (name.ends_with(suffix)) return true;
    const size_t mark = name.find_last_of("-_$");
    if (mark == std::string::npos || mark == 0) return false;
    const std::string last = name.substr(mark + 1);
    return last == "colonly" || last == "convcolonly";
}

}  // namespace surimi
