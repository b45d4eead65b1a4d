// SPDX-License-Identifier: Apache-2.0
#include "tests/support/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace surimi::test {
namespace {

struct Estimate {
    Real kronrod, difference;
};

Estimate gauss_kronrod(const std::function<Real(Real)>& f, Real a, Real b) {
    // Abscissae and weights of QUADPACK's qk15 (Piessens et al. 1983).
    constexpr std::array<Real, 8> x = {0.991455371120812639206854697526329L, 0.949107912342758524526189684047851L,
                                       0.864864423359769072789712788640926L, 0.741531185599394439863864773280788L,
                                       0.586087235467691130294144691693998L, 0.405845151377397166906606412076961L,
                                       0.207784955007898467600689403773245L, 0.0L};
    constexpr std::array<Real, 8> kronrod = {
        0.022935322010529224963732008058970L, 0.063092092629978553290700663189204L,
        0.104790010322250183839876322541518L, 0.140653259715525918745189590510238L,
        0.169004726639267902826583426598550L, 0.190350578064785409913256402421014L,
        0.204432940075298892414161999234649L, 0.209482141084727828012999174891714L};
    constexpr std::array<Real, 4> gauss = {0.129484966168869693270611432679082L, 0.279705391489276667901467771423780L,
                                           0.381830050505118944950369775488975L, 0.417959183673469387755102040816327L};
    const Real middle = (a + b) / 2, half = (b - a) / 2;
    Real sum_kronrod = 0, sum_gauss = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        const Real value = i == 7 ? f(middle) : f(middle - half * x[i]) + f(middle + half * x[i]);
        sum_kronrod += kronrod[i] * value;
        if (i % 2 == 1) sum_gauss += gauss[i / 2] * value;
    }
    return {sum_kronrod * half, std::abs(sum_kronrod - sum_gauss) * half};
}

Real refined(const std::function<Real(Real)>& f, Real a, Real b, const Estimate& whole, Real tolerance, int depth) {
    // A difference that is the rounding of the values themselves does not shrink any more.
    const bool is_noise = whole.difference <= 1e-17L * std::abs(whole.kronrod);
    if (whole.difference <= tolerance || is_noise || depth == 0) return whole.kronrod;
    const Real middle = (a + b) / 2;
    const Estimate left = gauss_kronrod(f, a, middle), right = gauss_kronrod(f, middle, b);
    return refined(f, a, middle, left, tolerance, depth - 1) + refined(f, middle, b, right, tolerance, depth - 1);
}

Vec3l point_of(const Ellipse<Real>& e, Real t) {
    return e.centre + std::cos(t) * e.half_u + std::sin(t) * e.half_v;
}

/// Sum of the integrals between neighbouring ones of these ends.
Real integral_between(const std::function<Real(Real)>& f, std::vector<Real> ends, Real relative) {
    std::sort(ends.begin(), ends.end());
    Real sum = 0;
    for (size_t i = 0; i + 1 < ends.size(); ++i) sum += integral(f, ends[i], ends[i + 1], relative);
    return sum;
}

/// The part of [0, end] in which start + s along is above the horizons of all these normals; empty: {0, 0}.
std::pair<Real, Real> part_above(const std::vector<Vec3l>& normals, const Vec3l& start, const Vec3l& along, Real end) {
    Real from = 0, to = end;
    for (const Vec3l& n : normals) {
        const Real height = glm::dot(n, start), slope = glm::dot(n, along);
        if (height < 0) from = std::max(from, slope > 0 ? -height / slope : end);
        if (height + slope * end < 0) to = std::min(to, slope < 0 ? std::max(Real(0), -height / slope) : 0);
    }
    return from < to ? std::pair(from, to) : std::pair(Real(0), Real(0));
}

bool is_above(const std::vector<Vec3l>& normals, const Vec3l& p) {
    return std::all_of(normals.begin(), normals.end(), [&](const Vec3l& n) { return glm::dot(n, p) >= 0; });
}

}  // namespace

Real integral(const std::function<Real(Real)>& f, Real a, Real b, Real relative) {
    if (!(b > a)) return 0;
    // Several intervals to begin with, so that a narrow peak is not overlooked.
    constexpr int n = 8;
    std::array<Estimate, n> first;
    Real sum = 0;
    for (int i = 0; i < n; ++i) {
        first[static_cast<size_t>(i)] = gauss_kronrod(f, a + (b - a) * i / n, a + (b - a) * (i + 1) / n);
        sum += std::abs(first[static_cast<size_t>(i)].kronrod);
    }
    constexpr int depth = 30;
    Real result = 0;
    for (int i = 0; i < n; ++i)
        result += refined(f, a + (b - a) * i / n, a + (b - a) * (i + 1) / n, first[static_cast<size_t>(i)],
                          relative * sum, depth);
    return result;
}

std::vector<std::pair<Real, Real>> parts_above(Real c, Real x, Real y, Real from, Real to) {
    std::vector<Real> ends = {from, to};
    const Real amplitude = std::hypot(x, y);
    if (amplitude > std::abs(c)) {
        const Real middle = std::atan2(y, x);
        const Real half = std::atan2(std::sqrt((amplitude - c) * (amplitude + c)), -c);
        for (Real end : {middle - half, middle + half}) {
            end += 2 * pi_l * std::ceil((from - end) / (2 * pi_l));
            if (end > from && end < to) ends.push_back(end);
        }
    }
    std::sort(ends.begin(), ends.end());
    std::vector<std::pair<Real, Real>> parts;
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
        const Real t = (ends[i] + ends[i + 1]) / 2;
        if (c + x * std::cos(t) + y * std::sin(t) >= 0) parts.emplace_back(ends[i], ends[i + 1]);
    }
    return parts;
}

Receiver cosine_receiver(const Vec3l& n) {
    const auto value = [n](const Vec3l& p) {
        const Real square = glm::dot(p, p);
        return std::max(Real(0), glm::dot(n, p)) / (square * square);
    };
    return {value, {n}};
}

Receiver lobe_receiver(const Mat3& to_cosine, const Vec3& normal) {
    const glm::mat<3, 3, Real> matrix(to_cosine);
    const Real determinant = glm::determinant(matrix);
    const auto value = [matrix, determinant](const Vec3l& p) {
        const Vec3l q = matrix * p;
        const Real square = glm::dot(q, q);
        return determinant * std::max(Real(0), q.z) / (pi_l * square * square);
    };
    return {value, {Vec3l(normal), glm::transpose(matrix)[2]}};
}

Real area_integral(const Vec3l& corner, const Vec3l& u, const Vec3l& v, const Receiver& receiver) {
    const Real side = std::abs(glm::dot(glm::cross(u, v), corner));
    const auto strip = [&](Real s) {
        const auto [from, to] = part_above(receiver.normals, corner + s * u, v, 1);
        return integral([&](Real t) { return side * receiver.value(corner + s * u + t * v); }, from, to);
    };
    // Kinks where a plane meets the first or the last edge.
    std::vector<Real> ends = {0, 1};
    for (const Vec3l& start : {corner, corner + v})
        for (const Vec3l& n : receiver.normals) {
            const auto [from, to] = part_above({n}, start, u, 1);
            if (from < to) ends.insert(ends.end(), {from, to});
        }
    return integral_between(strip, ends, 1e-14L);
}

Real area_integral(const Ellipse<Real>& ellipse, const Receiver& receiver) {
    const Real side = std::abs(glm::dot(glm::cross(ellipse.half_u, ellipse.half_v), ellipse.centre));
    const auto sector = [&](Real t) {
        const Vec3l outwards = std::cos(t) * ellipse.half_u + std::sin(t) * ellipse.half_v;
        const auto [from, to] = part_above(receiver.normals, ellipse.centre, outwards, 1);
        return integral([&](Real r) { return r * side * receiver.value(ellipse.centre + r * outwards); }, from, to);
    };
    // The sectors' integral has a kink where the outline crosses a horizon.
    std::vector<Real> ends = {0, 2 * pi_l};
    for (const Vec3l& n : receiver.normals)
        for (const auto& [from, to] : parts_above(glm::dot(n, ellipse.centre), glm::dot(n, ellipse.half_u),
                                                  glm::dot(n, ellipse.half_v), 0, 2 * pi_l))
            ends.insert(ends.end(), {from, to});
    return integral_between(sector, ends, 1e-14L);
}

Real area_integral(const Ellipsoid<Real>& ellipsoid, const Receiver& receiver) {
    const auto& v = ellipsoid.half_axes;
    const Real det = glm::dot(v[0], glm::cross(v[1], v[2])), volume = std::abs(det);
    // In the space where the ellipsoid is the unit ball, the origin lies at distance `far` in the direction `pole`.
    const Vec3l origin =
        -Vec3l(glm::dot(glm::cross(v[1], v[2]), ellipsoid.centre), glm::dot(glm::cross(v[2], v[0]), ellipsoid.centre),
               glm::dot(glm::cross(v[0], v[1]), ellipsoid.centre)) /
        det;
    const Real far = glm::length(origin);
    const glm::mat<3, 3, Real> frame = frame_around<Real>(origin / far);
    const auto to_world = [&](const Vec3l& s) { return v[0] * s.x + v[1] * s.y + v[2] * s.z; };
    const Real rim = std::atan2(std::sqrt((far - 1) * (far + 1)), Real(1));
    const Vec3l pole = to_world(frame[2]);
    return integral(
        [&](Real t) {
            const Vec3l side = to_world(std::cos(t) * frame[0] + std::sin(t) * frame[1]);
            std::vector<Real> ends = {0, rim};
            for (const Vec3l& n : receiver.normals)
                for (const auto& [from, to] :
                     parts_above(glm::dot(n, ellipsoid.centre), glm::dot(n, pole), glm::dot(n, side), 0, rim))
                    ends.insert(ends.end(), {from, to});
            return integral_between(
                [&](Real angle) {
                    const Vec3l p = ellipsoid.centre + std::cos(angle) * pole + std::sin(angle) * side;
                    const Real facing = std::sin(angle) * volume * (far * std::cos(angle) - 1);
                    return is_above(receiver.normals, p) ? facing * receiver.value(p) : 0;
                },
                ends, 1e-15L);
        },
        0, 2 * pi_l, 1e-12L);
}

Real area_integral(const Vec3l& a, const Vec3l& b, Real radius, const Receiver& receiver) {
    const Real length = glm::length(b - a);
    const glm::mat<3, 3, Real> frame = frame_around<Real>((b - a) / length);
    const Vec3l u = frame[0] * radius, v = frame[1] * radius;
    Real sum = 0;
    if (glm::dot(a, frame[2]) > 0) sum += area_integral(Ellipse<Real>{a, v, u}, receiver);
    if (glm::dot(b, frame[2]) < 0) sum += area_integral(Ellipse<Real>{b, u, v}, receiver);
    const auto strip = [&](Real t) {  // of the mantle, between the caps
        const Vec3l outwards = std::cos(t) * frame[0] + std::sin(t) * frame[1];
        const Vec3l foot = a + radius * outwards;
        const auto [z0, z1] = part_above(receiver.normals, foot, frame[2], length);
        const Real facing = radius * std::max(Real(0), -glm::dot(outwards, foot));
        return integral([&](Real z) { return facing * receiver.value(foot + z * frame[2]); }, z0, z1);
    };
    // It faces the origin where  outwards . p < 0,  p = a + R outwards + z axis; kinks where a rim meets a horizon.
    for (const auto& [from, to] : parts_above(-radius, -glm::dot(a, frame[0]), -glm::dot(a, frame[1]), 0, 2 * pi_l)) {
        std::vector<Real> ends = {from, to};
        for (const Vec3l& cap : {a, b})
            for (const Vec3l& n : receiver.normals)
                for (const auto& [left, right] :
                     parts_above(glm::dot(n, cap), glm::dot(n, u), glm::dot(n, v), from, to))
                    ends.insert(ends.end(), {left, right});
        sum += integral_between(strip, ends, 1e-13L);
    }
    return sum;
}

Real line_integral(const Vec3l& from, const Vec3l& to, const Receiver& receiver) {
    const Real side = glm::length(glm::cross(from, to - from));
    const auto [start, end] = part_above(receiver.normals, from, to - from, 1);
    return integral([&](Real s) { return side * receiver.value(from + s * (to - from)); }, start, end);
}

Real area_irradiance(const Ellipse<Real>& ellipse, const Vec3l& n) {
    return area_integral(ellipse, cosine_receiver(n));
}

Real area_irradiance(const Ellipsoid<Real>& ellipsoid, const Vec3l& n) {
    return area_integral(ellipsoid, cosine_receiver(n));
}

Real area_irradiance(const Vec3l& a, const Vec3l& b, Real radius, const Vec3l& n) {
    return area_integral(a, b, radius, cosine_receiver(n));
}

Real outline_irradiance(const Ellipse<Real>& e, const Vec3l& normal_in_double) {
    const Vec3l n = glm::normalize(normal_in_double);  // the closing edge is only right for a unit normal
    const Vec3l normal = glm::cross(e.half_u, e.half_v);
    const Real side = glm::dot(normal, e.centre) < 0 ? -1 : 1;
    // A full turn that begins below the horizon, if any of it is there, so the part above is in one piece.
    const Real start = std::atan2(-glm::dot(n, e.half_v), -glm::dot(n, e.half_u));
    const auto parts =
        parts_above(glm::dot(n, e.centre), glm::dot(n, e.half_u), glm::dot(n, e.half_v), start, start + 2 * pi_l);
    Real sum = 0;
    for (const auto& [from, to] : parts) {
        sum += side * integral(
                          [&](Real t) {
                              const Vec3l p = point_of(e, t);
                              const Vec3l dp = std::cos(t) * e.half_v - std::sin(t) * e.half_u;
                              return glm::dot(n, glm::cross(e.centre, dp) + normal) / glm::dot(p, p);
                          },
                          from, to, 1e-19L);
        // The closing edge p - q from its angles: the difference of the points would be rounded like the points.
        const Vec3l p = point_of(e, from), q = point_of(e, to);
        const Vec3l edge = (std::cos(from) - std::cos(to)) * e.half_u + (std::sin(from) - std::sin(to)) * e.half_v;
        if (to - from < 2 * pi_l * (1 - 1e-15L)) sum += std::atan2(glm::length(glm::cross(q, edge)), glm::dot(q, p));
    }
    return sum / 2;
}

Real corner_irradiance(std::span<const Vec3l> corners, const Vec3l& n) {
    std::vector<Vec3l> kept;
    for (size_t i = 0; i < corners.size(); ++i) {
        const Vec3l &a = corners[i], &b = corners[(i + 1) % corners.size()];
        const Real ha = glm::dot(n, a), hb = glm::dot(n, b);
        if (ha >= 0) kept.push_back(a);
        if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) kept.push_back(a + (b - a) * (ha / (ha - hb)));
    }
    Real sum = 0;
    for (size_t i = 0; i < kept.size(); ++i) {
        const Vec3l &a = kept[i], &b = kept[(i + 1) % kept.size()];
        const Vec3l c = glm::cross(a, b);
        const Real length = glm::length(c);
        if (length > 0) sum += std::atan2(length, glm::dot(a, b)) * glm::dot(n, c) / length;
    }
    return std::abs(sum) / 2;
}

}  // namespace surimi::test
