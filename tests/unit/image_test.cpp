// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "runtime/base/color.h"
#include "runtime/base/error.h"
#include "runtime/image/image_file.h"
#include "runtime/map/map_file.h"

namespace surimi {
namespace {

std::filesystem::path scratch(const std::string& name) {
    const auto folder = std::filesystem::temp_directory_path() / "surimi_image_test";
    std::filesystem::create_directories(folder);
    return folder / name;
}

/// A map in which no two texels, rows, columns or channels are alike.
VisibilityMap asymmetric_map(int width, int height) {
    VisibilityMap map;
    map.visibility = Image<Vec3f>(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            map.visibility.at(x, y) = Vec3f(static_cast<float>(x) / static_cast<float>(width),
                                            static_cast<float>(y) / static_cast<float>(2 * height),
                                            static_cast<float>(x + y) / static_cast<float>(4 * (width + height)));
    return map;
}

TEST(MapFile, ExrComesBackToHalfPrecision) {
    const VisibilityMap map = asymmetric_map(17, 9);
    write_map_exr(scratch("map.exr"), map);
    const VisibilityMap back = read_map_exr(scratch("map.exr"));
    ASSERT_EQ(back.visibility.width, 17);
    ASSERT_EQ(back.visibility.height, 9);
    for (size_t i = 0; i < map.visibility.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)  // half an ulp of a half in [0.5, 1]
            EXPECT_NEAR(back.visibility.pixels[i][c], map.visibility.pixels[i][c], 0x1p-12);
}

TEST(MapFile, PngComesBackWithinHalfACode) {
    const VisibilityMap map = asymmetric_map(17, 9);
    const Image<glm::u8vec4> decoded = decode_image(encode_map_png(map), "map.png");
    const VisibilityMap back = map_from_image(decoded, true);
    for (size_t i = 0; i < map.visibility.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(srgb_from_linear(static_cast<double>(back.visibility.pixels[i][c])),
                        srgb_from_linear(static_cast<double>(map.visibility.pixels[i][c])), 0.5 / 255 + 1e-6);
}

TEST(MapFile, TheSameMapGivesTheSameBytes) {
    write_map_exr(scratch("a.exr"), asymmetric_map(33, 20));
    write_map_exr(scratch("b.exr"), asymmetric_map(33, 20));
    std::ifstream a(scratch("a.exr"), std::ios::binary), b(scratch("b.exr"), std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(a), {}), std::string(std::istreambuf_iterator<char>(b), {}));
    EXPECT_EQ(encode_map_png(asymmetric_map(33, 20)), encode_map_png(asymmetric_map(33, 20)));
}

TEST(MapFile, RefusesWhatIsNoMap) {
    write_exr(scratch("grey.exr"), {2, 1, {"Y"}, {0, 1}}, ExrDepth::half);
    EXPECT_THROW(read_map_exr(scratch("grey.exr")), Error);
    write_exr(scratch("bright.exr"), {1, 1, {"R", "G", "B"}, {0, 2, 0}}, ExrDepth::half);
    EXPECT_THROW(read_map_exr(scratch("bright.exr")), Error);
    write_exr(scratch("nan.exr"), {1, 1, {"R", "G", "B"}, {0, NAN, 0}}, ExrDepth::half);
    EXPECT_THROW(read_map_exr(scratch("nan.exr")), Error);
    EXPECT_THROW(read_map_exr(scratch("missing.exr")), Error);
}

TEST(ImageFile, NamedChannelsComeBack) {
    const Channels channels{2, 2, {"TV.shadowed", "TV.unshadowed", "state"}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
    write_exr(scratch("layers.exr"), channels, ExrDepth::full);
    const Channels back = read_channels(scratch("layers.exr"));
    for (size_t i = 0; i < channels.names.size(); ++i) {
        const auto found = std::find(back.names.begin(), back.names.end(), channels.names[i]);
        ASSERT_NE(found, back.names.end()) << channels.names[i];
        const auto j = static_cast<size_t>(found - back.names.begin());
        for (size_t p = 0; p < 4; ++p) EXPECT_EQ(back.values[p * 3 + j], channels.values[p * 3 + i]);
    }
}

TEST(ImageFile, DamagedBytesAreAnErrorNotACrash) {
    std::vector<uint8_t> png = encode_map_png(asymmetric_map(40, 40));
    EXPECT_THROW(decode_image({}, "empty.png"), Error);
    EXPECT_THROW(decode_image(std::span(png).first(30), "header.png"), Error);
    EXPECT_THROW(decode_image(std::span(png).first(png.size() / 2), "half.png"), Error);
    EXPECT_THROW(write_exr("/nonexistent/folder/x.exr", {1, 1, {"R"}, {0}}, ExrDepth::half), Error);
}

TEST(Srgb, InvertsAndClamps) {
    for (int code = 0; code < 256; ++code)
        EXPECT_EQ(srgb8(Vec3(linear_from_srgb(code / 255.0))), glm::u8vec3(static_cast<uint8_t>(code)));
    EXPECT_EQ(srgb_from_linear(-1), 0);
    EXPECT_EQ(srgb_from_linear(7), 1);
    EXPECT_EQ(srgb_from_linear(NAN), 0);
}

TEST(LookUp, IsBilinearAndClampsAtTheBorder) {
    VisibilityMap map;
    map.visibility = Image<Vec3f>(2, 2);
    map.visibility.at(1, 0) = Vec3f(1);
    EXPECT_EQ(look_up(map, {0.75, 0.25}), Vec3(1));  // the middle of the upper right texel
    EXPECT_EQ(look_up(map, {0.5, 0.25}), Vec3(0.5));
    EXPECT_EQ(look_up(map, {0.5, 0.5}), Vec3(0.25));
    EXPECT_EQ(look_up(map, {5, -3}), Vec3(1));
    EXPECT_EQ(look_up(map, {NAN, NAN}), Vec3(0));
}

}  // namespace
}  // namespace surimi
