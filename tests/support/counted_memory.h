// SPDX-License-Identifier: Apache-2.0
// Counts what a program holds by way of operator new, to the byte that malloc gives. A program that uses it has its
// operators new and delete replaced.
#pragma once

#include <cstddef>

namespace surimi::test {

/// Begins to look for the highest count.
void restart_count();

/// The most that was held at a time since then, beyond what was held then.
size_t most_counted_bytes();

}  // namespace surimi::test
