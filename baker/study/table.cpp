// SPDX-License-Identifier: Apache-2.0
#include "baker/study/table.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "baker/study/reading.h"

namespace surimi {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> family_names = {"surimi", "sampling", "approximation"};

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

Json json_of(const Measurement& m) {
    return {{"setting", m.setting}, {"value", m.value}, {"secondsPerTexel", m.seconds}, {"raysPerTexel", m.rays},
            {"rmse", m.rmse},       {"p999", m.p999},   {"largest", m.largest}};
}

}  // namespace

std::string to_csv(const Study& study) {
    std::string text = "technique,setting,value,seconds_per_texel,rays_per_texel,rmse,p999,largest\r\n";
    for (const Series& series : study.series)
        for (const Measurement& m : series.points)
            text += fmt::format("{},{},{:g},{:.4g},{:.5g},{:.4g},{:.4g},{:.4g}\r\n", quoted(series.id),
                                quoted(m.setting), m.value, m.seconds, m.rays, m.rmse, m.p999, m.largest);
    return text;
}

std::string to_json(const Study& study, const std::string& file_name) {
    Json techniques = Json::array();
    for (const Series& series : study.series) {
        Json points = Json::array();
        for (const Measurement& m : series.points) points.push_back(json_of(m));
        techniques.push_back({{"id", series.id},
                              {"label", series.label},
                              {"family", family_names[static_cast<size_t>(series.family)]},
                              {"notes", series.notes},
                              {"points", points}});
    }
    const Recommendation r = recommend(study);
    Json recommended = json_of(r.measurement);
    recommended["mapSeconds"] = r.map_seconds;
    recommended["isKept"] = r.is_kept;
    const Json json{{"version", 1},
                    {"generator", "surimi " SURIMI_VERSION},
                    {"scene", {{"file", file_name}, {"triangles", study.triangles}, {"monitors", study.monitors}}},
                    {"map", {{"width", study.width}, {"height", study.height}, {"pages", study.pages}}},
                    {"texels", {{"measured", study.texels}, {"blocks", study.blocks}, {"lit", study.lit}}},
                    {"reference", {{"rays", study.reference_rays}, {"rmsError", study.reference_error}}},
                    {"seed", study.seed},
                    {"recommended", recommended},
                    {"reading", reading(study, file_name)},
                    {"techniques", techniques}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace surimi
