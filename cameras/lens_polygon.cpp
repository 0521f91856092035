#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "cameras/concentric.h"
#include "cameras/lens_shapes.h"
#include "cameras/spectrum.h"

namespace tessera {
namespace {

constexpr double pi = std::numbers::pi;
using Corners = std::vector<glm::dvec2>;

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// Regular polygon in the unit circle, counter-clockwise.
Corners regular_polygon(int blades, double rotation_radians) {
  Corners corners;
  for (int i = 0; i < blades; ++i) {
    const double angle = rotation_radians + 2.0 * pi * i / blades;
    corners.emplace_back(std::cos(angle), std::sin(angle));
  }
  return corners;
}

double area(const Corners& polygon) {
  double sum = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i)
    sum += 0.5 * cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return sum;
}

/// The part of `polygon` on the left of the line from a to b.
Corners clipped(const Corners& polygon, glm::dvec2 a, glm::dvec2 b) {
  Corners result;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double side_p = cross(b - a, p - a), side_q = cross(b - a, q - a);
    if (side_p >= 0.0) result.push_back(p);
    if ((side_p >= 0.0) != (side_q >= 0.0))
      result.push_back(p + (q - p) * (side_p / (side_p - side_q)));
  }
  return result;
}

/// Area common to a convex polygon and its copy moved by `shift`: the polygon's autocorrelation.
double overlap_area(const Corners& polygon, glm::dvec2 shift) {
  Corners common = polygon;
  for (size_t i = 0; i < polygon.size() && !common.empty(); ++i)
    common = clipped(common, polygon[i] + shift, polygon[(i + 1) % polygon.size()] + shift);
  return area(common);
}

class PolygonLens final : public LensProfile {
 public:
  PolygonLens(int blades, double rotation_degrees)
      : blades_(blades), corners_(regular_polygon(blades, rotation_degrees * pi / 180.0)) {}

  const char* name() const override { return "polygon"; }
  float extent() const override { return 1.0f; }

  /// Concentric squares become concentric polygons: the triangle (centre, corner i, corner i + 1)
  /// takes 1 / blades of the turn, at constant speed along its outer side, and so of the area.
  glm::vec2 sample(float a, float b) const override {
    const ConcentricPoint p = concentric_from_square(a, b);
    const float along = p.turn * float(blades_);
    const int side = std::min(int(along), blades_ - 1);
    const glm::vec2 from = corners_[size_t(side)], to = corners_[size_t((side + 1) % blades_)];
    const float fraction = std::min(along - float(side), 1.0f);
    return glm::clamp(p.radius * (from + (to - from) * fraction), -1.0f, 1.0f);
  }

  double band_limit(double energy_share) const override {
    return radius_holding(energy_share, mean_overlap(), reach);
  }

 private:
  static constexpr double reach = 2.0;  ///< no two points of the polygon are farther apart

  /// Autocorrelation averaged over directions, at distances [0, reach]. The spectrum itself has
  /// spikes across every side, ever thinner with frequency; the autocorrelation is smooth.
  std::vector<double> mean_overlap() const {
    constexpr int intervals = 512, directions = 24;
    const Corners polygon = regular_polygon(blades_, 0.0);
    std::vector<double> overlap(intervals + 1, 0.0);
    for (int d = 0; d < directions; ++d) {
      // Rotations, mirrors and the sign of the shift leave a period of pi / blades.
      const double angle = pi / blades_ * (d + 0.5) / directions;
      const glm::dvec2 direction(std::cos(angle), std::sin(angle));
      for (int i = 0; i <= intervals; ++i)
        overlap[size_t(i)] +=
            overlap_area(polygon, direction * (reach * i / intervals)) / directions;
    }
    return overlap;
  }

  int blades_;
  Corners corners_;
};

}  // namespace

std::unique_ptr<LensProfile> make_polygon_lens(int blades, double rotation_degrees) {
  if (blades < 3 || blades > 64)
    throw Error(fmt::format("lens profile \"polygon\": {} blades; expected 3 to 64", blades));
  if (!std::isfinite(rotation_degrees))
    throw Error("lens profile \"polygon\": the rotation is not a finite number of degrees");
  return std::make_unique<PolygonLens>(blades, rotation_degrees);
}

}  // namespace tessera
