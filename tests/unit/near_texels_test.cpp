// SPDX-License-Identifier: Apache-2.0
#include "baker/post/near_texels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random.h"

namespace surimi {
namespace {

/// A texel of one metre in the plane z = 0 that faces up.
TexelPlace texel(double x, double y, float visibility, uint32_t chart = 0) {
    return {.position = {x, y, 0}, .normal = {0, 0, 1}, .size = 1, .chart = chart, .visibility = visibility};
}

TEST(NearTexels, WeighByDistanceNormalAndChart_M62) {
    TexelPlace tilted = texel(0, 1.25, 0.5f);
    const double cosine = 0.8;
    tilted.normal = {0.6, 0, cosine};
    const NearTexels sources({texel(1, 0, 0.f), texel(-1.5, 0, 1.f, 1), tilted, texel(2, 0, 1.f), texel(2.5, 0, 1.f)});
    const auto falloff = [](double d) { return (1 - d * d / 4) * (1 - d * d / 4); };  // R = 2, twice the least distance
    const double own = falloff(1), other = falloff(1.5) / 4, bent = falloff(1.25) * (2 * cosine - 1);
    const auto mean = sources.mean(texel(0, 0, 1.f), 4);
    ASSERT_TRUE(mean);
    EXPECT_NEAR(*mean, (other + 0.5 * bent) / (own + other + bent), 1e-7);
}

TEST(NearTexels, TakeNothingFromBeyondTheRadius) {
    const NearTexels sources({texel(3, 0, 0.5f)});
    EXPECT_FALSE(sources.mean(texel(0, 0, 1.f), 2.9));
    EXPECT_EQ(sources.mean(texel(0, 0, 1.f), 3.1), 0.5f);
    EXPECT_FALSE(NearTexels({}).mean(texel(0, 0, 1.f), 10));
}

TEST(NearTexels, OfTheOtherSideGiveNothing) {
    TexelPlace back = texel(0.1, 0, 0.f, 1), corner = texel(0.1, 0, 0.f, 1);
    back.normal = {0, 0, -1};
    corner.normal = {1, 0, 0};
    EXPECT_FALSE(NearTexels({back, corner}).mean(texel(0, 0, 1.f), 4));
}

TEST(NearTexels, OfALayerAboveGiveNothing_M62) {
    TexelPlace above = texel(2, 0, 0.f, 1);
    above.position.z = 0.06;
    EXPECT_FALSE(NearTexels({above}).mean(texel(0, 0, 1.f), 4));
    above.position.z = 0.04;  // what float vertices and bent texels may be off
    EXPECT_TRUE(NearTexels({above}).mean(texel(0, 0, 1.f), 4));
}

TEST(NearTexels, OfTheNextFacetGiveWhereverTheyLieOnIt_M62) {
    const double angle = pi / 4;             // of an octagon
    for (const double sign : {-1.0, 1.0}) {  // convex and concave
        for (const double a : {0.1, 1.0, 2.0})
            for (const double b : {0.1, 1.0, 2.0}) {
                TexelPlace next = texel(b * std::cos(angle), 0, 0.5f, 1);
                next.position.z = -sign * b * std::sin(angle);
                next.normal = {sign * std::sin(angle), 0, std::cos(angle)};
                EXPECT_TRUE(NearTexels({next}).mean(texel(-a, 0, 1.f), 5)) << a << " " << b;
            }
    }
}

TEST(NearTexels, AtOnePlaceAreAveraged) {
    std::vector<TexelPlace> places;
    for (int i = 0; i < 12; ++i) places.push_back(texel(0, 0, i % 2 ? 1.f : 0.f));
    EXPECT_EQ(NearTexels(places).mean(texel(0, 0, 1.f), 1), 0.5f);
    EXPECT_EQ(NearTexels(places).mean(texel(1, 0, 1.f), 2), 0.5f);
    places.insert(places.end(), places.begin(), places.end());
    const auto mean = NearTexels(places).mean(texel(0, 0, 1.f), 1);
    ASSERT_TRUE(mean);
    EXPECT_TRUE(*mean > 0.4f && *mean < 0.6f) << *mean;
}

TEST(NearTexels, GiveTheSameInWhateverOrderTheyCome) {
    Random random{5};
    std::vector<TexelPlace> places;
    for (int i = 0; i < 400; ++i)
        places.push_back(texel(20 * random.next(), 20 * random.next(), static_cast<float>(random.next())));
    const NearTexels sources(places);
    std::ranges::reverse(places);
    std::swap(places[3], places[200]);
    const NearTexels others(places);
    size_t found = 0;
    for (int i = 0; i < 400; ++i) {
        const TexelPlace place = texel(20 * random.next(), 20 * random.next(), 1.f);
        const auto a = sources.mean(place, 2), b = others.mean(place, 2);
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        ++found;
        EXPECT_EQ(*a, *b);  // sums run by distance
    }
    EXPECT_GT(found, 300u);
}

}  // namespace
}  // namespace surimi
