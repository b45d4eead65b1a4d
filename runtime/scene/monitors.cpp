// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/monitors.h"

#include "runtime/base/error.h"
#include "runtime/scene/monitor_candidates.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <set>

namespace surimi {
namespace {

using Candidates = std::vector<MonitorCandidate>;

constexpr size_t most_monitors = 3;
constexpr const char* channel_letters = "RGB";

std::string quoted_for_shell(const std::string& name) {
    const bool is_plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
    });
    if (is_plain) return name;
    std::string quoted = "'";
    for (const char c : name) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// One line for each candidate, the brightest first, and the line to paste.
std::string listing(Candidates candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const MonitorCandidate& a, const MonitorCandidate& b) { return flux(a) > flux(b); });
    std::string text;
    std::string command;
    for (size_t i = 0; i < candidates.size(); ++i) {
        std::array<char, 96> numbers{};
        std::snprintf(numbers.data(), numbers.size(), "flux %.4g lm, area %.4g m2", flux(candidates[i]),
                      area(candidates[i].monitor));
        text += "\n  " + candidates[i].monitor.name + ": " + numbers.data();
        if (i < most_monitors)
            command += (i > 0 ? " " : "") + std::string("--monitor ") + quoted_for_shell(candidates[i].monitor.name);
    }
    return text + "\nChoose, for example: " + command;
}

/// The channel that a name ends in: Monitor_R, tv.g, Screen B.001.
std::optional<int> suffix_channel(std::string name) {
    const size_t n = name.size();
    const auto is_digit = [&](size_t i) { return std::isdigit(static_cast<unsigned char>(name[i])) != 0; };
    if (n > 4 && name[n - 4] == '.' && is_digit(n - 3) && is_digit(n - 2) && is_digit(n - 1))
        name.resize(n - 4);  // Blender's copies
    if (name.size() < 3 || std::string(" ._-").find(name[name.size() - 2]) == std::string::npos) return std::nullopt;
    const size_t channel =
        std::string("RGB").find(static_cast<char>(std::toupper(static_cast<unsigned char>(name.back()))));
    if (channel == std::string::npos) return std::nullopt;
    return static_cast<int>(channel);
}

/// Blender's custom properties know no booleans: true arrives as 1, which would be channel G. Several
/// monitors that all claim 1 mean true.
void forget_boolean_channels(Candidates& candidates, Scene& scene) {
    const bool are_all_one =
        std::all_of(candidates.begin(), candidates.end(), [](const MonitorCandidate& c) { return c.is_number_one; });
    if (candidates.size() < 2 || !are_all_one) return;
    for (MonitorCandidate& candidate : candidates) candidate.channel.reset();
    add_note(scene, "extras.monitor = 1 on every monitor taken as true, not as channel G", candidates[0].monitor.name,
             candidates.size());
}

/// Suffixes count only when no two agree and none is taken: else they mean something else.
void use_suffixes(Candidates& candidates) {
    std::multiset<int> claimed;
    for (const MonitorCandidate& c : candidates) {
        const std::optional<int> channel = c.channel ? c.channel : suffix_channel(c.label);
        if (channel) claimed.insert(*channel);
    }
    if (std::any_of(claimed.begin(), claimed.end(), [&](int channel) { return claimed.count(channel) > 1; })) return;
    for (MonitorCandidate& c : candidates)
        if (!c.channel) c.channel = suffix_channel(c.label);
}

/// Channels for those that have none: free ones, in the order given.
void assign_channels(Candidates& candidates, const Scene& scene) {
    std::array<const MonitorCandidate*, most_monitors> owner{};
    for (const MonitorCandidate& c : candidates) {
        if (!c.channel) continue;
        const MonitorCandidate*& other = owner[static_cast<size_t>(*c.channel)];
        if (other != nullptr)
            throw Error(ErrorKind::nothing_to_bake, scene.path.string() + ": " + other->monitor.name + " and " +
                                                        c.monitor.name + " both claim channel " +
                                                        channel_letters[*c.channel] + ":" + listing(candidates));
        other = &c;
    }
    for (MonitorCandidate& c : candidates) {
        if (!c.channel) {
            const auto free = std::find(owner.begin(), owner.end(), nullptr);
            c.channel = static_cast<int>(free - owner.begin());
            *free = &c;
        }
        c.monitor.channel = *c.channel;
    }
}

/// Names become names of layers, so no two may be equal.
void make_names_unique(Candidates& candidates) {
    std::set<std::string> taken;
    for (MonitorCandidate& c : candidates) {
        const std::string base = c.monitor.name;
        for (int n = 2; !taken.insert(c.monitor.name).second; ++n) c.monitor.name = base + "_" + std::to_string(n);
    }
}

void adopt(Candidates& candidates, Scene& scene) {
    std::sort(candidates.begin(), candidates.end(),
              [](const MonitorCandidate& a, const MonitorCandidate& b) { return *a.channel < *b.channel; });
    make_names_unique(candidates);
    for (MonitorCandidate& c : candidates) {
        if (!(luminance(c.monitor.radiance) > 0)) {
            c.monitor.radiance = Vec3(1);
            add_note(scene, "monitors that do not shine get a radiance of 1 (the map does not depend on it)",
                     c.monitor.name);
        }
        for (const size_t s : c.surfaces) scene.surfaces[s].monitor = static_cast<int>(scene.monitors.size());
        scene.monitors.push_back(std::move(c.monitor));
    }
}

[[noreturn]] void fail_without_monitor(const Scene& scene) {
    std::string message = scene.path.string() +
                          ": no monitor found. Name a node Monitor_R, Monitor_G or Monitor_B (or Screen, "
                          "Display, TV); or give it or its "
                          "material the custom property monitor = \"R\"; or use --monitor NODE; or describe "
                          "rectangles with [[monitor]] in the "
                          "TOML; or make a rectangle emissive.";
    size_t listed = 0;
    for (const Note& note : scene.notes) {
        const std::string prefix = "emissive, but no monitor: ";
        if (note.what.rfind(prefix, 0) != 0 || listed == 10) continue;
        if (listed++ == 0) message += " These shine, but are no rectangles; --monitor takes them all the same:";
        const std::string name = note.what.substr(prefix.size());
        message += "\n  " + name + ": " + note.where + "  (--monitor " + quoted_for_shell(name) + ")";
    }
    throw Error(ErrorKind::nothing_to_bake, message);
}

/// The rules of the product in their order; the first that yields a candidate.
Candidates first_rule(CandidateFinder& finder, const MonitorRequest& request, bool& is_automatic) {
    if (!request.command_line.empty()) return finder.selected(request.command_line, "--monitor");
    Candidates found = finder.selected(request.config_nodes, "[[monitor]] of the configuration:");
    Candidates rectangles = finder.from_rectangles(request.config_rectangles);
    std::move(rectangles.begin(), rectangles.end(), std::back_inserter(found));
    if (found.empty()) found = finder.area_lights();
    if (found.empty()) found = finder.marked();
    if (found.empty()) found = finder.named();
    if (!found.empty()) return found;
    is_automatic = true;
    return finder.emissive();
}

}  // namespace

MonitorSelector parse_monitor_selector(const std::string& text) {
    MonitorSelector selector;
    const size_t equals = text.rfind('=');
    selector.node = text.substr(0, equals);
    if (selector.node.empty())
        throw Error(ErrorKind::usage,
                    "--monitor \"" + text + "\": a node name is missing; write --monitor NODE or --monitor NODE=R");
    if (equals == std::string::npos) return selector;
    const std::string letter = text.substr(equals + 1);
    const size_t channel = letter.size() == 1 ? std::string("RGBrgb").find(letter) : std::string::npos;
    if (channel == std::string::npos)
        throw Error(ErrorKind::usage,
                    "--monitor \"" + text + "\": \"" + letter + "\" is no channel; write =R, =G or =B");
    selector.channel = static_cast<int>(channel % 3);
    return selector;
}

void find_monitors(Scene& scene, const MonitorRequest& request) {
    scene.monitors.clear();
    for (Surface& surface : scene.surfaces) surface.monitor = -1;
    CandidateFinder finder(scene);
    bool is_automatic = false;
    Candidates candidates = first_rule(finder, request, is_automatic);
    if (candidates.empty()) fail_without_monitor(scene);
    if (candidates.size() > most_monitors)
        throw Error(ErrorKind::nothing_to_bake, scene.path.string() + ": " + std::to_string(candidates.size()) +
                                                    " monitors found (" + candidates[0].monitor.reason +
                                                    ", ...), but a map has three channels:" + listing(candidates));
    if (!is_automatic) {  // automatic ones keep their order, by flux
        std::stable_sort(
            candidates.begin(), candidates.end(),
            [](const MonitorCandidate& a, const MonitorCandidate& b) { return a.monitor.name < b.monitor.name; });
        forget_boolean_channels(candidates, scene);
        use_suffixes(candidates);
    }
    assign_channels(candidates, scene);
    adopt(candidates, scene);
}

}  // namespace surimi
