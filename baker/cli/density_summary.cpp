// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/density_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace surimi {
namespace {

const char* reason(DensityCause cause) {
    switch (cause) {
        case DensityCause::unreached:
            return "no monitor faces or reaches them";
        case DensityCause::far:
            return "far from every monitor";
        case DensityCause::texel_scale:
            return "texel_scale";
        case DensityCause::full_page:
            return "their surface alone fills a map";
    }
    return "";
}

std::string counted(size_t count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace

void print_density_weights(const Atlas& atlas) {
    for (const DensityCause cause :
         {DensityCause::unreached, DensityCause::far, DensityCause::texel_scale, DensityCause::full_page}) {
        size_t surfaces = 0;
        DensityWeight sum{0, cause, 0, 0, 0, 0, INFINITY, 0};
        for (const DensityWeight& weight : atlas.weights) {
            if (weight.cause != cause) continue;
            ++surfaces;
            sum.charts += weight.charts;
            sum.area += weight.area;
            sum.texel_share += weight.texel_share;
            sum.least = std::min(sum.least, weight.least);
            sum.most = std::max(sum.most, weight.most);
        }
        if (surfaces == 0) continue;
        std::string range = fmt::format("{:.3g}", sum.least);
        if (sum.most > sum.least) range += fmt::format(" to {:.3g}", sum.most);
        fmt::print(stderr, "note: {} of {}, {:.4g} m2, have {} of the density ({}) and {:.2g} % of the texels\n",
                   counted(sum.charts, "chart"), counted(surfaces, "surface"), sum.area, range, reason(cause),
                   100 * sum.texel_share);
    }
}

}  // namespace surimi
