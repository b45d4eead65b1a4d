// SPDX-License-Identifier: Apache-2.0
// All that decides a bake, and the fixes that it can do without.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "baker/gather/settings.h"
#include "baker/post/settings.h"
#include "baker/unwrap/unwrap.h"

namespace surimi {

struct BakeSettings {
    UnwrapSettings unwrap;
    bool finds_inside = true;  ///< texels inside other geometry are found and filled instead of lit
    GatherSettings gather;
    PostSettings post;
    size_t audit = 0;   ///< texels of each monitor to check against many rays; 0: none
    size_t memory = 0;  ///< bytes that the process may take, files included; 0: no bound
};

/// The remedy for one artefact. All are on unless the user turns them off.
struct Fix {
    const char* name;  ///< as people write it
    const char* what;  ///< it does, in a few words
    bool& (*in)(BakeSettings&);
};

/// In the order in which a bake applies them.
std::span<const Fix> fixes();

/// Throws Error(usage), starting with `source`, for a name that is no fix's.
const Fix& fix_named(const std::string& name, const std::string& source);

}  // namespace surimi
