// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/seam_cost.h"

namespace surimi {
namespace {

/// A seam across a sharper edge than this is not seen.
const double visible_cosine = std::cos(40 * pi / 180);

/// Share of a chart's texels that a visible seam as long as the root of its area is worth (M45), by measurement.
constexpr double texels_for_visible = 0.2;
/// And one that is not seen: it still needs a gutter.
constexpr double texels_for_hidden = 0.01;

}  // namespace

void add_edge(const FaceGraph& graph, uint32_t face, uint32_t k, SeamLength& length) {
    const Vec3& a = graph.positions[graph.corners[face][k]];
    const Vec3& b = graph.positions[graph.corners[face][(k + 1) % 3]];
    const double metres = glm::length(b - a);
    length.all += metres;
    if (glm::dot(graph.normals[face], graph.normals[graph.neighbours[face][k]]) > visible_cosine)
        length.visible += metres;
}

double worth_of(const SeamLength& seam, double area) {
    return (texels_for_visible * seam.visible + texels_for_hidden * seam.all) * std::sqrt(area);
}

}  // namespace surimi
