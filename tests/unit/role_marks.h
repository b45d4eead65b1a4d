// SPDX-License-Identifier: Apache-2.0
// What is said of one role.
#pragma once

#include "runtime/scene/scene.h"

namespace surimi::test {

inline RoleMarks casts(bool value) {
    return {value, {}, {}, {}};
}

inline RoleMarks receives(bool value) {
    return {{}, value, {}, {}};
}

inline RoleMarks two_sided(bool value) {
    return {{}, {}, value, {}};
}

inline RoleMarks exclude(bool value) {
    return {{}, {}, {}, value};
}

}  // namespace surimi::test
