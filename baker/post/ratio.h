// SPDX-License-Identifier: Apache-2.0
// Irradiance estimates -> visibility of one channel.
#pragma once

#include <vector>

#include "baker/gather/gather.h"
#include "baker/post/channel.h"

namespace surimi {

/// V = S / E (M3) where E > 0; other texels are unlit or inside, those without a surface empty.
Channel visibility_channel(const Texels& texels, const std::vector<IrradianceEstimate>& estimates);

}  // namespace surimi
