// SPDX-License-Identifier: Apache-2.0
// Casters, receivers and glass as settings: --glass and [[object]], written as text.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "runtime/scene/roles.h"

namespace surimi {

/// "block" or "clear". Throws Error(usage), starting with `source`, for another name.
Glass parse_glass(const std::string& text, const std::string& source);
std::string name_of(Glass glass);

/// The [[object]] tables as TOML that gives the same when it is read; empty without any.
std::string objects_toml(const RoleSettings& settings);

/// Adds "object" to a JSON object, if there are any.
void add_objects_json(const RoleSettings& settings, nlohmann::ordered_json& json);

/// Calls `visit(key, mark)` for each key that an [[object]] may have besides its node.
template <class Marks, class Visit>
void visit_marks(Marks& marks, const Visit& visit) {
    visit("casts", marks.casts);
    visit("receives", marks.receives);
    visit("two_sided", marks.two_sided);
    visit("exclude", marks.exclude);
}

}  // namespace surimi
