// SPDX-License-Identifier: Apache-2.0
// Makes runtime/ltc/table_data.inc: fits every cell of the table of lobes, in a few minutes on two cores.
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "runtime/base/parallel.h"
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

std::string text_of(const LtcCell& cell) {
    std::string text = "{";
    for (const LobeShape& shape : {cell.full, cell.schlick})
        for (const double value : {shape.along, shape.lift, shape.skew, shape.depth}) text += literal(value) + ',';
    return text + literal(cell.albedo) + ',' + literal(cell.fresnel_root) + "},";
}

/// The better of the fits from several starts, each drawn towards where it started.
LobeShape best_fit(const FitCell& cell, const std::vector<LobeShape>& starts) {
    LobeShape best = cell.fit(starts.front(), starts.front());
    for (size_t i = 1; i < starts.size(); ++i) {
        const LobeShape other = cell.fit(starts[i], starts[i]);
        if (cell.error(other).objective < cell.error(best).objective) best = other;
    }
    return best;
}

size_t index_of(int column, int row) {
    return static_cast<size_t>(row * ltc_size + column);
}

/// Row by row in the given order, each from rough to smooth: every cell starts from the one of the row before and from
/// the rougher one.
template <class Settings>
std::vector<LobeShape> fit_part(LobePart part, const std::vector<int>& rows, const Settings& settings_of) {
    std::vector<LobeShape> shapes(ltc_size * ltc_size);
    for (size_t i = 0; i < rows.size(); ++i) {
        for (int column = ltc_size - 1; column >= 0; --column) {
            std::vector<LobeShape> starts;
            starts.push_back(i > 0 ? shapes[index_of(column, rows[i - 1])] : LobeShape{});
            if (column + 1 < ltc_size) starts.push_back(shapes[index_of(column + 1, rows[i])]);
            const double alpha = ltc_column_alpha(column), cosine = ltc_row_cosine(rows[i]);
            const FitCell cell(alpha, cosine, settings_of(ggx_albedo(alpha, cosine)), part);
            shapes[index_of(column, rows[i])] = best_fit(cell, starts);
        }
        std::fprintf(stderr, "%s: row %zu of %zu\n", part == LobePart::full ? "full" : "schlick", i + 1, rows.size());
    }
    return shapes;
}

std::vector<LobeShape> fit_full(const FitSettings& settings) {
    std::vector<int> rows(ltc_size);
    std::iota(rows.begin(), rows.end(), 0);
    return fit_part(LobePart::full, rows, [&](const GgxAlbedo&) { return settings; });
}

/// From grazing views, where this part decides what is seen, to steep ones, where it vanishes: there it is a ring that
/// no lobe fits, and the shape stays what it was. Beside a dielectric's F0 of 0.04 an albedo of 0.004 is a tenth.
std::vector<LobeShape> fit_schlick(const FitSettings& settings) {
    std::vector<int> rows(ltc_size);
    std::iota(rows.rbegin(), rows.rend(), 0);
    return fit_part(LobePart::schlick, rows, [&](const GgxAlbedo& albedo) {
        FitSettings own = settings;
        const double unimportance = 0.004 * albedo.full / (albedo.fresnel + 0.004 * albedo.full);
        own.stiffness += std::pow(unimportance, 4);
        return own;
    });
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: fit_ltc_table OUTPUT\n", stderr);
        return 2;
    }
    const FitSettings settings;
    std::vector<LobeShape> full, schlick;
    parallel_for(2, 1, [&](size_t part) {
        if (part == 0) full = fit_full(settings);
        if (part == 1) schlick = fit_schlick(settings);
    });
    std::FILE* out = std::fopen(argv[1], "w");
    if (!out) {
        std::fprintf(stderr, "cannot write %s\n", argv[1]);
        return 6;
    }
    std::fprintf(out,
                 "// Written by fit_ltc_table (runtime/ltc/fit): %d x %d cells, %d x %d + %d^2 nodes, stiffness %g.\n",
                 ltc_size, ltc_size, settings.around, settings.along, settings.bands, settings.stiffness);
    for (int row = 0; row < ltc_size; ++row) {
        for (int column = 0; column < ltc_size; ++column) {
            const size_t i = index_of(column, row);
            const GgxAlbedo albedo = ggx_albedo(ltc_column_alpha(column), ltc_row_cosine(row));
            const double root = std::pow(albedo.fresnel / albedo.full, 0.2);
            std::fprintf(out, "%s", text_of({full[i], schlick[i], albedo.full, root}).c_str());
        }
        std::fprintf(out, "\n");
    }
    return std::fclose(out) == 0 ? 0 : 6;
}
