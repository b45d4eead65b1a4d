// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/join.h"

#include <algorithm>
#include <map>
#include <queue>
#include <tuple>

#include "baker/unwrap/seam_cost.h"
#include "baker/unwrap/try_chart.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr uint32_t no_chart = UINT32_MAX;

/// An edge of a surface: corner k of a face.
struct Edge {
    uint32_t face;
    uint32_t k;
};

/// A chain of seam edges between the same two charts.
struct Run {
    std::array<uint32_t, 2> charts;
    std::vector<Edge> edges;  ///< seen from the first chart
    SeamLength length;
};

/// How many times over, on average, a surface's triangles may be flattened in tries to join charts.
double effort_of(UvQuality quality) {
    switch (quality) {
        case UvQuality::draft:
            return 2;
        case UvQuality::medium:
            return 16;
        default:
            return 100;
    }
}

class Joiner {
  public:
    Joiner(const FaceGraph& graph, const CutSettings& settings, SeamFlags& seams, std::vector<FlatChart>& charts)
        : graph_(graph), settings_(settings), seams_(seams), charts_(charts), number_(graph.corners.size()) {
        chart_of_.assign(graph.corners.size(), no_chart);
        size_t faces = 0;
        for (uint32_t c = 0; c < charts.size(); ++c) {
            for (const uint32_t f : charts[c].faces) chart_of_[f] = c;
            faces += charts[c].faces.size();
        }
        constexpr double triangles_per_texel = 30;
        effort_ =
            std::min(effort_of(settings.quality) * static_cast<double>(faces), triangles_per_texel * settings.texels);
    }

    void run(const Progress& progress) {
        for (uint32_t c = 0; c < charts_.size(); ++c)
            for (Run& run : runs_around(c))
                if (run.charts[1] >= c) offer(std::move(run));
        while (!queue_.empty() && effort_ > 0) {
            if (progress.is_cancelled && progress.is_cancelled())
                throw Error(ErrorKind::interrupted, "interrupted while joining charts");
            const Run run = std::move(runs_[static_cast<size_t>(-std::get<2>(queue_.top()))]);
            queue_.pop();
            if (charts_[run.charts[0]].faces.empty() || charts_[run.charts[1]].faces.empty()) continue;
            if (!try_to_join(run)) continue;
            for (Run& next : runs_around(static_cast<uint32_t>(charts_.size() - 1))) offer(std::move(next));
        }
        std::erase_if(charts_, [](const FlatChart& chart) { return chart.faces.empty(); });
    }

  private:
    /// The longest visible run comes first, then the longest, then the one that was found first.
    using Claim = std::tuple<float, float, int64_t>;  // visible and whole length, less the run's number

    void offer(Run run) {
        if (!is_worth_a_try(run)) return;
        const auto number = static_cast<int64_t>(runs_.size());
        queue_.emplace(static_cast<float>(run.length.visible), static_cast<float>(run.length.all), -number);
        runs_.push_back(std::move(run));
    }

    /// Seams on creases are not seen, but crumbs cost gutters.
    bool is_worth_a_try(const Run& run) const {
        const FlatChart& a = charts_[run.charts[0]];
        const FlatChart& b = charts_[run.charts[1]];
        if (run.length.visible > 0) return true;
        if (run.charts[0] == run.charts[1]) return false;
        constexpr double crumb_share = 0.02;
        return std::min(a.area, b.area) < crumb_share * std::max(a.area, b.area);
    }

    /// The distortion beyond which a chart of this area cannot be worth the seam that is saved. The energy that goes
    /// with a stretch is known within a factor only.
    DistortionBound bound_worth_it(const Run& run, double area) const {
        const auto [a, b] = run.charts;
        const double most = charts_[a].need + (a == b ? 0 : charts_[b].need) + worth_of(run.length, area);
        const double stretch = std::max(1.0, std::sqrt(most / area));
        constexpr double slack = 2.5;
        const double energy = 4 + slack * energy_of_stretch * (stretch - 1) * (stretch - 1);
        return {std::min(settings_.bound.energy, energy), std::min(settings_.bound.stretch, stretch)};
    }

    /// Whether the seam that is saved is worth the texels that the joined chart needs more.
    bool is_worth_it(const Run& run, const FlatChart& joined) const {
        const auto [a, b] = run.charts;
        const double before = charts_[a].need + (a == b ? 0 : charts_[b].need);
        return joined.need - before <= worth_of(run.length, joined.area);
    }

    std::vector<Run> runs_around(uint32_t chart) {
        std::map<uint32_t, std::vector<Edge>> by_neighbour;
        for (const uint32_t f : charts_[chart].faces) {
            for (uint32_t i = 0; i < 3; ++i) {
                const uint32_t k = (graph_.first_corners[f] + i) % 3;
                const uint32_t beyond = graph_.neighbours[f][k];
                if (beyond == no_face || !seams_.is_cut(f, k)) continue;
                if (chart_of_[beyond] == chart && graph_.ranks[beyond] < graph_.ranks[f]) continue;
                by_neighbour[chart_of_[beyond]].push_back({f, k});
            }
        }
        std::vector<Run> runs;
        for (const auto& [neighbour, edges] : by_neighbour) chain(chart, neighbour, edges, runs);
        return runs;
    }

    /// Edges that share an end are one run.
    void chain(uint32_t chart, uint32_t neighbour, const std::vector<Edge>& edges, std::vector<Run>& runs) const {
        std::map<uint32_t, std::vector<uint32_t>> at;  // place -> edges
        for (uint32_t e = 0; e < edges.size(); ++e)
            for (const uint32_t place : ends(edges[e])) at[place].push_back(e);
        std::vector<bool> is_taken(edges.size(), false);
        for (uint32_t start = 0; start < edges.size(); ++start) {
            if (is_taken[start]) continue;
            Run run{{chart, neighbour}, {}, {}};
            std::vector<uint32_t> open{start};
            is_taken[start] = true;
            while (!open.empty()) {
                const Edge edge = edges[open.back()];
                open.pop_back();
                run.edges.push_back(edge);
                add_edge(graph_, edge.face, edge.k, run.length);
                for (const uint32_t place : ends(edge)) {
                    for (const uint32_t e : at[place]) {
                        if (is_taken[e]) continue;
                        is_taken[e] = true;
                        open.push_back(e);
                    }
                }
            }
            runs.push_back(std::move(run));
        }
    }

    std::array<uint32_t, 2> ends(const Edge& edge) const {
        const auto& c = graph_.corners[edge.face];
        return {c[edge.k], c[(edge.k + 1) % 3]};
    }

    bool try_to_join(const Run& run) {
        const auto [a, b] = run.charts;
        std::vector<uint32_t> faces = charts_[a].faces;
        if (a != b) faces.insert(faces.end(), charts_[b].faces.begin(), charts_[b].faces.end());
        effort_ -= static_cast<double>(faces.size());
        for (const Edge& edge : run.edges) set_seam(graph_, edge.face, edge.k, false, seams_);
        std::sort(faces.begin(), faces.end(),
                  [&](uint32_t l, uint32_t r) { return graph_.ranks[l] < graph_.ranks[r]; });
        const Patch patch = build_patch(graph_, seams_, std::move(faces), number_);
        TriedChart tried = try_chart(graph_, patch, bound_worth_it(run, patch.unit * patch.unit));
        if (!tried.chart || !is_worth_it(run, *tried.chart)) {
            for (const Edge& edge : run.edges) set_seam(graph_, edge.face, edge.k, true, seams_);
            return false;
        }
        for (const uint32_t f : patch.faces) chart_of_[f] = static_cast<uint32_t>(charts_.size());
        charts_[a].faces.clear();
        charts_[b].faces.clear();
        charts_.push_back(std::move(*tried.chart));
        return true;
    }

    const FaceGraph& graph_;
    const CutSettings& settings_;
    SeamFlags& seams_;
    std::vector<FlatChart>& charts_;
    std::vector<uint32_t> number_;
    std::vector<uint32_t> chart_of_;
    std::vector<Run> runs_;
    std::priority_queue<Claim> queue_;
    double effort_ = 0;
};

}  // namespace

void join_charts(const FaceGraph& graph, const CutSettings& settings, const Progress& progress, SeamFlags& seams,
                 std::vector<FlatChart>& charts) {
    Joiner(graph, settings, seams, charts).run(progress);
}

}  // namespace surimi
