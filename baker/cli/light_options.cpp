// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/light_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "baker/cli/colors.h"
#include "baker/cli/numbers.h"
#include "runtime/base/error.h"
#include "runtime/material/emission.h"

namespace surimi {
namespace {

struct Assignment {
    size_t monitor;
    std::string value;
};

/// NODE=VALUE; a node's name may hold an equals sign, so the last one counts.
Assignment parse_assignment(const Scene& scene, const std::string& text, const char* option) {
    const size_t equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0)
        throw Error(ErrorKind::usage, fmt::format("{} takes NODE=VALUE, not \"{}\"", option, text));
    const std::string name = text.substr(0, equals);
    for (size_t m = 0; m < scene.monitors.size(); ++m)
        if (scene.monitors[m].name == name) return {m, text.substr(equals + 1)};
    std::string names;
    for (const Monitor& monitor : scene.monitors) names += " " + monitor.name;
    throw Error(ErrorKind::usage, fmt::format("{}: no monitor is called \"{}\"; the scene has{}", option, name,
                                              names.empty() ? " none" : names));
}

Vec3 parse_color(const std::string& text) {
    std::istringstream stream(text);
    std::vector<double> numbers;
    for (std::string item; std::getline(stream, item, ',');) numbers.push_back(parse_number(item, "--light"));
    if (numbers.size() == 1) numbers.assign(3, numbers[0]);
    if (numbers.size() != 3 || std::any_of(numbers.begin(), numbers.end(), [](double x) { return x < 0; }))
        throw Error(ErrorKind::usage,
                    "--light takes NODE=R,G,B or NODE=GREY, linear and at least 0, not \"" + text + "\"");
    return {numbers[0], numbers[1], numbers[2]};
}

/// Light is not negative, and what is no number is none.
Image<Vec3f> read_picture(const std::string& file) {
    Image<Vec3f> image = read_colors(file);
    for (Vec3f& p : image.pixels)
        for (int c = 0; c < 3; ++c) p[c] = p[c] > 0 ? p[c] : 0.0f;
    return image;
}

}  // namespace

std::vector<LitMonitor> chosen_lights(const Scene& scene, const std::vector<std::string>& lights,
                                      const std::vector<std::string>& pictures) {
    std::vector<LitMonitor> chosen = lit_monitors(scene);
    for (const std::string& text : lights) {
        const Assignment light = parse_assignment(scene, text, "--light");
        chosen[light.monitor].radiance = parse_color(light.value);
    }
    for (const std::string& text : pictures) {
        const Assignment picture = parse_assignment(scene, text, "--picture");
        chosen[picture.monitor].picture = MonitorPicture{blurred_levels(read_picture(picture.value)),
                                                         upright_mappings(scene.monitors[picture.monitor])};
    }
    return chosen;
}

}  // namespace surimi
