// SPDX-License-Identifier: Apache-2.0
// A map with a letter in each corner, on every way that it takes into an engine.
#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "exported_room.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"

namespace surimi::test {
namespace {

/// Letters of 5 x 7 that no turn or mirror makes another of them or themselves.
struct Letter {
    std::string_view rows;  ///< 7 times 5
    int column, row;        ///< of its upper left texel
};
constexpr int side = 24;
constexpr std::array letters{
    Letter{"#####"
           "#...."
           "#...."
           "####."
           "#...."
           "#...."
           "#....",
           1, 1},  // F, upper left
    Letter{"####."
           "#...#"
           "#...#"
           "####."
           "#.#.."
           "#..#."
           "#...#",
           side - 6, 1},  // R, upper right
    Letter{"..###"
           "....#"
           "....#"
           "....#"
           "....#"
           "#...#"
           ".###.",
           1, side - 8},  // J, lower left
    Letter{".###."
           "#...#"
           "#...."
           "#.###"
           "#...#"
           "#...#"
           ".###.",
           side - 6, side - 8},  // G, lower right
};

bool is_ink(int x, int y) {
    for (const Letter& letter : letters) {
        const int column = x - letter.column, row = y - letter.row;
        if (column >= 0 && column < 5 && row >= 0 && row < 7)
            return letter.rows[static_cast<size_t>(row * 5 + column)] == '#';
    }
    return false;
}

/// Dark letters on light ground in G, the other way round in R.
Image<Vec3f> letter_map() {
    Image<Vec3f> map(side, side, Vec3f(0, 1, 1));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            if (is_ink(x, y)) map.pixels[map.index(x, y)] = Vec3f(1, 0, 1);
    return map;
}

/// Every texel, in the order of the file: x to the right, y down.
template <class ValueAt>
void expect_upright(const char* way, const ValueAt& value_at) {
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const Vec3 value = value_at(x, y);
            ASSERT_NEAR(value.x, is_ink(x, y) ? 1 : 0, 1e-6) << way << ' ' << x << ' ' << y;
            ASSERT_NEAR(value.y, is_ink(x, y) ? 0 : 1, 1e-6) << way << ' ' << x << ' ' << y;
        }
}

template <class Value>
void expect_exr_upright(const std::filesystem::path& path, const Value& value) {
    const Channels file = read_channels(path);
    const auto channel = [&](const char* name) {
        return static_cast<size_t>(std::find(file.names.begin(), file.names.end(), name) - file.names.begin());
    };
    const size_t r = channel("R"), g = channel("G");
    ASSERT_EQ(file.width, side);
    expect_upright(path.filename().c_str(), [&](int x, int y) {
        const size_t at = static_cast<size_t>(y * side + x) * file.names.size();
        return Vec3(value(file.values.at(at + r)), value(file.values.at(at + g)), 0);
    });
}

void expect_png_upright(const char* way, std::span<const uint8_t> bytes) {
    const Image<glm::u8vec4> image = decode_image(bytes, "x.png");
    ASSERT_EQ(image.width, side);
    expect_upright(way, [&](int x, int y) { return Vec3(image.pixels[image.index(x, y)]) / 255.0; });
}

TEST(ExportOrientation, LettersStandUprightOnEveryWay) {
    ExportedRoom room;
    room.show(letter_map());
    room.write({"kanikama", "ltcgi", "arealit", "godot", "three"});
    const auto as_it_is = [](float value) { return static_cast<double>(value); };
    expect_exr_upright(room.place("kanikama/room.visibility.exr"), as_it_is);
    expect_exr_upright(room.place("arealit/room.visibility-arealit.exr"), as_it_is);
    expect_exr_upright(room.place("godot/room.visibility.exr"), as_it_is);
    expect_exr_upright(room.place("ltcgi/room.visibility-ltcgi.exr"),
                       [](float value) { return value < 0.2f ? 0.0 : 1.0; });
    const std::string png = room.text("godot/room.visibility.png");
    expect_png_upright("godot png", {reinterpret_cast<const uint8_t*>(png.data()), png.size()});
    for (const char* name : {"three/room.baked.glb", "godot/room.baked.glb"}) {
        const std::string glb = room.text(name);
        const GlbFile file(std::span(reinterpret_cast<const uint8_t*>(glb.data()), glb.size()));
        ASSERT_EQ(file.json["images"].size(), 1u);
        expect_png_upright(name, file.view(file.json["images"][0]["bufferView"].get<size_t>()));
    }
}

/// glTF: (0, 0) of a texture is the image's upper left, v runs down.
TEST(ExportOrientation, TheBakedFilesUvsPointAtTheLettersTexels) {
    ExportedRoom room;
    room.show(letter_map());
    room.write({"three"});
    const Scene scene = read_gltf(room.place("three/room.baked.glb"));
    const VisibilityMap map = read_map_exr(room.out / "room.visibility.exr");
    const Letter& letter = letters[2];
    const Vec2 stem((letter.column + 4.5) / side, (letter.row + 3.5) / side);
    EXPECT_NEAR(look_up(map, stem).x, 1, 1e-6) << "of J, which only J has, in the lower half of the image";
    EXPECT_NEAR(look_up(map, Vec2(stem.x, 1 - stem.y)).x, 0, 1e-6);
    ASSERT_GE(scene.surfaces.at(0).uv_sets.size(), 2u);
    EXPECT_EQ(Vec2f(scene.surfaces[0].uv_sets[1][scene.surfaces[0].triangles[0][0]]), Vec2f(0.1f, 0.1f));
}

}  // namespace
}  // namespace surimi::test
