// SPDX-License-Identifier: Apache-2.0
// Times in the unit that suits them.
#pragma once

#include <string>

namespace surimi {

/// "3.2 µs", "14 s": two significant digits from nanoseconds to seconds; "0 s" for nothing.
std::string in_time_unit(double seconds);

}  // namespace surimi
