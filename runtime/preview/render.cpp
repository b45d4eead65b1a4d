// SPDX-License-Identifier: Apache-2.0
#include "runtime/preview/render.h"

#include <algorithm>
#include <numeric>

#include "runtime/base/random.h"
#include "runtime/preview/see.h"

namespace surimi {
namespace {

constexpr int tile_size = 32;  // pixels: a batch of about a thousand points, whose arrays fit the second-level cache

/// Sums over the passes so far.
struct Film {
    Image<Vec3> sum;
    Image<float> roughness;         // sum over the samples that show a surface
    Image<uint16_t> rough_samples;  // how many those are
    Image<uint8_t> is_surface;      // some sample shows one
};

struct Tile {
    int x0, y0, width, height;
};

std::vector<Tile> tiles_of(int width, int height) {
    std::vector<Tile> tiles;
    for (int y = 0; y < height; y += tile_size)
        for (int x = 0; x < width; x += tile_size)
            tiles.push_back({x, y, std::min(tile_size, width - x), std::min(tile_size, height - y)});
    return tiles;
}

/// Adds one sample of every pixel of a tile: rays first, then all points that they see in one batch.
void add_tile(const Lighting& lighting, const View& view, const RenderSettings& settings, const Tile& tile,
              const Vec2& offset, uint64_t pass_key, Film& film, std::span<MonitorCounts> counts) {
    const double aspect = static_cast<double>(settings.width) / settings.height;
    std::vector<SeenPoint> seen_points;
    for (int y = tile.y0; y < tile.y0 + tile.height; ++y)
        for (int x = tile.x0; x < tile.x0 + tile.width; ++x) {
            const size_t pixel = film.sum.index(x, y);
            const Vec3 direction =
                ray_direction(view, (x + offset.x) / settings.width, (y + offset.y) / settings.height, aspect);
            const Seen seen =
                see(lighting, view.eye, direction, settings.show, hash(pass_key, pixel), pixel, seen_points);
            film.sum.pixels[pixel] += seen.color;
            if (seen.is_surface) film.is_surface.pixels[pixel] = 1;
            if (seen.roughness >= 0) {
                film.roughness.pixels[pixel] += static_cast<float>(seen.roughness);
                ++film.rough_samples.pixels[pixel];
            }
        }
    std::vector<ShadingPoint> points(seen_points.size());
    std::transform(seen_points.begin(), seen_points.end(), points.begin(), [](const SeenPoint& p) { return p.point; });
    std::vector<Parts> reflected(points.size());
    shade(lighting, points, reflected, counts);
    for (size_t i = 0; i < points.size(); ++i) {
        const Vec3 shown = settings.show == Show::diffuse    ? reflected[i].diffuse
                           : settings.show == Show::specular ? reflected[i].specular
                                                             : reflected[i].sum();
        film.sum.pixels[seen_points[i].pixel] += seen_points[i].weight * shown;
    }
}

/// Value below which 95 % of `values` lie; 0 when there are none.
double percentile_95(std::vector<float>& values) {
    if (values.empty()) return 0;
    const auto place = values.begin() + static_cast<ptrdiff_t>(values.size() * 95 / 100);
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place);
}

Picture develop(const Film& film, int passes) {
    Picture picture;
    picture.pixels = Image<Vec3f>(film.sum.width, film.sum.height);
    picture.roughness = Image<float>(film.sum.width, film.sum.height, -1);
    std::vector<float> levels;  // luminance of pixels that show a lit surface
    for (size_t i = 0; i < film.sum.pixels.size(); ++i) {
        const Vec3 mean = film.sum.pixels[i] / static_cast<double>(passes);
        picture.pixels.pixels[i] = Vec3f(mean);
        if (film.rough_samples.pixels[i] > 0)
            picture.roughness.pixels[i] = film.roughness.pixels[i] / static_cast<float>(film.rough_samples.pixels[i]);
        const auto level = static_cast<float>(luminance(mean));
        if (film.is_surface.pixels[i] && level > 0) levels.push_back(level);
    }
    picture.lit_share = static_cast<double>(levels.size()) / static_cast<double>(film.sum.pixels.size());
    picture.bright_level = percentile_95(levels);
    return picture;
}

/// A step through n sub-pixels that is coprime with n and near its golden section, so that early passes spread.
int stride(int n) {
    for (int step = static_cast<int>(0.618 * n);; ++step)
        if (std::gcd(step, n) == 1) return step;
}

}  // namespace

Picture render(const Lighting& lighting, const View& view, const RenderSettings& settings, const Progress& progress,
               const std::function<void(const Picture&, int pass, int passes)>& on_pass) {
    Film film{Image<Vec3>(settings.width, settings.height, Vec3(0)), Image<float>(settings.width, settings.height),
              Image<uint16_t>(settings.width, settings.height), Image<uint8_t>(settings.width, settings.height)};
    const std::vector<Tile> tiles = tiles_of(settings.width, settings.height);
    const size_t monitors = lighting.scene.monitors.size();
    std::vector<MonitorCounts> counts(tiles.size() * monitors);  // a slot for each tile
    const int side = settings.samples_per_side, passes = side * side, step = stride(passes);
    for (int pass = 0; pass < passes; ++pass) {
        const int cell = pass * step % passes;
        const Vec2 offset((cell % side + 0.5) / side, (cell / side + 0.5) / side);
        Progress of_pass = progress;
        if (progress.report)
            of_pass.report = [&](std::string_view stage, double fraction) {
                progress.report(stage, (pass + fraction) / passes);
            };
        const uint64_t pass_key = hash(settings.seed, static_cast<uint64_t>(pass));
        parallel_stage("picture", tiles.size(), 1, of_pass, [&](size_t begin, size_t end) {
            for (size_t t = begin; t < end; ++t)
                add_tile(lighting, view, settings, tiles[t], offset, pass_key, film,
                         std::span(counts).subspan(t * monitors, monitors));
        });
        if (on_pass && pass + 1 < passes) on_pass(develop(film, pass + 1), pass + 1, passes);
    }
    Picture picture = develop(film, passes);
    picture.counts.resize(monitors);
    for (size_t i = 0; i < counts.size(); ++i) picture.counts[i % monitors] += counts[i];
    return picture;
}

}  // namespace surimi
