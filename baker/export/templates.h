// SPDX-License-Identifier: Apache-2.0
// The files of samples/ that exports hand out. They lie in the program, so that it needs no folder of data.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace surimi {

/// The text of a file of samples/, named from there: "unity/SurimiVisibility.cs". Must be one of those that
/// baker/CMakeLists.txt lists.
std::string_view template_text(std::string_view name);

/// Puts values in the place of "{{key}}". Every key must be there, and every mark must be known.
std::string fill_in(std::string_view text, const std::vector<std::pair<std::string, std::string>>& values);

/// `text` as it reads in Markdown: what would be taken for a mark is escaped, and it stays on one line.
std::string markdown_text(const std::string& text);

}  // namespace surimi
