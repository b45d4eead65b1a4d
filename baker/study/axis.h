// SPDX-License-Identifier: Apache-2.0
// A logarithmic axis of a plot.
#pragma once

#include <vector>

namespace surimi {

struct LogAxis {
    double low = 1, high = 10;   ///< values, 0 < low < high
    double first = 0, last = 1;  ///< where they are, pixels

    double at(double value) const;
};

/// Both ends > 0, finite; widened to a decade when closer.
LogAxis make_log_axis(double low, double high, double first, double last);

struct Tick {
    double value = 1;
    bool is_decade = true;
};

/// Powers of ten, and their multiples by 2 to 9, within the axis, in order.
std::vector<Tick> ticks_of(const LogAxis& axis);

}  // namespace surimi
