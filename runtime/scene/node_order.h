// SPDX-License-Identifier: Apache-2.0
// The order in which what nodes hand down reaches everyone in one pass.
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/scene/scene.h"

namespace surimi {

/// Indices of all nodes, every parent before its children.
std::vector<size_t> parents_first(const Scene& scene);

}  // namespace surimi
