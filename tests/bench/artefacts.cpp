// SPDX-License-Identifier: Apache-2.0
// What is wrong with the map of a real room, in numbers and pictures, as Markdown:
// `cmake --build --preset release --target artefacts && build/release/bin/artefacts room.glb --size 1024`
// With `--without NAME`, the same with that fix turned off, beside it.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "baker/bake.h"
#include "baker/cli/options.h"
#include "runtime/base/error.h"
#include "runtime/trace/ray_scene.h"
#include "tests/support/map_pictures.h"
#include "tests/support/point_rays.h"
#include "tests/support/room_survey.h"
#include "tests/support/seam_survey.h"

namespace surimi {
namespace {

/// A bake with the fixes of these names turned off; the only place that knows them.
BakeSettings settings_without(const std::vector<std::string>& names) {
    BakeSettings settings;
    for (const std::string& name : names) {
        if (name == "density")
            settings.unwrap.is_uniform = true;
        else if (name == "all")
            for (const Fix& fix : fixes()) fix.in(settings) = false;
        else
            fix_named(name, "--without").in(settings) = false;
    }
    return settings;
}

struct Options {
    std::string file, config, pictures;  // config: of monitors and objects, as the program takes it
    std::vector<std::string> without;
    int size = 1024;
    double error = GatherSettings{}.error;
    test::SurveySettings survey;
    size_t worst = 6;
};

double error_named(const std::string& quality) {
    if (quality == "draft") return 0.02;
    if (quality == "medium") return 0.004;
    if (quality == "high") return 0.001;
    throw Error(ErrorKind::usage, "--quality is draft, medium or high, not " + quality);
}

Options read_options(const std::vector<std::string>& words) {
    const std::string usage =
        "usage: artefacts ROOM.glb [--config FILE.toml] [--size N] [--quality draft|medium|high] [--without FIX].. "
        "[--points N] [--rays N] [--pictures FOLDER] [--worst N]";
    Options options;
    for (size_t i = 0; i < words.size(); ++i) {
        if (!words[i].starts_with("--")) {
            options.file = words[i];
            continue;
        }
        if (i + 1 == words.size()) throw Error(ErrorKind::usage, usage);
        const std::string& option = words[i];
        const std::string& value = words[++i];
        if (option == "--config")
            options.config = value;
        else if (option == "--size")
            options.size = std::stoi(value);
        else if (option == "--quality")
            options.error = error_named(value);
        else if (option == "--without")
            options.without.push_back(value);
        else if (option == "--points")
            options.survey.points = std::stoul(value);
        else if (option == "--rays")
            options.survey.rays = static_cast<uint32_t>(std::stoul(value));
        else if (option == "--pictures")
            options.pictures = value;
        else if (option == "--worst")
            options.worst = std::stoul(value);
        else
            throw Error(ErrorKind::usage, usage);
    }
    if (options.file.empty()) throw Error(ErrorKind::usage, usage);
    return options;
}

struct Variant {
    std::string name;
    Bake bake;
    std::vector<test::SeamEdge> seams;
};

/// Everything fixed, and before it what is asked to be without.
std::vector<Variant> bake_variants(const Scene& scene, const Options& options) {
    std::vector<Variant> variants;
    for (const bool is_reduced : {true, false}) {
        if (is_reduced && options.without.empty()) continue;
        BakeSettings settings = settings_without(is_reduced ? options.without : std::vector<std::string>{});
        settings.unwrap.width = settings.unwrap.height = options.size;
        settings.gather.error = options.error;
        std::string name = "all";
        if (is_reduced) {
            name = "without";
            for (const std::string& fix : options.without) name += " " + fix;
        }
        variants.push_back({name, bake(scene, settings, {}), {}});
        variants.back().seams = test::find_seam_edges(scene, variants.back().bake.atlas);
    }
    return variants;
}

void print_states(const Scene& scene, const std::vector<Variant>& variants) {
    std::printf("\n| texels | monitor | empty | covered | unlit | filled | inside |\n|---|---|--:|--:|--:|--:|--:|\n");
    for (const Variant& variant : variants)
        for (const Monitor& monitor : scene.monitors) {
            std::array<size_t, 5> count{};
            for (const BakedPage& page : variant.bake.pages)
                for (const TexelState state : page.state[static_cast<size_t>(monitor.channel)].pixels)
                    ++count[static_cast<size_t>(state)];
            std::printf("| %s | %s | %zu | %zu | %zu | %zu | %zu |\n", variant.name.c_str(), monitor.name.c_str(),
                        count[0], count[1], count[2], count[3], count[4]);
        }
}

/// Of the places that jump by a tenth or more, up to a thousand of them: the share at which the truth jumps by half as
/// much or more, as where something stands upon the edge.
double share_of_true_steps(const Scene& scene, const RayScene& rays, size_t monitor,
                           const std::vector<test::SeamEdge>& edges, const test::SeamJumps& found) {
    constexpr size_t most = 1000;
    std::vector<test::SeamPlace> large;
    for (const test::SeamPlace& place : found.places)
        if (place.jump >= 0.1) large.push_back(place);
    if (large.empty()) return 0;
    const size_t stride = (large.size() + most - 1) / most, count = (large.size() + stride - 1) / stride;
    const test::Obstructed panels = test::panels_alone(scene, rays, monitor);
    std::vector<uint8_t> is_true(count, 0);
    parallel_for(count, 8, [&](size_t i) {
        const test::SeamPlace& place = large[i * stride];
        std::array<double, 2> truth{};
        for (size_t side = 0; side < 2; ++side) {
            const SurfacePoint point = test::point_beside(scene, edges[place.edge], side, place.share);
            truth[side] = test::visibility_by_rays(scene, rays, panels, monitor, point, 256).visibility;
        }
        is_true[i] = std::abs(truth[0] - truth[1]) >= place.jump / 2;
    });
    return static_cast<double>(std::count(is_true.begin(), is_true.end(), 1)) / static_cast<double>(count);
}

void print_seams(const Scene& scene, const RayScene& rays, const std::vector<Variant>& variants) {
    std::printf(
        "\n| seams | monitor | edges read | places | p50 | p99 | largest | over 1/255 | over 0.1 | of these true |\n"
        "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (const Variant& variant : variants)
        for (size_t m = 0; m < scene.monitors.size(); ++m) {
            const Monitor& monitor = scene.monitors[m];
            const auto found = test::seam_jumps(variant.bake, variant.seams, static_cast<size_t>(monitor.channel));
            std::printf("| %s | %s | %zu | %zu | %.4f | %.4f | %.4f | %.2f %% | %.2f %% | %.0f %% |\n",
                        variant.name.c_str(), monitor.name.c_str(), found.edges, found.places.size(),
                        found.quantile(0.5), found.quantile(0.99), found.largest(), 100 * found.share_over(1.0 / 255),
                        100 * found.share_over(0.1), 100 * share_of_true_steps(scene, rays, m, variant.seams, found));
        }
}

void print_errors(const std::string& variant, const std::string& monitor, std::vector<test::RoomPoint> points) {
    for (const bool is_all : {false, true}) {
        const test::SurveyResult r = test::judge(points, is_all);
        std::printf("| %s | %s | %s | %zu | %.5f | %.5f | %.4f | %.4f | %zu | %zu | %zu | %zu |\n", variant.c_str(),
                    monitor.c_str(), is_all ? "all" : "visible", r.points, r.mean, r.rmse, r.p99, r.largest, r.plain,
                    r.leaks, r.shadows, r.tenths);
    }
}

/// Rows of the worst places: each variant's map, then the truth.
void write_pictures(const Scene& scene, const RayScene& rays, size_t monitor, const std::vector<Variant>& variants,
                    const std::vector<test::RoomPoint>& worst, const std::string& folder) {
    std::vector<std::vector<Image<glm::u8vec3>>> rows;
    for (const test::RoomPoint& point : worst) {
        const View view = test::view_near(rays, point.point);
        auto& row = rows.emplace_back();
        for (const Variant& variant : variants)
            row.push_back(test::picture_of_map(scene, rays, variant.bake, monitor, view));
        row.push_back(test::picture_of_truth(scene, rays, monitor, view));
    }
    if (rows.empty()) return;
    std::filesystem::create_directories(folder);
    test::write_png(std::filesystem::path(folder) / (scene.monitors[monitor].name + ".png"), test::sheet_of(rows));
}

void survey(const Scene& scene, const RayScene& rays, const std::vector<Variant>& variants, const Options& options) {
    std::printf(
        "\n| errors | monitor | points | n | mean | RMSE | p99 | largest | within 5 %% of 0 or 1 | leaks | "
        "false shadows | off by 0.1 |\n|---|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        std::vector<test::RoomPoint> points = test::survey_room(scene, rays, m, options.survey);
        std::vector<test::RoomPoint> worst;
        for (const Variant& variant : variants) {
            test::read_values(variant.bake, scene.monitors[m].channel, points);
            print_errors(variant.name, scene.monitors[m].name, points);
            if (worst.empty()) worst = test::worst_of(points, options.worst, 0.3);  // of the first, the worse one
        }
        for (const test::RoomPoint& p : worst)
            std::fprintf(stderr, "%s: %.3f instead of %.3f on %s at %.3f, %.3f, %.3f\n", scene.monitors[m].name.c_str(),
                         p.value, p.truth, scene.surfaces[p.point.triangle.surface].name.c_str(), p.point.position.x,
                         p.point.position.y, p.point.position.z);
        if (!options.pictures.empty()) write_pictures(scene, rays, m, variants, worst, options.pictures);
    }
}

void print_costs(const std::vector<Variant>& variants) {
    std::printf("\n| stage | variant | seconds |\n|---|---|--:|\n");
    for (const Variant& variant : variants)
        for (const StageCost& cost : variant.bake.costs)
            std::printf("| %s | %s | %.2f |\n", cost.stage.c_str(), variant.name.c_str(), cost.seconds);
}

void run(const Options& options) {
    Given given;
    given.scene = options.file;
    given.config = options.config;
    given.quiet = true;
    const Scene scene = load_scene(given, effective_config(given));
    const std::vector<Variant> variants = bake_variants(scene, options);
    std::printf("%s, %d x %d, error %g\n", scene.path.filename().string().c_str(), options.size, options.size,
                options.error);
    print_states(scene, variants);
    const RayScene rays(scene);
    print_seams(scene, rays, variants);
    survey(scene, rays, variants, options);
    print_costs(variants);
}

}  // namespace
}  // namespace surimi

int main(int argc, char** argv) {
    try {
        surimi::run(surimi::read_options({argv + 1, argv + argc}));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
    return 0;
}
