// SPDX-License-Identifier: Apache-2.0
#include "baker/export/lobe_tables.h"

#include <array>
#include <bit>

#include "runtime/ltc/table.h"

namespace surimi {
namespace {

void append(std::vector<uint8_t>& bytes, double value) {
    const auto bits = std::bit_cast<uint32_t>(static_cast<float>(value));
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<uint8_t>(bits >> shift));
}

template <class NumbersOf>
void append_table(std::vector<uint8_t>& bytes, const NumbersOf& numbers_of) {
    for (int row = 0; row < ltc_size; ++row)
        for (int column = 0; column < ltc_size; ++column) {
            const std::array<double, 4> numbers = numbers_of(ltc_cell(column, row));
            for (const double number : numbers) append(bytes, number);
        }
}

std::array<double, 4> numbers_of_shape(const LobeShape& shape) {
    return {shape.along, shape.lift, shape.skew, shape.depth};
}

}  // namespace

std::vector<uint8_t> lobe_tables() {
    std::vector<uint8_t> bytes;
    append_table(bytes, [](const LtcCell& cell) { return numbers_of_shape(cell.full); });
    append_table(bytes, [](const LtcCell& cell) { return numbers_of_shape(cell.schlick); });
    append_table(bytes, [](const LtcCell& cell) { return std::array{cell.albedo, cell.fresnel_root, 0.0, 0.0}; });
    return bytes;
}

}  // namespace surimi
