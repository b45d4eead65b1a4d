// SPDX-License-Identifier: Apache-2.0
// A study's numbers for programs: CSV and JSON.
#pragma once

#include <string>

#include "baker/study/study.h"

namespace surimi {

/// A header, then one row for each technique and setting: technique, setting, value, seconds_per_texel, rays_per_texel,
/// rmse, p999, largest. Text is quoted (RFC 4180), numbers have a point and no unit.
std::string to_csv(const Study& study);

/// The same, with what was measured, the recommended setting and the reading, as an object. `file_name` is the scene's.
std::string to_json(const Study& study, const std::string& file_name);

}  // namespace surimi
