// SPDX-License-Identifier: Apache-2.0
// The published polygon lights and ours, on the same input: where theirs fail (research/ltc.md, 1.3 and 2), ours must
// not. The printed tables hold worst errors of the form factor, and medians of the relative error.
#include "runtime/shade/published.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "runtime/ltc/table.h"
#include "tests/stability/hazard.h"

namespace surimi {
namespace {

using published::Proxy;
using namespace hazard;

template <class T>
using Quad = std::array<glm::vec<3, T>, 4>;

/// In the frame in which the normal is z.
template <class T>
Quad<T> in_frame(const Corners& corners, const Vec3& normal) {
    const Mat3 to_frame = glm::transpose(frame_around(normal));
    Quad<T> quad;
    for (size_t i = 0; i < 4; ++i) quad[i] = glm::vec<3, T>(to_frame * corners[i]);
    return quad;
}

Corners parallelogram(const Vec3& centre, const Vec3& u, const Vec3& v) {
    return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

struct Errors {
    std::vector<double> absolute, relative;

    void add(double value, double expected) {
        ASSERT_FALSE(std::isnan(value));
        absolute.push_back(std::abs(value - expected));
        if (expected > 1e-12) relative.push_back(std::abs(value / expected - 1));
    }
    double worst() const { return *std::max_element(absolute.begin(), absolute.end()); }
    double median() const {
        std::vector<double> sorted = relative;
        std::sort(sorted.begin(), sorted.end());
        return sorted[sorted.size() / 2];
    }
    std::string text() const {
        char line[48];
        std::snprintf(line, sizeof line, " %.0e, %.0e |", worst(), median());
        return line;
    }
};

/// Errors of all methods over some quads, both sides emitting.
struct Row {
    Errors exact_clip, exact_clip_in_double, table, fraction, ours_in_float, ours;

    void add(const Corners& light, const Vec3& normal) {
        const double expected = exact(light, normal) / pi;
        const Quad<float> f = in_frame<float>(light, normal);
        const Quad<double> d = in_frame<double>(light, normal);
        exact_clip.add(published::clipped_polygon<float>(f, true), expected);
        exact_clip_in_double.add(published::clipped_polygon<double>(d, true), expected);
        table.add(published::clipless_polygon<float>(f, Proxy::table, true), expected);
        fraction.add(published::clipless_polygon<float>(f, Proxy::fraction, true), expected);
        ours_in_float.add(irradiance_of_polygon<float>(f, Vec3f(0), {0, 0, 1}, true) / pi, expected);
        ours.add(of(light, normal) / pi, expected);
    }
    void print(const std::string& name) const {
        std::printf("| %s |%s%s%s%s%s%s\n", name.c_str(), exact_clip.text().c_str(),
                    exact_clip_in_double.text().c_str(), table.text().c_str(), fraction.text().c_str(),
                    ours_in_float.text().c_str(), ours.text().c_str());
    }
};

void print_head() {
    std::puts(
        "| worst, relative median | published clip, float | the same, double | clipless, sphere table | clipless,"
        " (l^2+z)/(l+1) | ours, float | ours |\n|---|---|---|---|---|---|---|");
}

TEST(PublishedPolygon, ExactClipFailsNearTheLight_M1) {  // H1
    print_head();
    Choice choice{{1}};
    for (const auto& [h, bar] :
         {std::pair{1e-1, 0.0}, {1e-2, 1e-4}, {1e-3, 0.01}, {1e-4, 0.3}, {1e-5, 0.3}, {1e-6, 0.3}}) {
        Row row;
        for (int i = 0; i < 500; ++i) {
            const double x = choice.between(-0.8, 0.8), y = choice.between(-0.8, 0.8);
            row.add(ceiling(x - 1, x + 1, y - 1, y + 1, h), steep_normal(choice));
        }
        row.print("H1 light at " + std::to_string(h));
        EXPECT_GT(row.exact_clip.worst(), bar) << h;
        if (h < 5e-4) {
            EXPECT_GT(row.exact_clip_in_double.worst(), 0.2) << h;  // the formula, not its precision
        }
        EXPECT_LT(row.ours_in_float.worst(), 5e-7) << h;
        EXPECT_LT(row.ours.worst(), 1e-7) << h;
    }
}

TEST(PublishedPolygon, CliplessFailsNearTheLightsEdge_M4) {  // H2
    print_head();
    Choice choice{{2}};
    for (const auto& [d, table, fraction] : {std::tuple{1e-2, 0.05, 0.1}, {1e-4, 0.2, 0.2}, {1e-6, 0.4, 0.4}}) {
        Row row;
        for (int i = 0; i < 500; ++i) {
            const double angle = choice.between(0, 2 * pi), y = choice.between(-0.8, 0.8);
            const double x = d * std::cos(angle), h = d * std::sin(angle);
            row.add(ceiling(x, x + 2, y - 1, y + 1, h), choice.direction());
        }
        row.print("H2 edge at " + std::to_string(d));
        EXPECT_GT(row.table.worst(), table) << d;
        EXPECT_GT(row.fraction.worst(), fraction) << d;
        EXPECT_GT(row.exact_clip.worst(), 1e-3) << d;
        EXPECT_LT(row.ours.worst(), 1e-7) << d;
    }
}

TEST(PublishedPolygon, FloatDropsSmallLights_M1) {  // H3
    print_head();
    Choice choice{{3}};
    for (const auto& [size, bar] : {std::pair{1e-1, 3e-7}, {1e-2, 1e-5}, {1e-3, 1e-3}, {1e-4, 0.3}}) {
        Row row;
        for (int i = 0; i < 300; ++i) {
            const Vec3 centre(choice.between(-1, 1), choice.between(-1, 1), 1);
            const Vec3 u = size * choice.direction(), v = size * glm::normalize(glm::cross(u, choice.direction()));
            const Vec3 n = choice.direction();
            if (glm::dot(n, centre) < 0.2 || std::abs(glm::dot(glm::cross(u, v), centre)) < 0.1 * size * size) continue;
            row.add(parallelogram(centre, u, v), n);
        }
        row.print("H3 size " + std::to_string(size));
        for (const Errors* e : {&row.exact_clip, &row.table, &row.fraction}) EXPECT_GT(e->median(), bar) << size;
        EXPECT_LT(row.ours_in_float.median(), row.exact_clip.median() / 2) << size;
        EXPECT_LT(*std::max_element(row.ours.relative.begin(), row.ours.relative.end()), 1e-6) << size;
    }
}

TEST(PublishedPolygon, FloatLosesLightsAcrossTheHorizonOfSmoothLobes_M4) {  // H13
    print_head();
    for (const auto& [alpha, bar] : {std::pair{1e-1, 3e-6}, {1e-2, 3e-4}, {1e-3, 3e-2}, {1e-4, 1.0}}) {
        Choice choice{{13}};
        Row row;
        for (int i = 0; i < 2000; ++i) {
            const Vec3 centre = choice.direction(), u = 0.5 * choice.vector(), v = 0.5 * choice.vector();
            // Rounded to float, so that all methods start from the same quad.
            const Mat3 to_lobe(glm::mat3(ltc_lobe(std::sqrt(alpha), choice.between(0.1, 1)).inverse));
            Corners light = parallelogram(centre, u, v);
            int above = 0, above_surface = 0;
            for (Vec3& corner : light) {
                above_surface += corner.z > 0;
                corner = Vec3(Vec3f(to_lobe * corner));
                above += corner.z > 0;
            }
            const bool is_crossing = above > 0 && above < 4 && above_surface == 4;
            if (is_crossing && exact(light, {0, 0, 1}) > 1e-9) row.add(light, {0, 0, 1});
        }
        row.print("H13 alpha " + std::to_string(alpha));
        EXPECT_GT(row.exact_clip.relative.size(), 20U);
        EXPECT_GT(row.exact_clip.median(), bar) << alpha;
        EXPECT_LT(*std::max_element(row.ours.relative.begin(), row.ours.relative.end()), 1e-6) << alpha;
    }
}

TEST(PublishedLobe, SmoothLobesAreTooWideBetweenNodes_M24) {  // H13: of entries, not of numbers of a lobe
    for (const auto& [roughness, factor] : {std::pair{0.5 / 63, 2.08}, {1.5 / 63, 1.11}}) {
        const double width = 2 * roughness * roughness;
        const float published = published::lobe_at(static_cast<float>(roughness), 1).inverse[2].z;
        const double ours = ltc_lobe(roughness, 1).inverse[2].z;
        EXPECT_NEAR(static_cast<double>(published) / width, factor, 0.01);
        EXPECT_NEAR(ours / width, 1, 5e-3);
    }
}

/// Worst errors of the proxies over quads whose centre is 1 away, with half axes of up to `size`: in the order of
/// Proxy.
struct ProxyErrors {
    std::array<double, 3> above{}, crossing{};
};

ProxyErrors proxy_errors(double size) {
    ProxyErrors worst;
    Choice choice{{14}};
    for (int i = 0; i < 200'000; ++i) {
        // Squares and slender rectangles: each is the worst somewhere.
        const double least = i % 2 ? 1 : 0.1;
        const Vec3 centre = choice.direction(), u = size * choice.between(least, 1) * choice.direction();
        const Vec3 v = size * choice.between(least, 1) * glm::normalize(glm::cross(u, choice.direction()));
        const Corners light = parallelogram(centre, u, v);
        const auto above = std::count_if(light.begin(), light.end(), [](const Vec3& p) { return p.z > 0; });
        if (above == 0) continue;
        const double expected = of(light, {0, 0, 1}) / pi;
        auto& errors = above == 4 ? worst.above : worst.crossing;
        for (const Proxy proxy : {Proxy::sphere, Proxy::table, Proxy::fraction}) {
            const double e = published::clipless_polygon<double>(light, proxy, true);
            double& error = errors[static_cast<size_t>(proxy)];
            error = std::max(error, std::abs(e - expected));
        }
    }
    return worst;
}

TEST(PublishedProxies, ErrorsAtTheHorizonAreThoseOfResearch_M4) {
    // Research 1.3, worst of 10^6 quads; sphere, table, fraction. Half axes of 1.5, above: .0059 of the sphere hangs on
    // few quads, so it is left out. Our polygon takes the place of the truth: the hazards' tests hold it to 1e-7.
    std::puts("| half axes | case | sphere | table | (l^2+z)/(l+1) |\n|---|---|---|---|---|");
    const auto check = [](double size, const char* name, const std::array<double, 3>& found,
                          const std::array<double, 3>& stated) {
        std::printf("| %.1f | %s | %.4f | %.4f | %.4f |\n", size, name, found[0], found[1], found[2]);
        for (size_t i = 0; i < 3; ++i)
            if (stated[i] > 0) {
                EXPECT_NEAR(found[i] / stated[i], 1, 0.2) << size << ' ' << name << ' ' << i;
            }
    };
    const ProxyErrors small = proxy_errors(0.2), middle = proxy_errors(0.6), large = proxy_errors(1.5);
    check(0.2, "crossing", small.crossing, {.0004, .0004, .0018});
    check(0.6, "above", middle.above, {.0020, .0020, .038});
    check(0.6, "crossing", middle.crossing, {.0150, .0150, .045});
    check(1.5, "above", large.above, {0, 0, .083});
    check(1.5, "crossing", large.crossing, {.078, .078, .158});
}

TEST(PublishedProxies, SphereIsTheConeOfEqualFormFactor_M11) {
    Choice choice{{15}};
    double table = 0;
    for (int i = 0; i < 20'000; ++i) {
        const double length = choice.between(0, 1), z = choice.between(-1, 1);
        EllipticCone<double> cone;
        cone.a = cone.b = std::sqrt(length / (1 - length));
        const double expected = irradiance_of_cone(cone, Vec3(std::sqrt(1 - z * z), 0, z)) / pi;
        EXPECT_NEAR(published::clipped_sphere(length, z), expected, 1e-13) << length << ' ' << z;
        table = std::max(table, std::abs(published::at_horizon(length, z, Proxy::table) - expected));
    }
    EXPECT_NEAR(table, 0.020, 0.002);  // the table's own error, next to half spaces
}

TEST(PublishedPolygon, AgreesWhereNothingIsHard_M1) {
    Choice choice{{16}};
    for (int i = 0; i < 10'000; ++i) {
        const Corners light = parallelogram(2.0 * choice.direction(), choice.direction(), choice.direction());
        const Quad<double> quad = in_frame<double>(light, {0, 0, 1});
        EXPECT_NEAR(published::clipped_polygon<double>(quad), of(light, {0, 0, 1}, false) / pi, 5e-7);
    }
}

TEST(PublishedQuad, IsOursInOneLookup_M24) {
    // At a node the shader's way is the frame, the matrix and two integrals: ours in double, but for float.
    Choice choice{{17}};
    for (int i = 0; i < 200; ++i) {
        const Vec3 point = choice.vector(), normal = choice.direction();
        const double cosine = ltc_row_cosine(20);
        const Mat3 frame = frame_around(normal);
        const Vec3 view = std::sqrt(1 - cosine * cosine) * frame[0] + cosine * normal;
        const Corners light = parallelogram(point + 2.0 * choice.direction(), choice.direction(), choice.direction());
        const LtcLobe lobe = ltc_lobe(40.0 / 63, cosine);
        Corners in_lobe;
        for (const Vec3& corner : light) in_lobe.push_back(lobe.inverse * (glm::transpose(frame) * (corner - point)));
        const Quad<float> corners = {Vec3f(light[0]), Vec3f(light[1]), Vec3f(light[2]), Vec3f(light[3])};
        const float roughness = 40.0F / 63;
        const published::Shares s =
            published::clipped_quad(corners.data(), Vec3f(point), Vec3f(normal), Vec3f(view), roughness);
        EXPECT_NEAR(s.diffuse, irradiance_of_polygon<double>(light, point, normal) / pi, 3e-6) << i;
        EXPECT_NEAR(s.specular, of(in_lobe, {0, 0, 1}, false) / pi, 1e-5) << i;
        EXPECT_NEAR(s.albedo, lobe.albedo, 1e-6);
        EXPECT_NEAR(s.fresnel, ltc_lobe(40.0 / 63, cosine, LobePart::schlick).albedo, 1e-6);
        const published::Shares t = published::clipless_quad(corners.data(), Vec3f(point), Vec3f(normal), Vec3f(view),
                                                             roughness, Proxy::sphere);
        EXPECT_NEAR(t.diffuse, s.diffuse, 0.1) << i;
        EXPECT_NEAR(t.specular, s.specular, 0.1) << i;
    }
}

}  // namespace
}  // namespace surimi
