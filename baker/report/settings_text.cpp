// SPDX-License-Identifier: Apache-2.0
#include "baker/report/settings_text.h"

#include <string>

#include "runtime/base/math.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

std::string dumped(const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// As one word of a POSIX shell.
std::string shell_word(const std::string& text) {
    constexpr const char* harmless = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./=,:+";
    if (!text.empty() && text.find_first_not_of(harmless) == std::string::npos) return text;
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

/// The manifest's names are those of the configuration file, but for this one; the seconds that were to be spent are
/// spent: the error that followed says what they bought.
std::string option_name(const std::string& key) {
    return key == "uvQuality" ? "uv-quality" : key;
}
bool is_result(const std::string& key) {
    return key == "time";
}

bool is_table_list(const Json& value) {
    return value.is_array() && !value.empty() && value.front().is_object();
}

std::string words_of(const std::string& key, const Json& value) {
    const std::string option = "--" + option_name(key);
    if (value.is_boolean()) return value.get<bool>() ? " " + option : "";
    if (!value.is_array())
        return " " + option + " " + shell_word(value.is_string() ? value.get<std::string>() : dumped(value));
    std::string words;
    if (key == "size") words = " " + option;
    for (const Json& item : value)
        words += key == "size" ? " " + dumped(item) : " " + option + " " + shell_word(item.get<std::string>());
    return words;
}

Vec3 vector_of(const Json& v) {
    return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

std::string rectangle_toml(const Json& corners) {
    const Vec3 first = vector_of(corners.at(0)), second = vector_of(corners.at(1)), third = vector_of(corners.at(2)),
               last = vector_of(corners.at(3));
    const auto triple = [](const Vec3& v) { return dumped(Json::array({v.x, v.y, v.z})); };
    return "  { center = " + triple((first + second + third + last) / 4.0) +
           ", half_u = " + triple((second - first) / 2.0) + ", half_v = " + triple((last - first) / 2.0) + " },\n";
}

bool has_node(const Json& monitor) {
    return monitor.contains("node") && !monitor["node"].is_null();
}

std::string monitor_toml(const Json& monitor) {
    std::string text = "\n[[monitor]]\n";
    text += (has_node(monitor) ? "node = " : "name = ") + dumped(monitor.at("name")) + "\n";
    text += "channel = " + dumped(monitor.at("channel")) + "\n";
    if (has_node(monitor)) return text;
    text += "radiance = " + dumped(monitor.at("radiance")) + "\nrectangles = [\n";
    for (const Json& panel : monitor.at("corners")) text += rectangle_toml(panel);
    return text + "]\n";
}

}  // namespace

std::string command_of(const BakeFiles& bake) {
    const std::string file = bake.manifest.at("scene").at("file").get<std::string>();
    std::string command = "surimi bake " + shell_word(file);
    bool needs_file = false;
    for (const Json& monitor : bake.manifest.at("monitors")) {
        needs_file = needs_file || !has_node(monitor);
        if (has_node(monitor))
            command += " --monitor " + shell_word(monitor.at("name").get<std::string>() + "=" +
                                                  monitor.at("channel").get<std::string>());
    }
    for (const auto& [key, value] : bake.manifest.at("settings").items()) {
        needs_file = needs_file || is_table_list(value);
        if (!is_result(key) && !is_table_list(value)) command += words_of(key, value);
    }
    return needs_file ? "surimi bake " + shell_word(file) + " --config " + shell_word(bake.name + ".surimi.toml")
                      : command;
}

std::string toml_of(const BakeFiles& bake) {
    std::string text, tables;
    for (const auto& [key, value] : bake.manifest.at("settings").items()) {
        if (is_result(key)) continue;
        if (!is_table_list(value)) {
            text += option_name(key) + " = " + dumped(value) + "\n";
            continue;
        }
        for (const Json& table : value) {
            tables += "\n[[" + key + "]]\n";
            for (const auto& [name, member] : table.items()) tables += name + " = " + dumped(member) + "\n";
        }
    }
    for (const Json& monitor : bake.manifest.at("monitors")) tables += monitor_toml(monitor);
    return text + tables;
}

}  // namespace surimi
