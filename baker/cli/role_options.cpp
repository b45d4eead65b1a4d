// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/role_options.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "baker/cli/config_file.h"
#include "runtime/base/error.h"

namespace surimi {

Glass parse_glass(const std::string& text, const std::string& source) {
    for (const Glass glass : {Glass::block, Glass::clear})
        if (text == name_of(glass)) return glass;
    throw Error(ErrorKind::usage, fmt::format("{}: glass must be block or clear, not \"{}\"; did you mean \"{}\"?",
                                              source, text, nearest(text, {"block", "clear"})));
}

std::string name_of(Glass glass) {
    return glass == Glass::block ? "block" : "clear";
}

std::string objects_toml(const RoleSettings& settings) {
    std::string text;
    for (const ObjectRoles& object : settings.objects) {
        text += fmt::format("\n[[object]]\nnode = {}\n", nlohmann::json(object.node).dump());  // also TOML
        visit_marks(object.roles, [&](const char* key, const std::optional<bool>& mark) {
            if (mark) text += fmt::format("{} = {}\n", key, *mark);
        });
    }
    return text;
}

void add_objects_json(const RoleSettings& settings, nlohmann::ordered_json& json) {
    for (const ObjectRoles& object : settings.objects) {
        nlohmann::ordered_json& item = json["object"].emplace_back();
        item["node"] = object.node;
        visit_marks(object.roles, [&](const char* key, const std::optional<bool>& mark) {
            if (mark) item[key] = *mark;
        });
    }
}

}  // namespace surimi
