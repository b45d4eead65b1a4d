// SPDX-License-Identifier: Apache-2.0
#include "runtime/map/visibility_map.h"

#include "runtime/base/bilinear.h"

namespace surimi {

Vec3 look_up(const VisibilityMap& map, const Vec2& uv) {
    return look_up_bilinear(map.visibility, uv);
}

}  // namespace surimi
