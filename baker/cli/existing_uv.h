// SPDX-License-Identifier: Apache-2.0
// Existing UVs as the user meets them: which were taken and why, and a picture of those that are unfit.
#pragma once

#include <filesystem>
#include <functional>

#include "baker/unwrap/unwrap.h"

namespace surimi {

/// Calls `work`, which unwraps the scene with these settings. When it throws Error(scene) because the existing UVs are
/// unfit, writes `folder`/NAME.uv-faults.png, NAME being the scene file's stem, and throws the error on with the
/// picture's name.
void with_picture_of_faults(const Scene& scene, const UnwrapSettings& settings, const std::filesystem::path& folder,
                            const std::function<void()>& work);

/// Says on stderr which UVs were taken, and why, where that was a choice.
void print_uv_choice(const Atlas& atlas);

}  // namespace surimi
