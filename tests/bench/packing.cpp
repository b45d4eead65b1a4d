// SPDX-License-Identifier: Apache-2.0
// Packs made-up charts and those of scenes, and prints as Markdown how much of the map they fill and how dense they
// get. Usage: packing [--size W H] [--gutter N] [--mips N] [--only TEXT] [FILE.glb ...]
// --only: of the made-up sets, those with TEXT in their name.
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <map>
#include <string>

#include "baker/unwrap/fit.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/base/error.h"
#include "runtime/scene/gltf.h"
#include "tests/support/chart_shapes.h"

namespace {

using namespace surimi;

struct Job {
    MapSize map{1024, 1024};
    int gutter = 2;
    int mips = 0;
};

/// Charts of an atlas, flat, in metres.
struct Known {
    std::vector<FlatChart> charts;
    std::vector<double> factors;
};

void add_triangle(const Atlas& atlas, size_t surface, uint32_t triangle,
                  std::map<std::pair<float, float>, uint32_t>& ids, FlatChart& chart) {
    const double density = atlas.charts[atlas.surfaces[surface].chart[triangle]].texels_per_metre;
    std::array<uint32_t, 3> corners{};
    for (size_t k = 0; k < 3; ++k) {
        const Vec2f& uv = atlas.surfaces[surface].uv[triangle][k];
        const auto entry = ids.emplace(std::pair{uv.x, uv.y}, static_cast<uint32_t>(chart.points.size()));
        if (entry.second) chart.points.push_back(Vec2(uv) * Vec2(atlas.width, atlas.height) / density);
        corners[k] = entry.first->second;
    }
    const double area =
        0.5 * doubled_area(chart.points[corners[0]], chart.points[corners[1]], chart.points[corners[2]]);
    if (area < 0) std::swap(corners[1], corners[2]);
    chart.flat_area += std::abs(area);
    chart.faces.push_back(triangle);
    chart.triangles.push_back(corners);
}

Known charts_of(const Atlas& atlas) {
    Known known{std::vector<FlatChart>(atlas.charts.size()), {}};
    for (size_t s = 0; s < atlas.surfaces.size(); ++s) {
        std::map<uint32_t, std::vector<uint32_t>> triangles;
        for (uint32_t t = 0; t < atlas.surfaces[s].chart.size(); ++t)
            triangles[atlas.surfaces[s].chart[t]].push_back(t);
        for (const auto& [i, list] : triangles) {
            if (!(atlas.charts[i].texels_per_metre > 0)) {
                known.charts[i] = make_sliver(list[0]);
                continue;
            }
            std::map<std::pair<float, float>, uint32_t> ids;
            for (const uint32_t t : list) add_triangle(atlas, s, t, ids, known.charts[i]);
        }
    }
    for (FlatChart& chart : known.charts) {
        Vec2 low{INFINITY};
        for (const Vec2& p : chart.points) low = glm::min(low, p);
        for (Vec2& p : chart.points) {
            p -= low;
            chart.extent = glm::max(chart.extent, p);
        }
        chart.area = chart.flat_area;
    }
    for (const Chart& chart : atlas.charts)
        known.factors.push_back(chart.texels_per_metre > 0 ? chart.texels_per_metre / atlas.texels_per_metre : 1);
    return known;
}

double cpu_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void measure(const std::string& name, const Known& known, const Job& job) {
    const FitRequest request{known.charts, known.factors, job.gutter, {}, job.mips};
    const double start = cpu_seconds();
    const auto begin = std::chrono::steady_clock::now();
    const Layout layout = fit_to_map(request, job.map);
    const double cpu = cpu_seconds() - start;
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    double area = 0;
    for (size_t i = 0; i < known.charts.size(); ++i) {
        const double density = known.factors[i] * layout.texels_per_metre;
        area += known.charts[i].area * density * density;
    }
    double taken = 0;
    for (size_t i = 0; i < known.charts.size(); ++i) {
        const std::vector<Mask> masks = make_masks(chart_outline(known.charts[i]), layout.shapes[i], job.map);
        taken += least_texels({masks}, job.gutter);
    }
    taken /= static_cast<double>(job.map.width + job.gutter) * (job.map.height + job.gutter);
    const double share = area / (static_cast<double>(job.map.width) * job.map.height);
    std::printf("| %s | %zu | %.4f | %.4f | %.5g | %.2f | %.2f |\n", name.c_str(), known.charts.size(), share, taken,
                layout.texels_per_metre, cpu, wall);
    std::fflush(stdout);
}

int run(int argc, char** argv) {
    Job job;
    std::vector<std::string> files;
    std::string only;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--size") == 0 && i + 2 < argc) {
            job.map = {std::atoi(argv[i + 1]), std::atoi(argv[i + 2])};
            i += 2;
        } else if (std::strcmp(argv[i], "--gutter") == 0 && i + 1 < argc)
            job.gutter = std::atoi(argv[++i]);
        else if (std::strcmp(argv[i], "--mips") == 0 && i + 1 < argc)
            job.mips = std::atoi(argv[++i]);
        else if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc)
            only = argv[++i];
        else
            files.emplace_back(argv[i]);
    }
    std::printf(
        "| charts of, at %d x %d, gutter %d, mips %d | charts | share of the map | with touched texels and gutters | "
        "texels per "
        "metre | CPU s | s |\n"
        "|---|--:|--:|--:|--:|--:|--:|\n",
        job.map.width, job.map.height, job.gutter, job.mips);
    for (const test::ChartSet& set : test::chart_sets())
        if (set.name.find(only) != std::string::npos)
            measure(set.name, {set.charts, std::vector<double>(set.charts.size(), 1)}, job);
    for (const std::string& file : files) {
        UnwrapSettings settings;
        settings.uv = UvSource::automatic;
        measure(std::filesystem::path(file).stem().string(), charts_of(unwrap(read_gltf(file), settings, {})), job);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
