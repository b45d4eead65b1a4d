// SPDX-License-Identifier: Apache-2.0
#include "baker/write/evidence_sections.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "baker/evidence.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

/// Calls `section` for every monitor that has evidence, and stores what it returns under the monitor's channel.
template <class Section>
Json by_channel(const Scene& scene, const Bake& bake, const Section& section) {
    Json sections = Json::object();
    for (size_t m = 0; m < std::min(scene.monitors.size(), bake.evidence.size()); ++m)
        sections[std::string(1, "RGB"[scene.monitors[m].channel])] = section(bake.evidence[m]);
    return sections;
}

double ratio(size_t sum, size_t count) {
    return count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0;
}

Json promise_json(const MonitorEvidence& evidence, double error) {
    const Promise promise = promise_of(evidence, error);
    return {{"error", promise.error},
            {"shareAbove", promise.share_above},
            {"kept", promise.is_kept()},
            {"breaches", promise.breaches}};
}

Json histogram_json(const GatherStatistics& statistics) {
    Json below = Json::array({0});
    for (int bin = 1; bin < GatherStatistics::bins; ++bin)
        below.push_back(std::ldexp(1.0, bin - GatherStatistics::bins + 1));
    return {{"below", below}, {"texels", statistics.error_histogram}};
}

Json methods_json(const GatherStatistics& statistics) {
    Json methods = Json::object();
    for (size_t i = 0; i < statistics.methods.size(); ++i) {
        const GatherStatistics::OfMethod& method = statistics.methods[i];
        methods[name_of(static_cast<TexelMethod>(i))] = {
            {"texels", method.texels}, {"points", method.points}, {"rays", method.rays}};
    }
    return methods;
}

/// Candidates are sought in blocks that no facet hides, segments by points that split or scan.
Json work_json(const GatherStatistics& statistics) {
    const auto points = [&](TexelMethod method) { return statistics.methods[static_cast<size_t>(method)].points; };
    const size_t searched = statistics.blocks - std::min(statistics.blocks, statistics.shadowed_blocks);
    return {
        {"blocks", statistics.blocks},
        {"shadowedBlocks", statistics.shadowed_blocks},
        {"openBlocks", statistics.open_blocks},
        {"candidatesPerBlock", ratio(statistics.candidates, searched)},
        {"segmentsPerPoint", ratio(statistics.segments, points(TexelMethod::split) + points(TexelMethod::scanline))},
        {"failedChecks", statistics.failed_checks},
        {"refinedTexels", statistics.refined_texels}};
}

Json audit_json(const Audit& audit) {
    return {{"texels", audit.texels},
            {"rmse", audit.rmse},
            {"rmseInterval", {audit.rmse_low, audit.rmse_high}},
            {"beyond", audit.beyond},
            {"shareBeyondAtMost", audit.beyond_high},
            {"largest", audit.largest},
            {"referenceError", audit.reference_error}};
}

Json audits_json(const std::vector<Audit>& audits) {
    Json json = audit_json(joined_audit(audits));
    for (size_t page = 0; page < audits.size() && audits.size() > 1; ++page) {
        Json entry{{"page", page}};
        entry.update(audit_json(audits[page]));
        json["pages"].push_back(std::move(entry));
    }
    return json;
}

Json fit_json(const BilinearFit& fit) {
    return {{"texelsMoved", fit.texels},
            {"largestMove", fit.largest_move},
            {"rmsBefore", fit.rms_before},
            {"rmsAfter", fit.rms_after},
            {"rounds", fit.rounds}};
}

Json jumps_json(const Jumps& jumps) {
    return {{"largest", jumps.largest}, {"percentile99", jumps.percentile_99}};
}

Json seams_json(const StitchReport& seams) {
    return {{"pieces", seams.pieces},
            {"metres", seams.metres},
            {"texelsMoved", seams.texels},
            {"largestMove", seams.largest_move},
            {"jumpsBefore", jumps_json(seams.before)},
            {"jumpsAfter", jumps_json(seams.after)}};
}

}  // namespace

Json error_section(const Scene& scene, const Bake& bake) {
    Json section = Json::object();
    for (const Monitor& monitor : scene.monitors) {
        const EstimatedErrors errors = estimated_errors(bake, monitor.channel);
        section[std::string(1, "RGB"[monitor.channel])] = {
            {"mean", errors.mean}, {"rms", errors.rms}, {"max", errors.largest}};
    }
    return section;
}

Json evidence_section(const Scene& scene, const Bake& bake) {
    return by_channel(scene, bake, [&](const MonitorEvidence& evidence) {
        Json json{{"promise", promise_json(evidence, bake.error)},
                  {"errorHistogram", histogram_json(evidence.statistics)},
                  {"methods", methods_json(evidence.statistics)}};
        json.update(work_json(evidence.statistics));
        if (evidence.fit.rounds > 0) json["fit"] = fit_json(evidence.fit);
        json["seams"] = seams_json(evidence.seams);
        if (!evidence.audits.empty()) json["audit"] = audits_json(evidence.audits);
        return json;
    });
}

Json monitor_seconds_section(const Scene& scene, const Bake& bake) {
    return by_channel(scene, bake, [](const MonitorEvidence& evidence) {
        Json json{{"querySeconds", evidence.statistics.query_seconds}};
        for (size_t i = 0; i < evidence.statistics.methods.size(); ++i) {
            const GatherStatistics::OfMethod& method = evidence.statistics.methods[i];
            if (method.points == 0) continue;
            json["methods"][name_of(static_cast<TexelMethod>(i))] = {
                {"seconds", method.seconds},
                {"microsecondsPerPoint", method.seconds * 1e6 / static_cast<double>(method.points)}};
        }
        return json;
    });
}

}  // namespace surimi
