// SPDX-License-Identifier: Apache-2.0
// Names that a user writes -> the nodes that are meant.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/scene/scene.h"

namespace surimi {

/// Does `text` match the shell glob `pattern` (* and ?)?
bool matches_glob(const std::string& pattern, const std::string& text);

/// Indices of the shown scene's nodes that have this name; only where none has, of those that match it as a glob: a
/// node that is called "a*" is meant literally.
std::vector<size_t> matching_nodes(const Scene& scene, const std::string& name);

/// The name of the shown scene's node with the fewest edits from `name`, for messages; empty without nodes.
std::string nearest_node_name(const Scene& scene, const std::string& name);

}  // namespace surimi
