// SPDX-License-Identifier: Apache-2.0
#include "baker/study/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "baker/study/axis.h"
#include "baker/study/labels.h"
#include "baker/study/reading.h"
#include "baker/study/units.h"

namespace surimi {
namespace {

constexpr double width = 960, height = 640;
constexpr Box frame{{84, 74}, {936, 540}};
constexpr double font_size = 13, letter_width = 0.6 * font_size;  // of common sans-serif faces, on average

enum class Marker { circle, square, diamond, triangle };

struct Style {
    const char* id;
    const char* color;
    const char* dash;
    Marker marker;
    double stroke;
};

// Eight colours do not do for twelve lines: what belongs together shares one, and differs in dash and marker.
constexpr std::array<Style, 12> styles = {{{"surimi", "#d55e00", "", Marker::circle, 3.5},
                                           {"scanline", "#d55e00", "7 4", Marker::square, 1.8},
                                           {"exact", "#d55e00", "2 3", Marker::diamond, 1.8},
                                           {"mc", "#d55e00", "9 3 2 3", Marker::triangle, 1.8},
                                           {"random", "#000000", "", Marker::circle, 1.8},
                                           {"stratified", "#e69f00", "", Marker::square, 1.8},
                                           {"sobol", "#0072b2", "", Marker::diamond, 1.8},
                                           {"probe", "#0072b2", "2 3", Marker::triangle, 1.8},
                                           {"closest", "#009e73", "", Marker::circle, 1.8},
                                           {"hard-grid", "#cc79a7", "", Marker::square, 1.8},
                                           {"pcf", "#3a94c4", "7 4", Marker::diamond, 1.8},
                                           {"pcss", "#3a94c4", "", Marker::triangle, 1.8}}};

const Style& style_of(const std::string& id) {
    const auto style = std::ranges::find_if(styles, [&](const Style& s) { return id == s.id; });
    return style == styles.end() ? styles[4] : *style;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '<')
            result += "&lt;";
        else if (c == '&')
            result += "&amp;";
        else if (c == '"')
            result += "&quot;";
        else if (static_cast<unsigned char>(c) >= 0x20)  // XML has no other control characters than white space
            result += c;
    }
    return result;
}

bool is_drawn(const Measurement& m) {
    return m.seconds > 0 && m.rmse > 0;
}

/// Both axes around everything that is drawn, in whole decades upwards and downwards of error.
struct Axes {
    LogAxis seconds, rmse;
    Vec2 at(double s, double r) const { return {seconds.at(s), rmse.at(r)}; }
};

Axes axes_of(const Study& study) {
    double least_seconds = INFINITY, most_seconds = 0, least_rmse = INFINITY, most_rmse = 0;
    for (const Series& series : study.series) {
        for (const Measurement& m : series.points) {
            if (!is_drawn(m)) continue;
            least_seconds = std::min(least_seconds, m.seconds);
            most_seconds = std::max(most_seconds, m.seconds);
            least_rmse = std::min(least_rmse, m.rmse);
            most_rmse = std::max(most_rmse, m.rmse);
        }
    }
    if (!(most_seconds > 0)) least_seconds = 1e-6, most_seconds = 1e-3, least_rmse = 1e-4, most_rmse = 0.1;
    if (study.reference_error > 0) least_rmse = std::min(least_rmse, study.reference_error);
    return {make_log_axis(least_seconds / 1.5, most_seconds * 1.5, frame.low.x, frame.high.x),
            make_log_axis(least_rmse / 2.2, most_rmse * 1.4, frame.high.y, frame.low.y)};
}

std::string text_at(const Vec2& place, const std::string& attributes, const std::string& text) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", place.x, place.y, attributes, escaped(text));
}

std::string line(const Vec2& a, const Vec2& b, const std::string& attributes) {
    return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" {}/>\n", a.x, a.y, b.x, b.y, attributes);
}

std::string grid(const Axes& axes) {
    std::string svg;
    for (const Tick& tick : ticks_of(axes.seconds)) {
        const double x = axes.seconds.at(tick.value);
        svg += line({x, frame.low.y}, {x, frame.high.y}, tick.is_decade ? "stroke=\"#ccc\"" : "stroke=\"#eee\"");
        svg += line({x, frame.high.y}, {x, frame.high.y + (tick.is_decade ? 7 : 4)}, "stroke=\"#444\"");
        if (tick.is_decade)
            svg +=
                text_at({x, frame.high.y + 22}, "text-anchor=\"middle\"",
                        fmt::format("{:g} {}", tick.value / time_unit(tick.value).seconds, time_unit(tick.value).name));
    }
    for (const Tick& tick : ticks_of(axes.rmse)) {
        const double y = axes.rmse.at(tick.value);
        svg += line({frame.low.x, y}, {frame.high.x, y}, tick.is_decade ? "stroke=\"#ccc\"" : "stroke=\"#eee\"");
        svg += line({frame.low.x - (tick.is_decade ? 7 : 4), y}, {frame.low.x, y}, "stroke=\"#444\"");
        if (tick.is_decade)
            svg += text_at({frame.low.x - 11, y + 4.5}, "text-anchor=\"end\"", fmt::format("{:g}", tick.value));
    }
    return svg + fmt::format("<path d=\"M{0} {1}V{3}H{2}\" fill=\"none\" stroke=\"#444\"/>\n", frame.low.x, frame.low.y,
                             frame.high.x, frame.high.y);
}

struct Level {
    double rmse = 0;
    std::string text;
};

/// The levels that lie within the axes.
std::vector<Level> levels_of(const Study& study, const Axes& axes) {
    std::vector<Level> levels = {{visible_error / 2, fmt::format("RMSE that --error {:g} promises", visible_error)},
                                 {study.reference_error, "standard error of the reference"}};
    std::erase_if(levels, [&](const Level& l) { return !(l.rmse > axes.rmse.low && l.rmse < axes.rmse.high); });
    return levels;
}

std::string marker(const Vec2& p, const Style& style, const std::string& tooltip) {
    const double r = style.stroke > 2 ? 5.5 : 4;
    std::string shape;
    switch (style.marker) {
        case Marker::circle:
            shape = fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"", p.x, p.y, r);
            break;
        case Marker::square:
            shape = fmt::format("<path d=\"M{:.1f} {:.1f}h{}v{}h{}z\"", p.x - r, p.y - r, 2 * r, 2 * r, -2 * r);
            break;
        case Marker::diamond:
            shape = fmt::format("<path d=\"M{:.1f} {:.1f}l{},{} {},{} {},{}z\"", p.x, p.y - 1.3 * r, 1.3 * r, 1.3 * r,
                                -1.3 * r, 1.3 * r, -1.3 * r, -1.3 * r);
            break;
        case Marker::triangle:
            shape =
                fmt::format("<path d=\"M{:.1f} {:.1f}l{},{} {},0z\"", p.x, p.y - 1.2 * r, 1.2 * r, 2.1 * r, -2.4 * r);
            break;
    }
    return fmt::format("{} fill=\"{}\" stroke=\"#fff\"><title>{}</title></{}>\n", shape, style.color, escaped(tooltip),
                       style.marker == Marker::circle ? "circle" : "path");
}

std::string tooltip_of(const Series& series, const Measurement& m) {
    return fmt::format("{}, {}: {} a texel, {:.4g} rays, RMSE {:.2g}, 99.9 % within {:.2g}", series.label, m.setting,
                       in_time_unit(m.seconds), m.rays, m.rmse, m.p999);
}

std::string draw(const Series& series, const std::vector<Vec2>& points) {
    const Style& style = style_of(series.id);
    std::string path, markers;
    size_t i = 0;
    for (const Measurement& m : series.points) {
        if (!is_drawn(m)) continue;
        const Vec2& p = points[i++];
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", p.x, p.y);
        markers += marker(p, style, tooltip_of(series, m));
    }
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{}/>\n",
                       path, style.color, style.stroke,
                       *style.dash ? fmt::format(" stroke-dasharray=\"{}\"", style.dash) : "") +
           markers;
}

/// A text, its colour and whether it is bold.
struct Name {
    std::string text, color;
    bool is_bold = false;
};

std::string name_line(const Name& name, const PlacedLabel& label) {
    const Vec2 middle = 0.5 * (label.box.low + label.box.high);
    std::string svg;
    if (label.needs_leader) {
        const Vec2 end = glm::clamp(label.anchor, label.box.low, label.box.high);
        svg = line(label.anchor, end, fmt::format("stroke=\"{}\" stroke-width=\"0.8\"", name.color));
    }
    // A white rim keeps the text legible where a line passes behind it.
    return svg + text_at({middle.x, middle.y + 4.5},
                         fmt::format("text-anchor=\"middle\" fill=\"{}\" paint-order=\"stroke\" stroke=\"#fff\" "
                                     "stroke-width=\"4\" stroke-linejoin=\"round\" font-weight=\"{}\"",
                                     name.color, name.is_bold ? "bold" : "normal"),
                         name.text);
}

std::string captions(const Study& study) {
    const std::string first = fmt::format(
        "{} texels in {} blocks of 8 x 8, of {} lit by {} monitor{}; {} triangles; map {} x {}{}; seed {}; surimi {}.",
        study.texels, study.blocks, study.lit, study.monitors, study.monitors == 1 ? "" : "s", study.triangles,
        study.width, study.height, study.pages > 1 ? fmt::format(" x {} pages", study.pages) : "", study.seed,
        SURIMI_VERSION);
    const std::string second = fmt::format(
        "Reference: {} stratified rays a texel, RMS standard error {:.1e}, taken off. V is the average over the "
        "texel's "
        "footprint. One thread.",
        study.reference_rays, study.reference_error);
    return text_at({frame.low.x, height - 32}, "fill=\"#555\" font-size=\"12\"", first) +
           text_at({frame.low.x, height - 14}, "fill=\"#555\" font-size=\"12\"", second);
}

/// What is named in the plot: lines and texts, in the order in which they choose their places.
struct Names {
    std::vector<LabelledLine> lines;
    std::vector<Name> names;

    void add(std::vector<Vec2> points, const Name& name) {
        // Counted in characters: UTF-8 has more bytes, of which all but the first begin with 10.
        const auto letters = std::ranges::count_if(name.text, [](char c) { return (c & 0xc0) != 0x80; });
        const double bold = name.is_bold ? 1.08 : 1;
        lines.push_back({std::move(points), {bold * letter_width * static_cast<double>(letters), font_size + 2}});
        names.push_back(name);
    }
};

std::string draw_levels(const Study& study, const Axes& axes, Names& names) {
    std::string svg;
    for (const Level& level : levels_of(study, axes)) {
        const double y = axes.rmse.at(level.rmse);
        svg += line({frame.low.x, y}, {frame.high.x, y}, "stroke=\"#666\" stroke-dasharray=\"3 4\"");
        std::vector<Vec2> points;
        for (double x = frame.low.x; x <= frame.high.x; x += 20) points.emplace_back(x, y);
        names.add(points, {level.text, "#555"});
    }
    return svg;
}

std::string draw_all(const Study& study, const Axes& axes) {
    Names names;
    std::string svg;
    for (const Series& series : study.series) {
        std::vector<Vec2> points;
        for (const Measurement& m : series.points)
            if (is_drawn(m)) points.push_back(axes.at(m.seconds, m.rmse));
        if (points.empty()) continue;
        svg = draw(series, points) + svg;  // the first on top
        names.add(points, {series.label, style_of(series.id).color, style_of(series.id).stroke > 2});
    }
    svg = draw_levels(study, axes, names) + svg;
    for (const Series& series : study.series)
        for (const Measurement& m : series.points)
            if (series.id == automatic_id && is_drawn(m))
                names.add({axes.at(m.seconds, m.rmse)}, {m.setting, style_of(series.id).color});
    const Box inside{frame.low + 4.0, frame.high - 4.0};
    const std::vector<PlacedLabel> labels = place_labels(names.lines, inside);
    for (size_t i = 0; i < labels.size(); ++i) svg += name_line(names.names[i], labels[i]);
    return svg;
}

}  // namespace

std::string to_svg(const Study& study, const std::string& title) {
    const Axes axes = axes_of(study);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"{2}\" fill=\"#222\" role=\"img\">\n",
        width, height, font_size);
    svg += fmt::format("<title>{}: error of visibility against time</title>\n", escaped(title));
    svg += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", width, height);
    svg += text_at({frame.low.x, 32}, "font-size=\"19\" font-weight=\"bold\"", title + ": what accuracy costs");
    svg += text_at({frame.low.x, 56}, "fill=\"#555\"", "RMSE of visibility V, in [0, 1] (lower is better)");
    svg += grid(axes);
    svg += text_at({frame.high.x, frame.high.y + 42}, "text-anchor=\"end\" fill=\"#555\"",
                   "CPU time for each texel and monitor (further left is better)");
    svg += draw_all(study, axes) + captions(study);
    return svg + "</svg>\n";
}

}  // namespace surimi
