// SPDX-License-Identifier: Apache-2.0
// Files that appear whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace surimi {

/// Files that appear together. Each is written under a temporary name in its own folder; `commit` renames all of them.
/// What is not committed is removed again.
class PendingFiles {
  public:
    PendingFiles() = default;
    ~PendingFiles();
    PendingFiles(const PendingFiles&) = delete;
    PendingFiles& operator=(const PendingFiles&) = delete;

    /// The temporary name to write `path` under.
    std::filesystem::path add(const std::filesystem::path& path);

    /// Throws Error(cannot_write).
    void commit();

  private:
    std::vector<std::pair<std::filesystem::path, std::filesystem::path>> files_;  // temporary, final
};

/// Makes a folder, and those that it is in, unless it is there. Throws Error(cannot_write).
void make_folder(const std::filesystem::path& folder);

/// Writes bytes to a file that exists only once it is complete. Throws Error(cannot_write).
void write_file(const std::filesystem::path& path, std::span<const uint8_t> bytes);

/// Calls `visit` with all bytes of a file, a piece at a time. False where it cannot be read.
bool read_pieces(const std::filesystem::path& path, const std::function<void(std::span<const uint8_t>)>& visit);

/// Writes bytes in place, for a name from PendingFiles::add. Throws Error(cannot_write).
void write_bytes(const std::filesystem::path& path, std::span<const uint8_t> bytes);

}  // namespace surimi
