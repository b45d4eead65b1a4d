// SPDX-License-Identifier: Apache-2.0
#include "baker/report/opening_view.h"

#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/preview/display.h"
#include "runtime/preview/render.h"
#include "runtime/scene/monitors.h"
#include "runtime/trace/ray_scene.h"

namespace surimi {
namespace {

constexpr int still_width = 960, still_height = 540;
constexpr int reduction_for_exposure = 4;

void find_baked_monitors(Scene& baked, const BakeFiles& files) {
    MonitorRequest request;
    for (const BakedMonitor& monitor : files.monitors) request.command_line.push_back({monitor.name, monitor.channel});
    try {
        find_monitors(baked, request);
    } catch (
        const Error&) {  // the glb was changed after the bake, which the page says: only the view is less well chosen
        baked.monitors.clear();
    }
}

std::vector<LitMonitor> as_the_scene_has_them(const Scene& scene) {
    std::vector<LitMonitor> lights;
    for (const Monitor& monitor : scene.monitors) lights.push_back({monitor.radiance, {}});
    return lights;
}

std::vector<uint8_t> still(const Lighting& lighting, const View& view, double exposure) {
    RenderSettings settings;
    settings.width = still_width;
    settings.height = still_height;
    settings.samples_per_side = 2;
    return encode_png(to_codes(displayed(render(lighting, view, settings, {}).pixels, Show::lit, exposure)));
}

}  // namespace

OpeningView open_view(Scene& baked, const BakeFiles& files, const std::vector<VisibilityMap>& pages, bool with_stills) {
    find_baked_monitors(baked, files);
    const RayScene rays(baked, Attach::everything);
    LightingSettings settings;
    const Lighting shadowed(baked, pages, rays, as_the_scene_has_them(baked), settings);
    OpeningView opening;
    opening.view = baked.cameras.empty()
                       ? frame_automatically(shadowed, static_cast<double>(still_width) / still_height)
                       : view_of(baked.cameras.front());
    RenderSettings small;
    small.width = still_width / reduction_for_exposure;
    small.height = still_height / reduction_for_exposure;
    small.samples_per_side = 1;
    opening.exposure = automatic_exposure(render(shadowed, opening.view, small, {}));
    if (!with_stills) return opening;
    settings.visibility = VisibilitySource::none;
    const Lighting unshadowed(baked, pages, rays, as_the_scene_has_them(baked), settings);
    opening.stills = {still(unshadowed, opening.view, opening.exposure),
                      still(shadowed, opening.view, opening.exposure)};
    return opening;
}

}  // namespace surimi
