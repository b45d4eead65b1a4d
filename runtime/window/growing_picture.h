// SPDX-License-Identifier: Apache-2.0
// One picture, from a coarse first sight to the last pass, in work items that may stop at any time.
#pragma once

#include <functional>

#include "runtime/preview/film.h"

namespace surimi {

/// After its last pass it holds the very bytes that `render` gives for the same lighting, view and settings.
class GrowingPicture {
  public:
    /// Begins with one sample for each block of `first_block` pixels along a side; 1: with the first pass. What is
    /// shown while the first one is made is black. `lighting` must outlive it, and not change. A size of 0 is done at
    /// once.
    GrowingPicture(const Lighting& lighting, const View& view, const RenderSettings& settings, int first_block);

    /// Goes on with the present stage, on all threads, by work items that come to about `samples` camera rays: tiles of
    /// a coarse picture or of a pass, at least one for each thread. Before each item it asks `is_cancelled` (from any
    /// thread; may be empty), and leaves the item for later where the answer is true. Returns the parts of pixels()
    /// that are new.
    std::vector<Tile> advance(size_t samples, const std::function<bool()>& is_cancelled = {});

    const Image<Vec3f>& pixels() const { return pixels_; }  ///< what there is: linear; lit views: nits
    bool is_done() const { return pass_ == passes_; }
    bool is_first_sight() const { return !has_first_sight_; }  ///< not a whole picture yet, however coarse
    int block() const { return block_; }  ///< pixels along a side that a sample of this stage stands for
    int passes() const { return pass_; }  ///< whole ones, of passes_wanted()
    int passes_wanted() const { return passes_; }
    size_t samples() const { return samples_; }            ///< camera rays of all stages
    double bright_level() const { return bright_level_; }  ///< of the last whole stage, as Picture has it; 0 before
    MonitorCounts counts() const;                          ///< of all monitors and stages

  private:
    void begin_stage();
    void end_stage();

    Shot shot_;
    RenderSettings settings_;
    int passes_;
    int block_;
    int pass_ = 0;
    bool has_first_sight_ = false;
    size_t samples_ = 0;
    double bright_level_ = 0;
    Film film_{0, 0};    // of the passes; has pixels from the first one on
    Film coarse_{0, 0};  // of the present coarse stage
    Image<Vec3f> pixels_;
    std::vector<Tile> tiles_;            // of the present stage's film
    std::vector<size_t> pending_;        // tiles that are still to be done, the next one first
    std::vector<MonitorCounts> counts_;  // by tile of film_, then monitor
};

}  // namespace surimi
