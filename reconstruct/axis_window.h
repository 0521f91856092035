#pragma once
/// Gaussians along one image axis, cut to a finite reach.

#include <algorithm>
#include <cmath>

namespace tessera {

/// A Gaussian over distances in pixels whose tail ends smoothly within `reach` pixels: as it is
/// over the first two thirds of the reach, then down to 0 one pixel past the end.
class AxisGaussian {
 public:
  /// `deviation`: pixels; narrower than about 0.3 is the pixel alone.
  AxisGaussian(double deviation, int reach)
      : scale_(1.0 / std::max(deviation, 1e-3)), full_(2.0 * reach / 3.0), end_(reach + 1.0) {}

  /// 1 at distance 0.
  double operator()(double distance) const {
    const double r = distance * scale_;
    const double t = std::clamp((std::abs(distance) - full_) / (end_ - full_), 0.0, 1.0);
    return std::exp(-0.5 * r * r) * (1.0 - t * t * (3.0 - 2.0 * t));
  }

 private:
  double scale_, full_, end_;
};

}  // namespace tessera
