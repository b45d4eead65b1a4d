// SPDX-License-Identifier: Apache-2.0
// That the program with fused operations has some: flags that do nothing would let its tests pass for nothing (H31).
#include <gtest/gtest.h>

namespace surimi {
namespace {

[[gnu::noinline]] double residue(double a, double b, double product) {
    return a * b - product;
}

TEST(Fused, RoundingErrorOfAProductIsLeft) {
    volatile double third = 1.0 / 3;
    volatile double product = third * third;
    EXPECT_NE(residue(third, third, product), 0);
}

}  // namespace
}  // namespace surimi
