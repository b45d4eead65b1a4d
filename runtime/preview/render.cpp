// SPDX-License-Identifier: Apache-2.0
#include "runtime/preview/render.h"

#include "runtime/preview/film.h"

namespace surimi {

Picture render(const Lighting& lighting, const View& view, const RenderSettings& settings, const Progress& progress,
               const std::function<void(const Picture&, int pass, int passes)>& on_pass) {
    Film film(settings.width, settings.height);
    const Shot shot{lighting, view, settings.show, Vec2(settings.width, settings.height)};
    const std::vector<Tile> tiles = tiles_of(settings.width, settings.height);
    const size_t monitors = lighting.scene.monitors.size();
    std::vector<MonitorCounts> counts(tiles.size() * monitors);  // a slot for each tile
    const int passes = settings.samples_per_side * settings.samples_per_side;
    for (int pass = 0; pass < passes; ++pass) {
        const Pass of_number = pass_of(settings, pass);
        Progress of_pass = progress;
        if (progress.report)
            of_pass.report = [&](std::string_view stage, double fraction) {
                progress.report(stage, (pass + fraction) / passes);
            };
        parallel_stage("picture", tiles.size(), 1, of_pass, [&](size_t begin, size_t end) {
            for (size_t t = begin; t < end; ++t)
                add_tile(shot, of_number, tiles[t], film, std::span(counts).subspan(t * monitors, monitors));
        });
        if (on_pass && pass + 1 < passes) on_pass(develop(film, pass + 1), pass + 1, passes);
    }
    Picture picture = develop(film, passes);
    picture.counts.resize(monitors);
    for (size_t i = 0; i < counts.size(); ++i) picture.counts[i % monitors] += counts[i];
    return picture;
}

}  // namespace surimi
