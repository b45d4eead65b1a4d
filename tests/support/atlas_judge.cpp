// SPDX-License-Identifier: Apache-2.0
#include "tests/support/atlas_judge.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/support/single_cover.h"

namespace surimi::test {
namespace {

__extension__ typedef __int128 Int128;

constexpr int64_t grid = int64_t{1} << 24;  ///< points a unit of uv

struct JudgedTriangle {
    GridTriangle uv;
    uint32_t chart;
};

/// Collects what is wrong, and of each kind only the first place and the number.
class Faults {
  public:
    void add(const std::string& kind, const std::string& where) {
        for (Fault& fault : faults_)
            if (fault.kind == kind) {
                ++fault.count;
                return;
            }
        faults_.push_back({kind, where, 1});
    }
    std::vector<std::string> list() const {
        std::vector<std::string> texts;
        for (const Fault& fault : faults_)
            texts.push_back(fault.kind + ", " + std::to_string(fault.count) + " times, first at " + fault.where);
        return texts;
    }

  private:
    struct Fault {
        std::string kind, where;
        size_t count;
    };
    std::vector<Fault> faults_;
};

std::optional<GridPoint> grid_point(const Vec2f& uv) {
    const Vec2 scaled = Vec2(uv) * static_cast<double>(grid);
    for (int k = 0; k < 2; ++k)
        if (!(scaled[k] >= 0 && scaled[k] <= grid) || scaled[k] != std::floor(scaled[k])) return std::nullopt;
    return GridPoint{static_cast<int64_t>(scaled.x), static_cast<int64_t>(scaled.y)};
}

/// The triangles whose uv can be judged further, counter-clockwise.
std::vector<JudgedTriangle> collect(const Scene& scene, const Atlas& atlas, Faults& faults) {
    std::vector<JudgedTriangle> triangles;
    std::vector<int> winding(atlas.charts.size(), 0);
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        const size_t count = scene.surfaces[s].triangles.size();
        if (s >= atlas.surfaces.size() || atlas.surfaces[s].uv.size() != count ||
            atlas.surfaces[s].chart.size() != count) {
            faults.add("no uv for a surface", scene.surfaces[s].name);
            continue;
        }
        for (size_t t = 0; t < count; ++t) {
            const std::string where = scene.surfaces[s].name + ", triangle " + std::to_string(t);
            const uint32_t chart = atlas.surfaces[s].chart[t];
            if (chart >= atlas.charts.size() || atlas.charts[chart].surface != s) {
                faults.add("wrong chart", where);
                continue;
            }
            const auto& uv = atlas.surfaces[s].uv[t];
            const std::optional<GridPoint> a = grid_point(uv[0]), b = grid_point(uv[1]), c = grid_point(uv[2]);
            if (!a || !b || !c) {
                faults.add("uv off the grid or the map", where);
                continue;
            }
            const int64_t area = doubled_area(*a, *b, *c);
            const int turn = (area > 0) - (area < 0);
            if (winding[chart] == 0) winding[chart] = turn;
            if (turn == 0) {
                faults.add("no area", where);
            } else if (turn != winding[chart]) {
                faults.add("flipped", where);
            } else {
                triangles.push_back({turn > 0 ? GridTriangle{*a, *b, *c} : GridTriangle{*a, *c, *b}, chart});
            }
        }
    }
    return triangles;
}

/// Where the touched texels of a map are and whose they are. A grid point times the map's size is in units of
/// 2^-24 texels, so that the corners of texels are whole numbers too.
class TouchedTexels {
  public:
    TouchedTexels(int width, int height)
        : width_(width), height_(height), owners_(static_cast<size_t>(width) * static_cast<size_t>(height), nobody) {}

    void add(const JudgedTriangle& triangle, Faults& faults) {
        GridTriangle t = triangle.uv;
        for (GridPoint& p : t) p = {p[0] * width_, p[1] * height_};
        const auto [left, right] = std::minmax({t[0][0], t[1][0], t[2][0]});
        const auto [low, high] = std::minmax({t[0][1], t[1][1], t[2][1]});
        for (int64_t y = low / grid; y * grid < high; ++y)
            for (int64_t x = left / grid; x * grid < right; ++x) {
                if (!touches(t, x, y)) continue;
                uint32_t& owner = owners_[static_cast<size_t>(y * width_ + x)];
                if (owner != nobody && owner != triangle.chart) faults.add("texel of two charts", place(x, y));
                owner = triangle.chart;
            }
    }

    void check_gaps(int gutter, Faults& faults) const {
        for (int64_t y = 0; y < height_; ++y)
            for (int64_t x = 0; x < width_; ++x) {
                const uint32_t owner = owners_[static_cast<size_t>(y * width_ + x)];
                if (owner != nobody && is_near_other(owner, x, y, gutter)) faults.add("gutter", place(x, y));
            }
    }

  private:
    static constexpr uint32_t nobody = UINT32_MAX;

    static std::string place(int64_t x, int64_t y) { return "texel " + std::to_string(x) + ", " + std::to_string(y); }

    /// Whether the open texel meets the open triangle, given that their boxes do: no edge has the whole texel behind
    /// it.
    static bool touches(const GridTriangle& t, int64_t x, int64_t y) {
        for (size_t k = 0; k < 3; ++k) {
            const GridPoint &a = t[k], &b = t[(k + 1) % 3];
            const Int128 dx = b[0] - a[0], dy = b[1] - a[1];
            const int64_t corner_x = (dy < 0 ? x + 1 : x) * grid, corner_y = (dx > 0 ? y + 1 : y) * grid;
            if (dx * (corner_y - a[1]) - dy * (corner_x - a[0]) <= 0) return false;
        }
        return true;
    }

    /// The texels before (x, y) in the order of reading saw it already.
    bool is_near_other(uint32_t owner, int64_t x, int64_t y, int gutter) const {
        for (int64_t v = y; v <= std::min<int64_t>(y + gutter, height_ - 1); ++v)
            for (int64_t u = std::max<int64_t>(0, x - gutter); u <= std::min<int64_t>(x + gutter, width_ - 1); ++u) {
                const uint32_t other = owners_[static_cast<size_t>(v * width_ + u)];
                if (other != nobody && other != owner) return true;
            }
        return false;
    }

    int64_t width_, height_;
    std::vector<uint32_t> owners_;
};

double lowest_height(const std::array<Vec3, 3>& p) {
    const Vec3 a = p[1] - p[0], b = p[2] - p[1], c = p[0] - p[2];
    const double longest = std::sqrt(std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)}));
    return longest > 0 ? glm::length(glm::cross(a, b)) / longest : 0;
}

/// Singular values of the map from a triangle in space to the plane, the larger one first.
std::array<double, 2> singular_values(const std::array<Vec3, 3>& p, const std::array<Vec2, 3>& q) {
    const Vec3 e = p[1] - p[0], f = p[2] - p[0], normal = glm::normalize(glm::cross(e, f));
    const Vec3 x = glm::normalize(e), y = glm::cross(normal, x);
    const double ex = glm::dot(e, x), fx = glm::dot(f, x), fy = glm::dot(f, y);
    const Vec2 along = (q[1] - q[0]) / ex, across = (q[2] - q[0] - fx * along) / fy;
    const double mean = 0.5 * std::hypot(along.x + across.y, along.y - across.x);
    const double difference = 0.5 * std::hypot(along.x - across.y, along.y + across.x);
    return {mean + difference, std::abs(mean - difference)};
}

struct Sample {
    double density, area;  ///< in the worst direction, over the chart's
};

/// The density that 99 % of the area has at least.
double first_percentile(std::vector<Sample>& samples, double area) {
    std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.density < b.density; });
    double below = 0;
    for (const Sample& sample : samples) {
        below += sample.area;
        if (below > 0.01 * area) return sample.density;
    }
    return 0;
}

}  // namespace

std::vector<std::string> faults_of(const Scene& scene, const Atlas& atlas) {
    Faults faults;
    const std::vector<JudgedTriangle> triangles = collect(scene, atlas, faults);
    if (triangles.empty()) faults.add("no triangle is mapped", "all");
    std::vector<GridTriangle> uv;
    TouchedTexels texels(atlas.width, atlas.height);
    for (const JudgedTriangle& triangle : triangles) {
        uv.push_back(triangle.uv);
        texels.add(triangle, faults);
    }
    texels.check_gaps(atlas.gutter, faults);
    const std::string overlap = find_double_cover(uv);
    if (!overlap.empty()) faults.add("overlap", overlap + " of " + std::to_string(grid));
    return faults.list();
}

std::vector<Stretch> stretches_of(const Scene& scene, const Atlas& atlas) {
    struct Sums {
        std::vector<Sample> samples;
        double energy = 0, area = 0;
        Vec2 low{INFINITY}, high{-INFINITY};
    };
    std::vector<Sums> charts(atlas.charts.size());
    const Vec2 size(atlas.width, atlas.height);
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        for (size_t t = 0; t < surface.triangles.size(); ++t) {
            Sums& sums = charts[atlas.surfaces[s].chart[t]];
            const double density = atlas.charts[atlas.surfaces[s].chart[t]].texels_per_metre;
            std::array<Vec3, 3> p;
            std::array<Vec2, 3> q;
            for (size_t k = 0; k < 3; ++k) {
                p[k] = density * surface.positions[surface.triangles[t][k]];
                q[k] = Vec2(atlas.surfaces[s].uv[t][k]) * size;
                sums.low = glm::min(sums.low, q[k]);
                sums.high = glm::max(sums.high, q[k]);
            }
            if (!(lowest_height(p) > 1.0 / 32)) continue;
            const auto [large, small] = singular_values(p, q);
            const double area = 0.5 * glm::length(area_normal(p[0], p[1], p[2]));
            sums.energy += area * (large * large + small * small + 1 / (large * large) + 1 / (small * small));
            sums.area += area;
            sums.samples.push_back({small, area});
        }
    }
    std::vector<Stretch> stretches;
    for (Sums& sums : charts) {
        const Vec2 extent = sums.high - sums.low;
        if (sums.area > 0 && std::min(extent.x, extent.y) >= 1)
            stretches.push_back({sums.energy / sums.area, first_percentile(sums.samples, sums.area)});
    }
    return stretches;
}

}  // namespace surimi::test
