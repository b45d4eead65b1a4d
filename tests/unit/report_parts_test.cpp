// SPDX-License-Identifier: Apache-2.0
// What a report is made of: text that cannot break out, codes, packed bytes, settings to type again.
#include <gtest/gtest.h>

#include <zlib.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "baker/cli/config_file.h"
#include "baker/cli/options.h"
#include "baker/report/codes.h"
#include "baker/report/gzip.h"
#include "baker/report/page.h"
#include "baker/report/settings_text.h"
#include "baker/report/text.h"
#include "runtime/scene/uri.h"
#include "tests/unit/baked_folder.h"

namespace surimi::test {
namespace {

using OrderedJson = nlohmann::ordered_json;

const std::string hostile = "</script><script>alert(1)</script><!-- & \" ' \xE2\x80\xA8";

size_t occurrences(const std::string& text, const std::string& part) {
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(ReportText, JsonInAScriptCannotEndIt) {
    const OrderedJson json{{"name", hostile}, {hostile, 1}};
    const std::string text = script_text(json);
    EXPECT_EQ(text.find_first_of("<>&"), std::string::npos);
    EXPECT_EQ(OrderedJson::parse(text), json);
}

TEST(ReportText, BrokenUtf8IsReplaced) {
    EXPECT_EQ(OrderedJson::parse(script_text({{"name", "a\xFF"}}))["name"], "a\xEF\xBF\xBD");
    EXPECT_EQ(html_text("a\xFF"), "a\xEF\xBF\xBD");
}

TEST(ReportText, HtmlHasNoMarkup) {
    EXPECT_EQ(html_text("<b a=\"'\">&"), "&lt;b a=&quot;&#39;&quot;&gt;&amp;");
}

TEST(ReportText, DataUrisGiveTheBytesBack) {
    for (size_t size = 0; size < 8; ++size) {
        std::vector<uint8_t> bytes;
        for (size_t i = 0; i < size; ++i) bytes.push_back(static_cast<uint8_t>(251 * i + 255));
        const std::string uri = data_uri("image/png", bytes);
        EXPECT_EQ(uri.rfind("data:image/png;base64,", 0), 0u);
        EXPECT_EQ(decode_data_uri(uri), bytes) << size;
    }
}

TEST(ReportPage, NeitherTitleNorDataBreakOut) {
    const std::string harmless = make_page("room", {{"name", "room"}});
    const std::string page = make_page(hostile, {{"name", hostile}});
    for (const char* part : {"<script", "</script", "<!--", "alert(1)</"})
        EXPECT_EQ(occurrences(page, part), occurrences(harmless, part)) << part;
    EXPECT_EQ(occurrences(harmless, "id=\"data\""), 1u);
}

TEST(ReportPage, AsksForNothingFromElsewhere) {
    const std::string page = make_page("room", {});
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
    for (const char* part : {" src=\"", "<link", "@import"}) EXPECT_EQ(page.find(part), std::string::npos) << part;
    EXPECT_LT(page.size(), 1'100'000u);  // the part of a report that is always there
}

TEST(ReportCodes, KeepErrorsByTheirLogarithm) {
    EXPECT_EQ(error_code(0), 1);
    EXPECT_EQ(error_code(1), 2 + steps_per_octave * error_octaves);
    EXPECT_EQ(error_code(2), error_code(1));
    EXPECT_EQ(error_code(std::exp2(-error_octaves)), 2);
    for (double error = 1; error > 1e-4; error *= 0.83) {
        const double octaves = (error_code(error) - 2.0) / steps_per_octave - error_octaves;
        EXPECT_NEAR(octaves, std::log2(error), 0.5 / steps_per_octave + 1e-9);
    }
}

TEST(ReportCodes, DifferencesAreSymmetric) {
    EXPECT_EQ(difference_code(0), 128);
    EXPECT_EQ(difference_code(std::exp2(-difference_octaves)), 129);
    EXPECT_EQ(difference_code(-1), 128 - 1 - steps_per_octave * difference_octaves);
    for (const double d : {1e-3, 0.02, 0.3}) EXPECT_EQ(difference_code(d) - 128, 128 - difference_code(-d));
}

TEST(ReportCodes, LinearOnesReachBothEnds) {
    EXPECT_EQ(linear_code(-1, 0, 2), 1);
    EXPECT_EQ(linear_code(1, 0, 2), 128);
    EXPECT_EQ(linear_code(5, 0, 2), 255);
    EXPECT_EQ(linear_code(NAN, 0, 2), 1);
    EXPECT_EQ(linear_code(1, 0, 0), 1);
}

TEST(ReportGzip, UnpacksToTheSame) {
    std::vector<uint8_t> bytes(100'000);
    for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<uint8_t>(i * i >> 5);
    const std::vector<uint8_t> packed = gzip(bytes);
    EXPECT_EQ(packed, gzip(bytes));
    z_stream stream{};
    ASSERT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    std::vector<uint8_t> back(bytes.size() + 1);
    std::vector<uint8_t> source = packed;
    stream.next_in = source.data();
    stream.avail_in = static_cast<uInt>(source.size());
    stream.next_out = back.data();
    stream.avail_out = static_cast<uInt>(back.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    back.resize(stream.total_out);
    inflateEnd(&stream);
    EXPECT_EQ(back, bytes);
}

BakeFiles files_with(const Config& config, const OrderedJson& monitors) {
    BakeFiles files;
    files.name = "my room";
    files.manifest = {{"scene", {{"file", "my room.glb"}}},
                      {"settings", OrderedJson::parse(settings_json(config))},
                      {"monitors", monitors}};
    return files;
}

TEST(ReportSettings, TheTomlGivesTheSameSettings) {
    Config config;
    config.bake.unwrap.width = 640;
    config.bake.unwrap.gutter = 3;
    config.bake.unwrap.quality = UvQuality::high;
    config.bake.unwrap.is_uniform = true;
    config.bake.gather.error = 0.0123;
    config.bake.audit = 77;
    config.bake.unwrap.texel_scales = {{"Wall \"east\"", "", 2.5}};
    config.roles.objects = {{"Glass*", {}}};
    config.roles.objects[0].roles.casts = false;
    const OrderedJson monitors{{{"channel", "G"}, {"name", "TV"}, {"node", 3}},
                               {{"channel", "R"},
                                {"name", "wall"},
                                {"node", nullptr},
                                {"radiance", {1, 2, 3}},
                                {"corners", {{{0, 0, 0}, {2, 0, 0}, {2, 4, 0}, {0, 4, 0}}}}}};
    const auto path = test_folder() / "my room.surimi.toml";
    write_text(path, toml_of(files_with(config, monitors)));
    Config back;
    read_config_file(path, back);
    EXPECT_EQ(settings_json(back), settings_json(config));
    ASSERT_EQ(back.monitors.config_nodes.size(), 1u);
    EXPECT_EQ(back.monitors.config_nodes[0].node, "TV");
    EXPECT_EQ(back.monitors.config_nodes[0].channel, 1);
    ASSERT_EQ(back.monitors.config_rectangles.size(), 1u);
    EXPECT_EQ(back.monitors.config_rectangles[0].rectangles[0].center, Vec3(1, 2, 0));
    EXPECT_EQ(back.monitors.config_rectangles[0].rectangles[0].half_v, Vec3(0, 2, 0));
    EXPECT_EQ(command_of(files_with(config, monitors)), "surimi bake 'my room.glb' --config 'my room.surimi.toml'");
}

TEST(ReportSettings, TheCommandIsSafeInAShell) {
    Config config;
    config.bake.unwrap.is_uniform = true;
    const OrderedJson monitors{{{"channel", "R"}, {"name", "it's; rm -rf $HOME"}, {"node", 1}}};
    const std::string command = command_of(files_with(config, monitors));
    EXPECT_NE(command.find("--monitor 'it'\\''s; rm -rf $HOME=R'"), std::string::npos) << command;
    EXPECT_NE(command.find("--size 1024 1024"), std::string::npos) << command;
    EXPECT_NE(command.find("--uniform"), std::string::npos) << command;
    EXPECT_EQ(command.find("--exact"), std::string::npos) << command;
}

TEST(ReportSettings, SecondsThatWereSpentAreNoSetting) {
    Config config;
    config.seconds = 30;
    const BakeFiles files = files_with(config, OrderedJson::array());
    EXPECT_EQ(toml_of(files).find("time"), std::string::npos);
    EXPECT_EQ(command_of(files).find("time"), std::string::npos);
    EXPECT_NE(command_of(files).find("--error 0.004"), std::string::npos);
}

}  // namespace
}  // namespace surimi::test
