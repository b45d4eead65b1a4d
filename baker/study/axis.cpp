// SPDX-License-Identifier: Apache-2.0
#include "baker/study/axis.h"

#include <cmath>

namespace surimi {

double LogAxis::at(double value) const {
    return first + (last - first) * std::log(value / low) / std::log(high / low);
}

LogAxis make_log_axis(double low, double high, double first, double last) {
    if (high < 10 * low) {
        const double middle = std::sqrt(low * high);
        low = middle / std::sqrt(10.0);
        high = middle * std::sqrt(10.0);
    }
    return {low, high, first, last};
}

std::vector<Tick> ticks_of(const LogAxis& axis) {
    std::vector<Tick> ticks;
    for (int decade = static_cast<int>(std::floor(std::log10(axis.low))); std::pow(10.0, decade) <= axis.high; ++decade)
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * std::pow(10.0, decade);
            if (value >= axis.low && value <= axis.high) ticks.push_back({value, digit == 1});
        }
    return ticks;
}

}  // namespace surimi
