// SPDX-License-Identifier: Apache-2.0
// Counter-based random numbers: a value depends on its key alone, so the order of evaluation does not matter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace surimi {

/// A well-mixed 64-bit value of a key (finaliser of SplitMix64, Steele et al. 2014).
constexpr uint64_t hash(uint64_t key) {
    key += 0x9e3779b97f4a7c15u;
    key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
    key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
    return key ^ (key >> 31);
}
constexpr uint64_t hash(uint64_t a, uint64_t b) {
    return hash(hash(a) ^ b);
}

/// [0, 1) from the upper 53 bits.
constexpr double unit_double(uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

namespace sobol {

constexpr uint32_t reverse_bits(uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

/// Direction numbers of one dimension from its primitive polynomial (degree, inner coefficients) and first numbers m:
/// m_k = 2 a_1 m_k-1 ^ ... ^ 2^s m_k-s ^ m_k-s (Bratley and Fox 1988).
constexpr std::array<uint32_t, 32> directions(uint32_t degree, uint32_t coefficients, std::array<uint32_t, 3> first) {
    std::array<uint32_t, 32> v{};
    for (uint32_t k = 0; k < 32; ++k) {
        uint32_t m = 0;
        if (k < degree) {
            m = first[k];
        } else {
            const uint32_t oldest = v[k - degree] >> (31 - (k - degree));
            m = oldest ^ (oldest << degree);
            for (uint32_t j = 1; j < degree; ++j)
                if ((coefficients >> (degree - 1 - j)) & 1u) m ^= (v[k - j] >> (31 - (k - j))) << j;
        }
        v[k] = m << (31 - k);
    }
    return v;
}

/// Dimensions 1 to 3, with the polynomials and first numbers of Joe and Kuo 2008; dimension 0 is the radical inverse.
inline constexpr std::array<std::array<uint32_t, 32>, 3> matrices = {
    directions(1, 0, {1, 0, 0}), directions(2, 1, {1, 3, 0}), directions(3, 1, {1, 3, 1})};

/// Point `index` of the four-dimensional Sobol sequence, as 32-bit fractions.
constexpr std::array<uint32_t, 4> point(uint32_t index) {
    std::array<uint32_t, 4> x{reverse_bits(index), 0, 0, 0};
    for (uint32_t bit = 0; index != 0; index >>= 1, ++bit)
        if (index & 1u)
            for (size_t d = 0; d < 3; ++d) x[d + 1] ^= matrices[d][bit];
    return x;
}

/// Owen scrambling by hashing: every bit is flipped by a function of the bits above it (Laine and Karras 2011, with
/// the better-mixing constants of Vegdahl 2021). Keeps the stratification of any net in base 2. `reversed`: the
/// fraction with its first digit in the lowest bit.
constexpr uint32_t scramble_reversed(uint32_t reversed, uint32_t seed) {
    uint32_t x = reversed;
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse_bits(x);
}
constexpr uint32_t scramble(uint32_t x, uint32_t seed) {
    return scramble_reversed(reverse_bits(x), seed);
}

}  // namespace sobol

/// The scrambling of one item: a seed for each dimension.
using Scrambling = std::array<uint32_t, 4>;

constexpr Scrambling scrambling(uint64_t key) {
    Scrambling seeds{};
    for (size_t d = 0; d < 4; ++d) seeds[d] = static_cast<uint32_t>(hash(key, d));
    return seeds;
}

/// A Sobol point, scrambled; four numbers in [0, 1).
constexpr std::array<double, 4> scrambled(const std::array<uint32_t, 4>& point, const Scrambling& seeds) {
    std::array<double, 4> result{};
    for (size_t d = 0; d < 4; ++d) result[d] = static_cast<double>(sobol::scramble(point[d], seeds[d])) * 0x1p-32;
    return result;
}

}  // namespace surimi
