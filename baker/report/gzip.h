// SPDX-License-Identifier: Apache-2.0
// Bytes -> gzip, which browsers unpack on their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace surimi {

/// A gzip file (RFC 1952) without name and time: the same bytes give the same file. Throws Error(internal) beyond 4
/// GiB.
std::vector<uint8_t> gzip(std::span<const uint8_t> bytes);

}  // namespace surimi
