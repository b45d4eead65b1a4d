// SPDX-License-Identifier: Apache-2.0
// Unwraps every OBJ file of a folder, has an independent program measure the result, and prints both as Markdown.
// `cmake --build --preset release --target unwrap_table && build/release/bin/unwrap_table UVMETRICS FOLDER`
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "baker/unwrap/unwrap.h"
#include "tests/support/meshes.h"

namespace surimi {
namespace {

/// What xatlas f700c77 did with its defaults, measured by the project. A mesh listed here is an ordinary one, whose
/// figures go into the means.
struct Published {
    const char* mesh;
    double charts, smooth_seam, dirichlet, density_efficiency, seconds;
};
constexpr Published published[] = {{"gazebo", 332, 0.11, 4.01, 0.685, 0.039},
                                   {"suzanne", 68, 3.99, 4.05, 0.352, 0.067},
                                   {"suzanne_s2", 51, 14.69, 4.03, 0.380, 2.102},
                                   {"uvsphere", 6, 4.68, 4.02, 0.619, 0.200},
                                   {"icosphere5", 6, 4.85, 4.02, 0.488, 0.366},
                                   {"torus", 14, 11.65, 4.02, 0.398, 0.438},
                                   {"cylinder", 6, 5.62, 4.00, 0.720, 0.039},
                                   {"helix", 12, 0.65, 4.00, 0.133, 0.182},
                                   {"cloth", 65, 17.30, 4.00, 0.576, 1.243},
                                   {"terrain", 260, 18.20, 4.98, 0.074, 6.484},
                                   {"room", 286, 4.80, 4.01, 0.596, 0.266},
                                   {"foliage", 1500, 0.00, 4.00, 0.722, 0.130},
                                   {"text", 284, 5.39, 4.01, 0.597, 0.307},
                                   {"spider", 119, 7.53, 4.02, 0.354, 0.100},
                                   {"wuson", 134, 12.99, 4.07, 0.443, 0.212},
                                   {"engine", 3429, 38.25, 4.03, 0.456, 1.718},
                                   {"degenerate", 5, 6.18, 4.04, 0.581, 0.196},
                                   {"oc_bunny", 43, 12.01, 4.02, 0.411, 0.343},
                                   {"oc_bimba", 124, 15.96, 4.17, 0.146, 0.882},
                                   {"oc_horse", 48, 16.03, 4.17, 0.219, 0.861},
                                   {"oc_lucy", 270, 18.38, 4.03, 0.343, 0.339},
                                   {"oc_buddha2", 53, 13.48, 4.12, 0.207, 0.709},
                                   {"oc_cow2", 60, 12.71, 4.02, 0.424, 0.834},
                                   {"oc_tooth", 10, 7.17, 4.04, 0.411, 3.090},
                                   {"oc_circular_box", 477, 25.50, 4.11, 0.257, 3.010},
                                   {"oc_feline_half", 290, 30.54, 4.10, 0.238, 2.428},
                                   {"oc_toy", 150, 19.28, 4.01, 0.488, 1.806},
                                   {"oc_ArtDemo", 569, 15.81, 4.04, 0.369, 0.640},
                                   {"oc_48", 1564, 67.38, 4.24, 0.361, 20.216}};

const Published* find_published(const std::string& mesh) {
    const auto found = std::find_if(std::begin(published), std::end(published),
                                    [&](const Published& some) { return some.mesh == mesh; });
    return found == std::end(published) ? nullptr : found;
}

struct Options {
    UnwrapSettings unwrap;
    std::vector<std::string> only;  ///< names of meshes; empty: all
    std::string uvmetrics;
    std::filesystem::path folder;
};

struct Row {
    std::string mesh;
    std::string failure;                   ///< empty: measured
    std::map<std::string, double> values;  ///< by the names that uvmetrics gives them
    bool is_fit = false;                   ///< uvmetrics --check passed
    double cutting = 0, packing = 0;       ///< CPU seconds of all threads
};

// ---- OBJ files

/// The vertex of "7", "7/3", "7//2" or "-1/-1/-1".
uint32_t vertex_of(const std::string& corner, size_t vertices) {
    const long long number = std::stoll(corner);
    const long long index = number < 0 ? static_cast<long long>(vertices) + number : number - 1;
    if (index < 0 || index >= static_cast<long long>(vertices)) throw std::out_of_range("no vertex " + corner);
    return static_cast<uint32_t>(index);
}

test::Mesh read_obj(const std::filesystem::path& path) {
    std::ifstream file(path);
    test::Mesh mesh;
    std::string line, word;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        words >> word;
        if (line.starts_with("v ") || line.starts_with("v\t")) {
            Vec3 p{0};
            for (int k = 0; k < 3 && words >> word; ++k) p[k] = std::strtod(word.c_str(), nullptr);
            mesh.positions.push_back(p);
        } else if (line.starts_with("f ") || line.starts_with("f\t")) {
            std::vector<uint32_t> polygon;
            while (words >> word) polygon.push_back(vertex_of(word, mesh.positions.size()));
            for (size_t i = 2; i < polygon.size(); ++i)
                mesh.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
        }
    }
    if (mesh.triangles.empty()) throw std::runtime_error("no triangle in " + path.string());
    return mesh;
}

void write_obj(const std::filesystem::path& path, const Surface& surface, const SurfaceUv& flat) {
    std::FILE* out = std::fopen(path.c_str(), "w");
    if (!out) throw std::runtime_error("cannot write " + path.string());
    for (const Vec3& p : surface.positions) std::fprintf(out, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
    for (const auto& triangle : flat.uv)
        for (const Vec2f& uv : triangle)
            std::fprintf(out, "vt %.9g %.9g\n", static_cast<double>(uv.x), static_cast<double>(uv.y));
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        const auto& [a, b, c] = surface.triangles[t];
        std::fprintf(out, "f %u/%zu %u/%zu %u/%zu\n", a + 1, 3 * t + 1, b + 1, 3 * t + 2, c + 1, 3 * t + 3);
    }
    if (std::fclose(out) != 0) throw std::runtime_error("cannot write " + path.string());
}

// ---- measuring

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Unwraps. Time that passes after the report of a stage whose name begins with "pack" counts as packing, all other
/// time as cutting.
Atlas unwrap_timed(const Scene& scene, const UnwrapSettings& settings, Row& row) {
    double since = cpu_seconds();
    bool is_packing = false;
    std::mutex mutex;
    Progress progress;
    progress.report = [&](std::string_view stage, double) {
        const std::lock_guard lock(mutex);
        const double now = cpu_seconds();
        (is_packing ? row.packing : row.cutting) += now - since;
        since = now;
        is_packing = stage.starts_with("pack");
    };
    Atlas atlas = unwrap(scene, settings, progress);
    (is_packing ? row.packing : row.cutting) += cpu_seconds() - since;
    return atlas;
}

std::string quoted(const std::string& word) {
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
    return parts;
}

/// Runs uvmetrics on a file and keeps all that it says.
void measure(const Options& options, const std::filesystem::path& file, const Atlas& atlas, Row& row) {
    const std::string command = quoted(options.uvmetrics) + " " + quoted(file.string()) + " --size " +
                                std::to_string(atlas.width) + " " + std::to_string(atlas.height) + " --padding " +
                                std::to_string(options.unwrap.gutter) + " --check --quiet --csv - --header";
    std::FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) throw std::runtime_error("cannot run " + options.uvmetrics);
    std::string text;
    for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
    const int status = pclose(pipe);
    const std::vector<std::string> lines = split(text, '\n');
    if (lines.size() != 2) throw std::runtime_error("uvmetrics measured nothing");
    const std::vector<std::string> names = split(lines[0], ','), values = split(lines[1], ',');
    for (size_t i = 1; i < std::min(names.size(), values.size()); ++i)
        row.values[names[i]] = values[i] == "null" ? NAN : std::strtod(values[i].c_str(), nullptr);
    row.is_fit = status == 0;
}

Row judge(const Options& options, const std::filesystem::path& file, const std::filesystem::path& temporary) {
    Row row;
    row.mesh = file.stem().string();
    try {
        const Scene scene = test::scene_of({read_obj(file)});
        const Atlas atlas = unwrap_timed(scene, options.unwrap, row);
        const std::filesystem::path unwrapped = temporary / file.filename();
        write_obj(unwrapped, scene.surfaces[0], atlas.surfaces[0]);
        measure(options, unwrapped, atlas, row);
        std::filesystem::remove(unwrapped);
        if (atlas.width != options.unwrap.width || atlas.height != options.unwrap.height)
            row.failure = "size " + std::to_string(atlas.width) + " x " + std::to_string(atlas.height);
    } catch (const std::exception& error) {
        row.failure = error.what();
    }
    return row;
}

// ---- printing

void print(const Row& row) {
    if (!row.failure.empty()) {
        std::printf("| %s | **%s** |\n", row.mesh.c_str(), row.failure.c_str());
        std::fflush(stdout);
        return;
    }
    const auto at = [&](const char* name) { return row.values.at(name); };
    std::printf("| %s | %.0f | %.0f (%.0f) | %.2f | %.2f | %.3f | %.2f (%.2f) | %.3f | %.3f | %.2f |", row.mesh.c_str(),
                at("tris"), at("charts"), at("single_tri_charts"), at("smooth_seam_rel"), at("seam_rel"),
                at("l2_stretch"), at("linf_stretch"), at("linf_p999"), at("angle_mean"), at("area_mean"),
                at("sym_dirichlet"));
    std::printf(" %.3f | %.3f | %.3f | %.0f / %.0f | %.0f | %.0f | %.0f | %.0f | %s | %.2f | %.2f |\n",
                at("area_share"), at("footprint_share"), at("density_efficiency"), at("overlap_pairs"),
                at("overlap_texels"), at("flipped"), at("mirrored_charts"), at("unmapped"), at("self_bleed_texels"),
                row.is_fit ? "pass" : "**FAIL**", row.cutting, row.packing);
    std::fflush(stdout);
}

struct Means {
    double log_density = 0, log_seam = 0, dirichlet = 0, most_dirichlet = 0, charts = 0, seconds = 0;
    int rows = 0, seamed = 0;

    void add(double density, double seam, double energy, double chart_count, double time) {
        log_density += std::log(density);
        if (seam > 0) log_seam += std::log(seam);
        seamed += seam > 0;
        dirichlet += energy;
        most_dirichlet = std::max(most_dirichlet, energy);
        charts += chart_count;
        seconds += time;
        ++rows;
    }
};

void print_means(const std::vector<Row>& rows) {
    Means ours, theirs;
    for (const Row& row : rows) {
        const Published* other = find_published(row.mesh);
        if (!other || !row.failure.empty()) continue;
        ours.add(row.values.at("density_efficiency"), row.values.at("smooth_seam_rel"), row.values.at("sym_dirichlet"),
                 row.values.at("charts"), row.cutting + row.packing);
        theirs.add(other->density_efficiency, other->smooth_seam, other->dirichlet, other->charts, other->seconds);
    }
    if (ours.rows == 0) return;
    std::printf("\n| over %d of %zu ordinary rows | Surimi | xatlas |\n|---|--:|--:|\n", ours.rows,
                std::size(published));
    const auto line = [&](const char* what, const char* format, const auto& value_of) {
        const std::string text = std::string("| ") + what + " | " + format + " | " + format + " |\n";
        std::printf(text.c_str(), value_of(ours), value_of(theirs));
    };
    line("density efficiency, geometric mean", "%.3f", [](const Means& m) { return std::exp(m.log_density / m.rows); });
    line("smooth seam where there is one, geometric mean", "%.2f",
         [](const Means& m) { return std::exp(m.log_seam / std::max(1, m.seamed)); });
    line("rows with a smooth seam", "%.0f", [](const Means& m) { return double(m.seamed); });
    line("E_sd, mean", "%.3f", [](const Means& m) { return m.dirichlet / m.rows; });
    line("E_sd, largest", "%.3f", [](const Means& m) { return m.most_dirichlet; });
    line("charts", "%.0f", [](const Means& m) { return m.charts; });
    line("seconds", "%.1f", [](const Means& m) { return m.seconds; });
}

// ---- command line

std::optional<UvQuality> quality_of(const std::string& name) {
    if (name == "draft") return UvQuality::draft;
    if (name == "medium") return UvQuality::medium;
    if (name == "high") return UvQuality::high;
    return std::nullopt;
}

bool take_option(const std::string& name, const std::string& value, Options& options) {
    if (name == "--size") options.unwrap.width = options.unwrap.height = std::atoi(value.c_str());
    if (name == "--padding") options.unwrap.gutter = std::atoi(value.c_str());
    if (name == "--stretch") options.unwrap.stretch = std::atof(value.c_str());
    if (name == "--threads") set_thread_count(std::atoi(value.c_str()));
    if (name == "--only") options.only = split(value, ',');
    if (name == "--quality") {
        if (!quality_of(value)) return false;
        options.unwrap.quality = *quality_of(value);
    }
    constexpr const char* known[] = {"--size", "--padding", "--stretch", "--threads", "--only", "--quality"};
    return std::find(std::begin(known), std::end(known), name) != std::end(known);
}

bool read_options(int argc, char** argv, Options& options) {
    int i = 1;
    for (; i + 1 < argc && std::string(argv[i]).starts_with("--"); i += 2)
        if (!take_option(argv[i], argv[i + 1], options)) return false;
    if (i + 2 != argc) return false;
    options.uvmetrics = argv[i];
    options.folder = argv[i + 1];
    return std::filesystem::is_directory(options.folder);
}

std::vector<std::filesystem::path> files_of(const Options& options) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(options.folder)) {
        const std::string name = entry.path().stem().string();
        const bool is_wanted =
            options.only.empty() || std::find(options.only.begin(), options.only.end(), name) != options.only.end();
        if (entry.path().extension() == ".obj" && is_wanted) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace
}  // namespace surimi

int main(int argc, char** argv) {
    surimi::Options options;
    if (!surimi::read_options(argc, argv, options)) {
        std::fputs(
            "usage: unwrap_table [--size 1024] [--padding 2] [--stretch 1.5] [--quality draft|medium|high]\n"
            "                    [--threads 0] [--only MESH,MESH] UVMETRICS FOLDER_OF_OBJ\n",
            stderr);
        return 2;
    }
    const std::filesystem::path temporary =
        std::filesystem::temp_directory_path() / ("unwrap_table_" + std::to_string(getpid()));
    std::filesystem::create_directories(temporary);
    std::puts(
        "| mesh | tris | charts (1-tri) | smooth seam | all seams | L2 | Linf (p99.9) | angle | area | E_sd | area "
        "share | footpr. | dens.eff | overlaps (pairs / texels) | flip | mirr. | unmap. | self-bleed | check | "
        "cut s | pack s |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
    std::vector<surimi::Row> rows;
    for (const auto& file : surimi::files_of(options)) {
        rows.push_back(surimi::judge(options, file, temporary));
        print(rows.back());
    }
    std::filesystem::remove_all(temporary);
    surimi::print_means(rows);
    const auto is_good = [](const surimi::Row& row) { return row.failure.empty() && row.is_fit; };
    return !rows.empty() && std::all_of(rows.begin(), rows.end(), is_good) ? 0 : 1;
}
