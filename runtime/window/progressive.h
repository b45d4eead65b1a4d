// SPDX-License-Identifier: Apache-2.0
// A renderer in the background that always works on the last wish, and shows what there is.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "runtime/window/growing_picture.h"

namespace surimi {

/// What the picture shall be.
struct Wish {
    View view;
    RenderSettings picture;
    LightingSettings lighting;
    std::vector<Vec3> radiance;      ///< of each monitor of the scene: linear, nits
    std::optional<double> exposure;  ///< stops; empty: automatic. Another exposure starts nothing anew
    int metering = 0;  ///< the automatic exposure is that of the first wish with a new number, and is kept from then on
    bool operator==(const Wish&) const = default;
};

/// How far the renderer is.
struct RenderStatus {
    size_t wish = 0;       ///< number of the wish that is shown, as `show` gave it
    bool is_done = false;  ///< its last pass is in the picture
    int block = 1;         ///< pixels along a side of a sample of the present stage
    int passes = 0;        ///< whole ones
    int passes_wanted = 0;
    size_t camera_rays = 0;       ///< of this wish
    size_t light_samples = 0;     ///< at most as many were traced or weighed for it, where light is sampled
    double seconds_per_pass = 0;  ///< of the last whole pass, wall time; 0 before
    double first_seconds = 0;     ///< from the wish to its first picture, however coarse
    double exposure = 1;          ///< factor; what lit views are multiplied by before the curve
};

/// A picture as far as it is.
struct Frame {
    Image<Vec3f> pixels;       ///< linear; lit views: nits
    Image<glm::u8vec3> codes;  ///< the same for a screen, exposed: sRGB
    Show show = Show::lit;     ///< what they show
    RenderStatus status;
};

/// Owns the thread that renders. `lighting` is taken over; what it refers to must outlive the renderer.
class ProgressiveRenderer {
  public:
    /// `on_news`, called from the thread that renders, tells that there is another frame to take; it may be empty.
    explicit ProgressiveRenderer(Lighting lighting, std::function<void()> on_news = {});
    /// Stops after the work items at hand.
    ~ProgressiveRenderer();
    ProgressiveRenderer(const ProgressiveRenderer&) = delete;
    ProgressiveRenderer& operator=(const ProgressiveRenderer&) = delete;

    /// Makes `wish` the one to work on and returns its number at once; the same wish as before changes nothing. The
    /// work on the one before ends with the work items at hand, but its first picture is always finished and shown: who
    /// drags the camera sees it move.
    size_t show(const Wish& wish);

    /// Puts the newest frame into `frame` and returns true, or returns false where there is none since the last call.
    /// Never waits for rendering. Throws what stopped the renderer, if something did.
    bool take(Frame& frame);

  private:
    struct Work;
    void run();
    void publish(const Work& work);

    Lighting lighting_;
    std::function<void()> on_news_;
    std::mutex mutex_;  // of what follows; held for copies only
    std::condition_variable has_changed_;
    Wish wish_;
    std::atomic<size_t> number_{0};  // of wish_
    Frame ready_;
    bool has_news_ = false;
    std::exception_ptr failure_;
    std::atomic<bool> stops_{false};
    std::thread thread_;  // the last, since it uses all of the above
};

}  // namespace surimi
