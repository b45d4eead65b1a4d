// SPDX-License-Identifier: Apache-2.0
// What a study chooses, says, lists and draws.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "baker/study/axis.h"
#include "baker/study/labels.h"
#include "baker/study/plot.h"
#include "baker/study/reading.h"
#include "baker/study/table.h"
#include "baker/study/units.h"
#include "runtime/base/error.h"
#include "tests/support/random.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

Measurement point(double value, double seconds, double rmse) {
    Measurement m;
    m.setting = "E = " + std::to_string(value);
    m.value = value;
    m.seconds = seconds;
    m.rays = 10;
    m.rmse = rmse;
    m.p999 = m.largest = 3 * rmse;
    return m;
}

/// Ours is exact enough from 3 us on; random rays need a hundred times that; a map never arrives.
Study example() {
    Study study;
    study.series = {
        {automatic_id,
         "Surimi",
         "ours",
         Family::surimi,
         {point(0.02, 2e-6, 5e-3), point(0.004, 3e-6, 1e-3), point(0.002, 4e-6, 5e-4), point(0.001, 9e-6, 2e-4)}},
        {random_id,
         "random & <more>",
         "\"pairs\"",
         Family::sampling,
         {point(16, 1e-6, 1e-1), point(1600, 1e-4, 1e-2), point(160000, 1e-2, 1e-3)}},
        {"pcss", "PCSS", "", Family::approximation, {point(16, 1e-6, 0.2)}}};
    study.reference_error = 1e-4;
    study.reference_rays = 65536;
    study.texels = 500;
    study.blocks = 125;
    study.lit = 1'000'000;
    study.triangles = 12;
    study.width = study.height = 1024;
    study.monitors = 1;
    return study;
}

/// Are all tags closed in order, all attributes quoted, no '<' or bare '&' in text? Empty when so.
std::string fault_of_xml(const std::string& xml) {
    std::vector<std::string> open;
    size_t at = 0;
    while (at < xml.size()) {
        if (xml[at] == '&') {
            const size_t end = xml.find(';', at);
            if (end == std::string::npos || end - at > 6) return "a bare & in: " + xml.substr(at, 30);
        }
        if (xml[at++] != '<') continue;
        const size_t end = xml.find('>', at);
        if (end == std::string::npos) return "an open tag at the end";
        const std::string tag = xml.substr(at, end - at);
        if (tag.find('<') != std::string::npos) return "< in a tag: " + tag;
        if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return "an open quote: " + tag;
        const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
        if (tag[0] == '/') {
            if (open.empty() || "/" + open.back() != tag) return "closes nothing: " + tag;
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(name);
        }
        at = end + 1;
    }
    return open.empty() ? "" : "never closed: " + open.back();
}

TEST(StudyReport, TimesAnErrorTakesAreBetweenTheSettings) {
    const Study study = example();
    EXPECT_NEAR(*seconds_at(study.series[1], 1e-2), 1e-4, 1e-15);
    EXPECT_NEAR(*seconds_at(study.series[1], std::sqrt(1e-5)), 1e-3, 1e-12);  // half-way of the logarithms
    EXPECT_EQ(*seconds_at(study.series[1], 0.5), 1e-6);                       // the first setting is good enough
    EXPECT_FALSE(seconds_at(study.series[1], 1e-4));
    EXPECT_FALSE(seconds_at(study.series[2], 0.1));
    EXPECT_EQ(least_rmse(study.series[0]), 2e-4);
    EXPECT_TRUE(std::isinf(least_rmse({})));
}

TEST(StudyReport, RecommendsTheFinestErrorThatIsNearlyFree) {
    Study study = example();
    EXPECT_EQ(recommend(study).measurement.value, 0.002);  // 4/3 of the time of 0.004; 0.001 takes three times as much
    EXPECT_NEAR(recommend(study).map_seconds, 4, 1e-12);
    EXPECT_TRUE(recommend(study).is_kept);
    study.series[0].points[2].seconds = 5e-6;
    EXPECT_EQ(recommend(study).measurement.value, 0.004);
    study.series[0].points[1].p999 = 0.0041;  // a promise that was not kept is not recommended
    EXPECT_EQ(recommend(study).measurement.value, 0.002);
    study.series[0].points[2].rmse = 0.0011;  // nor one whose RMSE is more than half the error
    EXPECT_EQ(recommend(study).measurement.value, 0.001);
    EXPECT_TRUE(recommend(study).is_kept);
    for (Measurement& m : study.series[0].points) m.p999 = 0.5;
    EXPECT_EQ(recommend(study).measurement.value, 0.001);
    EXPECT_FALSE(recommend(study).is_kept);
    study.series.erase(study.series.begin());
    EXPECT_THROW(recommend(study), Error);
}

TEST(StudyReport, ReadsWhatThePlotShows) {
    const std::string text = reading(example(), "room.glb");
    EXPECT_NE(text.find("At an RMSE of 0.01 the fastest is Surimi (2.0 µs of CPU a texel)"), std::string::npos) << text;
    EXPECT_NE(text.find("uniform random rays 50 times that"), std::string::npos) << text;
    EXPECT_NE(text.find("more than"), std::string::npos) << text;  // at 0.0005, which random rays do not reach
    EXPECT_NE(text.find("PCSS (0.2)"), std::string::npos) << text;
    EXPECT_NE(text.find("surimi bake room.glb --error 0.002"), std::string::npos) << text;
    Study coarse = example();
    coarse.reference_error = 1e-3;
    EXPECT_NE(reading(coarse, "room.glb").find("too coarse to judge an RMSE of 0.0005"), std::string::npos);
}

TEST(StudyReport, SaysWhenOthersWin) {
    Study study = example();
    study.series[1].points[1].seconds = 1e-6;
    const std::string text = reading(study, "room.glb");
    EXPECT_NE(text.find("At an RMSE of 0.01 the fastest is random"), std::string::npos) << text;
    EXPECT_NE(text.find("the best of ours, Surimi, takes 2.0 times that"), std::string::npos) << text;
}

TEST(StudyReport, CsvHasOneRowForEachSetting) {
    std::istringstream csv(to_csv(example()));
    std::string row;
    std::set<std::string> rows;
    while (std::getline(csv, row)) {
        ASSERT_FALSE(row.empty());
        EXPECT_EQ(row.back(), '\r');
        EXPECT_EQ(std::count(row.begin(), row.end(), ','), 7) << row;
        EXPECT_EQ(std::count(row.begin(), row.end(), '"') % 4, 0) << row;
        rows.insert(row);
    }
    EXPECT_EQ(rows.size(), 9u);
    EXPECT_TRUE(rows.contains("\"random\",\"E = 1600.000000\",1600,0.0001,10,0.01,0.03,0.03\r"));
}

TEST(StudyReport, JsonHoldsTheSameNumbers) {
    const auto json = nlohmann::json::parse(to_json(example(), "room.glb"));
    EXPECT_EQ(json["techniques"].size(), 3u);
    EXPECT_EQ(json["techniques"][0]["points"][1]["rmse"], 1e-3);
    EXPECT_EQ(json["recommended"]["value"], 0.002);
    EXPECT_EQ(json["reference"]["rays"], 65536);
}

TEST(StudyReport, SvgIsWellFormedWhateverTheNames) {
    const Study study = example();
    const std::string svg = to_svg(study, "a <b> & \"c\"\x01");
    EXPECT_EQ(fault_of_xml(svg), "");
    EXPECT_NE(svg.find("<rect width=\"960\" height=\"640\" fill=\"#fff\"/>"), std::string::npos);  // for dark browsers
    EXPECT_NE(svg.find("random &amp; &lt;more>"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(svg, to_svg(study, "a <b> & \"c\"\x01"));
    EXPECT_EQ(fault_of_xml(to_svg({}, "empty")), "");
    Study zero = example();  // an exact series of no error cannot be drawn on this scale
    for (Measurement& m : zero.series[0].points) m.rmse = 0;
    EXPECT_EQ(fault_of_xml(to_svg(zero, "zero")), "");
}

TEST(StudyReport, TheXmlCheckFindsFaults) {
    EXPECT_NE(fault_of_xml("<a><b></a></b>"), "");
    EXPECT_NE(fault_of_xml("<a>x & y</a>"), "");
    EXPECT_NE(fault_of_xml("<a b=\"c></a>"), "");
    EXPECT_NE(fault_of_xml("<a>"), "");
}

TEST(StudyReport, LabelsDoNotOverlap) {
    Choice choice{{5}};
    for (int round = 0; round < 20; ++round) {
        std::vector<LabelledLine> lines(12);
        for (LabelledLine& line : lines) {
            for (int i = 0; i < 6; ++i) line.points.emplace_back(choice.between(0, 850), choice.between(0, 460));
            line.label_size = {choice.between(40, 170), 15};
        }
        const Box area{{0, 0}, {850, 460}};
        const std::vector<PlacedLabel> labels = place_labels(lines, area);
        ASSERT_EQ(labels.size(), lines.size());
        for (size_t i = 0; i < labels.size(); ++i) {
            EXPECT_GE(labels[i].box.low.x, 0);
            EXPECT_GE(labels[i].box.low.y, 0);
            EXPECT_LE(labels[i].box.high.x, 850);
            EXPECT_LE(labels[i].box.high.y, 460);
            for (size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(labels[i].box, labels[j].box)) << round;
        }
    }
}

TEST(StudyReport, AxesHaveTicksAtDecadesAndBetween) {
    const LogAxis axis = make_log_axis(0.9e-6, 2.5e-5, 100, 900);
    EXPECT_EQ(axis.at(0.9e-6), 100);
    EXPECT_NEAR(axis.at(2.5e-5), 900, 1e-9);
    int decades = 0, others = 0;
    double before = 0;
    for (const Tick& tick : ticks_of(axis)) {
        EXPECT_GT(tick.value, before);
        before = tick.value;
        ++(tick.is_decade ? decades : others);
    }
    EXPECT_EQ(decades, 2);  // 1e-6, 1e-5
    EXPECT_EQ(others, 10);  // 9e-7, 2 to 9e-6, 2e-5
    EXPECT_NEAR(make_log_axis(1, 1, 0, 1).high, std::sqrt(10.0), 1e-12);
}

TEST(StudyReport, TimesHaveTheUnitThatSuitsThem) {
    EXPECT_EQ(in_time_unit(0), "0 s");
    EXPECT_EQ(in_time_unit(3.24e-6), "3.2 µs");
    EXPECT_EQ(in_time_unit(0.99999e-3), "1.0 ms");
    EXPECT_EQ(in_time_unit(83.2), "83 s");
    EXPECT_EQ(in_time_unit(5e-10), "0.5 ns");
}

/// Kanikama's room on maps of 128 x 128.
struct Room {
    Scene scene = test::kanikama_room();
    StudySettings settings;
    Room() {
        settings.unwrap.width = settings.unwrap.height = 128;
        settings.texels = 40;
        settings.reference_rays = 1024;
        settings.seed = 2;
    }
};

TEST(StudyReport, ChoosesLitTexelsInWholeBlocks) {
    const Room room;
    const Atlas atlas = unwrap(room.scene, room.settings.unwrap, {});
    const std::vector<Texels> pages = {find_texels(room.scene, atlas)};
    const Selection chosen = choose_texels(room.scene, atlas, pages, 40, 1);
    EXPECT_EQ(chosen.texels.size(), 40u);
    EXPECT_GT(chosen.lit, chosen.lit_in_blocks);
    EXPECT_GE(chosen.block_count, 10u);
    size_t in_blocks = 0;
    for (size_t m = 0; m < room.scene.monitors.size(); ++m) {
        std::set<uint32_t> blocks;
        const Texels& subset = chosen.blocks[m][0];
        const auto block_of = [](uint32_t index) { return index / 128 / 8 * 16 + index % 128 / 8; };
        for (const Texel& texel : subset.texels) {
            blocks.insert(block_of(texel.index));
            EXPECT_FALSE(subset.triangles_of(texel).empty());
        }
        size_t expected = 0;
        for (const Texel& texel : pages[0].texels) expected += blocks.contains(block_of(texel.index)) ? 1 : 0;
        EXPECT_EQ(subset.texels.size(), expected);
        in_blocks += blocks.size();
    }
    EXPECT_EQ(in_blocks, chosen.block_count);
    const Selection all = choose_texels(room.scene, atlas, pages, 1'000'000, 1);
    EXPECT_LE(all.texels.size(), all.lit);
    EXPECT_EQ(all.lit_in_blocks, all.lit);
}

TEST(StudyReport, ValuesDoNotDependOnThreadsAndTheCountIsRestored) {
    const Room room;
    set_thread_count(1);
    const Study one = study(room.scene, room.settings, {});
    set_thread_count(2);
    const Study two = study(room.scene, room.settings, {});
    EXPECT_EQ(thread_count(), 2);
    set_thread_count(0);
    ASSERT_EQ(one.series.size(), two.series.size());
    ASSERT_EQ(one.series.size(), 12u);
    EXPECT_EQ(one.reference_error, two.reference_error);
    std::set<std::string> ids;
    for (size_t s = 0; s < one.series.size(); ++s) {
        ids.insert(one.series[s].id);
        ASSERT_FALSE(one.series[s].points.empty());
        for (size_t i = 0; i < one.series[s].points.size(); ++i) {
            const Measurement &a = one.series[s].points[i], &b = two.series[s].points[i];
            EXPECT_EQ(a.rmse, b.rmse) << one.series[s].id << a.setting;
            EXPECT_EQ(a.largest, b.largest);
            EXPECT_GT(a.seconds, 0);
            EXPECT_LE(a.rmse, 1);
        }
    }
    EXPECT_EQ(ids.size(), 12u);
    EXPECT_EQ(fault_of_xml(to_svg(one, "room")), "");
}

TEST(StudyReport, NothingLitIsAnError) {
    Room room;
    for (Monitor& monitor : room.scene.monitors)  // far above, facing up
        monitor.panels = {{{{0, 50, 0}, {0, 50, 1}, {1, 50, 1}, {1, 50, 0}}}};
    try {
        study(room.scene, room.settings, {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::nothing_to_bake);
    }
}

}  // namespace
}  // namespace surimi
