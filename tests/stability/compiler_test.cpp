// SPDX-License-Identifier: Apache-2.0
// What compilers are known to get wrong, or may do by their flags, where the results would be silent (H31). CMake gives
// this file the optimisation of the product's code.
#include <gtest/gtest.h>

#include <limits>

#include "runtime/base/math.h"

namespace surimi {
namespace {

struct Numbers {
    double x, y, z;
};

/// GCC 12.2 drops these conversions at -O2, unless -fno-tree-slp-vectorize.
[[gnu::noinline]] Numbers through_float(Numbers n) {
    return {static_cast<double>(static_cast<float>(n.x)), static_cast<double>(static_cast<float>(n.y)),
            static_cast<double>(static_cast<float>(n.z))};
}

[[gnu::noinline]] Vec3 through_float(const Vec3& v) {
    return Vec3(Vec3f(v));
}

[[gnu::noinline]] double residue(double a, double b, double product) {
    return a * b - product;
}

[[gnu::noinline]] bool is_number(double x) {
    return x == x && !std::isnan(x);
}

// Volatile, because what is known at compile time is computed there, and right.
TEST(Compiler, RoundTripsThroughFloatRound) {              // H31
    const double rounded = 0.100000001490116119384765625;  // the float next to 0.1
    volatile double tenth = 0.1;
    const Numbers n = through_float(Numbers{tenth, tenth, tenth});
    EXPECT_EQ(n.x, rounded);
    EXPECT_EQ(n.y, rounded);
    EXPECT_EQ(n.z, rounded);
    EXPECT_EQ(through_float(Vec3(tenth, tenth, tenth)), Vec3(rounded));
}

TEST(Compiler, ProductsAreRoundedBeforeTheyAreAdded) {  // H31: fused, the rounding error would be left
    volatile double third = 1.0 / 3;
    volatile double product = third * third;
    EXPECT_EQ(residue(third, third, product), 0);
}

TEST(Compiler, NotANumberIsSeen) {  // H31: -ffast-math would assume it away
    volatile double zero = 0;
    EXPECT_FALSE(is_number(zero / zero));
    EXPECT_FALSE(is_number(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_TRUE(is_number(zero));
}

}  // namespace
}  // namespace surimi
