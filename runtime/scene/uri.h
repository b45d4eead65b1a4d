// SPDX-License-Identifier: Apache-2.0
// The URIs of glTF buffers and images: data in the URI itself, or a file beside the document.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace surimi {

/// "%20" -> " "; malformed escapes stay as they are.
std::string percent_decode(const std::string& text);

bool is_data_uri(const std::string& uri);

/// The bytes of "data:[type][;base64],..."; none when it is malformed.
std::optional<std::vector<uint8_t>> decode_data_uri(const std::string& uri);

/// The file that a relative URI names, seen from `folder`; none for absolute paths and for other schemes
/// (http, file): a scene must not be able to read whatever it likes.
std::optional<std::filesystem::path> resolve_uri(const std::filesystem::path& folder, const std::string& uri);

/// All bytes of a regular file; none when it cannot be read.
std::optional<std::vector<uint8_t>> read_file(const std::filesystem::path& path);

}  // namespace surimi
