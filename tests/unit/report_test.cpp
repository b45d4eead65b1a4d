// SPDX-License-Identifier: Apache-2.0
// Reports of bakes on disk.
#include "baker/report/report.h"

#include <gtest/gtest.h>

#include <zlib.h>

#include <functional>

#include "baker/report/codes.h"
#include "baker/report/difference.h"
#include "baker/report/opening_view.h"
#include "baker/report/scene_copy.h"
#include "baker/write/bake_files.h"
#include "runtime/base/error.h"
#include "runtime/base/random.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"
#include "runtime/scene/uri.h"
#include "tests/unit/baked_folder.h"

namespace surimi::test {
namespace {

/// What the page was given.
Json data_of(const std::string& page) {
    const std::string begin = "id=\"data\">";
    const size_t at = page.find(begin) + begin.size();
    return Json::parse(page.substr(at, page.find("</script>", at) - at));
}

Json report_of(const OutputPaths& paths, const std::vector<std::filesystem::path>& references = {}) {
    return data_of(make_report({paths.manifest_json, {}, {}, references}));
}

Image<glm::u8vec4> picture_of(const Json& uri) {
    return decode_image(*decode_data_uri(uri.get<std::string>()), "x.png");
}

std::vector<uint8_t> unpacked(std::vector<uint8_t> packed) {
    std::vector<uint8_t> bytes(64 << 20);
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    stream.next_in = packed.data();
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = bytes.data();
    stream.avail_out = static_cast<uInt>(bytes.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    bytes.resize(stream.total_out);
    inflateEnd(&stream);
    return bytes;
}

/// The places of all nulls, which is what JSON has for NaN.
std::vector<std::string> nulls_of(const Json& json, const std::string& place = "") {
    if (json.is_null()) return {place};
    std::vector<std::string> all;
    if (!json.is_structured()) return all;
    for (const auto& [key, value] : json.items())
        for (const std::string& one : nulls_of(value, place + "/" + key)) all.push_back(one);
    return all;
}

template <class Call>
ErrorKind kind_of(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.kind();
    }
    ADD_FAILURE() << "it did not throw";
    return ErrorKind::internal;
}

TEST(Report, OfABakeWithOneMonitorHasEveryPicture) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    const Json report = report_of(paths);
    EXPECT_EQ(report["complaints"], Json::array());
    ASSERT_EQ(report["pages"].size(), 1u);
    const Json& pictures = report["pages"][0]["pictures"];
    ASSERT_EQ(pictures.size(), 4u);
    for (const char* name : {"map", "error", "state", "atlas"}) {
        EXPECT_EQ(picture_of(pictures[name]).width, 48) << name;
        EXPECT_EQ(picture_of(pictures[name]).height, 48) << name;
    }
    EXPECT_EQ(nulls_of(report), (std::vector<std::string>{"/reference", "/study"}));
    EXPECT_EQ(*decode_data_uri(pictures["map"].get<std::string>()), *read_file(paths.pages[0].visibility_png));
    EXPECT_GT(report["view"]["exposure"], 0.0);
}

TEST(Report, PicturesAreTheEvidence) {
    RoomFile file(2);
    const OutputPaths paths = bake_to_disk(file);
    const BakeFiles files = find_bake(paths.manifest_json);
    const Evidence evidence = read_evidence(paths.pages[0].lightmaps_exr, files);
    const Json pictures = report_of(paths)["pages"][0]["pictures"];
    const auto errors = picture_of(pictures["error"]), states = picture_of(pictures["state"]);
    size_t measured = 0;
    for (size_t i = 0; i < evidence.texel_count(); ++i)
        for (int c = 0; c < 2; ++c) {
            const Evidence::OfMonitor& monitor = evidence.monitors[static_cast<size_t>(c)];
            EXPECT_EQ(states.pixels[i][c] % 8, static_cast<int>(evidence.at(i, *monitor.state)));
            const bool is_covered = evidence.at(i, *monitor.state) == 1;
            EXPECT_EQ(errors.pixels[i][c],
                      is_covered ? error_code(static_cast<double>(evidence.at(i, *monitor.error))) : 0);
            measured += is_covered;
        }
    EXPECT_GT(measured, 100u);
    for (const glm::u8vec4& pixel : states.pixels) EXPECT_EQ(pixel.z, 0);  // there is no third monitor
}

TEST(Report, OutlinesAndDensityLieOnCharts) {
    RoomFile file;
    const Json report = report_of(bake_to_disk(file));
    const auto atlas = picture_of(report["pages"][0]["pictures"]["atlas"]);
    const auto states = picture_of(report["pages"][0]["pictures"]["state"]);
    size_t sides = 0, inside = 0;
    for (size_t i = 0; i < atlas.pixels.size(); ++i) {
        if (states.pixels[i].x % 8 == 1) {
            EXPECT_GT(atlas.pixels[i].x, 0) << "a measured texel is on a chart";
        }
        sides += atlas.pixels[i].z > 0;
        inside += atlas.pixels[i].x > 0;
    }
    EXPECT_GT(sides, 50u);
    EXPECT_LT(sides, inside);
    EXPECT_EQ(report["atlas"]["charts"], 3);  // floor, plate, monitor
}

TEST(Report, IsTheSameForTheSameFiles) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    EXPECT_EQ(make_report({paths.manifest_json, {}, {}, {}}),
              make_report({paths.manifest_json.parent_path(), {}, {}, {}}));
}

TEST(Report, HostileNamesStayText) {
    RoomFile harmless, file(1, "</script><script>alert(1)</script><!--");
    const auto count = [](const std::string& text, const std::string& part) {
        size_t n = 0;
        for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
        return n;
    };
    const std::string expected = make_report({bake_to_disk(harmless).manifest_json, {}, {}, {}});
    const std::string page = make_report({bake_to_disk(file).manifest_json, {}, {}, {}});
    EXPECT_NE(page.find("alert(1)"), std::string::npos);
    for (const char* part : {"<script", "</script", "<!--"})
        EXPECT_EQ(count(page, part), count(expected, part)) << part;
}

TEST(Report, OfTwoPagesShowsBoth) {
    RoomFile file;
    BakeSettings settings = quick_settings();
    settings.unwrap.atlases = 2;
    const OutputPaths paths = bake_to_disk(file, settings);
    ASSERT_EQ(paths.pages.size(), 2u);
    const Json report = report_of(paths);
    ASSERT_EQ(report["pages"].size(), 2u);
    size_t charted = 0;
    for (const Json& page : report["pages"]) {
        EXPECT_EQ(page["pictures"].size(), 4u);
        const auto atlas = picture_of(page["pictures"]["atlas"]);
        charted += std::any_of(atlas.pixels.begin(), atlas.pixels.end(), [](const auto& p) { return p.x > 0; });
    }
    EXPECT_EQ(charted, 2u);
    const Image<Vec3f> first = read_map_exr(paths.pages[0].visibility_exr).visibility;
    EXPECT_EQ(kind_of([&] { report_of(paths, {paths.pages[0].visibility_exr}); }), ErrorKind::usage);
}

TEST(Report, WithoutItsLightmapsSaysSo) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    std::filesystem::remove(paths.pages[0].lightmaps_exr);
    const Json report = report_of(paths);
    EXPECT_EQ(report["pages"][0]["pictures"].size(), 2u);
    ASSERT_EQ(report["complaints"].size(), 1u);
    EXPECT_NE(report["complaints"][0].get<std::string>().find("room.lightmaps.exr"), std::string::npos);
}

TEST(Report, WithoutItsGlbHasPicturesOfTheMapAlone) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    std::filesystem::remove(paths.baked_glb);
    const Json report = report_of(paths);
    EXPECT_EQ(report["pages"][0]["pictures"].size(), 3u);
    EXPECT_FALSE(report.contains("scene"));
}

TEST(Report, NoticesFilesOfAnotherBake) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    VisibilityMap map = read_map_exr(paths.pages[0].visibility_exr);
    map.visibility.pixels[0].x = 0.5f;
    write_map_exr(paths.pages[0].visibility_exr, map);
    const Json report = report_of(paths);
    ASSERT_EQ(report["complaints"].size(), 1u);
    EXPECT_NE(report["complaints"][0].get<std::string>().find("is not the file that the bake wrote"),
              std::string::npos);
}

TEST(Report, ComparesWithAReference) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    const VisibilityMap map = read_map_exr(paths.pages[0].visibility_exr);
    VisibilityMap other = map;
    const float step = 0.125f;
    for (Vec3f& v : other.visibility.pixels) v.x = v.x >= 0.5f ? v.x - step : v.x + step;
    const auto reference = paths.manifest_json.parent_path() / "reference.exr";
    write_map_exr(reference, other);
    const Json report = report_of(paths, {reference});
    const Json& numbers = report["reference"]["channels"]["R"];
    EXPECT_NEAR(numbers["rmse"], step, 1e-3);  // the files hold half floats
    EXPECT_NEAR(numbers["p99"], step, 1e-3);
    EXPECT_EQ(numbers["shareBeyond"], 1.0);
    size_t sum = 0;
    for (const Json& n : numbers["histogram"]["texels"]) sum += n.get<size_t>();
    EXPECT_EQ(sum, numbers["texels"].get<size_t>());
    EXPECT_EQ(sum, report["manifest"]["texels"]["R"]["covered"].get<size_t>());
    const auto difference = picture_of(report["pages"][0]["pictures"]["difference"]);
    for (size_t i = 0; i < difference.pixels.size(); ++i)
        if (difference.pixels[i].x > 0) {
            EXPECT_EQ(difference.pixels[i].x > 128, map.visibility.pixels[i].x >= 0.5f) << i;
        }
}

TEST(Report, LightmapsAreAReferenceToo) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    const Json numbers = report_of(paths, {paths.pages[0].lightmaps_exr})["reference"]["channels"]["R"];
    EXPECT_LT(numbers["rmse"], 1e-3);  // its own: but for half floats
    EXPECT_GT(numbers["texels"], 100);
}

TEST(Report, RefusesReferencesThatDoNotFit) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    VisibilityMap small;
    small.visibility = Image<Vec3f>(8, 8, Vec3f(1));
    const auto reference = paths.manifest_json.parent_path() / "small.exr";
    write_map_exr(reference, small);
    EXPECT_EQ(kind_of([&] { report_of(paths, {reference}); }), ErrorKind::usage);
    EXPECT_EQ(kind_of([&] { report_of(paths, {"nowhere.exr"}); }), ErrorKind::scene);
}

TEST(Report, PicksUpAStudyBesideTheBake) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    write_text(paths.manifest_json.parent_path() / "study.json", R"({"techniques": []})");
    EXPECT_TRUE(report_of(paths)["study"].is_object());
    write_text(paths.manifest_json.parent_path() / "study.json", "nonsense");
    EXPECT_EQ(kind_of([&] { report_of(paths); }), ErrorKind::scene);
}

TEST(Report, ExplainsWhatItCannotFind) {
    const auto folder = test_folder();
    EXPECT_EQ(kind_of([&] { find_bake(folder); }), ErrorKind::scene);
    EXPECT_EQ(kind_of([&] { find_bake(folder / "no.visibility.json"); }), ErrorKind::scene);
    write_text(folder / "a.visibility.json", "{}");
    EXPECT_EQ(kind_of([&] { find_bake(folder); }), ErrorKind::scene);
    write_text(folder / "b.visibility.json", "{}");
    EXPECT_EQ(kind_of([&] { find_bake(folder); }), ErrorKind::usage);
}

TEST(Report, ReadsNoFilesFromElsewhere) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    Json manifest = Json::parse(text_of(paths.manifest_json));
    std::filesystem::rename(paths.baked_glb, paths.manifest_json.parent_path().parent_path() / "room.baked.glb");
    for (Json& output : manifest["outputs"])
        if (output["role"] == "bakedGlb") output["file"] = "../room.baked.glb";
    write_text(paths.manifest_json, manifest.dump());
    EXPECT_TRUE(find_bake(paths.manifest_json).baked_glb.empty());
}

TEST(ReportView, StillsAreDarkerWithShadows) {
    RoomFile file;
    const OutputPaths paths = bake_to_disk(file);
    const std::vector<VisibilityMap> maps{read_map_exr(paths.pages[0].visibility_exr)};
    Scene baked = read_gltf(paths.baked_glb);
    const OpeningView opening = open_view(baked, find_bake(paths.manifest_json), maps, true);
    const auto without = decode_image(opening.stills.unshadowed, "x.png"),
               with = decode_image(opening.stills.shadowed, "x.png");
    ASSERT_EQ(without.pixels.size(), with.pixels.size());
    size_t darker = 0;
    for (size_t i = 0; i < with.pixels.size(); ++i) {
        EXPECT_LE(with.pixels[i].x, without.pixels[i].x);
        darker += with.pixels[i].x + 20 < without.pixels[i].x;
    }
    EXPECT_GT(darker, with.pixels.size() / 100);
}

/// The copy of a room whose material has a texture of this many pixels a side.
struct CopiedRoom {
    RoomFile file;
    OutputPaths paths;
    SceneCopy copy;
    Json json;

    explicit CopiedRoom(int side) {
        Image<glm::u8vec3> noise(side, side);
        for (size_t i = 0; i < noise.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c) noise.pixels[i][c] = static_cast<uint8_t>(hash(3 * i + static_cast<size_t>(c)));
        file.json["images"] = {{{"bufferView", file.add_view(encode_png(noise))}, {"mimeType", "image/png"}}};
        file.json["textures"] = {{{"source", 0}}};
        for (Json& mesh : file.json["meshes"])
            mesh["primitives"][0]["attributes"]["TEXCOORD_0"] = file.add_floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
        file.json["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
        file.json["animations"] = Json::array();
        paths = bake_to_disk(file);
        copy = copy_scene(paths.baked_glb, read_gltf(paths.baked_glb));
        json = GlbFile(unpacked(copy.glb_gzip)).json;
    }
};

TEST(ReportScene, KeepsSmallTextures) {
    const CopiedRoom room(16);
    EXPECT_TRUE(room.copy.has_textures);
    EXPECT_FALSE(room.json.contains("animations"));
    for (const Json& material : room.json["materials"])
        EXPECT_TRUE(material["pbrMetallicRoughness"].contains("baseColorTexture"));
}

TEST(ReportScene, ReplacesLargeTexturesByTheirMean) {
    const CopiedRoom room(700);
    ASSERT_GT(std::filesystem::file_size(room.paths.baked_glb), most_texture_bytes);
    EXPECT_FALSE(room.copy.has_textures);
    EXPECT_LT(room.copy.bytes, 5000u);
    for (const Json& material : room.json["materials"]) {
        EXPECT_FALSE(material["pbrMetallicRoughness"].contains("baseColorTexture"));
        // Codes are even from 0 to 255: the integral of their linear values, 1.055 / 3.4.
        EXPECT_NEAR(material["pbrMetallicRoughness"]["baseColorFactor"][0], 0.3103, 0.003);
    }
    for (const Json& mesh : room.json["meshes"])
        EXPECT_FALSE(mesh["primitives"][0]["attributes"].contains("TEXCOORD_0"));
}

TEST(ReportScene, CarriesAPlaceForTheMapAndNotTheMap) {
    const CopiedRoom room(16);
    size_t carriers = 0;
    for (const Json& material : room.json["materials"]) {
        if (!material.contains("extras")) continue;
        const Json& texture = material["extensions"]["KHR_materials_clearcoat"]["clearcoatTexture"];
        EXPECT_EQ(texture["texCoord"], 1);
        const Json& image =
            room.json["images"][room.json["textures"][texture["index"].get<size_t>()]["source"].get<size_t>()];
        EXPECT_LT(room.json["bufferViews"][image["bufferView"].get<size_t>()]["byteLength"], 200);
        EXPECT_EQ(material["extras"]["visibilityMap"]["channels"][0], "Monitor_R");
        ++carriers;
    }
    EXPECT_GE(carriers, 1u);
}

}  // namespace
}  // namespace surimi::test
