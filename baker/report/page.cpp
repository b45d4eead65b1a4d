// SPDX-License-Identifier: Apache-2.0
#include "baker/report/page.h"

#include <cassert>
#include <string_view>

#include <nlohmann/json.hpp>

#include "baker/report/text.h"

// page.html lies in the program, so that a report needs no files beside it. SURIMI_PAGE is its path at build.
__asm__(
    ".pushsection .rodata\n"
    "surimi_page_begin:\n"
    ".incbin \"" SURIMI_PAGE
    "\"\n"
    "surimi_page_end:\n"
    ".popsection\n");

extern "C" {
extern const char surimi_page_begin[];
extern const char surimi_page_end[];
}

namespace surimi {

std::string make_page(const std::string& title, const nlohmann::ordered_json& data) {
    // bundle.mjs makes sure that each is there once, in this order.
    constexpr std::string_view title_mark = "<!-- title of the report -->", data_mark = "<!-- data of the report -->";
    const std::string_view page(surimi_page_begin, static_cast<size_t>(surimi_page_end - surimi_page_begin));
    const size_t title_at = page.find(title_mark), data_at = page.find(data_mark);
    assert(title_at != std::string_view::npos && data_at != std::string_view::npos && title_at < data_at);
    const std::string json = script_text(data);
    std::string result;
    result.reserve(page.size() + json.size() + 1024);
    result += page.substr(0, title_at);
    result += html_text(title);
    result += page.substr(title_at + title_mark.size(), data_at - title_at - title_mark.size());
    result += "<script type=\"application/json\" id=\"data\">" + json + "</script>";
    result += page.substr(data_at + data_mark.size());
    return result;
}

}  // namespace surimi
