// SPDX-License-Identifier: Apache-2.0
// Times of what becomes of maps after their texels are measured, as Markdown: fill and gutters of every monitor of the
// given rooms, on maps of 1024 x 1024. Visibility is that of one ray a texel.
// Usage: fill_stages FILE.glb ...
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "baker/post/fill.h"
#include "baker/post/gutter.h"
#include "baker/texel/texel_surface.h"
#include "baker/unwrap/unwrap.h"
#include "runtime/base/error.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/gltf.h"
#include "runtime/scene/monitors.h"
#include "runtime/trace/ray_scene.h"

namespace {

using namespace surimi;

/// Wall and processor seconds since it was made.
class Timer {
  public:
    double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    double processor() const { return static_cast<double>(std::clock() - clock_) / CLOCKS_PER_SEC; }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::clock_t clock_ = std::clock();
};

Channel channel_of(const Scene& scene, const Atlas& atlas, const Texels& texels, const RayScene& rays, size_t monitor) {
    Channel channel{Image<float>(texels.width, texels.height, 1.f),
                    Image<TexelState>(texels.width, texels.height, TexelState::empty)};
    const Polygon& panel = scene.monitors[monitor].panels[0];
    const Vec3 target = (panel.corners[0] + panel.corners[2]) * 0.5, front = front_normal(panel);
    parallel_for(texels.texels.size(), 256, [&](size_t i) {
        const SurfacePoint point = TexelSurface(scene, atlas, texels, texels.texels[i]).center();
        const Vec3 way = target - point.position;
        const bool is_lit = glm::dot(way, point.normal) > 0 && glm::dot(way, front) < 0;
        const uint32_t index = texels.texels[i].index;
        channel.state.pixels[index] = is_lit ? TexelState::covered : TexelState::unlit;
        if (is_lit)
            channel.visibility.pixels[index] = rays.is_occluded(rays.ray_origin(point), target, monitor) ? 0.f : 1.f;
    });
    return channel;
}

void measure(const std::string& file) {
    Scene scene = read_gltf(file);
    find_monitors(scene, {});
    UnwrapSettings settings;
    settings.width = settings.height = 1024;
    settings.quality = UvQuality::draft;
    const Atlas atlas = unwrap(scene, settings, {});
    const Texels texels = find_texels(scene, atlas);
    const RayScene rays(scene);
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        const Channel channel = channel_of(scene, atlas, texels, rays, m);
        size_t lit = 0;
        for (const TexelState state : channel.state.pixels) lit += state == TexelState::covered;
        for (const bool in_space : {false, true}) {
            Channel filled = channel;
            const Timer filling;
            fill(scene, atlas, {&texels, 1}, {&filled, 1}, {.fills_in_space = in_space, .stitches_seams = false});
            const double wall = filling.wall(), processor = filling.processor();
            const Timer growing;
            grow_gutters(texels, filled, 1);
            grow_gutters(texels, filled, all_rings);
            std::printf("| %s | %s | %zu | %zu | %s | %.3f | %.3f | %.3f |\n", file.c_str(),
                        scene.monitors[m].name.c_str(), texels.texels.size(), lit, in_space ? "space" : "chart", wall,
                        processor, growing.wall());
        }
    }
}

}  // namespace

int main(int count, char** arguments) {
    std::printf(
        "| room | monitor | texels | lit | fill from | fill s | its processor s | gutters s |\n| - | - | - | - | - | - "
        "| - | - |\n");
    try {
        for (int i = 1; i < count; ++i) measure(arguments[i]);
    } catch (const Error& error) {
        std::fprintf(stderr, "fill_stages: %s\n", error.what());
        return 1;
    }
    return 0;
}
