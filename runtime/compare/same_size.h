// SPDX-License-Identifier: Apache-2.0
// The one thing that every comparison needs first.
#pragma once

#include <string>

#include "runtime/base/error.h"
#include "runtime/base/image.h"

namespace surimi {

/// Throws Error(usage), naming both sizes, when they differ.
template <class A, class B>
void require_same_size(const Image<A>& image, const Image<B>& reference) {
    if (image.width == reference.width && image.height == reference.height) return;
    const auto size = [](const auto& one) { return std::to_string(one.width) + " x " + std::to_string(one.height); };
    throw Error(ErrorKind::usage, "images of different sizes cannot be compared: " + size(image) + " and " +
                                      size(reference) + "; give two of the same size");
}

}  // namespace surimi
