// SPDX-License-Identifier: Apache-2.0
#include "baker/study/units.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace surimi {

std::string in_time_unit(double seconds) {
    if (!(seconds > 0)) return "0 s";
    constexpr std::array<std::pair<double, const char*>, 4> units = {
        {{1, "s"}, {1e-3, "ms"}, {1e-6, "µs"}, {1e-9, "ns"}}};
    auto unit = units.begin();
    while (unit + 1 != units.end() && seconds < 0.9995 * unit->first) ++unit;
    const double value = seconds / unit->first;
    return fmt::format("{:.{}f} {}", value, value < 9.95 ? 1 : 0, unit->second);
}

}  // namespace surimi
