// SPDX-License-Identifier: Apache-2.0
#include "baker/gather/weld.h"

#include <algorithm>
#include <bit>

#include "runtime/base/parallel.h"

namespace surimi {
namespace {

constexpr unsigned bucket_bits = 10;  // a million items make buckets that sort in the first cache
constexpr size_t buckets = size_t{1} << bucket_bits;

size_t bucket_of(uint64_t key) {
    return static_cast<size_t>(key >> (64 - bucket_bits));
}

uint64_t bits_of(float value) {
    return std::bit_cast<uint32_t>(value == 0 ? 0.0f : value);
}

uint64_t key_of(const Vec3f& place, uint8_t owner) {
    return mixed(mixed(bits_of(place.x) << 32 | bits_of(place.y)) ^ (bits_of(place.z) << 8 | owner));
}

}  // namespace

uint64_t mixed(uint64_t value) {
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
}

void sort_by_key(std::vector<Keyed>& items) {
    constexpr size_t ranges = 32;
    const size_t grain = std::max<size_t>(1, (items.size() + ranges - 1) / ranges);
    std::vector<std::vector<size_t>> next(ranges, std::vector<size_t>(buckets, 0));
    parallel_ranges(items.size(), grain, [&](size_t begin, size_t end) {
        std::vector<size_t>& counts = next[begin / grain];
        for (size_t i = begin; i < end; ++i) ++counts[bucket_of(items[i].key)];
    });
    std::vector<size_t> starts(buckets + 1, 0);
    size_t sum = 0;
    for (size_t b = 0; b < buckets; ++b) {
        starts[b] = sum;
        for (std::vector<size_t>& counts : next) {
            const size_t count = counts[b];
            counts[b] = sum;
            sum += count;
        }
    }
    starts[buckets] = sum;

    std::vector<Keyed> sorted(items.size());
    parallel_ranges(items.size(), grain, [&](size_t begin, size_t end) {
        std::vector<size_t>& slots = next[begin / grain];
        for (size_t i = begin; i < end; ++i) sorted[slots[bucket_of(items[i].key)]++] = items[i];
    });
    items.swap(sorted);
    parallel_for(buckets, 16, [&](size_t b) {
        std::sort(items.begin() + static_cast<std::ptrdiff_t>(starts[b]),
                  items.begin() + static_cast<std::ptrdiff_t>(starts[b + 1]),
                  [](const Keyed& a, const Keyed& c) { return a.key != c.key ? a.key < c.key : a.index < c.index; });
    });
}

std::vector<uint32_t> weld(std::span<const Vec3f> places, std::span<const uint8_t> owners) {
    constexpr size_t grain = 1 << 14;
    std::vector<Keyed> items(places.size());
    parallel_for(places.size(), grain, [&](size_t i) {
        items[i] = {key_of(places[i], owners[i]), static_cast<uint32_t>(i)};
    });
    sort_by_key(items);

    std::vector<uint32_t> first(places.size());
    parallel_ranges(items.size(), grain, [&](size_t begin, size_t end) {
        std::vector<uint32_t> distinct;  // of those with one key: more than one is a collision
        for (size_t i = begin; i < end; ++i) {
            if (i > 0 && items[i].key == items[i - 1].key) continue;
            distinct.clear();
            for (size_t j = i; j < items.size() && items[j].key == items[i].key; ++j) {
                const uint32_t vertex = items[j].index;
                const auto equal = std::find_if(distinct.begin(), distinct.end(), [&](uint32_t other) {
                    return places[other] == places[vertex] && owners[other] == owners[vertex];
                });
                first[vertex] = equal == distinct.end() ? vertex : *equal;
                if (equal == distinct.end()) distinct.push_back(vertex);
            }
        }
    });
    return first;
}

}  // namespace surimi
