// SPDX-License-Identifier: Apache-2.0
#include "runtime/compare/compare.h"

#include <algorithm>
#include <array>
#include <vector>

#include "runtime/base/parallel.h"
#include "runtime/compare/same_size.h"

namespace surimi {
namespace {

/// Taps of a one-dimensional filter, from -radius to radius.
struct Kernel {
    int radius = 0;
    std::vector<double> taps;
};

/// Rows of an image and, above and below, those that filters reach; double because sums of three dozen taps follow.
using Band = Image<double>;

/// One Gaussian of a contrast sensitivity function, as seen in the image: amplitude and width.
struct Sensitivity {
    double a = 0;  ///< at frequency 0
    double b = 0;  ///< a exp(-b f^2), degrees squared
};
/// Fitted by Andersson et al. 2020 (their table 1) to the functions of the achromatic, red-green and blue-yellow
/// channels; only the last needs a second Gaussian.
constexpr std::array<std::array<Sensitivity, 2>, 3> sensitivities = {
    {{{{1, 0.0047}, {}}}, {{{1, 0.0053}, {}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};
constexpr double widest_sensitivity = 0.04;

constexpr double color_exponent = 0.7;    // q_c
constexpr double knee = 0.4;              // p_c: share of the largest colour difference at which compression begins
constexpr double knee_value = 0.95;       // p_t: and the value that it gets
constexpr double feature_width = 0.082;   // w: degrees from one side of the widest edge that is an edge to the other
constexpr double feature_exponent = 0.5;  // q_f

/// Samples g(x) at whole pixels.
template <class Function>
Kernel sampled(int radius, const Function& g) {
    Kernel kernel{radius, {}};
    for (int x = -radius; x <= radius; ++x) kernel.taps.push_back(g(static_cast<double>(x)));
    return kernel;
}

/// Scales positive taps to sum 1 and negative ones to sum -1, so that the answer to a step does not depend on the
/// sampling.
Kernel balanced(Kernel kernel) {
    double positive = 0, negative = 0;
    for (const double tap : kernel.taps) (tap > 0 ? positive : negative) += tap;
    for (double& tap : kernel.taps) tap /= tap > 0 ? positive : negative < 0 ? -negative : 1;
    return kernel;
}

/// Every filter of M28 at one resolution.
struct Filters {
    struct Term {
        double weight = 0;
        Kernel kernel;
    };
    std::array<std::vector<Term>, 3> sensitivity;  ///< of each channel, a sum of separable Gaussians of sum 1
    Kernel smooth, edge, point;                    ///< Gaussian and its two derivatives
    int reach = 0;                                 ///< the largest radius
};

Filters make_filters(double pixels_per_degree) {
    Filters filters;
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest_sensitivity / 2) / pi * pixels_per_degree));
    for (size_t channel = 0; channel < 3; ++channel) {
        double total = 0;
        for (const Sensitivity& s : sensitivities[channel]) {
            if (!(s.a > 0)) continue;
            const double scale = pi * pi / (s.b * pixels_per_degree * pixels_per_degree);
            Kernel kernel = balanced(sampled(radius, [&](double x) { return std::exp(-scale * x * x); }));
            const double side = 1 / kernel.taps[static_cast<size_t>(radius)];  // sum before it was balanced
            const double weight = s.a * std::sqrt(pi / s.b) * side * side;
            total += weight;
            filters.sensitivity[channel].push_back({weight, std::move(kernel)});
        }
        for (Filters::Term& term : filters.sensitivity[channel]) term.weight /= total;
    }
    const double deviation = feature_width / 2 * pixels_per_degree;
    const int feature_radius = static_cast<int>(std::ceil(3 * deviation));
    const auto gauss = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
    filters.smooth = balanced(sampled(feature_radius, gauss));
    filters.edge = balanced(sampled(feature_radius, [&](double x) { return -x * gauss(x); }));
    filters.point =
        balanced(sampled(feature_radius, [&](double x) { return (x * x / (deviation * deviation) - 1) * gauss(x); }));
    filters.reach = std::max(radius, feature_radius);
    return filters;
}

/// Filters along the rows; the border's pixels continue beyond it.
Band along(const Band& band, const Kernel& kernel) {
    Band result(band.width, band.height);
    std::vector<double> padded(static_cast<size_t>(band.width + 2 * kernel.radius));
    for (int y = 0; y < band.height; ++y) {
        const double* row = &band.at(0, y);
        for (int x = 0; x < static_cast<int>(padded.size()); ++x)
            padded[static_cast<size_t>(x)] = row[std::clamp(x - kernel.radius, 0, band.width - 1)];
        double* out = &result.at(0, y);
        for (size_t k = 0; k < kernel.taps.size(); ++k)
            for (int x = 0; x < band.width; ++x) out[x] += kernel.taps[k] * padded[static_cast<size_t>(x) + k];
    }
    return result;
}

/// Filters down the columns, for the rows from `first` on that the band has neighbours for, `height` of them.
Band down(const Band& band, const Kernel& kernel, int first, int height) {
    Band result(band.width, height);
    for (int y = 0; y < height; ++y) {
        double* out = &result.at(0, y);
        for (int k = 0; k <= 2 * kernel.radius; ++k) {
            const double* row = &band.at(0, first + y - kernel.radius + k);
            const double tap = kernel.taps[static_cast<size_t>(k)];
            for (int x = 0; x < band.width; ++x) out[x] += tap * row[x];
        }
    }
    return result;
}

/// Linear sRGB to XYZ relative to its white, so that white is (1, 1, 1) (Rec. 709 primaries, D65).
const Mat3& xyz_of_rgb() {
    static const Mat3 matrix = [] {
        const Mat3 rows(0.4123907993, 0.3575843394, 0.1804807884,   // X
                        0.2126390059, 0.7151686788, 0.0721923154,   // Y
                        0.0193308187, 0.1191947798, 0.9505321522);  // Z
        Mat3 scaled = rows;
        for (int i = 0; i < 3; ++i) scaled[i] /= rows[i].x + rows[i].y + rows[i].z;
        return glm::transpose(scaled);
    }();
    return matrix;
}

/// CIELAB with the chroma scaled by lightness, as colours look paler in the dark (Hunt 1952).
Vec3 perceived(const Vec3& rgb) {
    const Vec3 xyz = xyz_of_rgb() * rgb;
    constexpr double bend = 6.0 / 29;
    const auto f = [](double t) { return t > bend * bend * bend ? std::cbrt(t) : t / (3 * bend * bend) + 4.0 / 29; };
    const double x = f(xyz.x), y = f(xyz.y), z = f(xyz.z);
    const double lightness = 116 * y - 16;
    return {lightness, 5 * lightness * (x - y), 2 * lightness * (y - z)};
}

/// HyAB of two such colours, to the power q_c.
double color_distance(const Vec3& a, const Vec3& b) {
    return std::pow(std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z), color_exponent);
}

/// The largest of these distances, between green and blue.
double largest_color_distance() {
    return color_distance(perceived({0, 1, 0}), perceived({0, 0, 1}));
}

/// What is seen of some rows of one image.
struct Seen {
    Image<Vec3> color;
    Band edge, point;
};

/// A colour as a screen shows it.
Vec3 displayed(const Vec3f& color) {
    const auto clamp = [](float x) { return x > 0 ? std::min(static_cast<double>(x), 1.0) : 0; };
    return {clamp(color.x), clamp(color.y), clamp(color.z)};
}

double length(double x, double y) {
    return std::sqrt(x * x + y * y);
}

Seen see(const Image<Vec3f>& image, const Filters& filters, int first_row, int rows) {
    std::array<Band, 3> opponent;  // Y, X - Y and Y - Z, relative to white
    opponent.fill(Band(image.width, rows + 2 * filters.reach));
    for (int y = 0; y < opponent[0].height; ++y) {
        const int row = std::clamp(first_row + y - filters.reach, 0, image.height - 1);
        for (int x = 0; x < image.width; ++x) {
            const Vec3 xyz = xyz_of_rgb() * displayed(image.at(x, row));
            opponent[0].at(x, y) = xyz.y;
            opponent[1].at(x, y) = xyz.x - xyz.y;
            opponent[2].at(x, y) = xyz.y - xyz.z;
        }
    }
    Seen seen{Image<Vec3>(image.width, rows), Band(image.width, rows), Band(image.width, rows)};
    for (int c = 0; c < 3; ++c)
        for (const Filters::Term& term : filters.sensitivity[static_cast<size_t>(c)]) {
            const Band blurred =
                down(along(opponent[static_cast<size_t>(c)], term.kernel), term.kernel, filters.reach, rows);
            for (size_t i = 0; i < blurred.pixels.size(); ++i)
                seen.color.pixels[i][c] += term.weight * blurred.pixels[i];
        }
    static const Mat3 rgb_of_xyz = glm::inverse(xyz_of_rgb());
    for (Vec3& color : seen.color.pixels) {
        const Vec3 xyz(color.x + color.y, color.x, color.x - color.z);
        color = perceived(glm::clamp(rgb_of_xyz * xyz, 0.0, 1.0));
    }
    const Band smooth = along(opponent[0], filters.smooth);
    const auto strength = [&](const Kernel& kernel, Band& result) {
        const Band across = down(along(opponent[0], kernel), filters.smooth, filters.reach, rows);
        const Band upright = down(smooth, kernel, filters.reach, rows);
        for (size_t i = 0; i < result.pixels.size(); ++i)
            result.pixels[i] = length(across.pixels[i], upright.pixels[i]);
    };
    strength(filters.edge, seen.edge);
    strength(filters.point, seen.point);
    return seen;
}

/// The colour difference, compressed to [0, 1] so that small ones stay apart.
double compressed(double distance, double largest) {
    const double bend = knee * largest;
    if (distance < bend) return knee_value / bend * distance;
    return std::min(1.0, knee_value + (distance - bend) / (largest - bend) * (1 - knee_value));
}

}  // namespace

Image<float> flip(const Image<Vec3f>& image, const Image<Vec3f>& reference, double pixels_per_degree) {
    require_same_size(image, reference);
    if (!(pixels_per_degree >= 1 && pixels_per_degree <= 10000))  // below 1 no tap next to the middle counts
        throw Error(ErrorKind::usage, "pixels per degree must be from 1 to 10000");
    Image<float> result(image.width, image.height);
    if (result.empty()) return result;
    const Filters filters = make_filters(pixels_per_degree);
    const double largest = largest_color_distance();
    // Bands keep memory small; long enough for the rows that neighbours compute twice not to matter.
    const size_t band_rows = static_cast<size_t>(std::max(64, 4 * filters.reach));
    parallel_ranges(static_cast<size_t>(image.height), band_rows, [&](size_t begin, size_t end) {
        const int first = static_cast<int>(begin), rows = static_cast<int>(end - begin);
        const Seen a = see(image, filters, first, rows), b = see(reference, filters, first, rows);
        float* out = &result.at(0, first);
        for (size_t i = 0; i < a.color.pixels.size(); ++i) {
            const double color = compressed(color_distance(a.color.pixels[i], b.color.pixels[i]), largest);
            const double feature = std::max(std::abs(a.edge.pixels[i] - b.edge.pixels[i]),
                                            std::abs(a.point.pixels[i] - b.point.pixels[i]));
            const double seen = std::pow(std::min(1.0, feature / std::sqrt(2.0)), feature_exponent);
            out[i] = static_cast<float>(std::pow(color, 1 - seen));
        }
    });
    return result;
}

}  // namespace surimi
