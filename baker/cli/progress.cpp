// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string_view>

namespace surimi {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<bool> is_interrupted{false};  // written by the signal handler, which has no other way to speak

enum class Style { bar, lines, json };

struct Display {
    Style style = Style::lines;
    std::mutex mutex;
    std::string stage;
    double shown = -1;  // fraction of the last output
    Clock::time_point start, last;

    void show(std::string_view name, double fraction);
    void show_bar(double fraction, double seconds);
};

void Display::show_bar(double fraction, double seconds) {
    constexpr int cells = 28;
    const int full = static_cast<int>(fraction * cells);
    const double left = fraction > 0.01 ? seconds * (1 - fraction) / fraction : 0;
    fmt::print(stderr, "\r{:<28} [{:=<{}}{:<{}}] {:3.0f} %  {:.0f} s{}\033[K", stage, "", full, "", cells - full,
               100 * fraction, seconds, fraction < 1 && left > 0 ? fmt::format(", {:.0f} s left", left) : "");
    if (fraction >= 1) fmt::print(stderr, "\n");
    std::fflush(stderr);
}

void Display::show(std::string_view name, double fraction) {
    const std::lock_guard lock(mutex);
    const auto now = Clock::now();
    if (stage != name) stage = name, shown = -1, start = now;
    // Threads report out of order; only what moves on is news.
    const double step = style == Style::bar ? 0.001 : 0.1;
    const bool is_due = fraction >= shown + step || (fraction >= 1 && shown < 1);
    if (!is_due || (style == Style::bar && fraction < 1 && now - last < std::chrono::milliseconds(50))) return;
    const double seconds = std::chrono::duration<double>(now - start).count();
    last = now;
    shown = style == Style::bar || fraction >= 1 ? fraction : std::floor(fraction * 10) / 10;
    if (style == Style::bar) show_bar(fraction, seconds);
    if (style == Style::lines) fmt::print(stderr, "{}: {:.0f} %, {:.1f} s\n", stage, 100 * fraction, seconds);
    if (style == Style::json)
        fmt::print(stderr, "{{\"stage\":\"{}\",\"fraction\":{:.3f},\"seconds\":{:.3f}}}\n", stage, fraction, seconds);
}

}  // namespace

Progress make_progress(const std::string& style, bool is_quiet) {
    std::signal(SIGINT, [](int) { is_interrupted = true; });
    Progress progress;
    progress.is_cancelled = [] { return is_interrupted.load(); };
    if (is_quiet || style == "none") return progress;
    const char* terminal = std::getenv("TERM");
    const bool can_redraw = isatty(STDERR_FILENO) && terminal && std::string_view(terminal) != "dumb";
    const auto display = std::make_shared<Display>();
    if (style == "bar" || (style == "auto" && can_redraw)) display->style = Style::bar;
    if (style == "json") display->style = Style::json;
    progress.report = [display](std::string_view stage, double fraction) { display->show(stage, fraction); };
    return progress;
}

}  // namespace surimi
