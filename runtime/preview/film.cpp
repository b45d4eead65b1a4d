// SPDX-License-Identifier: Apache-2.0
#include "runtime/preview/film.h"

#include <algorithm>
#include <numeric>

#include "runtime/base/random.h"
#include "runtime/preview/see.h"

namespace surimi {
namespace {

/// Value below which 95 % of `values` lie; 0 when there are none.
double percentile_95(std::vector<float>& values) {
    if (values.empty()) return 0;
    const auto place = values.begin() + static_cast<ptrdiff_t>(values.size() * 95 / 100);
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place);
}

/// A step through n sub-pixels that is coprime with n and near its golden section, so that early passes spread.
int stride(int n) {
    for (int step = static_cast<int>(0.618 * n);; ++step)
        if (std::gcd(step, n) == 1) return step;
}

}  // namespace

std::vector<Tile> tiles_of(int width, int height, int size) {
    std::vector<Tile> tiles;
    for (int y = 0; y < height; y += size)
        for (int x = 0; x < width; x += size)
            tiles.push_back({x, y, std::min(size, width - x), std::min(size, height - y)});
    return tiles;
}

Pass pass_of(const RenderSettings& settings, int pass) {
    const int side = settings.samples_per_side, passes = side * side;
    const int cell = pass * stride(passes) % passes;
    return {Vec2((cell % side + 0.5) / side, (cell / side + 0.5) / side),
            hash(settings.seed, static_cast<uint64_t>(pass))};
}

void add_tile(const Shot& shot, const Pass& pass, const Tile& tile, Film& film, std::span<MonitorCounts> counts) {
    const double aspect = shot.pixels.x / shot.pixels.y;
    std::vector<SeenPoint> seen_points;
    for (int y = tile.y0; y < tile.y0 + tile.height; ++y)
        for (int x = tile.x0; x < tile.x0 + tile.width; ++x) {
            const size_t pixel = film.sum.index(x, y);
            const Vec3 direction = ray_direction(shot.view, (x + pass.offset.x) / shot.pixels.x,
                                                 (y + pass.offset.y) / shot.pixels.y, aspect);
            const Seen seen =
                see(shot.lighting, shot.view.eye, direction, shot.show, hash(pass.key, pixel), pixel, seen_points);
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
    shade(shot.lighting, points, reflected, counts);
    for (size_t i = 0; i < points.size(); ++i) {
        const Vec3 shown = shot.show == Show::diffuse    ? reflected[i].diffuse
                           : shot.show == Show::specular ? reflected[i].specular
                                                         : reflected[i].sum();
        film.sum.pixels[seen_points[i].pixel] += seen_points[i].weight * shown;
    }
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
    picture.lit_share =
        static_cast<double>(levels.size()) / static_cast<double>(std::max<size_t>(1, film.sum.pixels.size()));
    picture.bright_level = percentile_95(levels);
    return picture;
}

}  // namespace surimi
