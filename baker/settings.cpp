// SPDX-License-Identifier: Apache-2.0
#include "baker/settings.h"

#include <algorithm>
#include <array>

#include "runtime/base/error.h"

namespace surimi {

std::span<const Fix> fixes() {
    static constexpr std::array all{
        Fix{"covers", "what lies flat on a monitor does not block it",
            [](BakeSettings& s) -> bool& { return s.gather.clears_covers; }},
        Fix{"inside", "what lies inside other geometry is left out of texels",
            [](BakeSettings& s) -> bool& { return s.finds_inside; }},
        Fix{"terminator", "coarse smooth surfaces do not shadow themselves",
            [](BakeSettings& s) -> bool& { return s.gather.lifts_smooth; }},
        Fix{"fill", "texels without light take values from around them in space, not from their chart alone",
            [](BakeSettings& s) -> bool& { return s.post.fills_in_space; }},
        Fix{"seams", "both sides of every seam are made to agree",
            [](BakeSettings& s) -> bool& { return s.post.stitches_seams; }}};
    return all;
}

const Fix& fix_named(const std::string& name, const std::string& source) {
    std::string names;
    for (const Fix& fix : fixes()) {
        if (name == fix.name) return fix;
        names += (names.empty() ? "" : ", ") + std::string(fix.name);
    }
    throw Error(ErrorKind::usage, source + ": there is no fix \"" + name + "\" to do without; there are " + names);
}

}  // namespace surimi
