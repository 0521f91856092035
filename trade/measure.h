#pragma once
/// One measured run: a process, what its statistics say, and how far its image is from the
/// reference.

#include <string>

#include "images/image.h"
#include "trade/measurement.h"
#include "trade/renderer.h"

namespace tessera::trade {

/// How far an image is from the reference, over R, G and B.
struct ImageError {
  double rmse = unknown, rel_mse = unknown;
  double visible = unknown;  ///< share of pixels, in [0, 1]
};

/// The channels R, G and B of an image. Throws Error naming `path` when one is missing.
Image colours_of(const Image& image, const std::string& path);

/// Throws Error when the windows differ, or values are not finite in one of them only.
ImageError error_of(const Image& image, const Image& reference);

struct MeasureFiles {
  std::string image;      ///< where the first repeat stays
  std::string reference;  ///< an EXR
};

/// Renders a configuration. The first round keeps its image and compares it with the reference;
/// further ones only hash theirs. Never throws for what the renderer does.
Measurement measure(const Renderer& renderer, const Configuration& configuration, int round,
                    double limit_s, const MeasureFiles& files);

}  // namespace tessera::trade
