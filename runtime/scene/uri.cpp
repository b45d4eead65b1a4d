// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/uri.h"

#include <cctype>
#include <fstream>
#include <system_error>

namespace surimi {
namespace {

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

int base64_value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;  // '-' and '_': the URL-safe alphabet, which some exporters write
    if (c == '/' || c == '_') return 63;
    return -1;
}

std::optional<std::vector<uint8_t>> decode_base64(const std::string& text) {
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3);
    uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        if (c == '=') break;
        if (std::isspace(static_cast<unsigned char>(c)) != 0) continue;
        const int value = base64_value(c);
        if (value < 0) return std::nullopt;
        bits = (bits << 6 | static_cast<uint32_t>(value)) & 0xFFFFFFu;
        bit_count += 6;
        if (bit_count < 8) continue;
        bit_count -= 8;
        bytes.push_back(static_cast<uint8_t>(bits >> bit_count & 0xFFu));
    }
    return bytes;
}

/// "http:", "file:", "C:": letters, digits, + - . up to a colon before any slash.
bool has_scheme(const std::string& uri) {
    for (const char c : uri) {
        if (c == ':') return true;
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '+' && c != '-' && c != '.') return false;
    }
    return false;
}

}  // namespace

std::string percent_decode(const std::string& text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const bool has_two_more = text[i] == '%' && text.size() - i > 2;
        const int high = has_two_more ? hex_value(text[i + 1]) : -1;
        const int low = has_two_more ? hex_value(text[i + 2]) : -1;
        if (high < 0 || low < 0) {
            decoded.push_back(text[i]);
            continue;
        }
        decoded.push_back(static_cast<char>(high * 16 + low));
        i += 2;
    }
    return decoded;
}

bool is_data_uri(const std::string& uri) {
    return uri.rfind("data:", 0) == 0;
}

std::optional<std::vector<uint8_t>> decode_data_uri(const std::string& uri) {
    const size_t comma = uri.find(',');
    if (!is_data_uri(uri) || comma == std::string::npos) return std::nullopt;
    const std::string header = uri.substr(0, comma);
    const std::string body = percent_decode(uri.substr(comma + 1));
    if (header.find(";base64") != std::string::npos) return decode_base64(body);
    return std::vector<uint8_t>(body.begin(), body.end());
}

std::optional<std::filesystem::path> resolve_uri(const std::filesystem::path& folder, const std::string& uri) {
    const std::string name = percent_decode(uri);
    if (name.empty() || name.find('\0') != std::string::npos || has_scheme(uri) || has_scheme(name))
        return std::nullopt;
    if (name.front() == '/' || name.front() == '\\') return std::nullopt;
    return folder / std::filesystem::path(name);
}

std::optional<std::vector<uint8_t>> read_file(const std::filesystem::path& path) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) return std::nullopt;  // no folders, pipes or devices
    std::ifstream stream(path, std::ios::binary);
    const auto size = std::filesystem::file_size(path, problem);
    if (!stream || problem) return std::nullopt;
    std::vector<uint8_t> bytes(size);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<uintmax_t>(stream.gcount()) != size) return std::nullopt;
    return bytes;
}

}  // namespace surimi
