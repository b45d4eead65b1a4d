// SPDX-License-Identifier: Apache-2.0
#include "baker/export/export.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "baker/cli/export_options.h"
#include "baker/export/ltcgi_curve.h"
#include "baker/export/target_files.h"
#include "exported_room.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"

namespace surimi::test {
namespace {

using Names = std::vector<std::string>;

template <class Action>
ErrorKind error_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.kind();
    }
    ADD_FAILURE() << "nothing was thrown";
    return ErrorKind::internal;
}

Names all_targets() {
    Names names;
    for (const ExportTarget& target : export_targets()) names.push_back(target.name);
    return names;
}

float value_of(const Channels& channels, const std::string& name, size_t texel) {
    const auto found = std::find(channels.names.begin(), channels.names.end(), name);
    if (found == channels.names.end()) throw std::runtime_error("no channel " + name);
    const auto offset = static_cast<size_t>(found - channels.names.begin());
    return channels.values.at(texel * channels.names.size() + offset);
}

TEST(Export, EveryTargetHasItsFilesAndNothingElse) {
    const ExportedRoom room;
    EXPECT_EQ(room.write(all_targets()).size(), 28u);
    EXPECT_EQ(room.files(), (Names{"arealit/Editor/SurimiTextureImporter.cs",
                                   "arealit/README.md",
                                   "arealit/room.visibility-arealit.exr",
                                   "godot/README.md",
                                   "godot/room.baked.glb",
                                   "godot/room.surimi.json",
                                   "godot/room.visibility.exr",
                                   "godot/room.visibility.png",
                                   "godot/surimi.gdshader",
                                   "godot/surimi_apply.gd",
                                   "godot/surimi_import.gd",
                                   "godot/surimi_lights.gdshaderinc",
                                   "godot/surimi_lobes.bin",
                                   "kanikama/Editor/SurimiSetup.cs",
                                   "kanikama/Editor/SurimiTextureImporter.cs",
                                   "kanikama/README.md",
                                   "kanikama/SurimiVisibility.cs",
                                   "kanikama/room.surimi.json",
                                   "kanikama/room.visibility.exr",
                                   "ltcgi/Editor/SurimiSetup.cs",
                                   "ltcgi/Editor/SurimiTextureImporter.cs",
                                   "ltcgi/README.md",
                                   "ltcgi/SurimiVisibility.cs",
                                   "ltcgi/room.surimi.json",
                                   "ltcgi/room.visibility-ltcgi.exr",
                                   "three/README.md",
                                   "three/index.html",
                                   "three/room.baked.glb"}));
    for (const std::string& name : room.files()) EXPECT_GT(std::filesystem::file_size(room.place(name)), 100u) << name;
}

TEST(Export, KanikamaGetsTheMapAsItIs) {
    ExportedRoom room;
    room.show(Image<Vec3f>(3, 2, Vec3f(0.25f, 0.5f, 1)));
    room.write({"kanikama"});
    const Channels map = read_channels(room.place("kanikama/room.visibility.exr"));
    EXPECT_EQ(map.names.size(), 3u) << "BC6H has no fourth channel";
    EXPECT_EQ(value_of(map, "R", 5), 0.25f);
    EXPECT_EQ(value_of(map, "G", 5), 0.5f);
    EXPECT_EQ(value_of(map, "B", 5), 1.0f);
}

TEST(Export, AreaLitGetsAFourthChannelOfOne) {
    ExportedRoom room;
    room.show(Image<Vec3f>(3, 2, Vec3f(0.25f, 0.5f, 0)));
    room.write({"arealit"});
    const Channels map = read_channels(room.place("arealit/room.visibility-arealit.exr"));
    ASSERT_EQ(map.names.size(), 4u);
    EXPECT_EQ(value_of(map, "R", 5), 0.25f);
    EXPECT_EQ(value_of(map, "B", 5), 0.0f);
    EXPECT_EQ(value_of(map, "A", 5), 1.0f);
}

TEST(Export, ListsTellObjectsMonitorsAndProperties) {
    const ExportedRoom room;
    room.write({"kanikama", "ltcgi", "godot"});
    const Json list = Json::parse(room.text("kanikama/room.surimi.json"));
    EXPECT_EQ(list["texture"], "_Udon_LTC_VisibilityMap");
    EXPECT_EQ(list["scaleOffset"], "");
    EXPECT_EQ(list["maps"], Json({"room.visibility.exr"}));
    ASSERT_EQ(list["objects"].size(), 1u);
    EXPECT_EQ(list["objects"][0]["name"], "Wall");
    EXPECT_EQ(list["objects"][0]["st"], Json({1, 1, 0, 0}));
    EXPECT_TRUE(list["objects"][0]["primitives"].empty()) << "one map for all";
    EXPECT_EQ(list["monitors"][0]["channel"], 1);
    EXPECT_EQ(list["monitors"][0]["radiance"], Json({3.0, 2.0, 1.0}));
    const Json ltcgi = Json::parse(room.text("ltcgi/room.surimi.json"));
    EXPECT_EQ(ltcgi["texture"], "_Udon_LTCGI_Lightmap");
    EXPECT_EQ(ltcgi["scaleOffset"], "_Udon_LTCGI_LightmapST");
}

TEST(Export, UnityHasItsXMirrored) {
    const ExportedRoom room;
    room.write({"kanikama", "godot"});
    const Json unity = Json::parse(room.text("kanikama/room.surimi.json"))["quads"][0]["corners"];
    const Json gltf = Json::parse(room.text("godot/room.surimi.json"))["quads"][0]["corners"];
    EXPECT_EQ(gltf, Json({0.5, 0.0, 3.0, 0.5, 1.0, 3.0, 2.0, 1.0, 3.0, 2.0, 0.0, 3.0}));
    EXPECT_EQ(unity, Json({-0.5, 0.0, 3.0, -0.5, 1.0, 3.0, -2.0, 1.0, 3.0, -2.0, 0.0, 3.0}));
}

TEST(Export, SeveralMapsAreToldApartByPrimitive) {
    ExportedRoom room;
    room.add_page(Image<Vec3f>(4, 4, Vec3f(0.5f)));
    room.bake.atlas.surfaces[1].page = 1;
    room.write({"kanikama", "ltcgi", "arealit", "godot"});
    for (const char* name :
         {"kanikama/room.visibility.0.exr", "kanikama/room.visibility.1.exr", "ltcgi/room.visibility-ltcgi.1.exr",
          "arealit/room.visibility-arealit.1.exr", "godot/room.visibility.1.exr", "godot/room.visibility.1.png"})
        EXPECT_TRUE(std::filesystem::exists(room.place(name))) << name;
    EXPECT_EQ(value_of(read_channels(room.place("kanikama/room.visibility.1.exr")), "G", 0), 0.5f);
    const Json list = Json::parse(room.text("kanikama/room.surimi.json"));
    EXPECT_EQ(list["maps"], Json({"room.visibility.0.exr", "room.visibility.1.exr"}));
    ASSERT_EQ(list["objects"].size(), 2u);
    EXPECT_EQ(list["objects"][0]["map"], 0);
    EXPECT_EQ(list["objects"][0]["primitives"], Json({0}));
    EXPECT_EQ(list["objects"][1]["map"], 1);
    EXPECT_EQ(list["objects"][1]["primitives"], Json({1}));
}

TEST(Export, HostileNamesStayText) {
    const std::string name = "a/1\"\\\n</script>*{{uv}}";
    ExportedRoom room(name);
    room.scene.monitors[0].name = name;
    room.write(all_targets());
    for (const char* file : {"kanikama/room.surimi.json", "godot/room.surimi.json"}) {
        const Json list = Json::parse(room.text(file));
        EXPECT_EQ(list["objects"][0]["name"], name);
        EXPECT_EQ(list["monitors"][0]["name"], name);
    }
    EXPECT_NE(room.text("kanikama/README.md").find(R"(G = a/1"\\ \</script\>\*\{\{uv\}\})"), std::string::npos)
        << "no mark of Markdown, no new line, no mark of ours";
}

TEST(Export, ReadmesAreFilledInAndSayWhichModelFits) {
    ExportedRoom room;
    room.write(all_targets());
    for (const std::string& target : all_targets()) {
        const std::string readme = room.text(target + "/README.md");
        EXPECT_EQ(readme.find("{{"), std::string::npos) << target;
        EXPECT_NE(readme.find("G = Screen"), std::string::npos) << target;
        EXPECT_EQ(readme.find("# room in "), 0u) << target;
    }
    EXPECT_NE(room.text("kanikama/README.md").find("new UVs"), std::string::npos);
    room.bake.atlas.is_existing = true;
    room.write({"kanikama"});
    EXPECT_NE(room.text("kanikama/README.md").find("the lightmap UVs that the model had already"), std::string::npos);
}

TEST(Export, ThePageNamesItsModelAndEndsNoScript) {
    const ExportedRoom room("Wall", "a\"b <!-- c");
    room.write({"three"});
    const std::string page = room.text("three/index.html");
    EXPECT_NE(page.find("loadAsync(\"a\\\"b \\u003c!-- c.baked.glb\")"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(room.place("three/a\"b <!-- c.baked.glb")));
}

TEST(Export, GodotHasRoomForSixteenQuads) {
    ExportedRoom room;
    room.add_monitor("Curved", 2, most_godot_quads - 1);
    room.bake.evidence.resize(2);
    room.write({"godot"});
    const std::string shader = room.text("godot/surimi.gdshader");
    EXPECT_NE(shader.find("most_quads = " + std::to_string(most_godot_quads)), std::string::npos);
    room.add_monitor("One", 0);
    room.bake.evidence.resize(3);
    EXPECT_EQ(error_of([&] { room.write({"godot"}); }), ErrorKind::usage);
}

TEST(Export, SameBakeSameBytes) {
    const ExportedRoom room;
    room.write(all_targets());
    Names first;
    for (const std::string& name : room.files()) first.push_back(room.text(name));
    room.write(all_targets());
    const Names names = room.files();
    ASSERT_EQ(first.size(), names.size());
    for (size_t i = 0; i < names.size(); ++i) EXPECT_EQ(first[i], room.text(names[i])) << names[i];
}

TEST(Export, WhatIsMissingStopsItBeforeAnythingIsWritten) {
    const ExportedRoom room;
    room.write({});
    std::filesystem::remove(room.out / "room.visibility.exr");
    std::vector<std::string> warnings;
    EXPECT_EQ(error_of([&] { export_bake(room.out, {"kanikama"}, warnings); }), ErrorKind::scene);
    EXPECT_TRUE(room.files().empty());
    EXPECT_EQ(error_of([&] { export_bake(room.folder, {"kanikama"}, warnings); }), ErrorKind::scene);
}

TEST(Export, WhatWasChangedSinceTheBakeIsSaid) {
    const ExportedRoom room;
    room.write({});
    std::ofstream(room.out / "room.visibility.png", std::ios::app) << "more";
    std::vector<std::string> warnings;
    export_bake(room.out, {"kanikama"}, warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("room.visibility.png"), std::string::npos);
}

TEST(Export, AFileWhereTheFolderShouldBeIsAnError) {
    const ExportedRoom room;
    room.write({});
    std::ofstream(room.out / "export") << "in the way";
    std::vector<std::string> warnings;
    EXPECT_EQ(error_of([&] { export_bake(room.out, {"kanikama"}, warnings); }), ErrorKind::cannot_write);
}

TEST(Export, AFolderInTheWayLeavesNoneOfTheFiles) {
    const ExportedRoom room;
    room.write({});
    std::filesystem::create_directories(room.place("three/index.html"));
    std::vector<std::string> warnings;
    EXPECT_EQ(error_of([&] { export_bake(room.out, {"kanikama", "three"}, warnings); }), ErrorKind::cannot_write);
    EXPECT_TRUE(room.files().empty()) << "not those of the first target either, and nothing temporary";
}

TEST(Export, UnknownTargetsNameTheNearest) {
    try {
        parse_export_targets({"three", "goddot"}, "--export");
        FAIL() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_NE(std::string(error.what()).find("\"goddot\"; did you mean godot?"), std::string::npos);
    }
    EXPECT_EQ(parse_export_targets({"three", "ltcgi", "three"}, "--export"), (Names{"ltcgi", "three"}));
}

/// All halves in [0, 1], twice as many places as there are steps of 8 bits.
Image<Vec3f> all_halves() {
    Image<Vec3f> map(128, 121, Vec3f(1));
    for (size_t bits = 0; bits <= 0x3C00; ++bits) {
        const auto fraction = static_cast<float>(bits & 0x3FF) / 1024;
        const int exponent = static_cast<int>(bits >> 10);
        map.pixels[bits].y = exponent > 0 ? std::ldexp(1 + fraction, exponent - 15) : std::ldexp(fraction, -14);
    }
    return map;
}

/// LTCGI's own words: what it skips, and what it multiplies with.
double shown_by_ltcgi(double map) {
    if (map < 0.001) return 0;
    const double x = std::clamp(std::clamp(map - 0.1, 0.0, 1.0) / 0.3, 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

TEST(Export, LtcgiShowsTheVisibilityOfTheMap_M69) {
    ExportedRoom room;
    const Image<Vec3f> map = all_halves();
    room.show(map);
    room.write({"ltcgi"});
    const Channels file = read_channels(room.place("ltcgi/room.visibility-ltcgi.exr"));
    double before = 0;
    for (size_t bits = 0; bits <= 0x3C00; ++bits) {
        const auto visibility = static_cast<double>(map.pixels[bits].y);
        const auto stored = static_cast<double>(value_of(file, "G", bits));
        const double shown = shown_by_ltcgi(stored), x = std::clamp((stored - 0.1) / 0.3, 0.0, 1.0);
        // Half a step of a half, by the slope of the curve there and by its bend, 6 at most (M69).
        const double step = std::ldexp(0.5, std::ilogb(stored) - 10) / 0.3;
        EXPECT_LE(std::abs(shown - visibility), 6 * x * (1 - x) * step + 3 * step * step) << visibility;
        EXPECT_LE(std::abs(shown - visibility), 1.5 / 0.3 * 0x1p-13);
        EXPECT_GE(stored, before) << "no step back";
        before = stored;
    }
    EXPECT_EQ(shown_by_ltcgi(static_cast<double>(value_of(file, "G", 0))), 0.0);
    EXPECT_EQ(shown_by_ltcgi(static_cast<double>(value_of(file, "G", 0x3C00))), 1.0);
    EXPECT_EQ(value_of(file, "R", 0), value_of(file, "G", 0x3C00)) << "no light in this channel: 1";
}

TEST(Export, LtcgisFilterComesBeforeItsCurve_M69) {
    double worst = 0;
    for (int i = 0; i <= 64; ++i)
        for (int j = 0; j <= 64; ++j)
            for (int k = 0; k <= 64; ++k) {
                const double a = i / 64.0, b = j / 64.0, share = k / 64.0;
                const double read = (1 - share) * ltcgi_map_value(a) + share * ltcgi_map_value(b);
                worst = std::max(worst, std::abs(ltcgi_factor(read) - ((1 - share) * a + share * b)));
            }
    EXPECT_LE(worst, 0.125 + 1e-3) << "the ends are moved by half a step";
    EXPECT_GT(worst, 0.12) << "and so much it is";
}

TEST(Export, LtcgisCurveIsDefinedEverywhere_M69) {
    EXPECT_EQ(ltcgi_factor(ltcgi_map_value(-1)), 0.0);
    EXPECT_EQ(ltcgi_factor(ltcgi_map_value(2)), 1.0);
    EXPECT_EQ(ltcgi_factor(ltcgi_map_value(NAN)), 1.0);
    for (const double v : {1e-300, 1e-12, 1e-6, 0.5, 1 - 1e-6, 1 - 1e-15}) {
        EXPECT_NEAR(ltcgi_factor(ltcgi_map_value(v)), v, 1e-14) << v;
    }
}

}  // namespace
}  // namespace surimi::test
