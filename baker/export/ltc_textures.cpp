// SPDX-License-Identifier: Apache-2.0
#include "baker/export/ltc_textures.h"

#include <array>

#include "runtime/ltc/table.h"

namespace surimi {
namespace {

template <class NumbersOf>
Channels texture_of(const NumbersOf& numbers_of) {
    Channels texture{ltc_size, ltc_size, {"R", "G", "B", "A"}, {}};
    for (int row = 0; row < ltc_size; ++row)
        for (int column = 0; column < ltc_size; ++column) {
            const std::array<double, 4> numbers = numbers_of(ltc_cell(column, row));
            for (const double number : numbers) texture.values.push_back(static_cast<float>(number));
        }
    return texture;
}

std::array<double, 4> numbers_of_shape(const LobeShape& shape) {
    return {shape.along, shape.lift, shape.skew, shape.depth};
}

}  // namespace

Channels full_lobe_texture() {
    return texture_of([](const LtcCell& cell) { return numbers_of_shape(cell.full); });
}

Channels schlick_lobe_texture() {
    return texture_of([](const LtcCell& cell) { return numbers_of_shape(cell.schlick); });
}

Channels albedo_texture() {
    return texture_of([](const LtcCell& cell) { return std::array{cell.albedo, cell.fresnel_root, 0.0, 0.0}; });
}

}  // namespace surimi
