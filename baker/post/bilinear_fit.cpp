// SPDX-License-Identifier: Apache-2.0
#include "baker/post/bilinear_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "baker/post/read_average.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

constexpr double stay_weight = 0.1;  // lambda of (M67)
// As of stitching: what is less would only take from texels that they are plain.
constexpr double least_change = 0x1p-14;
constexpr double settled = least_change / 64;  // a round that changes less is the last
constexpr size_t most_rounds = 500;            // never reached: 30 to 40 are enough
constexpr size_t grain = 4096;                 // of texels

/// A measured texel: what the changes around it are to average to.
struct Equation {
    uint32_t at = 0;   // in the field
    float target = 0;  // measured, less the average of the values before
};

/// The page with a ring around it, so that all that is on it has eight neighbours.
struct Field {
    size_t width = 0;                   // of the map
    size_t stride = 0;                  // of the field
    std::vector<ReadAverage> averages;  // 0: of what has none; 1: of whole texels; others of one texel each
    std::vector<Equation> equations;
    std::vector<uint32_t> unknowns;  // places in the field, in order
    // By place:
    std::vector<uint32_t> average;  // index into averages
    std::vector<float> value;       // before
    std::vector<float> change;
    std::vector<float> ahead;  // changes, carried on by the momentum
    std::vector<float> miss;   // of equations: target less what `ahead` averages to, times area

    size_t place_of(size_t index) const { return (index / width + 1) * stride + index % width + 1; }
    size_t index_of(size_t place) const { return (place / stride - 1) * width + place % stride - 1; }
    /// Of the 3 x 3 places around one, row by row.
    std::array<size_t, 9> around(size_t place) const {
        const size_t above = place - stride, below = place + stride;
        return {above - 1, above, above + 1, place - 1, place, place + 1, below - 1, below, below + 1};
    }
    double average_over(size_t place, const std::vector<float>& values) const {
        const ReadAverage& reads = averages[average[place]];
        const auto places = around(place);
        double sum = 0;
        for (size_t k = 0; k < 9; ++k)
            sum += static_cast<double>(reads.weights[k]) * static_cast<double>(values[places[k]]);
        return sum;
    }
    /// The sum over the texels that read a place, of their weight for it times `of` them.
    double spread_back(size_t place, const std::vector<float>& of) const {
        const auto places = around(place);
        double sum = 0;
        for (size_t k = 0; k < 9; ++k)
            sum +=
                static_cast<double>(averages[average[places[k]]].weights[8 - k]) * static_cast<double>(of[places[k]]);
        return sum;
    }
    double area_of(const Equation& equation) const { return static_cast<double>(averages[average[equation.at]].area); }
};

bool is_measured(const Channel& channel, size_t index) {
    return channel.state.pixels[index] == TexelState::covered;
}

/// Sets what the reads over each measured texel average to.
void find_averages(const Receivers& receivers, std::span<const Panel> panels, const Channel& channel, Field& field) {
    const Texels& texels = receivers.texels;
    field.averages = {ReadAverage{}, read_average_of_whole};
    std::vector<uint8_t> is_part(texels.texels.size());
    parallel_for(is_part.size(), grain, [&](size_t i) {
        const Texel& texel = texels.texels[i];
        if (!is_measured(channel, texel.index)) return;
        is_part[i] = !is_read_as_whole(receivers, texel);
        field.average[field.place_of(texel.index)] = 1;
    });
    std::vector<uint32_t> parts;
    for (size_t i = 0; i < is_part.size(); ++i)
        if (is_part[i]) parts.push_back(static_cast<uint32_t>(i));
    field.averages.resize(2 + parts.size());
    parallel_for(parts.size(), 64, [&](size_t p) {
        const Texel& texel = texels.texels[parts[p]];
        field.averages[2 + p] = read_average(receivers, panels, texel);
        field.average[field.place_of(texel.index)] = static_cast<uint32_t>(2 + p);
    });
}

/// Texels that may change: not empty, not exactly 0 or 1 by measurement, and read over some measured texel.
void find_unknowns(const Channel& channel, Field& field) {
    const size_t count = channel.state.pixels.size();
    std::vector<uint8_t> is_unknown(count);
    parallel_for(count, grain, [&](size_t i) {
        const float value = channel.visibility.pixels[i];
        const bool is_plain = is_measured(channel, i) && (value == 0 || value == 1);
        if (is_plain || channel.state.pixels[i] == TexelState::empty) return;
        const auto places = field.around(field.place_of(i));
        for (size_t k = 0; k < 9; ++k) is_unknown[i] |= field.averages[field.average[places[k]]].weights[8 - k] > 0;
    });
    field.unknowns.reserve(static_cast<size_t>(std::ranges::count(is_unknown, uint8_t{1})));
    for (size_t i = 0; i < count; ++i)
        if (is_unknown[i]) field.unknowns.push_back(static_cast<uint32_t>(field.place_of(i)));
}

/// The measured texels whose reads meet what may change, and what is missing there.
void find_equations(const Texels& texels, Field& field) {
    std::vector<uint8_t> meets(field.average.size());
    for (const uint32_t unknown : field.unknowns)
        for (const size_t place : field.around(unknown)) meets[place] = field.averages[field.average[place]].area > 0;
    field.equations.reserve(static_cast<size_t>(std::ranges::count(meets, uint8_t{1})));
    for (const Texel& texel : texels.texels)
        if (const size_t place = field.place_of(texel.index); meets[place])
            field.equations.push_back({static_cast<uint32_t>(place), 0});
    parallel_for(field.equations.size(), grain, [&](size_t e) {
        Equation& equation = field.equations[e];
        const double measured = static_cast<double>(field.value[equation.at]);
        equation.target = static_cast<float>(measured - field.average_over(equation.at, field.value));
    });
}

Field field_of(const Receivers& receivers, std::span<const Panel> panels, const Channel& channel) {
    const Texels& texels = receivers.texels;
    Field field;
    field.width = static_cast<size_t>(texels.width);
    field.stride = field.width + 2;
    const size_t places = field.stride * (static_cast<size_t>(texels.height) + 2);
    field.average.resize(places);
    find_averages(receivers, panels, channel, field);
    find_unknowns(channel, field);
    field.value.resize(places);
    for (size_t i = 0; i < channel.visibility.pixels.size(); ++i)
        field.value[field.place_of(i)] = channel.visibility.pixels[i];
    find_equations(texels, field);
    for (auto* values : {&field.change, &field.ahead, &field.miss}) values->resize(places);
    return field;
}

/// Writes `miss` for changes `values`.
void find_misses(Field& field, const std::vector<float>& values) {
    parallel_for(field.equations.size(), grain, [&](size_t e) {
        const Equation& equation = field.equations[e];
        const double miss = static_cast<double>(equation.target) - field.average_over(equation.at, values);
        field.miss[equation.at] = static_cast<float>(field.area_of(equation) * miss);
    });
}

/// A bound for the curvature of what is to be least: the largest sum of a row, as no entry is negative.
double largest_curvature(Field& field) {
    for (const Equation& equation : field.equations)
        field.miss[equation.at] = static_cast<float>(field.area_of(equation));  // times the sum of weights, 1
    double largest = 0;
    for (const uint32_t unknown : field.unknowns) largest = std::max(largest, field.spread_back(unknown, field.miss));
    return largest + stay_weight;
}

/// One round of projected descent with momentum; the largest change of a change.
double descend(Field& field, double curvature, double momentum) {
    find_misses(field, field.ahead);
    std::vector<float> largest((field.unknowns.size() + grain - 1) / grain);
    parallel_for(largest.size(), 1, [&](size_t block) {
        const size_t end = std::min(field.unknowns.size(), (block + 1) * grain);
        for (size_t u = block * grain; u < end; ++u) {
            const size_t place = field.unknowns[u];
            const double start = static_cast<double>(field.ahead[place]),
                         was = static_cast<double>(field.change[place]);
            const double fall = field.spread_back(place, field.miss) - stay_weight * start;
            const double value = static_cast<double>(field.value[place]);
            const double is = std::clamp(start + fall / curvature, -value, 1 - value);
            field.change[place] = static_cast<float>(is);
            field.ahead[place] = static_cast<float>(is + momentum * (is - was));
            largest[block] = std::max(largest[block], static_cast<float>(std::abs(is - was)));
        }
    });
    return largest.empty() ? 0 : static_cast<double>(*std::ranges::max_element(largest));
}

/// Adds up squares of what is missing, by area, in the order of the map.
double squared_misses(Field& field) {
    double sum = 0;
    for (const Equation& equation : field.equations) {
        const double miss = static_cast<double>(equation.target) - field.average_over(equation.at, field.change);
        sum += field.area_of(equation) * miss * miss;
    }
    return sum;
}

double measured_area(const Field& field) {
    double sum = 0;
    for (const uint32_t average : field.average) sum += static_cast<double>(field.averages[average].area);
    return sum;
}

/// Writes the changes that are worth it.
void store(Field& field, Channel& channel, BilinearFit& fit) {
    for (const uint32_t unknown : field.unknowns) {
        const double change = static_cast<double>(field.change[unknown]);
        if (std::abs(change) < least_change) {
            field.change[unknown] = 0;
            continue;
        }
        ++fit.texels;
        fit.largest_move = std::max(fit.largest_move, std::abs(change));
        const double value = std::clamp(static_cast<double>(field.value[unknown]) + change, 0.0, 1.0);
        channel.visibility.pixels[field.index_of(unknown)] = static_cast<float>(value);
    }
}

}  // namespace

void BilinearFit::add(const BilinearFit& page) {
    const double all = area + page.area;
    const auto joined = [&](double mine, double other) {
        return all > 0 ? std::sqrt((mine * mine * area + other * other * page.area) / all) : 0;
    };
    rms_before = joined(rms_before, page.rms_before);
    rms_after = joined(rms_after, page.rms_after);
    area = all;
    texels += page.texels;
    largest_move = std::max(largest_move, page.largest_move);
    rounds = std::max(rounds, page.rounds);
}

BilinearFit fit_bilinear(const Receivers& receivers, std::span<const Panel> panels, Channel& channel) {
    BilinearFit fit;
    Field field = field_of(receivers, panels, channel);
    fit.area = measured_area(field);
    if (!(fit.area > 0)) return fit;
    fit.rms_before = std::sqrt(squared_misses(field) / fit.area);
    const double curvature = largest_curvature(field);
    const double root = std::sqrt(stay_weight / curvature), momentum = (1 - root) / (1 + root);
    while (fit.rounds < most_rounds) {
        ++fit.rounds;
        if (descend(field, curvature, momentum) < settled) break;
    }
    store(field, channel, fit);
    fit.rms_after = std::sqrt(squared_misses(field) / fit.area);
    return fit;
}

size_t bilinear_fit_bytes(const Texels& texels) {
    const size_t places = (static_cast<size_t>(texels.width) + 2) * (static_cast<size_t>(texels.height) + 2);
    const size_t on_map = places * (sizeof(uint32_t) + 4 * sizeof(float));
    const size_t lists = places * sizeof(uint32_t) + texels.texels.size() * sizeof(Equation);
    return on_map + lists + texels.texels.size() * sizeof(ReadAverage);  // at most: whole ones share theirs
}

}  // namespace surimi
