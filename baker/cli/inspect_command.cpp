// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>

#include "baker/cli/commands.h"
#include "baker/cli/options.h"
#include "runtime/base/error.h"
#include "runtime/scene/gltf.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

Json as_json(const Vec3& v) {
    return {v.x, v.y, v.z};
}

Json monitor_json(const Monitor& monitor) {
    Json panels = Json::array();
    for (const Polygon& panel : monitor.panels) {
        Json corners = Json::array();
        for (const Vec3& corner : panel.corners) corners.push_back(as_json(corner));
        panels.push_back(corners);
    }
    return {{"name", monitor.name},
            {"channel", std::string(1, "RGB"[monitor.channel])},
            {"why", monitor.reason},
            {"area_square_metres", area(monitor)},
            {"radiance", as_json(monitor.radiance)},
            {"flux", luminance(monitor.radiance) * area(monitor) * pi},
            {"front", as_json(front_normal(monitor.panels.front()))},
            {"two_sided", monitor.two_sided},
            {"panels", panels}};
}

/// State of the uv sets over all surfaces.
struct UvCounts {
    size_t with_first = 0, with_second = 0, second_out_of_range = 0;
};

UvCounts count_uv_sets(const Scene& scene) {
    UvCounts counts;
    for (const Surface& surface : scene.surfaces) {
        counts.with_first += !surface.uv_sets.empty();
        if (surface.uv_sets.size() < 2) continue;
        ++counts.with_second;
        for (const Vec2& uv : surface.uv_sets[1])
            if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) {
                ++counts.second_out_of_range;
                break;
            }
    }
    return counts;
}

/// Surfaces whose roles are not the usual ones; names the first few.
void print_roles(const Scene& scene, const std::vector<UnusualRoles>& roles) {
    if (!roles.empty()) fmt::print("roles\n");
    constexpr size_t most_lines = 20;
    for (size_t i = 0; i < std::min(roles.size(), most_lines); ++i)
        fmt::print("  {}: {}\n", scene.surfaces[roles[i].surface].name, roles[i].why);
    if (roles.size() > most_lines) fmt::print("  and {} more; --json lists them all\n", roles.size() - most_lines);
}

Json roles_json(const Scene& scene, const std::vector<UnusualRoles>& roles) {
    Json list = Json::array();
    for (const UnusualRoles& unusual : roles) {
        const Surface& surface = scene.surfaces[unusual.surface];
        list.push_back({{"surface", surface.name},
                        {"casts", surface.casts},
                        {"receives", surface.receives},
                        {"two_sided", surface.is_two_sided},
                        {"excluded", surface.is_excluded},
                        {"why", unusual.why}});
    }
    return list;
}

Json report_json(const Scene& scene, const std::vector<UnusualRoles>& roles, const std::string& problem) {
    const Bounds box = bounds(scene);
    const UvCounts uv = count_uv_sets(scene);
    Json report;
    report["scene"] = scene.path.filename().string();
    report["nodes"] = scene.nodes.size();
    report["surfaces"] = scene.surfaces.size();
    report["triangles"] = triangle_count(scene);
    report["materials"] = scene.materials.size();
    report["images"] = scene.images.size();
    report["cameras"] = Json::array();
    for (const Camera& camera : scene.cameras) report["cameras"].push_back(camera.name);
    if (!scene.surfaces.empty()) report["bounds"] = {{"low", as_json(box.low)}, {"high", as_json(box.high)}};
    report["uv"] = {{"surfaces_with_texcoord_0", uv.with_first},
                    {"surfaces_with_texcoord_1", uv.with_second},
                    {"texcoord_1_out_of_range", uv.second_out_of_range}};
    report["monitors"] = Json::array();
    for (const Monitor& monitor : scene.monitors) report["monitors"].push_back(monitor_json(monitor));
    report["roles"] = roles_json(scene, roles);
    report["notes"] = Json::array();
    for (const Note& note : scene.notes)
        report["notes"].push_back({{"what", note.what}, {"count", note.count}, {"where", note.where}});
    if (!problem.empty()) report["problem"] = problem;
    return report;
}

void print_report(const Scene& scene, const std::vector<UnusualRoles>& roles, const std::string& problem) {
    const Bounds box = bounds(scene);
    fmt::print("{}\n", scene.path.filename().string());
    fmt::print("  {} triangles in {} surfaces, {} nodes, {} materials, {} images, {} cameras\n", triangle_count(scene),
               scene.surfaces.size(), scene.nodes.size(), scene.materials.size(), scene.images.size(),
               scene.cameras.size());
    if (!scene.surfaces.empty()) {
        const Vec3 size = box.high - box.low;
        fmt::print("  {:.3g} x {:.3g} x {:.3g} m\n", size.x, size.y, size.z);
    }
    const UvCounts uv = count_uv_sets(scene);
    fmt::print("  TEXCOORD_0 on {} surfaces, TEXCOORD_1 on {}{}\n", uv.with_first, uv.with_second,
               uv.second_out_of_range ? fmt::format(" ({} of them leave [0, 1])", uv.second_out_of_range) : "");
    fmt::print("monitors\n");
    for (const Monitor& monitor : scene.monitors) {
        const Vec3 front = front_normal(monitor.panels.front());
        fmt::print(
            "  {} {}: {:.3g} m2 in {} panel{}, shines towards ({:.2f}, {:.2f}, {:.2f}), radiance ({:.3g}, {:.3g}, "
            "{:.3g}); found by {}\n",
            "RGB"[monitor.channel], monitor.name, area(monitor), monitor.panels.size(),
            monitor.panels.size() == 1 ? "" : "s", front.x, front.y, front.z, monitor.radiance.x, monitor.radiance.y,
            monitor.radiance.z, monitor.reason);
    }
    if (scene.monitors.empty()) fmt::print("  none\n");
    print_roles(scene, roles);
    if (!scene.notes.empty()) fmt::print("notes\n");
    for (const Note& note : scene.notes)
        fmt::print("  {}: {}{}\n", note.what, note.count, note.where.empty() ? "" : ", first at " + note.where);
    if (!problem.empty()) fmt::print("problem\n  {}\n", problem);
}

}  // namespace

Run add_inspect_command(CLI::App& app) {
    const auto given = std::make_shared<Given>();
    CLI::App* command = app.add_subcommand("inspect", "What is in a scene, which parts are monitors, and why");
    add_scene_options(*command, *given);
    return [given] {
        const Config config = effective_config(*given);
        Scene scene = read_gltf(given->scene);
        std::vector<UnusualRoles> roles;
        std::string problem;
        ErrorKind kind{};
        try {
            roles = apply_roles(scene, config.roles);
            find_monitors(scene, config.monitors);
        } catch (const Error& error) {  // the rest of the report is still worth having
            problem = error.what();
            kind = error.kind();
        }
        if (given->json)
            fmt::print("{}\n", report_json(scene, roles, problem).dump(2));
        else
            print_report(scene, roles, problem);
        return static_cast<int>(kind);
    };
}

}  // namespace surimi
