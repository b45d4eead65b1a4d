// SPDX-License-Identifier: Apache-2.0
// The one exception of Surimi: what is wrong, where, and what to do. Only the command line catches it.
#pragma once

#include <stdexcept>
#include <string>

namespace surimi {

/// Why the program stops; the values are its exit codes.
enum class ErrorKind {
    internal = 1,
    usage = 2,            ///< command line or configuration
    scene = 3,            ///< the scene cannot be read or is invalid
    nothing_to_bake = 4,  ///< no monitor, no receiver, or ambiguous monitors
    target_missed = 5,    ///< the error asked for was not reached
    cannot_write = 6,
    interrupted = 130,
};

class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

  private:
    ErrorKind kind_;
};

}  // namespace surimi
