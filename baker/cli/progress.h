// SPDX-License-Identifier: Apache-2.0
// Progress on stderr, and the answer to Ctrl-C.
#pragma once

#include <string>

#include "runtime/base/parallel.h"

namespace surimi {

/// A Progress that shows a bar on a terminal, one line for each 10 % in a pipe, JSON Lines ("json"), or nothing
/// ("none"); style "auto" chooses bar or lines. Cancelled by SIGINT.
Progress make_progress(const std::string& style, bool is_quiet);

}  // namespace surimi
