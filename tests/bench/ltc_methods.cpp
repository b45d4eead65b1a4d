// SPDX-License-Identifier: Apache-2.0
// Time and error of ways to shade with a polygon light, as Markdown: ours by instruction set, and the published ones.
// `cmake --build --preset release --target ltc_methods && build/release/bin/ltc_methods`, on a quiet machine.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "runtime/batch/batch.h"
#include "runtime/ltc/polygon.h"
#include "runtime/ltc/table.h"
#include "runtime/shade/published.h"
#include "tests/support/quadrature.h"
#include "tests/support/random.h"
#include "tests/support/shading_cases.h"

namespace surimi {
namespace {

using Corners = std::vector<Vec3>;

/// Points and what shaders are given of them.
struct Scene {
    PointBatch points;
    std::vector<Vec3f> position, normal, view;
    std::vector<float> roughness;
};

struct Method {
    std::string name;
    std::function<void()> select;  ///< before a run, not timed
    std::function<void(const Scene&, const Corners&, ShareBatch&)> shade;
    bool is_published;  ///< has the published lobe, which is not cut at the true horizon
};

Scene scene_of(const PointBatch& points) {
    Scene scene{points, {}, {}, {}, {}};
    for (size_t i = 0; i < points.size(); ++i) {
        scene.position.emplace_back(points.position[i]);
        scene.normal.emplace_back(points.normal[i]);
        scene.view.emplace_back(points.view[i]);
        scene.roughness.push_back(static_cast<float>(points.roughness[i]));
    }
    return scene;
}

void shade_in_batches(const Scene& scene, const Corners& corners, Precision precision, ShareBatch& shares) {
    static LobeBatch lobes;
    place_lobes(scene.points, lobes);
    add_polygon(scene.points, lobes, corners, false, Terms::both, precision, {}, shares);
}

/// One point after the other in double: the light above the horizon as a list, transformed, and (M1).
void shade_one_by_one(const Scene& scene, const Corners& corners, ShareBatch& shares) {
    static Corners kept;
    for (size_t i = 0; i < scene.points.size(); ++i) {
        const Vec3 p = scene.points.position[i], n = scene.points.normal[i], v = scene.points.view[i];
        const double cosine = glm::dot(n, v);
        const LtcLobe lobe = ltc_lobe(scene.points.roughness[i], cosine);
        const Vec3 t = glm::normalize(v - n * cosine), b = glm::cross(n, t);
        const auto local = [&](const Vec3& w) { return Vec3(glm::dot(w, t), glm::dot(w, b), glm::dot(w, n)); };
        kept.clear();
        Vec3 from = local(corners.back() - p);
        for (const Vec3& corner : corners) {
            const Vec3 to = local(corner - p);
            if (from.z * to.z < 0) kept.push_back(lobe.inverse * (from + (to - from) * (from.z / (from.z - to.z))));
            if (to.z >= 0) kept.push_back(lobe.inverse * to);
            from = to;
        }
        shares.diffuse[i] += irradiance_of_polygon<double>(corners, p, n) / pi;
        if (kept.size() > 2)
            shares.specular[i] += irradiance_of_polygon<double>(kept, Vec3(0), Vec3(0, 0, 1)) / pi / (1 - lobe.leak);
    }
}

void shade_published(const Scene& scene, const Corners& corners, const published::Proxy* proxy, ShareBatch& shares) {
    const Vec3f quad[4] = {Vec3f(corners[0]), Vec3f(corners[1]), Vec3f(corners[2]), Vec3f(corners[3])};
    for (size_t i = 0; i < scene.roughness.size(); ++i) {
        const Vec3f &p = scene.position[i], &n = scene.normal[i], &v = scene.view[i];
        const published::Shares s = proxy ? published::clipless_quad(quad, p, n, v, scene.roughness[i], *proxy)
                                          : published::clipped_quad(quad, p, n, v, scene.roughness[i]);
        shares.diffuse[i] += static_cast<double>(s.diffuse);
        shares.specular[i] += static_cast<double>(s.specular);
    }
}

std::vector<Method> methods() {
    static constexpr published::Proxy table = published::Proxy::table, fraction = published::Proxy::fraction;
    const auto published = [](const published::Proxy* proxy) {
        return [proxy](const Scene& s, const Corners& c, ShareBatch& out) { shade_published(s, c, proxy, out); };
    };
    std::vector<Method> all = {
        {"published, exact clip, float", [] {}, published(nullptr), true},
        {"published, sphere table, float", [] {}, published(&table), true},
        {"published, (l^2 + z) / (l + 1), float", [] {}, published(&fraction), true},
        {"ours, point by point, double", [] {}, shade_one_by_one, false},
    };
    for (const std::string& set : instruction_sets())
        for (const Precision precision : {Precision::full, Precision::mixed})
            all.push_back({"ours, batch, " + std::string(precision == Precision::full ? "full, " : "mixed, ") + set,
                           [set] { use_instruction_set(set); },
                           [precision](const Scene& s, const Corners& c, ShareBatch& out) {
                               shade_in_batches(s, c, precision, out);
                           },
                           false});
    return all;
}

double thread_nanoseconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e9 + static_cast<double>(t.tv_nsec);
}

/// A room with a screen on one wall: a quarter of the points each on the floor, a side wall, the opposite wall, and
/// anywhere with any normal.
PointBatch points_in_a_room(size_t count) {
    Random random{1};
    const auto between = [&](double low, double high) { return low + (high - low) * random.next(); };
    PointBatch points;
    for (size_t i = 0; i < count; ++i) {
        const double x = between(-2, 2), y = between(-1, 1.5), z = between(-1.9, 2);
        const std::array<Vec3, 4> places = {Vec3(x, -1, z), Vec3(-2, y, z), Vec3(x, y, 2), Vec3(x, y, z)};
        const Vec3 any = normalize_or({between(-1, 1), between(-1, 1), between(-1, 1)}, {0, 1, 0});
        const std::array<Vec3, 4> normals = {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1), any};
        const size_t kind = 4 * i / count;
        points.position.push_back(places[kind]);
        points.normal.push_back(normals[kind]);
        points.view.push_back(normalize_or(Vec3(0.5, 0, 1.8) - places[kind], {0, 1, 0}));
        points.roughness.push_back(random.next());
    }
    return points;
}

void print_times() {
    constexpr size_t count = 4096;
    constexpr int rounds = 31;
    const Scene scene = scene_of(points_in_a_room(count));
    const Corners light = {{-0.5, 0.5, -2}, {0.5, 0.5, -2}, {0.5, 1.2, -2}, {-0.5, 1.2, -2}};
    const std::vector<Method> all = methods();
    std::vector<std::vector<double>> times(all.size());
    ShareBatch shares{std::vector<double>(count), std::vector<double>(count), 0};
    // All methods in turn, so that a busy stretch of the machine meets all of them.
    for (int round = -1; round < rounds; ++round)
        for (size_t m = 0; m < all.size(); ++m) {
            all[m].select();
            const double begin = thread_nanoseconds();
            all[m].shade(scene, light, shares);
            if (round >= 0) times[m].push_back((thread_nanoseconds() - begin) / count);
        }
    std::printf("| method | ns per point and light: median | least | times the published |\n|---|---|---|---|\n");
    double published = 0;
    for (size_t m = 0; m < all.size(); ++m) {
        std::ranges::sort(times[m]);
        const double median = times[m][rounds / 2];
        if (m == 0) published = median;
        std::printf("| %s | %.0f | %.0f | %.2f |\n", all[m].name.c_str(), median, times[m].front(), median / published);
    }
}

/// What the published lobe would reflect if it were integrated exactly.
double exact_published_specular(const Corners& corners, const Vec3& p, const Vec3& n, const Vec3& v, double roughness) {
    using test::Vec3l;
    const Vec3l z(n), x = glm::normalize(Vec3l(v) - z * glm::dot(z, Vec3l(v))), y = glm::cross(z, x);
    const float cosine = static_cast<float>(std::clamp(glm::dot(n, v), 0.0, 1.0));
    const glm::mat<3, 3, test::Real> inverse(published::lobe_at(static_cast<float>(roughness), cosine).inverse);
    std::vector<Vec3l> seen;
    for (const Vec3& corner : corners) {
        const Vec3l w = Vec3l(corner) - Vec3l(p);
        seen.push_back(inverse * Vec3l(glm::dot(w, x), glm::dot(w, y), glm::dot(w, z)));
    }
    return static_cast<double>(test::corner_irradiance(seen, Vec3l(0, 0, 1)) / test::pi_l);
}

struct Errors {
    double most = 0, squares = 0;
    size_t count = 0, not_finite = 0;
    void add(double error) {
        if (!std::isfinite(error)) {
            ++not_finite;
            return;
        }
        most = std::max(most, std::abs(error));
        squares += error * error;
        ++count;
    }
    std::string text() const {
        char buffer[96];
        const double rms = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
        std::snprintf(buffer, sizeof buffer, "%.0e / %.0e", most, rms);
        const size_t all = count + not_finite;
        return buffer + (not_finite ? ", NaN " + std::to_string(100 * not_finite / all) + " %" : std::string());
    }
};

/// Errors of a method over a family, for points in front of their lights.
std::pair<Errors, Errors> errors_of(const Method& method, const test::ShadingFamily& family) {
    Errors diffuse, specular;
    for (const test::ShadingCase& c : family.cases) {
        Corners corners = c.corners;
        const Vec3 front = glm::cross(corners[1] - corners[0], corners[3] - corners[0]);
        if (glm::dot(front, c.points.position[0] - corners[0]) < 0) std::ranges::reverse(corners);
        ShareBatch shares{std::vector<double>(c.points.size()), std::vector<double>(c.points.size()), 0};
        method.shade(scene_of(c.points), corners, shares);
        for (size_t i = 0; i < c.points.size(); ++i) {
            const double exact = method.is_published
                                     ? exact_published_specular(corners, c.points.position[i], c.points.normal[i],
                                                                c.points.view[i], c.points.roughness[i])
                                     : c.specular[i];
            diffuse.add(shares.diffuse[i] - c.diffuse[i]);
            specular.add(shares.specular[i] - exact);
        }
    }
    return {diffuse, specular};
}

void print_errors() {
    std::vector<test::ShadingFamily> families = test::shading_families(500, 8);
    // Without area, or with a corner at the point, there is no front.
    std::erase_if(families,
                  [](const auto& family) { return family.name.starts_with("H5") || family.name.starts_with("H7"); });
    std::printf(
        "\nErrors against long double, maximum / RMS, of the share of light. Specular: of each method's own lobe"
        " (the published one is not cut at the true horizon).\n\n| method |");
    for (const test::ShadingFamily& family : families) std::printf(" %s |", family.name.c_str());
    std::printf("\n|---|");
    for (size_t i = 0; i < families.size(); ++i) std::printf("---|");
    for (const Method& method : methods()) {
        method.select();
        std::string rows[2] = {"\n| " + method.name + ": diffuse |", "\n| " + method.name + ": specular |"};
        for (const test::ShadingFamily& family : families) {
            const auto [diffuse, specular] = errors_of(method, family);
            rows[0] += " " + diffuse.text() + " |";
            rows[1] += " " + specular.text() + " |";
        }
        std::printf("%s%s", rows[0].c_str(), rows[1].c_str());
    }
    std::printf("\n");
}

}  // namespace
}  // namespace surimi

int main() {
    surimi::print_times();
    surimi::print_errors();
}
