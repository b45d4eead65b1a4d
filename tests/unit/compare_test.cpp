// SPDX-License-Identifier: Apache-2.0
#include "runtime/compare/compare.h"

#include <gtest/gtest.h>

#include <limits>

#include "runtime/base/error.h"
#include "runtime/base/parallel.h"

namespace surimi {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

template <class Color>
Image<Vec3f> painted(int width, int height, const Color& color) {
    Image<Vec3f> image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = Vec3f(color(x, y));
    return image;
}

/// Smooth and colourful; `bend` changes two of the channels.
Image<Vec3f> gradient(bool bend) {
    return painted(96, 64, [&](int x, int y) {
        const double u = (x + 0.5) / 96, v = (y + 0.5) / 64;
        return bend ? Vec3(u * u, v, 0.25 + 0.25 * (u + v)) : Vec3(u, v, 0.5 * (u + v));
    });
}

/// Squares of 8 pixels, and a dark bar on demand.
Image<Vec3f> board(bool with_bar) {
    return painted(96, 64, [&](int x, int y) {
        const Vec3 color = (x / 8 + y / 8) % 2 == 0 ? Vec3(0.8, 0.7, 0.2) : Vec3(0.1, 0.15, 0.6);
        return with_bar && x >= 40 && x < 44 ? 0.05 * color : color;
    });
}

TEST(Difference, OfIdenticalImagesIsZero) {
    const ImageDifference same = difference(board(true), board(true));
    EXPECT_EQ(same.rmse, 0);
    EXPECT_EQ(same.relative_mse, 0);
    EXPECT_EQ(same.mean_absolute, 0);
    EXPECT_EQ(same.largest, 0);
    EXPECT_EQ(same.p99, 0);
    EXPECT_EQ(same.not_finite, 0u);
}

TEST(Difference, HasTheValuesOfItsDefinitions_M28) {
    // Everything here is a sum of few powers of two: exact.
    Image<Vec3f> image(20, 10, Vec3f(1.5f)), reference(20, 10, Vec3f(1));
    ImageDifference shifted = difference(image, reference);
    EXPECT_EQ(shifted.rmse, 0.5);
    EXPECT_EQ(shifted.mean_absolute, 0.5);
    EXPECT_EQ(shifted.largest, 0.5);
    EXPECT_EQ(shifted.p99, 0.5);
    EXPECT_NEAR(shifted.relative_mse, 0.25 / 1.01, 1e-15);

    image = reference;
    image.at(7, 3) = {1, 1, -3};  // one channel of one pixel of 200, off by 4
    image.at(8, 3) = {1, 5, 1};   // another, later in reading order
    image.at(9, 3) = {1, 2, 1};
    const ImageDifference spot = difference(image, reference);
    EXPECT_NEAR(spot.rmse, std::sqrt(33.0 / 600), 1e-15);
    EXPECT_NEAR(spot.mean_absolute, 9.0 / 600, 1e-17);
    EXPECT_EQ(spot.largest, 4);
    EXPECT_EQ(spot.largest_x, 7);
    EXPECT_EQ(spot.largest_y, 3);
    EXPECT_EQ(spot.p99, 1) << "198 of 200 pixels differ by 1 or less";
}

TEST(Difference, IsSymmetricExceptWhereItIsRelative) {
    const ImageDifference ab = difference(gradient(true), gradient(false));
    const ImageDifference ba = difference(gradient(false), gradient(true));
    EXPECT_GT(ab.rmse, 0.1);
    EXPECT_EQ(ab.rmse, ba.rmse);
    EXPECT_EQ(ab.mean_absolute, ba.mean_absolute);
    EXPECT_EQ(ab.largest, ba.largest);
    EXPECT_EQ(ab.p99, ba.p99);
    EXPECT_NE(ab.relative_mse, ba.relative_mse);
}

TEST(Difference, LeavesOutWhatIsNotFiniteAndCountsIt) {
    Image<Vec3f> image(4, 3, Vec3f(0.5f)), reference(4, 3, Vec3f(0.25f));
    image.at(0, 0).y = nan;
    image.at(1, 0).x = infinity;
    reference.at(3, 2).z = -infinity;
    reference.at(0, 0).x = nan;
    const ImageDifference some = difference(image, reference);
    EXPECT_EQ(some.not_finite, 3u);
    EXPECT_EQ(some.rmse, 0.25);
    EXPECT_EQ(some.largest, 0.25);
    EXPECT_EQ(some.largest_x, 2);
    EXPECT_EQ(some.p99, 0.25);

    const Image<float> absolute = absolute_difference(image, reference);
    EXPECT_EQ(absolute.at(2, 0), 0.25f);
    EXPECT_TRUE(std::isnan(absolute.at(0, 0)) && std::isnan(absolute.at(1, 0)) && std::isnan(absolute.at(3, 2)));

    const ImageDifference none = difference(Image<Vec3f>(2, 2, Vec3f(nan)), Image<Vec3f>(2, 2));
    EXPECT_EQ(none.not_finite, 4u);
    EXPECT_EQ(none.rmse, 0);
    EXPECT_EQ(none.relative_mse, 0);
    EXPECT_EQ(difference({}, {}).rmse, 0);
}

TEST(Difference, OfTheLargestFloatsIsFinite) {
    const float most = std::numeric_limits<float>::max();
    const ImageDifference extremes = difference(Image<Vec3f>(3, 3, Vec3f(most)), Image<Vec3f>(3, 3, Vec3f(-most)));
    EXPECT_EQ(extremes.largest, 2.0 * most);
    EXPECT_NEAR(extremes.rmse / most, 2, 1e-12);
    EXPECT_TRUE(std::isfinite(extremes.relative_mse));
    EXPECT_EQ(absolute_difference(Image<Vec3f>(1, 1, Vec3f(most)), Image<Vec3f>(1, 1, Vec3f(-most))).at(0, 0), most);
}

TEST(Compare, RefusesImagesOfDifferentSizes) {
    const Image<Vec3f> wide(4, 3), tall(3, 4);
    const auto kind_and_text = [](const auto& call) {
        try {
            call();
        } catch (const Error& error) {
            return std::to_string(static_cast<int>(error.kind())) + " " + error.what();
        }
        return std::string("nothing thrown");
    };
    for (const std::string& text :
         {kind_and_text([&] { difference(wide, tall); }), kind_and_text([&] { flip(wide, tall); })}) {
        EXPECT_EQ(text.substr(0, 2), "2 ");
        EXPECT_NE(text.find("4 x 3 and 3 x 4"), std::string::npos) << text;
    }
    EXPECT_EQ(kind_and_text([&] { flip(wide, wide, 0.5); }).substr(0, 2), "2 ");
    EXPECT_EQ(kind_and_text([&] { flip(wide, wide, std::nan("")); }).substr(0, 2), "2 ");
}

TEST(Flip, OfIdenticalImagesIsZeroAndOfGreenAndBlueOne) {
    const Image<float> same = flip(board(true), board(true));
    EXPECT_EQ(mean(same), 0);
    // Black and white are not the extreme: d = 100^0.7 and D = 41.27657, so C = 0.95 + 0.05 (d - 0.4 D) / (0.6 D), and
    // nothing is a feature.
    for (const float value : flip(Image<Vec3f>(40, 30), Image<Vec3f>(40, 30, Vec3f(1))).pixels)
        EXPECT_NEAR(value, 0.9673792, 1e-6);
    const Image<float> largest = flip(Image<Vec3f>(40, 30, Vec3f(0, 1, 0)), Image<Vec3f>(40, 30, Vec3f(0, 0, 1)));
    for (const float value : largest.pixels) EXPECT_NEAR(value, 1, 1e-6);
}

/// The figures are those of the reference implementation, FLIP.h of github.com/NVlabs/flip at 1eb247c (version 1.6,
/// single precision), fed with these very floats. Ours was within 7e-6 of it here, and within 4e-6 (mean) and 1.2e-4
/// (any pixel) on photographs of 1920 x 1080; its rounding and its white point in 10 digits account for that.
TEST(Flip, AgreesWithTheReferenceImplementation_M28) {
    EXPECT_NEAR(mean(flip(gradient(true), gradient(false))), 0.36149928, 2e-5);
    EXPECT_NEAR(mean(flip(board(true), board(false))), 0.06637816, 2e-5);
    EXPECT_NEAR(mean(flip(board(true), board(false), 20)), 0.05144276, 2e-5);
    EXPECT_NEAR(mean(flip(board(true), board(false), 150)), 0.07352227, 2e-5);
}

TEST(Flip, DoesNotDependOnTheOrderOfItsImages) {
    EXPECT_EQ(flip(board(true), gradient(false)).pixels, flip(gradient(false), board(true)).pixels);
}

TEST(Flip, DoesNotDependOnBandsAndThreads) {
    // 300 rows are several bands. The image repeats every 16 rows, so rows far from the border repeat bit by bit; a
    // band with wrong neighbours would not.
    const auto rows = [](bool with_dot) {
        return painted(24, 304, [&](int x, int y) {
            return Vec3(x / 8 % 2 == 0 ? 0.8 : 0.1, y % 16 < 8 ? 0.6 : 0.3, with_dot && y % 16 == 3 ? 1 : 0.2);
        });
    };
    set_thread_count(1);
    const Image<float> one = flip(rows(true), rows(false));
    set_thread_count(0);
    const Image<float> all = flip(rows(true), rows(false));
    EXPECT_EQ(one.pixels, all.pixels);
    EXPECT_GT(mean(one), 0.01);
    for (int y = 32; y < 272 - 16; ++y)
        for (int x = 0; x < one.width; ++x) ASSERT_EQ(one.at(x, y), one.at(x, y + 16)) << x << " " << y;
}

TEST(Flip, ShowsWhatIsNotFiniteAsAScreenDoes) {
    Image<Vec3f> strange = board(false), shown = strange;
    strange.at(5, 5) = Vec3f(nan);
    shown.at(5, 5) = Vec3f(0);
    strange.at(50, 20) = Vec3f(infinity, 7, -infinity);
    shown.at(50, 20) = Vec3f(1, 1, 0);
    EXPECT_EQ(mean(flip(strange, shown)), 0);
    const Image<float> seen = flip(strange, board(false));
    EXPECT_GT(seen.at(5, 5), 0.1f) << "a NaN in the picture is an error that is seen";
    for (const float value : seen.pixels) ASSERT_TRUE(value >= 0 && value <= 1);
    EXPECT_EQ(flip(Image<Vec3f>(1, 1, Vec3f(nan)), Image<Vec3f>(1, 1)).at(0, 0), 0);
    EXPECT_TRUE(flip({}, {}).empty());
}

TEST(HeatMap, LightnessRisesEvenly) {
    Image<float> ramp(64, 1);
    for (int i = 0; i < 64; ++i) ramp.at(i, 0) = static_cast<float>(i);
    const Image<glm::u8vec3> colors = heat_map(ramp, 0, 63);
    const auto lightness = [](const glm::u8vec3& code) {  // CIE L*
        Vec3 linear;
        for (int c = 0; c < 3; ++c) {
            const double v = code[c] / 255.0;
            linear[c] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        }
        const double y = luminance(linear);
        return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
    };
    EXPECT_LT(lightness(colors.at(0, 0)), 1);
    EXPECT_GT(lightness(colors.at(63, 0)), 95);
    for (int i = 1; i < 64; ++i) {
        const double step = lightness(colors.at(i, 0)) - lightness(colors.at(i - 1, 0));
        EXPECT_GT(step, 0.5) << i;  // a third of the even step of 100 / 63
        EXPECT_LT(step, 2.4) << i;  // and half more; magma itself has 0.40 to 2.43
    }
}

TEST(HeatMap, ClampsAndShowsNoNumberAsBlack) {
    Image<float> values(6, 1);
    values.pixels = {-infinity, 0, nan, 1, 5, infinity};
    const auto colors = heat_map(values, 0, 1).pixels;
    EXPECT_EQ(colors[0], colors[1]);
    EXPECT_EQ(colors[2], colors[1]);
    EXPECT_EQ(colors[4], colors[3]);
    EXPECT_EQ(colors[5], colors[3]);
    EXPECT_NE(colors[1], colors[3]);
    for (const auto& color : heat_map(values, 1, 1).pixels) EXPECT_EQ(color, colors[1]);
    for (const auto& color : heat_map(values, 0, std::nan("")).pixels) EXPECT_EQ(color, colors[1]);
}

TEST(Compare, AMaskLeavesOutWhatItDoesNotCover) {
    const Image<Vec3f> reference(10, 10, Vec3f(0.5F));
    Image<Vec3f> image = reference;
    Image<uint8_t> mask(10, 10, 1);
    for (int x = 0; x < 10; ++x) image.at(x, 0) = Vec3f(9), mask.at(x, 0) = 0;
    image.at(3, 0) = Vec3f(nan);
    image.at(4, 5).y = 0.4F;
    const ImageDifference numbers = difference(image, reference, mask);
    EXPECT_EQ(numbers.compared, 90U);
    EXPECT_EQ(numbers.not_finite, 0U);
    EXPECT_NEAR(numbers.largest, 0.1, 1e-6);
    EXPECT_EQ(numbers.largest_y, 5);
    EXPECT_NEAR(numbers.rmse_of_channel.y, 0.1 / std::sqrt(90), 1e-6);
    EXPECT_EQ(numbers.rmse_of_channel.x, 0);
    EXPECT_EQ(numbers.p95, 0);
    EXPECT_NEAR(numbers.p99, 0.1, 1e-6);
    EXPECT_NEAR(mean(absolute_difference(image, reference), mask), 0.1 / 90, 1e-6);
    EXPECT_EQ(difference(image, reference, Image<uint8_t>(10, 10, 0)).compared, 0U);
    EXPECT_THROW(difference(image, reference, Image<uint8_t>(10, 9, 1)), Error);
}

TEST(Compare, PercentilesOfKnownDifferences) {
    const Image<Vec3f> reference(1000, 1);
    Image<Vec3f> image = reference;
    for (int x = 0; x < 1000; ++x) image.at(x, 0).z = static_cast<float>(x + 1);
    const ImageDifference numbers = difference(image, reference);
    EXPECT_EQ(numbers.p50, 500);
    EXPECT_EQ(numbers.p95, 950);
    EXPECT_EQ(numbers.p99, 990);
    EXPECT_EQ(numbers.p999, 999);
}

TEST(Compare, SignedDifferencesAreBlueOrOrange) {
    Image<Vec3f> image(5, 1, Vec3f(0.5F)), reference = image;
    image.pixels[0].x = 0.25F;
    image.pixels[2].y = 0.75F;
    image.pixels[3].z = nan;
    image.pixels[4] = Vec3f(infinity);
    const Image<float> values = signed_difference(image, reference);
    EXPECT_EQ(values.pixels[0], -0.25F);
    EXPECT_EQ(values.pixels[2], 0.25F);
    EXPECT_TRUE(std::isnan(values.pixels[3]));
    const Image<glm::u8vec3> shown = signed_heat_map(values, 0.25);
    EXPECT_GT(shown.pixels[0].b, shown.pixels[0].r);
    EXPECT_EQ(shown.pixels[1], glm::u8vec3(255));
    EXPECT_GT(shown.pixels[2].r, shown.pixels[2].b);
    EXPECT_EQ(shown.pixels[3], glm::u8vec3(0));
    EXPECT_EQ(signed_heat_map(values, 0).pixels[0], glm::u8vec3(0));
    EXPECT_EQ(signed_heat_map(Image<float>(1, 1, -infinity), 1).pixels[0], shown.pixels[0]);
}

}  // namespace
}  // namespace surimi
