// SPDX-License-Identifier: Apache-2.0
// Makes runtime/ltc/table_data.inc: fits every cell of the table of lobes, in a few minutes on one core.
#include <cstdio>
#include <string>
#include <vector>

#include "runtime/ltc/fit/fit_cell.h"
#include "runtime/ltc/table.h"

namespace {

using namespace surimi;

/// A float literal that reads back as the same float.
std::string literal(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(static_cast<float>(value)));
    std::string result = text;
    if (result.find_first_of(".e") == std::string::npos) result += '.';
    return result + 'f';
}

std::string line_of(const LtcCell& cell) {
    std::string line = "{";
    for (const double value : {cell.shape.along, cell.shape.lift, cell.shape.skew, cell.shape.depth, cell.albedo})
        line += literal(value) + ',';
    return line + literal(cell.fresnel_root) + "},";
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: fit_ltc_table OUTPUT\n", stderr);
        return 2;
    }
    std::FILE* out = std::fopen(argv[1], "w");
    if (!out) {
        std::fprintf(stderr, "cannot write %s\n", argv[1]);
        return 6;
    }
    const FitSettings settings;
    std::fprintf(out,
                 "// Written by fit_ltc_table (runtime/ltc/fit): %d x %d cells, %d x %d + %d^2 nodes, stiffness %g.\n",
                 ltc_size, ltc_size, settings.around, settings.along, settings.bands, settings.stiffness);
    // Down the rows and from rough to smooth: every cell starts from the one above and from the rougher one.
    std::vector<LobeShape> above(ltc_size);
    for (int row = 0; row < ltc_size; ++row) {
        std::string line;
        for (int column = ltc_size - 1; column >= 0; --column) {
            const FitCell cell(ltc_column_alpha(column), ltc_row_cosine(row), settings);
            LobeShape& best = above[static_cast<size_t>(column)];
            best = cell.fit(best, best);
            if (column + 1 < ltc_size) {
                const LobeShape& rougher = above[static_cast<size_t>(column + 1)];
                const LobeShape other = cell.fit(rougher, rougher);
                if (cell.error(other).objective < cell.error(best).objective) best = other;
            }
            const GgxAlbedo albedo = cell.albedo;
            line = line_of({best, albedo.full, std::pow(albedo.fresnel / albedo.full, 0.2)}) + line;
        }
        std::fprintf(out, "%s\n", line.c_str());
        std::fprintf(stderr, "row %d of %d\n", row + 1, ltc_size);
    }
    return std::fclose(out) == 0 ? 0 : 6;
}
