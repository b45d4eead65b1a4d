// SPDX-License-Identifier: Apache-2.0
// What an error costs: gather at several settings beside Monte Carlo at the number of samples that reaches the same
// RMSE, on the same texels, in one run, on one thread, in seconds of CPU; printed as Markdown.
// `cmake --build --preset release --target visibility_table && build/release/bin/visibility_table low room.glb`
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "baker/gather/gather.h"
#include "baker/gather/monte_carlo.h"
#include "baker/gather/panel.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/base/random.h"
#include "runtime/scene/gltf.h"
#include "runtime/scene/monitors.h"
#include "tests/support/occlusion_scenes.h"

namespace surimi {
namespace {

struct Options {
    int size = 512;
    size_t texels = 8192;      ///< about so many, in random tiles of 16 x 16; 0: all
    size_t references = 1000;  ///< texels with a reference, for each monitor
    int most_samples = 16384;  ///< of the Monte Carlo that is measured
    std::vector<std::string> scenes;
};

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

bool is_file(const std::string& scene) {
    return scene.ends_with(".glb") || scene.ends_with(".gltf");
}

std::string name_of(const std::string& scene) {
    const size_t begin = scene.find_last_of('/') + 1;
    return scene.substr(begin, scene.find_last_of('.') - begin);
}

/// One scene with the texels that are measured.
struct Job {
    Scene scene;
    Atlas atlas;
    Texels texels;
    double share = 1;  ///< of the map's texels
    std::optional<RayScene> rays;
    Silhouettes silhouettes;
    SamplePoints points;
};

/// Keeps the texels of random tiles, as whole blocks, until there are enough.
void keep_some(Texels& texels, size_t count) {
    constexpr uint32_t tile = 16;
    const auto width = static_cast<uint32_t>(texels.width);
    const auto tile_of = [&](const Texel& t) {
        return t.index / width / tile * (width / tile + 1) + t.index % width / tile;
    };
    std::map<uint64_t, std::pair<uint32_t, size_t>> tiles;  // by random number: tile, its texels
    for (const Texel& texel : texels.texels) {
        auto& [number, size] = tiles[hash(11, tile_of(texel))];
        number = tile_of(texel);
        ++size;
    }
    std::set<uint32_t> kept;
    size_t sum = 0;
    for (const auto& [key, entry] : tiles) {
        if (sum >= count) break;
        kept.insert(entry.first);
        sum += entry.second;
    }
    std::erase_if(texels.texels, [&](const Texel& texel) { return !kept.contains(tile_of(texel)); });
}

/// Rooms made by name are mapped where they are plain: their blobs and leaves only cast shadows.
Scene receivers_of(const Scene& scene, bool is_made) {
    Scene receivers = scene;
    if (!is_made) return receivers;
    const std::vector<uint32_t> plain = test::plain_surfaces(scene);
    for (uint32_t s = 0; s < receivers.surfaces.size(); ++s)
        if (!std::ranges::binary_search(plain, s)) receivers.surfaces[s].triangles.clear();
    return receivers;
}

void set_up(Job& job, const Options& options, const std::string& scene) {
    if (is_file(scene)) {
        job.scene = read_gltf(scene);
        find_monitors(job.scene, {});
    } else {
        job.scene = test::room_with(test::contents_named(scene));
    }
    const Scene receivers = receivers_of(job.scene, !is_file(scene));
    UnwrapSettings settings;
    settings.width = settings.height = options.size;
    settings.quality = UvQuality::draft;
    job.atlas = unwrap(receivers, settings, {});
    job.texels = find_texels(receivers, job.atlas);
    const double all = static_cast<double>(job.texels.texels.size());
    if (options.texels > 0) keep_some(job.texels, options.texels);
    job.share = static_cast<double>(job.texels.texels.size()) / all;
    job.rays.emplace(job.scene);
    const double start = cpu_seconds();
    job.silhouettes = find_silhouettes(job.scene, *job.rays);
    std::fprintf(stderr, "%s: %zu triangles, %zu texels, silhouettes %.2f s\n", scene.c_str(),
                 triangle_count(job.scene), job.texels.texels.size(), cpu_seconds() - start);
}

/// Two independent references of one texel.
struct Reference {
    size_t texel = 0;
    double first = 0, second = 0, error = 0;  ///< error: standard error of their mean, estimated
};

/// Values of the texels with references.
struct Measured {
    double rmse = 0;
    double least_rmse = 0;  ///< below it the references cannot tell
    double beyond = 0;      ///< share of texels further off than the error asked for and 3 standard errors
};

/// The two references' errors are independent, so the mean product of both differences is free of their variance.
template <class Value>
Measured measure(const std::vector<Reference>& references, double error, const Value& value_of) {
    double sum = 0, squares = 0;
    size_t beyond = 0;
    for (size_t i = 0; i < references.size(); ++i) {
        const Reference& r = references[i];
        const double value = value_of(i);
        const double square = (value - r.first) * (value - r.second);
        sum += square;
        squares += square * square;
        beyond += std::abs(value - 0.5 * (r.first + r.second)) > error + 3 * r.error;
    }
    const double count = static_cast<double>(references.size());
    const double deviation = std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)) / count);
    return {std::sqrt(std::max(0.0, sum / count)), std::sqrt(deviation), static_cast<double>(beyond) / count};
}

/// Everything about one monitor.
class Bench {
  public:
    Bench(const Job& job, size_t monitor) : job_(job), monitor_(monitor), sampler_(job.scene.monitors[monitor]) {
        for (const Panel& panel : panels_of(job.scene.monitors[monitor], *job.rays))
            clearance_ = std::max(clearance_, panel.clearance);
    }

    TexelSurface surface(size_t texel) const {
        return {job_.scene, job_.atlas, job_.texels, job_.texels.texels[texel]};
    }
    MonteCarloEstimate trace(size_t texel, int samples, uint64_t key) const {
        const MonteCarloTask task{.rays = *job_.rays,
                                  .sampler = sampler_,
                                  .points = job_.points,
                                  .monitor = monitor_,
                                  .clearance = clearance_,
                                  .samples = samples,
                                  .key = hash(key, texel)};
        return monte_carlo(task, surface(texel));
    }
    /// The ratio estimator over pairs of independent random points: what is done without any care.
    double trace_uniformly(size_t texel, uint32_t samples) const;
    Gathered gather_with(const Texels& texels, const GatherSettings& settings) const {
        return gather(job_.scene, job_.atlas, texels, *job_.rays, job_.silhouettes, monitor_, settings, {});
    }

  private:
    const Job& job_;
    size_t monitor_;
    MonitorSampler sampler_;
    double clearance_ = 0;
};

double Bench::trace_uniformly(size_t texel, uint32_t samples) const {
    const TexelSurface area = surface(texel);
    const uint64_t key = hash(99, texel);
    double all = 0, seen = 0;
    for (uint64_t i = 0; i < samples; ++i) {
        const auto r = [&](uint64_t k) { return unit_double(hash(key, 4 * i + k)); };
        const SurfacePoint from = area.sample(r(0), r(1));
        const LightPoint to = sampler_.sample(r(2), r(3));
        const Vec3 d = to.position - from.position;
        const double emitted = sampler_.is_two_sided() ? std::abs(glm::dot(d, to.normal)) : -glm::dot(d, to.normal);
        const double cosine = glm::dot(d, from.normal), r2 = glm::dot(d, d);
        if (!(emitted > 0 && cosine > 0)) continue;
        const double weight = emitted * cosine / (r2 * r2);
        all += weight;
        if (glm::dot(d, from.geometric_normal) <= 0) continue;
        RayPacket packet;
        packet.add(job_.rays->ray_origin(from) - job_.rays->center(), to.position - job_.rays->center(),
                   std::max(0.0, 1 - clearance_ / std::abs(glm::dot(d, to.normal))));
        if (job_.rays->occluded(packet, monitor_) == 0) seen += weight;
    }
    return all > 0 ? seen / all : 0;
}

std::vector<Reference> find_references(const Bench& bench, std::vector<size_t> lit, size_t count) {
    std::sort(lit.begin(), lit.end(), [](size_t a, size_t b) { return hash(5, a) < hash(5, b); });
    lit.resize(std::min(lit.size(), count));
    std::vector<Reference> references(lit.size());
    parallel_for(lit.size(), 1, [&](size_t i) {
        const MonteCarloEstimate a = bench.trace(lit[i], 1 << 15, 1001), b = bench.trace(lit[i], 1 << 15, 1002);
        references[i] = {lit[i], a.visibility, b.visibility, 0.5 * std::hypot(a.error, b.error)};
    });
    return references;
}

/// Error and microseconds a texel of Monte Carlo by its number of samples.
struct CurvePoint {
    double samples = 0, rmse = 0, microseconds = 0;
};

/// Samples and microseconds at which the curve reaches an RMSE: straight between its points in logarithms, and beyond
/// them.
CurvePoint at_rmse(const std::vector<CurvePoint>& curve, double rmse) {
    if (curve[0].rmse <= rmse) return curve[0];  // hardly a penumbra
    size_t i = 1;
    while (i + 1 < curve.size() && curve[i].rmse > rmse) ++i;
    const CurvePoint &a = curve[i - 1], &b = curve[i];
    const double slope = std::clamp(std::log(b.rmse / a.rmse) / std::log(b.samples / a.samples), -1.0, -0.5);
    const double samples = b.samples * std::exp(std::log(rmse / b.rmse) / slope);
    return {samples, rmse, samples * b.microseconds / b.samples};
}

struct Setting {
    const char* name;
    double error;
    bool is_exact;
};
constexpr Setting all_settings[] = {
    {"0.02", 0.02, false}, {"0.004", 0.004, false}, {"0.001", 0.001, false}, {"exact", 0.004, true}};

/// CPU of all texels of a scene and setting, ours and Monte Carlo's at the same RMSE.
struct Totals {
    double ours = 0, sobol = 0, uniform = 0;
};

std::vector<CurvePoint> curve_of(const Bench& bench, const std::vector<Reference>& references, int most) {
    std::vector<CurvePoint> curve;
    for (int samples = 16; samples <= most; samples *= 4) {
        std::vector<double> values;
        const double start = cpu_seconds();
        for (const Reference& r : references) values.push_back(bench.trace(r.texel, samples, 7).visibility);
        const double seconds = cpu_seconds() - start;
        const Measured found = measure(references, 1, [&](size_t i) { return values[i]; });
        curve.push_back({static_cast<double>(samples), std::max(found.rmse, 1e-6),
                         1e6 * seconds / static_cast<double>(references.size())});
    }
    return curve;
}

/// RMSE of one uniform sample, by the law of its square root: from 256 and 1024 of them.
double uniform_deviation(const Bench& bench, const std::vector<Reference>& references) {
    double squares = 0;
    for (const uint32_t samples : {256u, 1024u}) {
        const Measured found =
            measure(references, 1, [&](size_t i) { return bench.trace_uniformly(references[i].texel, samples); });
        squares += 0.5 * found.rmse * found.rmse * samples;
    }
    return std::sqrt(squares);
}

void run_monitor(const Job& job, size_t monitor, const Options& options, const std::string& scene,
                 std::vector<Totals>& totals) {
    const Bench bench(job, monitor);
    std::vector<size_t> lit;
    std::vector<Gathered> results;
    std::vector<double> seconds;
    for (const Setting& setting : all_settings) {
        GatherSettings settings;
        settings.error = setting.error;
        settings.is_exact = setting.is_exact;
        // What a map costs before its first texel is shared by all of its texels, not by the few that are measured.
        Texels none = job.texels;
        none.texels.clear();
        const double begin = cpu_seconds();
        bench.gather_with(none, settings);
        const double start = cpu_seconds();
        results.push_back(bench.gather_with(job.texels, settings));
        seconds.push_back(cpu_seconds() - start - (start - begin) * (1 - job.share));
    }
    for (size_t i = 0; i < job.texels.texels.size(); ++i)
        if (results[0].estimates[i].unshadowed > 1e-6f) lit.push_back(i);
    if (lit.empty()) return;
    const std::vector<Reference> references = find_references(bench, lit, options.references);
    const std::vector<CurvePoint> curve = curve_of(bench, references, options.most_samples);
    const double deviation = uniform_deviation(bench, references);
    for (size_t s = 0; s < std::size(all_settings); ++s) {
        const Measured found = measure(references, all_settings[s].error, [&](size_t i) {
            const IrradianceEstimate& e = results[s].estimates[references[i].texel];
            return e.unshadowed > 0 ? static_cast<double>(e.shadowed) / static_cast<double>(e.unshadowed) : 0.0;
        });
        const double texels = static_cast<double>(lit.size());
        const double microseconds = 1e6 * seconds[s] / texels;
        const double rmse = std::max({found.rmse, found.least_rmse, 1e-6});
        const CurvePoint equal = at_rmse(curve, rmse);
        const double uniform =
            std::max(16.0, std::pow(deviation / rmse, 2)) * curve.back().microseconds / curve.back().samples;
        std::printf("| %s %s | %s | %.2f | %.2f | %.1f | %.1e | %.2f %% | %s%.0f | %.1f | %.1f | %.0f |\n",
                    scene.c_str(), job.scene.monitors[monitor].name.c_str(), all_settings[s].name, seconds[s],
                    microseconds, static_cast<double>(results[s].statistics.rays()) / texels, found.rmse,
                    100 * found.beyond, equal.samples > curve.back().samples || equal.samples < 16 ? "~" : "",
                    equal.samples, equal.microseconds, equal.microseconds / microseconds, uniform / microseconds);
        totals[s].ours += microseconds * texels;
        totals[s].sobol += equal.microseconds * texels;
        totals[s].uniform += uniform * texels;
    }
    std::fflush(stdout);
}

/// Geometric means over scenes of the ratios of their totals.
void print_means(const std::vector<std::vector<Totals>>& scenes) {
    if (scenes.empty()) return;
    std::printf(
        "\n| geometric mean over %zu scenes from files | speed-up over Sobol-Owen | over uniform rays "
        "|\n|---|--:|--:|\n",
        scenes.size());
    for (size_t s = 0; s < std::size(all_settings); ++s) {
        double sobol = 0, uniform = 0;
        for (const std::vector<Totals>& scene : scenes) {
            sobol += std::log(scene[s].sobol / scene[s].ours) / static_cast<double>(scenes.size());
            uniform += std::log(scene[s].uniform / scene[s].ours) / static_cast<double>(scenes.size());
        }
        std::printf("| %s | %.1f | %.0f |\n", all_settings[s].name, std::exp(sobol), std::exp(uniform));
    }
}

bool read_options(int argc, char** argv, Options& options) {
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (!name.starts_with("--")) {
            options.scenes.push_back(name);
            continue;
        }
        if (i + 1 == argc) return false;
        const int value = std::atoi(argv[++i]);
        if (name == "--size") options.size = value;
        if (name == "--texels") options.texels = static_cast<size_t>(value);
        if (name == "--references") options.references = static_cast<size_t>(value);
        if (name == "--samples") options.most_samples = std::clamp(value, 64, 1 << 16);
    }
    return !options.scenes.empty();
}

}  // namespace
}  // namespace surimi

int main(int argc, char** argv) {
    surimi::Options options;
    if (!surimi::read_options(argc, argv, options)) {
        std::fputs(
            "usage: visibility_table [--size 512] [--texels 8192] [--references 1000] [--samples 16384]\n"
            "                        low|mid|high|leaf|million|FILE.glb ...\n",
            stderr);
        return 2;
    }
    surimi::set_thread_count(1);
    std::puts(
        "| scene, monitor | error | s | us / lit texel | rays / lit texel | RMSE | beyond | samples for that RMSE | "
        "their us | speed-up | over uniform |\n|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
    std::vector<std::vector<surimi::Totals>> from_files;
    for (const std::string& scene : options.scenes) {
        surimi::Job job;
        surimi::set_up(job, options, scene);
        std::vector<surimi::Totals> totals(std::size(surimi::all_settings));
        for (size_t m = 0; m < job.scene.monitors.size(); ++m)
            surimi::run_monitor(job, m, options, surimi::name_of(scene), totals);
        if (surimi::is_file(scene) && totals[0].ours > 0) from_files.push_back(totals);
    }
    surimi::print_means(from_files);
    return 0;
}
