// SPDX-License-Identifier: Apache-2.0
#include "baker/study/units.h"

#include <fmt/format.h>

#include <array>

namespace surimi {

TimeUnit time_unit(double seconds) {
    constexpr std::array<TimeUnit, 4> units = {{{1, "s"}, {1e-3, "ms"}, {1e-6, "µs"}, {1e-9, "ns"}}};
    size_t i = 0;
    while (i + 1 < units.size() && seconds < 0.9995 * units[i].seconds) ++i;
    return units[i];
}

std::string in_time_unit(double seconds) {
    if (!(seconds > 0)) return "0 s";
    const TimeUnit unit = time_unit(seconds);
    const double value = seconds / unit.seconds;
    return fmt::format("{:.{}f} {}", value, value < 9.95 ? 1 : 0, unit.name);
}

}  // namespace surimi
