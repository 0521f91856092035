#pragma once
/// Stage header: engine. A Scene and Settings go in, an image and its statistics come out. The
/// command line is a thin layer over this, and so would any binding be.

#include <atomic>
#include <functional>
#include <memory>
#include <string_view>

#include "base/diagnostics.h"
#include "engine/plan.h"
#include "engine/progress.h"
#include "engine/settings.h"
#include "engine/statistics.h"
#include "images/image.h"
#include "scenes/scene.h"
#include "shade/shade.h"

namespace tessera {

/// How a frame tells how far it is and learns that it should stop. Called from worker threads, one
/// at a time: when a pass begins, and for each bucket that is done.
struct FrameControl {
  std::function<void(const FrameProgress& progress)> progress;
  const std::atomic<bool>* cancel = nullptr;  ///< when it turns true no further bucket is started
  /// Makes what shades the frame, in place of make_shading(). For measuring. With one thread its
  /// shade() sees the buckets in raster order.
  std::function<std::unique_ptr<Shading>(std::string_view spec, const ShadingFrame& frame)>
      make_shading;
  /// Changes the plan before the frame is made. For measuring.
  std::function<void(FramePlan& plan)> revise_plan;
};

struct FrameResult {
  /// Every channel asked for, over the crop window. Its metadata name the scene, the frame, the
  /// plan and the options in force, the version and the time, and whether the frame is complete.
  Image image;
  Statistics statistics;
  std::string heatmap;           ///< name of the heat map among the channels; empty: none
  bool display_encoded = false;  ///< the scene's Exposure has a gamma: colours are not linear
  bool complete = true;          ///< false after a cancellation
  /// Whether no bucket is missing; missing ones are black and transparent. A frame of several
  /// passes that was cancelled is whole if one of them was, but has fewer samples than asked for.
  bool whole = true;
};

/// Renders one frame. The image is the same bit for bit for any thread count and bucket size.
/// Throws Error when the settings or the scene cannot be rendered.
FrameResult render_frame(const Scene& scene, const Settings& settings, Diagnostics& diagnostics,
                         const FrameControl& control = {});

/// The plan alone, without rendering.
FramePlan plan_frame(const Scene& scene, const Settings& settings, Diagnostics& diagnostics);

}  // namespace tessera
