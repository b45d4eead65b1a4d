// SPDX-License-Identifier: Apache-2.0
// Visibility from a point by lines across the panel: on each, silhouettes cut intervals of constant numbers of
// occluders, one ray tells which number is none, and the light of an interval is a closed form.
#pragma once

#include <cstdint>
#include <vector>

#include "baker/gather/line_lanes.h"
#include "baker/gather/split.h"

namespace surimi {

struct ScanlineTask {
    const RayScene& rays;
    size_t monitor = 0;
    int lines = 64;      ///< a multiple of 4
    double shift = 0.5;  ///< of the lines, in [0, 1) of their distance
    int checks = 2;      ///< rays through random intervals that have to agree
    uint64_t key = 0;    ///< of the random numbers
};

/// Memory that is used again from point to point.
struct ScanlineWorkspace {
    struct Crossing {
        float x;
        int jump;
    };
    struct Event {
        double height;
        int jump;
    };
    struct Interval {
        float begin;
        int depth;
    };
    struct Level {
        double length = 0;  ///< of all its intervals
        float longest = 0;
        Vec2 middle{0};  ///< of the longest, (x, y) of the turned frame
    };
    struct Line {
        float begin = 0, end = 0;          ///< of the open part of the panel; begin >= end: not met
        float lit_begin = 0, lit_end = 0;  ///< of the lit part
        uint32_t first = 0;                ///< its intervals are intervals[first, next line's first)
    };
    struct Owner {         ///< of an integral's end
        uint8_t set;       ///< its line's number modulo 4
        bool is_arriving;  ///< of what arrives, not of all light
    };
    LineSegments turned;
    std::vector<uint32_t> offsets;
    std::vector<Crossing> crossings;
    std::vector<Event> events;
    std::vector<Interval> intervals;
    std::vector<Level> levels;
    std::vector<Line> lines;
    LineEnds ends;
    std::vector<Owner> owners;
};

/// Sums over lines of the panel's lit part (M54). The error is estimated from four interleaved sets of lines (M55).
/// Cross-check rays: one on the level above the one that is taken to be free, and `checks` random ones.
PointVisibility scan(const PanelView& view, const Segments& segments, const ScanlineTask& task,
                     ScanlineWorkspace& work);

}  // namespace surimi
