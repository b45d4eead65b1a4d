// SPDX-License-Identifier: Apache-2.0
// Draws docs/ltc-fit.svg: how far our table of lobes is from GGX, cell by cell, beside the published one. Prints the
// same numbers as Markdown. Usage: fit_report OUTPUT.svg
#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <string>

#include "runtime/ltc/fit/fit_cell.h"
#include "runtime/ltc/table.h"
#include "tests/support/published_fit.h"

namespace {

using namespace surimi;
using Grid = std::array<std::array<double, 8>, 8>;  ///< rows of view angles, columns of roughness

Grid our_total_variation() {
    Grid grid{};
    for (size_t i = 0; i < 8; ++i)
        for (size_t j = 0; j < 8; ++j) {
            const int column = test::compared_columns[j], row = test::compared_rows[i];
            const FitCell cell(ltc_column_alpha(column), ltc_row_cosine(row), {});
            grid[i][j] = cell.error(ltc_cell(column, row).full).total_variation;
        }
    return grid;
}

std::string formatted(const char* format, ...) __attribute__((format(printf, 1, 2)));

std::string formatted(const char* format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

/// Three decimals without the zero before the point; those of the published table's last row have two.
std::string number(double value, bool is_rounded) {
    const std::string text = formatted(is_rounded ? "%.2f" : "%.3f", value);
    return text[0] == '0' ? text.substr(1) : text;
}

struct Panel {
    const char* title;
    Grid grid;
    bool is_last_row_rounded;
    std::string number_at(size_t i, size_t j) const { return number(grid[i][j], i == 7 && is_last_row_rounded); }
};

double degrees_of(int row) {
    const double cosine = ltc_row_cosine(row);
    return std::atan2(std::sqrt((1 - cosine) * (1 + cosine)), cosine) * 180 / pi;
}

constexpr double greatest = 0.75;  ///< end of the colour scale

/// White to dark blue, even in the root of the value, because the cells go from 0.0001 to 0.75.
Vec3 color_of(double value) {
    const double t = std::sqrt(std::clamp(value / greatest, 0.0, 1.0));
    const Vec3 white(255, 255, 255), middle(86, 150, 200), dark(8, 38, 92);
    return t < 0.5 ? glm::mix(white, middle, 2 * t) : glm::mix(middle, dark, 2 * t - 1);
}

struct Drawing {
    std::string text;

    void box(double x, double y, double width, double height, double value) {
        const Vec3 c = color_of(value);
        text += formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"rgb(%.0f,%.0f,%.0f)\"/>\n",
                          x, y, width, height, c.x, c.y, c.z);
    }
    /// `anchor` is start, middle or end; y that of the base line.
    void words(double x, double y, int size, const char* anchor, const std::string& content, bool is_light = false) {
        text += formatted("<text x=\"%.1f\" y=\"%.1f\" font-size=\"%d\" text-anchor=\"%s\" fill=\"%s\">", x, y, size,
                          anchor, is_light ? "#fff" : "#1a1a1a") +
                content + "</text>\n";
    }
};

constexpr double cell_width = 50, cell_height = 36;
constexpr double readable = 0.27;  ///< above it white text has more contrast than black

void draw_panel(Drawing& drawing, double left, double top, const Panel& panel) {
    drawing.words(left, top - 14, 15, "start", panel.title);
    drawing.words(left - 8, top - 14, 12, "end", "view angle");
    drawing.words(left + 4 * cell_width, top + 8 * cell_height + 40, 13, "middle", "roughness (square root of alpha)");
    // Grey shows between the cells, because the best are white.
    drawing.text += formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#c8c8c8\"/>\n",
                              left - 1, top - 1, 8 * cell_width + 1, 8 * cell_height + 1);
    for (size_t i = 0; i < 8; ++i) {
        const double y = top + static_cast<double>(i) * cell_height;
        drawing.words(left - 8, y + cell_height / 2 + 5, 12, "end",
                      formatted(i == 7 ? "%.2f°" : "%.0f°", degrees_of(test::compared_rows[i])));
        for (size_t j = 0; j < 8; ++j) {
            const double x = left + static_cast<double>(j) * cell_width, value = panel.grid[i][j];
            drawing.box(x, y, cell_width - 1, cell_height - 1, value);
            drawing.words(x + cell_width / 2, y + cell_height / 2 + 5, 13, "middle", panel.number_at(i, j),
                          value > readable);
        }
    }
    for (size_t j = 0; j < 8; ++j)
        drawing.words(left + (static_cast<double>(j) + 0.5) * cell_width, top + 8 * cell_height + 18, 12, "middle",
                      formatted("%.2f", test::compared_columns[j] / 63.0));
}

void draw_scale(Drawing& drawing, double left, double top) {
    constexpr int steps = 100;
    constexpr double length = 400;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        drawing.box(left + i * length / steps, top, length / steps + 0.5, 14, t * t * greatest);
    }
    for (const double value : {0.0, 0.01, 0.05, 0.15, 0.35, 0.75}) {
        const double x = left + length * std::sqrt(value / greatest);
        drawing.text += formatted("<path d=\"M%.1f %.1fv5\" stroke=\"#1a1a1a\"/>\n", x, top + 14);
        drawing.words(x, top + 32, 12, "middle", formatted("%g", value));
    }
    drawing.words(left + length + 24, top + 12, 12, "start",
                  "total variation: half the integral of |lobe - GGX|, both of integral 1;");
    drawing.words(left + length + 24, top + 29, 12, "start", "it bounds the error of any light's specular share");
}

std::string drawing_of(const Panel& ours, const Panel& published) {
    Drawing drawing;
    drawing.text =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1020 486\" width=\"1020\" height=\"486\" "
        "font-family=\"DejaVu Sans, Verdana, sans-serif\">\n"
        "<title>Distance of fitted lobes from GGX</title>\n<rect width=\"1020\" height=\"486\" fill=\"#fff\"/>\n";
    constexpr double top = 60, left = 96, right = 588;
    draw_panel(drawing, left, top, ours);
    draw_panel(drawing, right, top, published);
    draw_scale(drawing, left, top + 8 * cell_height + 74);
    drawing.words(left, 474, 11, "start",
                  "Drawn by tests/bench/fit_report.cpp. The published table was measured by the project; its last row "
                  "was fitted at 89.95°.");
    return drawing.text + "</svg>\n";
}

void print(const Panel& panel) {
    std::printf("| %s: view, roughness |", panel.title);
    for (const int column : test::compared_columns) std::printf(" %.2f |", column / 63.0);
    std::puts("\n|---|---|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < 8; ++i) {
        std::printf("| %.2f deg |", degrees_of(test::compared_rows[i]));
        for (size_t j = 0; j < 8; ++j) std::printf(" %s |", panel.number_at(i, j).c_str());
        std::puts("");
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: fit_report OUTPUT.svg\n", stderr);
        return 2;
    }
    const Panel ours{"Surimi's table", our_total_variation(), false};
    const Panel published{"Published table (Heitz, Dupuy, Hill, Neubelt 2016)", test::published_total_variation, true};
    print(ours);
    print(published);
    const std::string drawing = drawing_of(ours, published);
    std::FILE* out = std::fopen(argv[1], "w");
    const bool is_written = out && std::fwrite(drawing.data(), 1, drawing.size(), out) == drawing.size();
    if (!out || std::fclose(out) != 0 || !is_written) {
        std::fprintf(stderr, "cannot write %s\n", argv[1]);
        return 6;
    }
}
