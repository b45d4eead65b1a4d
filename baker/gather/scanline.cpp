// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/scanline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/base/random.h"

namespace surimi {
namespace {

using Work = ScanlineWorkspace;

/// Directions of the lines that are tried, 0.25, 0.5, 0.7854, 1.05 and 1.3 rad: none is parallel to the panel's sides.
constexpr std::array<Vec2, 5> directions = {
    Vec2(0.968912421710645, 0.247403959254523), Vec2(0.877582561890373, 0.479425538604203),
    Vec2(0.707105482510711, 0.707108079857943), Vec2(0.497571047891727, 0.867423225594017),
    Vec2(0.267498828624587, 0.963558185417193)};

/// Lines nearly along long silhouettes meet them in few places: the direction with the least sum of squared errors,
/// |dx| min(1, (spacing / dy)^2) for each long segment, wins (research/sampling.md 2.5).
Vec2 choose_direction(const Segments& segments, double spacing) {
    std::array<double, directions.size()> sums{};
    for (size_t i = 0; i < segments.count; ++i) {
        const double dx = segments.x1[i] - segments.x0[i], dy = segments.y1[i] - segments.y0[i];
        if (dx * dx + dy * dy < 9 * spacing * spacing) continue;
        for (size_t k = 0; k < directions.size(); ++k) {
            const double across = dx * directions[k].x + dy * directions[k].y;
            const double along2 = std::pow(dy * directions[k].x - dx * directions[k].y, 2);
            const double share = along2 < spacing * spacing ? 1 : spacing * spacing / along2;
            sums[k] += across * share * across * share;
        }
    }
    return directions[static_cast<size_t>(std::ranges::min_element(sums) - sums.begin())];
}

class Scan {
  public:
    Scan(const PanelView& view, const Segments& segments, const ScanlineTask& task, Work& work)
        : view_(view), segments_(segments), task_(task), work_(work) {}

    PointVisibility run() {
        place_lattice();
        sort_crossings();
        clip_lines();
        make_intervals();
        find_free_level();
        if (result_.is_consistent) check_random_intervals();
        if (result_.is_consistent && is_anything_free_) integrate();
        return result_;
    }

  private:
    void place_lattice() {
        // 2.8: the panel's square under the steepest angle.
        const Vec2 direction = choose_direction(segments_, 2.8 / task_.lines);
        lattice_.cosine = direction.x;
        lattice_.sine = direction.y;
        double low = INFINITY, high = -INFINITY;
        for (const Vec2& corner : view_.lit) {
            const double y = lattice_.to_frame(corner).y;
            low = std::min(low, y);
            high = std::max(high, y);
        }
        lattice_.bottom = low;
        lattice_.spacing = (high - low) / task_.lines;
        lattice_.shift = task_.shift;
        lattice_.count = task_.lines;
    }

    /// Crossings by line, unsorted within one.
    void sort_crossings() {
        LineSegments& turned = work_.turned;
        find_crossed_lines(segments_, lattice_, turned);
        auto& offsets = work_.offsets;
        offsets.assign(static_cast<size_t>(task_.lines) + 2, 0);
        for (size_t i = 0; i < turned.count; ++i)
            for (auto j = static_cast<size_t>(turned.first[i]); j <= static_cast<size_t>(turned.last[i]); ++j)
                ++offsets[j + 2];
        for (size_t j = 2; j < offsets.size(); ++j) offsets[j] += offsets[j - 1];
        work_.crossings.resize(offsets.back());
        for (size_t i = 0; i < turned.count; ++i) {
            double x = turned.x[i];
            const int jump = static_cast<int>(turned.jump[i]);
            for (auto j = static_cast<size_t>(turned.first[i]); j <= static_cast<size_t>(turned.last[i]); ++j) {
                work_.crossings[offsets[j + 1]++] = {static_cast<float>(x), jump};
                x += turned.step[i];
            }
        }
    }

    /// Where the lines enter and leave a convex polygon.
    template <class Set>
    void clip_lines_by(const std::vector<Vec2>& polygon, const Set& set) {
        for (size_t i = 0; i < polygon.size(); ++i) {
            Vec2 a = lattice_.to_frame(polygon[i]), b = lattice_.to_frame(polygon[(i + 1) % polygon.size()]);
            const bool is_left = b.y < a.y;  // counter-clockwise: the left chain runs down
            if (is_left) std::swap(a, b);
            const auto line_of = [&](double y) { return (y - lattice_.bottom) / lattice_.spacing - lattice_.shift; };
            const double first = std::max(0.0, std::ceil(line_of(a.y)));
            const double last = std::min(lattice_.count - 1.0, std::ceil(line_of(b.y)) - 1);
            const double slope = (b.x - a.x) / (b.y - a.y);
            for (double j = first; j <= last; ++j)
                set(work_.lines[static_cast<size_t>(j)], is_left,
                    static_cast<float>(a.x + (lattice_.height(static_cast<int>(j)) - a.y) * slope));
        }
    }

    void clip_lines() {
        work_.lines.assign(static_cast<size_t>(task_.lines) + 1, {});
        clip_lines_by(view_.open,
                      [](Work::Line& line, bool is_left, float x) { (is_left ? line.begin : line.end) = x; });
        clip_lines_by(view_.lit,
                      [](Work::Line& line, bool is_left, float x) { (is_left ? line.lit_begin : line.lit_end) = x; });
    }

    /// How the number of occluders changes along the left end of the lines, going up: segments that end on the left
    /// chain of the open polygon.
    void collect_events() {
        auto& events = work_.events;
        events.clear();
        const auto is_left = [&](double side) {
            if (side < 0) return false;
            const auto i = static_cast<size_t>(side);
            const Vec2 a = lattice_.to_frame(view_.open[i]);
            const Vec2 b = lattice_.to_frame(view_.open[(i + 1) % view_.open.size()]);
            return b.y < a.y;
        };
        for (const uint32_t i : segments_.on_sides) {
            const int jump = static_cast<int>(segments_.jump[i]);
            // Into the polygon, its left side is above; out of it, below.
            if (is_left(segments_.side0[i]))
                events.push_back({lattice_.to_frame({segments_.x0[i], segments_.y0[i]}).y, jump});
            if (is_left(segments_.side1[i]))
                events.push_back({lattice_.to_frame({segments_.x1[i], segments_.y1[i]}).y, -jump});
        }
        std::ranges::sort(events, [](const Work::Event& a, const Work::Event& b) {
            return a.height < b.height || (a.height == b.height && a.jump < b.jump);
        });
    }

    static void sort_line(std::span<Work::Crossing> crossings) {
        const auto before = [](const Work::Crossing& a, const Work::Crossing& b) {
            return a.x < b.x || (a.x == b.x && a.jump < b.jump);
        };
        if (crossings.size() > 24) {  // measured: up to here insertion is faster
            std::ranges::sort(crossings, before);
            return;
        }
        for (size_t i = 1; i < crossings.size(); ++i) {
            const Work::Crossing crossing = crossings[i];
            size_t k = i;
            for (; k > 0 && before(crossing, crossings[k - 1]); --k) crossings[k] = crossings[k - 1];
            crossings[k] = crossing;
        }
    }

    /// Intervals of equal depth, which is counted from an unknown number of occluders at the lowest line's left end.
    void make_intervals() {
        collect_events();
        work_.intervals.clear();
        lowest_ = std::numeric_limits<int>::max();
        int highest = std::numeric_limits<int>::min();
        int depth_of_left_end = 0;
        size_t event = 0;
        for (int j = 0; j < lattice_.count; ++j) {
            Work::Line& line = work_.lines[static_cast<size_t>(j)];
            line.first = static_cast<uint32_t>(work_.intervals.size());
            for (; event < work_.events.size() && work_.events[event].height <= lattice_.height(j); ++event)
                depth_of_left_end += work_.events[event].jump;
            if (!(line.begin < line.end)) continue;
            const uint32_t begin = work_.offsets[static_cast<size_t>(j)],
                           end = work_.offsets[static_cast<size_t>(j) + 1];
            const std::span<Work::Crossing> crossings(work_.crossings.data() + begin, end - begin);
            sort_line(crossings);
            int depth = depth_of_left_end;
            float x = line.begin;
            const auto add = [&](float to) {
                if (!(to > x)) return;
                work_.intervals.push_back({x, depth});
                lowest_ = std::min(lowest_, depth);
                highest = std::max(highest, depth);
                x = to;
            };
            for (const Work::Crossing& crossing : crossings) {
                add(std::min(crossing.x, line.end));
                depth += crossing.jump;
            }
            add(line.end);
        }
        work_.lines.back().first = static_cast<uint32_t>(work_.intervals.size());
        if (!work_.intervals.empty()) measure_levels(highest);
    }

    template <class Visit>
    void for_each_interval(const Visit& visit) const {
        for (int j = 0; j < lattice_.count; ++j) {
            const Work::Line& line = work_.lines[static_cast<size_t>(j)];
            const uint32_t last = work_.lines[static_cast<size_t>(j) + 1].first;
            for (uint32_t i = line.first; i < last; ++i)
                visit(j, work_.intervals[i], i + 1 < last ? work_.intervals[i + 1].begin : line.end);
        }
    }

    void measure_levels(int highest) {
        work_.levels.assign(static_cast<size_t>(highest - lowest_) + 1, {});
        for_each_interval([&](int line, const Work::Interval& interval, float end) {
            Work::Level& level = work_.levels[static_cast<size_t>(interval.depth - lowest_)];
            const float length = end - interval.begin;
            level.length += length;
            all_length_ += length;
            if (!(length > level.longest)) return;
            level.longest = length;
            level.middle = {0.5 * (interval.begin + end), lattice_.height(line)};
        });
    }

    bool is_free(const Vec2& place) {
        ++result_.rays;
        const Vec3 target = view_.panel->at(lattice_.to_panel(place));
        return !task_.rays.is_occluded_until(view_.end, view_.origin, target, task_.monitor);
    }

    /// The lowest level that a ray finds free has no occluders, and the levels below it, which cannot exist, must be
    /// slivers. One ray more has to find the largest level above it blocked.
    void find_free_level() {
        const auto& levels = work_.levels;
        constexpr double negligible = 1e-5, sliver = 1e-3, substantial = 0.02;  // of the length of all lines
        double skipped = 0;
        size_t k = 0;
        if (work_.intervals.empty()) return;
        const auto counts = [&](size_t i) { return levels[i].length >= negligible * all_length_; };
        for (; k < levels.size() && !is_anything_free_; ++k) {
            if (!counts(k)) continue;
            if (is_free(levels[k].middle)) {
                is_anything_free_ = true;
                free_depth_ = lowest_ + static_cast<int>(k);
                continue;
            }
            skipped += levels[k].length;
            if (skipped > substantial * all_length_) break;  // blocked on the lowest level: nothing is free
        }
        if (is_anything_free_ && skipped > sliver * all_length_) result_.is_consistent = false;
        size_t check = levels.size();
        for (size_t i = is_anything_free_ ? k : k + 1; i < levels.size(); ++i)
            if (levels[i].length > sliver * all_length_ &&
                (check == levels.size() || levels[i].length > levels[check].length))
                check = i;
        if (check < levels.size() && is_free(levels[check].middle)) result_.is_consistent = false;
    }

    void check_random_intervals() {
        if (work_.intervals.empty()) return;
        for (int c = 0; c < task_.checks && result_.is_consistent; ++c) {
            const auto i = static_cast<uint32_t>(unit_double(hash(task_.key, static_cast<uint64_t>(c))) *
                                                 static_cast<double>(work_.intervals.size()));
            const auto after = std::upper_bound(work_.lines.begin(), work_.lines.end(), i,
                                                [](uint32_t at, const Work::Line& line) { return at < line.first; });
            const auto j = after - work_.lines.begin() - 1;
            const float begin = work_.intervals[i].begin;
            const float end =
                i + 1 < after->first ? work_.intervals[i + 1].begin : work_.lines[static_cast<size_t>(j)].end;
            if (end - begin < 1e-3f) continue;  // a ray's own rounding could leave it
            const bool is_claimed = is_anything_free_ && work_.intervals[i].depth == free_depth_;
            const Vec2 middle(0.5 * (begin + end), lattice_.height(static_cast<int>(j)));
            if (is_free(middle) != is_claimed) result_.is_consistent = false;
        }
    }

    /// The integrals' ends: every line of the lit part, and every change between free and blocked.
    void integrate() {
        const Panel& panel = *view_.panel;
        const Vec3 along = panel.axis_s * lattice_.cosine + panel.axis_t * lattice_.sine;
        const Vec3 up = panel.axis_t * lattice_.cosine - panel.axis_s * lattice_.sine;
        const Vec3 to_center = panel.center - view_.origin;
        const double along2 = glm::dot(along, along), rise = glm::dot(view_.normal, along);
        // Of the line's start, center + height * up: products with itself, with the line and with the normal.
        const double c_along = glm::dot(to_center, along), u_along = glm::dot(up, along);
        const double c_normal = glm::dot(to_center, view_.normal), u_normal = glm::dot(up, view_.normal);
        LineEnds& ends = work_.ends;
        ends.clear();
        work_.owners.clear();
        for (int j = 0; j < lattice_.count; ++j) {
            const Work::Line& line = work_.lines[static_cast<size_t>(j)];
            if (!(line.lit_begin < line.lit_end)) continue;
            // The foot of the point on the line, from which x is counted.
            const double height = lattice_.height(j), foot = -(c_along + height * u_along) / along2;
            const Vec3 nearest = to_center + height * up + foot * along;
            const double distance2 = glm::dot(nearest, nearest);
            const double scale = std::sqrt(along2 / distance2), factor = 0.5 / (distance2 * along2);
            const double weight = factor * scale * (c_normal + height * u_normal + foot * rise), offset = factor * rise;
            const auto add = [&](float x, double sign, bool is_arriving) {
                ends.add((x - foot) * scale, sign * weight, sign * offset);
                work_.owners.push_back({static_cast<uint8_t>(j & 3), is_arriving});
            };
            add(line.lit_begin, -1, false);
            add(line.lit_end, 1, false);
            bool was_free = false;
            const uint32_t last = work_.lines[static_cast<size_t>(j) + 1].first;
            for (uint32_t i = line.first; i < last; ++i) {
                const bool is_now_free = work_.intervals[i].depth == free_depth_;
                if (is_now_free != was_free) add(work_.intervals[i].begin, is_now_free ? -1 : 1, true);
                was_free = is_now_free;
            }
            if (was_free) add(line.end, 1, true);
        }
        integrate_to_ends(ends);
        add_up();
    }

    void add_up() {
        std::array<double, 4> all{}, seen{};
        for (size_t i = 0; i < work_.owners.size(); ++i)
            (work_.owners[i].is_arriving ? seen : all)[work_.owners[i].set] += work_.ends.light[i];
        const double whole = all[0] + all[1] + all[2] + all[3];
        if (!(whole > 0)) return;
        const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0; };
        result_.visibility = std::clamp((seen[0] + seen[1] + seen[2] + seen[3]) / whole, 0.0, 1.0);
        const double halves =
            std::abs(ratio(seen[0] + seen[2], all[0] + all[2]) - ratio(seen[1] + seen[3], all[1] + all[3]));
        const double even = std::abs(ratio(seen[0], all[0]) - ratio(seen[2], all[2]));
        const double odd = std::abs(ratio(seen[1], all[1]) - ratio(seen[3], all[3]));
        result_.error = std::max({halves / 2, even / 6, odd / 6});
    }

    const PanelView& view_;
    const Segments& segments_;
    const ScanlineTask& task_;
    Work& work_;
    Lattice lattice_;
    PointVisibility result_;
    int lowest_ = 0, free_depth_ = 0;
    bool is_anything_free_ = false;
    double all_length_ = 0;
};

}  // namespace

PointVisibility scan(const PanelView& view, const Segments& segments, const ScanlineTask& task,
                     ScanlineWorkspace& work) {
    if (view.open.empty()) return {};
    return Scan(view, segments, task, work).run();
}

}  // namespace surimi
