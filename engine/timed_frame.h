#pragma once
/// Frames within a time: as many samples in every pixel as there is time for (docs/quality.md).

#include "engine/frame_passes.h"

namespace tessera {

/// Renders passes of even samples until the time of Settings::time_s is spent, or those of
/// Settings::passes. The image is their mean, each counting by its samples; short ones that only
/// told what samples cost are left out. Warns when even the fewest samples take longer.
FrameResult render_within_time(FramePasses& passes, const Settings& settings,
                               Diagnostics& diagnostics);

}  // namespace tessera
