#pragma once
/// Frames to an error, or to that or a time, whichever comes first: rounds of two passes each, the
/// first with as many samples in all pixels, the others with many where there is much noise
/// (docs/quality.md).

#include "engine/frame_passes.h"

namespace tessera {

/// Renders until what Settings::error and Settings::time_s ask for is reached, whichever comes
/// first. The error is the root of the mean over pixels and R, G, B of variance / (value^2 + 0.01),
/// of linear values. Without a time, the image is the same for any thread count and bucket size.
/// Warns when an error is out of reach. Throws Error when the settings make no sense.
FrameResult render_accurate(FramePasses& passes, const Settings& settings,
                            Diagnostics& diagnostics);

}  // namespace tessera
