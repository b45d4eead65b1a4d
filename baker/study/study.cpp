// SPDX-License-Identifier: Apache-2.0
#include "baker/study/study.h"

#include "baker/study/techniques.h"
#include "runtime/base/error.h"
#include "runtime/base/random.h"

namespace surimi {
namespace {

constexpr double patience = 30;  // seconds for one setting

/// The thread that measures is the only one: what runs beside it would share its caches.
class OneThread {
  public:
    OneThread() : before_(thread_count()) { set_thread_count(1); }
    ~OneThread() { set_thread_count(before_); }
    OneThread(const OneThread&) = delete;
    OneThread& operator=(const OneThread&) = delete;

  private:
    int before_;
};

std::vector<Reference> trace_references(const Subject& subject, size_t rays, const Progress& progress) {
    const std::vector<StudiedTexel>& chosen = subject.selection.texels;
    std::vector<Reference> references(chosen.size());
    parallel_stage("reference", chosen.size(), 1, progress, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const TexelSurface surface = surface_of(subject, chosen[i]);
            const Receiver receiver{subject.monitors[chosen[i].monitor], surface, hash(~subject.seed, i)};
            references[i] = reference_visibility(receiver, rays);
        }
    });
    return references;
}

/// Drops texels that not one ray of a reference found lit: a sliver of the monitor above the horizon.
void drop_unlit(Selection& selection, std::vector<Reference>& references) {
    size_t kept = 0;
    for (size_t i = 0; i < references.size(); ++i) {
        if (!references[i].is_lit) continue;
        references[kept] = references[i];
        selection.texels[kept++] = selection.texels[i];
    }
    references.resize(kept);
    selection.texels.resize(kept);
    if (kept == 0)
        throw Error(ErrorKind::nothing_to_bake,
                    "no monitor lights any texel of the map; surimi inspect shows which way the monitors face");
}

std::vector<Series> measure_all(const Subject& subject, const RayScene& rays, const Progress& progress) {
    const OneThread one_thread;
    const double start = thread_seconds();
    const Silhouettes silhouettes = find_silhouettes(subject.scene, rays);
    std::vector<Technique> techniques = baker_techniques(silhouettes, thread_seconds() - start);
    for (Technique& technique : other_techniques()) techniques.push_back(std::move(technique));
    std::vector<Series> result;
    for (size_t i = 0; i < techniques.size(); ++i) {
        Series& series = result.emplace_back(techniques[i].series);
        for (const Trial& trial : techniques[i].trials) {
            if (progress.is_cancelled && progress.is_cancelled()) throw Error(ErrorKind::interrupted, "interrupted");
            if (progress.report)
                progress.report("measuring", static_cast<double>(i) / static_cast<double>(techniques.size()));
            const double trial_start = thread_seconds();
            series.points.push_back(trial.run(subject));
            series.points.back().setting = trial.setting;
            series.points.back().value = trial.value;
            if (thread_seconds() - trial_start > patience) break;  // the next setting takes longer still
        }
    }
    if (progress.report) progress.report("measuring", 1);
    return result;
}

}  // namespace

Study study(const Scene& scene, const StudySettings& settings, const Progress& progress) {
    const Atlas atlas = unwrap(scene, settings.unwrap, progress);
    std::vector<Texels> pages;
    for (int page = 0; page < atlas.pages; ++page) pages.push_back(find_texels(scene, atlas, page));
    const RayScene rays(scene);
    std::vector<StudiedMonitor> monitors;
    for (size_t m = 0; m < scene.monitors.size(); ++m) monitors.emplace_back(scene, rays, m);

    Selection selection = choose_texels(scene, atlas, pages, settings.texels, settings.seed);
    std::vector<Reference> references;
    const Subject subject{scene, atlas, selection, monitors, references, settings.seed};
    references = trace_references(subject, settings.reference_rays, progress);
    drop_unlit(selection, references);

    Study result;
    result.series = measure_all(subject, rays, progress);
    result.reference_error = reference_error(references);
    result.reference_rays = settings.reference_rays;
    result.texels = references.size();
    result.blocks = selection.block_count;
    result.lit = selection.lit;
    result.triangles = triangle_count(scene);
    result.width = atlas.width;
    result.height = atlas.height;
    result.pages = atlas.pages;
    result.monitors = monitors.size();
    result.seed = settings.seed;
    return result;
}

}  // namespace surimi
