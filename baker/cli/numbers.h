// SPDX-License-Identifier: Apache-2.0
// Numbers that stand inside the values of options.
#pragma once

#include <charconv>
#include <cmath>
#include <string>

#include "runtime/base/error.h"

namespace surimi {

/// The finite number that `text` is; throws Error(usage) that names the option.
inline double parse_number(const std::string& text, const std::string& option) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        throw Error(ErrorKind::usage, option + ": \"" + text + "\" is not a number");
    return value;
}

}  // namespace surimi
