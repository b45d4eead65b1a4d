// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/node_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace surimi {
namespace {

size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = std::exchange(row[0], i);
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

bool matches_glob(const std::string& pattern, const std::string& text) {
    size_t p = 0;
    size_t t = 0;
    size_t star = std::string::npos;
    size_t retry = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            retry = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (star != std::string::npos) {
            p = star + 1;
            t = ++retry;  // the star swallows one character more
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

std::string nearest_node_name(const Scene& scene, const std::string& name) {
    std::string nearest;
    size_t best = SIZE_MAX;
    for (const Node& node : scene.nodes) {
        const size_t distance =
            node.is_in_scene ? edit_distance(name.substr(0, 64), node.name.substr(0, 64)) : SIZE_MAX;
        if (distance < best) nearest = node.name;
        best = std::min(best, distance);
    }
    return nearest;
}

std::vector<size_t> matching_nodes(const Scene& scene, const std::string& name) {
    std::vector<size_t> exact;
    std::vector<size_t> matching;
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
        if (!scene.nodes[n].is_in_scene) continue;
        if (scene.nodes[n].name == name) exact.push_back(n);
        if (matches_glob(name, scene.nodes[n].name)) matching.push_back(n);
    }
    return exact.empty() ? matching : exact;
}

}  // namespace surimi
