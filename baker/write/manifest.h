// SPDX-License-Identifier: Apache-2.0
// What a bake was made from, with what, and what came out, as JSON for people and programs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "baker/bake.h"

namespace surimi {

/// Tells whether two files are the same, not who made them (Fowler, Noll and Vo 1991).
class ContentHash {
  public:
    void add(std::span<const uint8_t> bytes);
    /// "fnv1a64:" and sixteen hexadecimal digits.
    std::string text() const;

  private:
    uint64_t hash_ = 0xCBF29CE484222325;  // offset basis of the 64-bit FNV-1a
};

/// Of all these bytes.
std::string content_hash(std::span<const uint8_t> bytes);

/// A finished output file.
struct ManifestFile {
    std::string role;  ///< "visibility", "bakedGlb", ...
    std::string name;
    size_t size = 0;   ///< bytes
    std::string hash;  ///< content_hash
    int page = -1;     ///< of the atlas; -1: the file is of all pages
};

/// The manifest. With several pages, the map lists the files of each, and a node has an entry for each page that it
/// lies on. Everything that differs from run to run (seconds, memory) is in its last member, "run"; the
/// rest depends on scene and settings alone. `scene_hash` is that of the scene file, `settings_json` an
/// object.
std::string make_manifest(const Scene& scene, const Bake& bake, const std::string& settings_json,
                          const std::string& scene_hash, const std::vector<ManifestFile>& files);

}  // namespace surimi
