// SPDX-License-Identifier: Apache-2.0
#include "baker/study/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "baker/study/units.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

// RMSE. 0.01 is what a draft may have; --error 0.004 and 0.001 promise the other two.
constexpr std::array<double, 3> levels = {0.01, 0.002, 0.0005};

struct Finisher {
    const Series* series = nullptr;
    double seconds = INFINITY;
};

/// The series of a family, or of all others, that reaches an RMSE first.
Finisher first_at(const Study& study, double rmse, bool is_ours) {
    Finisher best;
    for (const Series& series : study.series) {
        if ((series.family == Family::surimi) != is_ours) continue;
        const double seconds = seconds_at(series, rmse).value_or(INFINITY);
        if (seconds < best.seconds) best = {&series, seconds};
    }
    return best;
}

std::string times(double factor) {
    return fmt::format("{:.{}f} times", factor, factor < 9.95 ? 1 : 0);
}

/// "5.1 times faster than uniform random rays", or how much more it is at least.
std::string against_random(const Study& study, double rmse, double seconds) {
    const auto random = std::ranges::find(study.series, std::string(random_id), &Series::id);
    if (random == study.series.end() || random->points.empty()) return "";
    if (const auto at = seconds_at(*random, rmse)) return ", uniform random rays " + times(*at / seconds) + " that";
    return ", uniform random rays more than " + times(random->points.back().seconds / seconds) + " that";
}

std::string at_level(const Study& study, double rmse) {
    const Finisher ours = first_at(study, rmse, true), other = first_at(study, rmse, false);
    if (!ours.series && !other.series) return fmt::format("Nothing measured reaches an RMSE of {:g}. ", rmse);
    const bool we_win = ours.seconds <= other.seconds;
    const Finisher &winner = we_win ? ours : other, &second = we_win ? other : ours;
    std::string text = fmt::format("At an RMSE of {:g} the fastest is {} ({} of CPU a texel)", rmse,
                                   winner.series->label, in_time_unit(winner.seconds));
    if (second.series)
        text += fmt::format("; the best of {}, {}, takes {} that", we_win ? "the others" : "ours", second.series->label,
                            times(second.seconds / winner.seconds));
    else
        text += we_win ? "; no other technique gets there" : "; none of ours gets there";
    return text + against_random(study, rmse, winner.seconds) + ". ";
}

std::string those_that_never_arrive(const Study& study, double rmse) {
    std::string text;
    for (const Series& series : study.series)
        if (series.family == Family::approximation && least_rmse(series) > rmse)
            text += fmt::format("{}{} ({:.2g})", text.empty() ? "" : ", ", series.label, least_rmse(series));
    return text.empty() ? "" : fmt::format("Above {:g} at every setting stay (least RMSE): {}. ", rmse, text);
}

}  // namespace

std::optional<double> seconds_at(const Series& series, double rmse) {
    const Measurement* before = nullptr;
    for (const Measurement& point : series.points) {
        if (point.rmse > rmse) {
            before = &point;
            continue;
        }
        if (!before || !(point.seconds > 0) || !(before->seconds > 0) || !(point.rmse > 0)) return point.seconds;
        const double share = std::log(before->rmse / rmse) / std::log(before->rmse / point.rmse);
        return before->seconds * std::pow(point.seconds / before->seconds, share);
    }
    return std::nullopt;
}

double least_rmse(const Series& series) {
    double least = INFINITY;
    for (const Measurement& point : series.points) least = std::min(least, point.rmse);
    return least;
}

Recommendation recommend(const Study& study) {
    const auto automatic = std::ranges::find(study.series, std::string(automatic_id), &Series::id);
    if (automatic == study.series.end() || automatic->points.empty())
        throw Error(ErrorKind::internal, "a study without the baker's own settings");
    const Measurement *first = nullptr, *best = nullptr;
    for (const Measurement& point : automatic->points) {  // from loose to fine
        if (point.value > visible_error || point.p999 > point.value || point.rmse > point.value / 2) continue;
        if (!first) first = best = &point;
        if (point.seconds <= worthwhile_cost * first->seconds) best = &point;
    }
    Recommendation result;
    result.is_kept = best != nullptr;
    result.measurement = best ? *best : automatic->points.back();
    result.map_seconds = result.measurement.seconds * static_cast<double>(study.lit);
    return result;
}

std::string reading(const Study& study, const std::string& file_name) {
    std::string text = fmt::format(
        "{} texels of {} at {} x {}{}, under {} monitor{}, were measured against {} rays each, whose own error is "
        "{:.1g} "
        "RMS. ",
        study.texels, file_name, study.width, study.height, study.pages > 1 ? fmt::format(" x {}", study.pages) : "",
        study.monitors, study.monitors == 1 ? "" : "s", study.reference_rays, study.reference_error);
    for (const double level : levels) {
        if (level >= study.reference_error)
            text += at_level(study, level);
        else
            text += fmt::format("The reference is too coarse to judge an RMSE of {:g}. ", level);
    }
    text += those_that_never_arrive(study, levels[0]);
    const Recommendation r = recommend(study);
    text += fmt::format(
        "Recommended: surimi bake {} --error {:g}, which costs {} a texel, {} of one core for the {} lit "
        "texels of the whole map",
        file_name, r.measurement.value, in_time_unit(r.measurement.seconds), in_time_unit(r.map_seconds), study.lit);
    const size_t outliers = allowed_outliers(study.texels);
    text += fmt::format("; {} of the {} texels were within {:.2g}, RMSE {:.2g}{}.\n",
                        outliers > 0 ? fmt::format("all but {}", outliers) : "all", study.texels, r.measurement.p999,
                        r.measurement.rmse, r.is_kept ? "" : ": the promise was NOT kept here");
    return text;
}

}  // namespace surimi
