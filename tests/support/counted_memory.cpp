// SPDX-License-Identifier: Apache-2.0
#include "tests/support/counted_memory.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<size_t> held{0}, most{0}, at_start{0};

void add(size_t bytes) {
    const size_t now = held.fetch_add(bytes) + bytes;
    size_t before = most.load();
    while (now > before && !most.compare_exchange_weak(before, now)) {
    }
}

}  // namespace

void* operator new(size_t bytes, const std::nothrow_t&) noexcept {
    void* block = std::malloc(bytes > 0 ? bytes : 1);
    if (block) add(malloc_usable_size(block));
    return block;
}

void* operator new(size_t bytes) {
    void* block = operator new(bytes, std::nothrow);
    if (!block) throw std::bad_alloc();
    return block;
}

void operator delete(void* block) noexcept {
    if (block) held -= malloc_usable_size(block);
    std::free(block);
}

void operator delete(void* block, size_t) noexcept {
    operator delete(block);
}

namespace surimi::test {

void restart_count() {
    at_start = held.load();
    most = held.load();
}

size_t most_counted_bytes() {
    return most - at_start;
}

}  // namespace surimi::test
