// SPDX-License-Identifier: Apache-2.0
// Text and bytes as they may stand in a page, whoever chose them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace surimi {

/// JSON for a <script> element that the browser does not run: nothing in it can end the element or begin a comment.
/// Text that is no UTF-8 gets replacement characters.
std::string script_text(const nlohmann::ordered_json& json);

/// Text for the content of an element or an attribute in quotes. What is no UTF-8 becomes replacement characters.
std::string html_text(const std::string& text);

/// "data:TYPE;base64,..."
std::string data_uri(std::string_view type, std::span<const uint8_t> bytes);

}  // namespace surimi
