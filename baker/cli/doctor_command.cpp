// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "baker/bake.h"
#include "baker/cli/commands.h"
#include "runtime/base/error.h"
#include "runtime/batch/batch.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {
namespace {

/// Adds a square that looks along +z or -z as a surface of its own.
uint32_t add_square(Scene& scene, const std::string& name, double half, double z, bool looks_up) {
    Node node;
    node.name = name;
    node.is_in_scene = true;
    node.mesh = static_cast<int>(scene.nodes.size());
    scene.nodes.push_back(node);
    Surface surface;
    surface.name = name;
    surface.node = surface.mesh = node.mesh;
    const double y = looks_up ? half : -half;
    surface.positions = {{-half, -y, z}, {half, -y, z}, {half, y, z}, {-half, y, z}};
    surface.normals.assign(4, Vec3(0, 0, looks_up ? 1 : -1));
    surface.triangles = {{0, 1, 2}, {0, 2, 3}};
    surface.source_triangle = {0, 1};
    surface.source_vertex = {0, 1, 2, 3};
    scene.surfaces.push_back(std::move(surface));
    return static_cast<uint32_t>(scene.surfaces.size() - 1);
}

/// A floor under a monitor, with or without a lid between them that nothing gets past.
Scene floor_under_monitor(bool with_lid) {
    Scene scene;
    add_square(scene, "floor", 0.5, 0, true);
    const uint32_t panel = add_square(scene, "monitor", 0.25, 1, false);
    scene.surfaces[panel].monitor = 0;
    Monitor monitor;
    monitor.name = "monitor";
    monitor.node = scene.surfaces[panel].node;
    const std::vector<Vec3>& corners = scene.surfaces[panel].positions;
    monitor.panels = {{{corners.begin(), corners.end()}}};
    monitor.reason = "built by doctor";
    scene.monitors.push_back(std::move(monitor));
    if (with_lid) add_square(scene, "lid", 2, 0.5, false);
    return scene;
}

/// Whether all texels of the floor have this visibility.
bool floor_is(float expected, bool with_lid) {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = 64;
    const Bake result = bake(floor_under_monitor(with_lid), settings, {});
    size_t covered = 0;
    for (const BakedPage& page : result.pages)
        for (size_t i = 0; i < page.state[0].pixels.size(); ++i) {
            if (page.state[0].pixels[i] != TexelState::covered) continue;
            ++covered;
            if (page.map.visibility.pixels[i].x != expected) return false;
        }
    return covered > 100;
}

/// Whether a map comes back as it was written, in the folder for temporary files.
bool files_come_back() {
    const auto path = std::filesystem::temp_directory_path() / fmt::format("surimi-doctor-{}.exr", getpid());
    VisibilityMap map;
    map.visibility = Image<Vec3f>(16, 16, Vec3f(0.25F, 0.5F, 1));
    write_map_exr(path, map);
    const VisibilityMap back = read_map_exr(path);
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    const Image<glm::u8vec4> png = decode_image(encode_map_png(map), "doctor.png");
    return back.visibility.pixels == map.visibility.pixels && png.pixels.front() == glm::u8vec4(137, 188, 255, 255);
}

struct Check {
    const char* what;
    std::function<bool()> holds;
};

double gibibytes(long pages) {
    return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1073741824;
}

int examine(bool as_json) {
    const std::vector<std::string> sets = instruction_sets();
    const nlohmann::ordered_json machine{{"surimi", SURIMI_VERSION},
                                         {"compiler", __VERSION__},
                                         {"tracing", tracing_library()},
                                         {"images", image_library()},
                                         {"instructionSet", sets.empty() ? "none" : sets.front()},
                                         {"threads", thread_count()},
                                         {"memoryGiB", std::round(10 * gibibytes(sysconf(_SC_PHYS_PAGES))) / 10},
                                         {"freeGiB", std::round(10 * gibibytes(sysconf(_SC_AVPHYS_PAGES))) / 10}};
    const std::vector<Check> checks{{"a floor in full light is exactly 1", [] { return floor_is(1, false); }},
                                    {"a floor under a lid is exactly 0", [] { return floor_is(0, true); }},
                                    {"maps are written and read back", files_come_back}};
    nlohmann::ordered_json report{{"machine", machine}, {"checks", nlohmann::ordered_json::array()}};
    if (!as_json)
        for (const auto& [key, value] : machine.items())
            fmt::print("{:16} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
    size_t failures = 0;
    for (const Check& check : checks) {
        std::string result;
        try {
            result = check.holds() ? "ok" : "FAILED";
        } catch (const std::exception& error) {
            result = std::string("FAILED: ") + error.what();
        }
        failures += result != "ok";
        report["checks"].push_back({{"check", check.what}, {"result", result}});
        if (!as_json) fmt::print("{:40} {}\n", check.what, result);
    }
    if (as_json) fmt::print("{}\n", report.dump(2));
    if (failures > 0)
        throw Error(ErrorKind::internal,
                    "what fails here fails in a bake, too; reinstall Surimi and the libraries named above, and report "
                    "it with these lines if it stays");
    return 0;
}

}  // namespace

Run add_doctor_command(CLI::App& app) {
    const auto as_json = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("doctor", "Whether Surimi works on this machine, and with what");
    command->add_flag("--json", *as_json, "Print it as JSON");
    return [as_json] { return examine(*as_json); };
}

}  // namespace surimi
