// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/downsample.h"

#include <algorithm>
#include <cmath>

namespace surimi {

IrradianceEstimate average(std::span<const IrradianceEstimate> subtexels, std::span<const double> areas) {
    const bool has_area = std::ranges::any_of(areas, [](double area) { return area > 0; });
    IrradianceEstimate result;
    double whole = 0, unshadowed = 0, shadowed = 0, squares = 0;
    for (size_t i = 0; i < subtexels.size(); ++i) {
        const double area = has_area ? areas[i] : 1;
        if (!(area > 0)) continue;
        const IrradianceEstimate& e = subtexels[i];
        whole += area;
        unshadowed += area * static_cast<double>(e.unshadowed);
        shadowed += area * static_cast<double>(e.shadowed);
        const double error = area * static_cast<double>(e.unshadowed) * static_cast<double>(e.error);
        squares += error * error;
        result.method = std::max(result.method, e.method);
    }
    if (!(unshadowed > 0)) return {};
    result.unshadowed = static_cast<float>(unshadowed / whole);
    result.shadowed = static_cast<float>(shadowed / whole);
    result.error = static_cast<float>(std::sqrt(squares) / unshadowed);
    return result;
}

std::vector<IrradianceEstimate> downsample(const Receivers& receivers, const Texels& texels,
                                           std::span<const IrradianceEstimate> estimates) {
    const Texels& subtexels = receivers.texels;
    const auto width = static_cast<uint32_t>(texels.width), fine_width = static_cast<uint32_t>(subtexels.width);
    const uint32_t factor = fine_width / width;
    std::vector<IrradianceEstimate> result(texels.texels.size());
    parallel_for(result.size(), 256, [&](size_t i) {
        const uint32_t index = texels.texels[i].index;
        std::array<IrradianceEstimate, most_subdivided * most_subdivided> parts;
        std::array<double, most_subdivided * most_subdivided> areas;
        size_t count = 0;
        for (uint32_t y = 0; y < factor; ++y) {
            const uint32_t begin = (index / width * factor + y) * fine_width + index % width * factor;
            const auto first = std::ranges::lower_bound(subtexels.texels, begin, {}, &Texel::index);
            for (auto sub = first; sub != subtexels.texels.end() && sub->index - begin < factor; ++sub) {
                parts[count] = estimates[static_cast<size_t>(sub - subtexels.texels.begin())];
                areas[count++] = exposed_area(receivers, *sub);
            }
        }
        result[i] = average({parts.data(), count}, {areas.data(), count});
    });
    return result;
}

}  // namespace surimi
