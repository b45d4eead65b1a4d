// SPDX-License-Identifier: Apache-2.0
// Is the JSON of a glTF document what it claims to be? Types, indices, node tree, required extensions.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>

namespace surimi {

/// Checks the types of all members that the core specification defines, that every index points at something,
/// that the nodes form trees, and that we can read the required extensions. Whole numbers written as 5.0
/// become 5, because tinygltf ignores them otherwise. Throws Error(scene).
void check_json(nlohmann::json& json, const std::filesystem::path& path);

}  // namespace surimi
