// SPDX-License-Identifier: Apache-2.0
// Times in the unit that suits them.
#pragma once

#include <string>

namespace surimi {

struct TimeUnit {
    double seconds = 1;
    const char* name = "s";
};

/// The largest of s, ms, µs, ns of which there is one or more; ns for less.
TimeUnit time_unit(double seconds);

/// "3.2 µs", "14 s": two significant digits from nanoseconds to seconds; "0 s" for nothing.
std::string in_time_unit(double seconds);

}  // namespace surimi
