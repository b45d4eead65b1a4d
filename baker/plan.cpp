// SPDX-License-Identifier: Apache-2.0
#include "baker/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "baker/texel/lift.h"
#include "runtime/scene/texture.h"

namespace surimi {
namespace {

std::string percent(double part, double whole) {
    const double value = whole > 0 ? 100 * part / whole : 0;
    return fmt::format("{:.{}f} %", value, value > 0 && value < 1 ? 2 : 0);
}

std::string percent(size_t part, size_t whole) {
    return percent(static_cast<double>(part), static_cast<double>(whole));
}

size_t masked_surfaces(const Scene& scene) {
    return static_cast<size_t>(std::ranges::count_if(
        scene.surfaces, [&](const Surface& surface) { return surface.casts && is_cutout(scene, surface); }));
}

/// Writes down a plan's stages in the order of bake().
class StageList {
  public:
    StageList(const Scene& scene, const BakeSettings& settings, const Preparation& preparation, Plan& plan)
        : scene_(scene), settings_(settings), preparation_(preparation), plan_(plan) {}

    void add_preparation() {
        const Atlas& atlas = preparation_.atlas;
        const std::string uv = atlas.is_existing ? "TEXCOORD_1 of the file is taken as it is, after a check"
                                                 : fmt::format("{} new charts", atlas.charts.size());
        add("unwrap", uv + (atlas.uv_reason.empty() ? "" : ": " + atlas.uv_reason),
            seconds_of(preparation_.costs, "unwrap"));
        add("texels", fmt::format("{} texels that {} triangles touch", plan_.texels, triangle_count(scene_)),
            seconds_of(preparation_.costs, "texels"));
        add("rays", "tree over all triangles", seconds_of(preparation_.costs, "rays"));
        const size_t masked = masked_surfaces(scene_);
        add_part("alpha filter", masked > 0,
                 masked > 0
                     ? fmt::format("{} of {} surfaces have alpha-masked materials", masked, scene_.surfaces.size())
                     : "every surface is opaque to rays, so none is asked for its texture");
        add_inside();
        add("silhouettes", silhouettes_reason(), seconds_of(preparation_.costs, "silhouettes"));
        add_lift();
        add("seams",
            fmt::format("edges on which charts meet, within {} surfaces and between them", scene_.surfaces.size()),
            seconds_of(preparation_.costs, "seams"))
            .runs = settings_.post.stitches_seams;
    }

    void add_monitor(size_t m, const PostSeconds& post) {
        const Monitor& monitor = scene_.monitors[m];
        const PlannedMonitor& planned = plan_.monitors[m];
        const Calibration& c = planned.calibration;
        const bool is_lit = planned.blocks.lit() > 0 || c.lit > 0;
        add("light from " + monitor.name, light_reason(planned), c.seconds).runs = is_lit;
        plan_.stages.back().rays = c.rays;
        if (is_lit) {
            add_method(c, TexelMethod::split, "exact splitting", "few silhouettes cross the monitor");
            add_method(c, TexelMethod::scanline, "scanlines", "many silhouettes cross the monitor");
            add_method(c, TexelMethod::monte_carlo, "Monte Carlo", monte_carlo_reason(planned));
        }
        add("fill " + monitor.name,
            fmt::format("{} of the map has no light of its own: gutters, and texels that face away",
                        percent(map_texels() - c.lit, map_texels())),
            post.fill);
        const bool fits = settings_.post.fit == Fit::bilinear;
        add("fit " + monitor.name,
            fits ? "values are fitted so that bilinear reads average to what is measured"
                 : "not asked for: --fit bilinear",
            post.fit)
            .runs = fits;
        const size_t pieces = preparation_.seams.pieces.size();
        add("seams " + monitor.name,
            !settings_.post.stitches_seams ? "turned off"
            : pieces > 0 ? fmt::format("{} pieces of edges on which charts meet are made to agree", pieces)
                         : "no two charts meet on an edge that is smooth",
            post.seams)
            .runs = pieces > 0;
    }

    void add_audit(size_t m, double seconds_per_texel) {
        const std::string name = "audit of " + scene_.monitors[m].name;
        if (settings_.audit == 0) {
            add(name, "not asked for: --audit N", 0).runs = false;
            return;
        }
        const double lit = plan_.monitors[m].calibration.lit;
        const double count = std::min(static_cast<double>(settings_.audit), lit);
        add(name, fmt::format("{:.0f} texels against 65536 rays each", count), count * seconds_per_texel);
    }

  private:
    PlannedStage& add(const std::string& stage, const std::string& why, double seconds) {
        return plan_.stages.emplace_back(PlannedStage{stage, true, why, seconds, 0, false});
    }
    PlannedStage& add_part(const std::string& stage, bool runs, const std::string& why) {
        return plan_.stages.emplace_back(PlannedStage{stage, runs, why, 0, 0, true});
    }

    void add_inside() {
        const ExposureCounts& exposure = preparation_.exposure;
        const bool runs = settings_.finds_inside && exposure.probes > 0;
        add("inside",
            !settings_.finds_inside ? "turned off"
            : runs ? fmt::format("{} texels are crossed by other surfaces: {} places probed, {} texels lie inside, "
                                 "{} in part",
                                 exposure.touched, exposure.probes, exposure.inside, exposure.partly)
                   : "nothing touches anything: no place is probed",
            seconds_of(preparation_.costs, "inside"))
            .runs = runs;
    }

    void add_lift() {
        size_t round = 0;
        for (const Surface& surface : scene_.surfaces)
            for (uint32_t t = 0; t < surface.triangles.size(); ++t) round += round_triangle(surface, t) ? 1 : 0;
        const bool runs = settings_.gather.lifts_smooth && round > 0;
        add_part("terminator", runs,
                 !settings_.gather.lifts_smooth ? "turned off"
                 : runs                         ? fmt::format("{} triangles are coarser than their shading", round)
                                                : "no triangle is coarser than its shading");
    }

    double map_texels() const { return static_cast<double>(plan_.width) * plan_.height * plan_.pages; }

    std::string silhouettes_reason() const {
        size_t with_silhouettes = 0, lit = 0;
        for (const PlannedMonitor& monitor : plan_.monitors) {
            with_silhouettes += monitor.blocks.silhouettes + monitor.blocks.crowded;
            lit += monitor.blocks.lit();
        }
        return fmt::format("{} edges; {} of the blocks that a monitor may light have some in the way",
                           preparation_.silhouettes.edges.size(), percent(with_silhouettes, lit));
    }

    static std::string light_reason(const PlannedMonitor& planned) {
        const BlockCounts& blocks = planned.blocks;
        if (blocks.lit() == 0 && !(planned.calibration.lit > 0)) return "nothing faces the monitor: not traced";
        const std::string faced = fmt::format("faces {} of the blocks", percent(blocks.lit(), blocks.seen));
        if (blocks.open == blocks.lit()) return faced + "; never blocked: no silhouettes, one ray for a texel";
        if (blocks.hidden == blocks.lit()) return faced + "; all of them are hidden by one facet: one ray for a block";
        std::string text = faced + "; of those";
        const auto append = [&](size_t count, const char* what) {
            if (count > 0)
                text += fmt::format("{} {} {}", text.ends_with("those") ? "" : ",", percent(count, blocks.lit()), what);
        };
        append(blocks.hidden, "hidden by one facet");
        append(blocks.open, "open");
        append(blocks.silhouettes, "need silhouettes");
        append(blocks.cutouts, "need rays because of cutouts");
        append(blocks.crowded, "are left to rays");
        return text;
    }

    std::string monte_carlo_reason(const PlannedMonitor& planned) const {
        if (settings_.gather.method == Method::monte_carlo) return "asked for: --method mc";
        std::string text = "shadows sharper than a texel, and what stands on texels";
        if (planned.blocks.cutouts > 0) text += "; cutouts";
        if (planned.blocks.crowded > 0) text += "; blocks with very many silhouettes";
        if (planned.calibration.failed_checks > 0) text += "; cross-check rays that disagree";
        return text;
    }

    void add_method(const Calibration& c, TexelMethod method, const char* name, const std::string& why) {
        const Calibration::OfMethod& of = c.methods[static_cast<size_t>(method)];
        const bool runs = of.texels > 0;
        const std::string share = percent(of.texels, c.lit) + " of the lit texels";
        add_part(name, runs, runs ? share + ": " + why : "no sampled texel needs it").rays = of.rays;
    }

    const Scene& scene_;
    const BakeSettings& settings_;
    const Preparation& preparation_;
    Plan& plan_;
};

}  // namespace

double Plan::seconds() const {
    double sum = 0;
    for (const PlannedStage& stage : stages) sum += stage.seconds;
    return sum;
}

double Plan::rays() const {
    double sum = 0;
    for (const PlannedStage& stage : stages) sum += stage.is_part ? 0 : stage.rays;
    return sum;
}

Plan plan(const Scene& scene, const BakeSettings& settings, const Progress& progress) {
    check_memory_of_maps(scene, settings);
    const Preparation preparation = prepare(scene, settings, progress);
    const Atlas& atlas = preparation.atlas;
    Plan plan;
    plan.width = atlas.width;
    plan.height = atlas.height;
    plan.pages = atlas.pages;
    plan.texels_per_metre = atlas.texels_per_metre;
    for (const Texels& texels : preparation.texels) plan.texels += texels.texels.size();
    BakeSettings bounded = settings;
    bounded.gather.band_rows = rows_within_memory(scene, preparation, settings);
    plan.memory = planned_memory(scene, preparation, bounded);
    plan.warnings = preparation.warnings;
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        PlannedMonitor& monitor = plan.monitors.emplace_back();
        monitor.reach = find_reach(scene, preparation, m, settings.gather);
        for (const Reach& reach : monitor.reach) monitor.blocks.add(reach.blocks);
        monitor.calibration = calibrate(scene, preparation, m, settings.gather, progress);
    }
    StageList stages(scene, settings, preparation, plan);
    stages.add_preparation();
    const PostSeconds post = calibrate_post(scene, preparation, settings.post);
    for (size_t m = 0; m < scene.monitors.size(); ++m) {
        stages.add_monitor(m, post);
        stages.add_audit(m, settings.audit > 0 ? calibrate_audit(scene, preparation, m, settings.gather) : 0);
    }
    return plan;
}

}  // namespace surimi
