// SPDX-License-Identifier: Apache-2.0
// Prints, as Markdown, what disk lights cost and how far they are off: the published ways (Heitz and Hill 2017) in
// float and double with the sphere table at the horizon, and ours.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "tests/support/disk_families.h"
#include "tests/support/published_disk.h"

namespace {

using namespace surimi;
using test::AxesBy;
using test::DiskCase;
using test::DiskFamily;

/// A method is a function that fills the form factors of both sides of some ellipses in the cosine's space.
struct Method {
    const char* name;
    void (*fill)(const std::vector<Ellipse<double>>& ellipses, std::vector<double>& values);
};

template <class T>
Ellipse<T> as(const Ellipse<double>& e) {
    using V = glm::vec<3, T>;
    return {V(e.centre), V(e.half_u), V(e.half_v)};
}

template <class T, AxesBy by>
void published(const std::vector<Ellipse<double>>& ellipses, std::vector<double>& values) {
    for (size_t i = 0; i < ellipses.size(); ++i)
        values[i] = static_cast<double>(test::published_disk(as<T>(ellipses[i]), by, published::Proxy::table, true));
}

template <class T>
void ours(const std::vector<Ellipse<double>>& ellipses, std::vector<double>& values) {
    using V = glm::vec<3, T>;
    for (size_t i = 0; i < ellipses.size(); ++i)
        values[i] = static_cast<double>(irradiance_of_ellipse(as<T>(ellipses[i]), V(0), V(0, 0, 1), true)) / pi;
}

constexpr Method methods[] = {{"published, plain, float", published<float, AxesBy::plain>},
                              {"published, sqrt(Q), float", published<float, AxesBy::root>},
                              {"published, u and v, float", published<float, AxesBy::sums>},
                              {"published, plain, double", published<double, AxesBy::plain>},
                              {"published, sqrt(Q), double", published<double, AxesBy::root>},
                              {"published, u and v, double", published<double, AxesBy::sums>},
                              {"ours, float", ours<float>},
                              {"ours, double", ours<double>}};

/// Time of this thread in nanoseconds.
double thread_time() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

/// Median over 25 repeats, in nanoseconds for each ellipse.
double time_of(const Method& method, const std::vector<Ellipse<double>>& ellipses) {
    std::vector<double> values(ellipses.size()), times;
    for (int repeat = 0; repeat < 25; ++repeat) {
        const double start = thread_time();
        method.fill(ellipses, values);
        times.push_back((thread_time() - start) / static_cast<double>(ellipses.size()));
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

/// Worst and root mean square error of the form factor, and how many are not a number.
std::string errors_of(const Method& method, const std::vector<DiskCase>& cases) {
    std::vector<Ellipse<double>> ellipses;
    for (const DiskCase& c : cases) ellipses.push_back(c.ellipse);
    std::vector<double> values(cases.size());
    method.fill(ellipses, values);
    double worst = 0, squares = 0;
    size_t count = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        if (std::isnan(values[i])) continue;
        const double error = std::abs(values[i] - cases[i].exact);
        worst = std::max(worst, error);
        squares += error * error;
        ++count;
    }
    char text[64];
    if (count == 0) return " - |";
    std::snprintf(text, sizeof text, " %.0e, %.0e, %zu |", worst, std::sqrt(squares / static_cast<double>(count)),
                  cases.size() - count);
    return text;
}

}  // namespace

int main() {
    const std::vector<DiskFamily> families = test::disk_families(500);
    // Apart, because above the horizon our closed form needs no function beyond roots.
    std::vector<Ellipse<double>> above, across;
    for (const DiskFamily& family : families)
        for (const DiskCase& c : family.cases) (c.is_above ? above : across).push_back(c.ellipse);
    std::puts("| method | ns above the horizon | ns across it |\n|---|---|---|");
    for (const Method& method : methods)
        std::printf("| %s | %.0f | %.0f |\n", method.name, time_of(method, above), time_of(method, across));
    std::printf("\n| worst, RMS error, NaN of %zu |", families[0].cases.size());
    for (const Method& method : methods) std::printf(" %s |", method.name);
    std::puts("\n|---|---|---|---|---|---|---|---|---|");
    for (const DiskFamily& family : families) {
        std::printf("| %s |", family.name.c_str());
        for (const Method& method : methods) std::fputs(errors_of(method, family.cases).c_str(), stdout);
        std::puts("");
    }
}
