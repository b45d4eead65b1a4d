// SPDX-License-Identifier: Apache-2.0
// The page that shows a report: one HTML file, made by baker/report/page and embedded in the program.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace surimi {

/// The page with this title and these data. Neither can break out of its place.
std::string make_page(const std::string& title, const nlohmann::ordered_json& data);

}  // namespace surimi
