// SPDX-License-Identifier: Apache-2.0
// tinygltf itself, compiled here instead of linked, so that the sanitizers see it.
#define TINYGLTF_IMPLEMENTATION
#include "runtime/scene/gltf_document.h"
