#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cameras/concentric.h"
#include "cameras/lens_shapes.h"
#include "cameras/spectrum.h"

namespace tessera {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double inner_radius = 0.9, outer_radius = 1.1, edge_width = outer_radius - inner_radius;

/// Light through the ring [inner_radius, r] divided by 2 pi, with x = (r - inner_radius) /
/// edge_width: the integral of (1 - smoothstep(x)) r dr, term by term.
double ring_light(double x) {
  const double x2 = x * x, x4 = x2 * x2;
  return edge_width * (inner_radius * (x - x * x2 + x4 / 2) +
                       edge_width * (x2 / 2 - 3 * x4 / 4 + 2 * x * x4 / 5));
}

class SmoothLens final : public LensProfile {
 public:
  SmoothLens() : total_(inner_radius * inner_radius / 2 + ring_light(1.0)) {
    // The light left outside r falls with the cube of (outer_radius - r), so r is smooth as a
    // function of its cube root, and a table over that needs no care at the end.
    const double root_at_inner = std::cbrt(ring_light(1.0) / total_);
    root_step_ = root_at_inner / double(edge_radii_.size() - 1);
    for (size_t i = 0; i < edge_radii_.size(); ++i) {
      const double root = double(i) * root_step_;
      edge_radii_[i] = float(radius_leaving(root * root * root * total_));
    }
  }

  const char* name() const override { return "smooth"; }
  float extent() const override { return float(outer_radius); }

  glm::vec2 sample(float a, float b) const override {
    const ConcentricPoint p = concentric_from_square(a, b);
    const float angle = 2.0f * float(pi) * p.turn;
    const float r = radius_from_share(p.radius);
    return {r * std::cos(angle), r * std::sin(angle)};
  }

  double band_limit(double energy_share) const override {
    double energy = pi * inner_radius * inner_radius;
    for (int i = 0; i < nodes; ++i) {
      const double x = (i + 0.5) / nodes, light = 1.0 - x * x * (3.0 - 2.0 * x);
      energy += 2.0 * pi * light * light * (inner_radius + edge_width * x) * edge_width / nodes;
    }
    return frequency_holding(energy_share, energy, [](double f) {
      const double amplitude = transform(f);
      return 2.0 * pi * f * amplitude * amplitude;
    });
  }

 private:
  static constexpr int nodes = 96;

  /// Hankel transform 2 pi * integral of T(r) J0(2 pi f r) r dr. By parts only the edge, where T
  /// changes, is left: -1/f * integral of T'(r) J1(2 pi f r) r dr.
  static double transform(double f) {
    if (f == 0.0) return 0.0;
    double sum = 0.0;
    for (int i = 0; i < nodes; ++i) {
      const double x = (i + 0.5) / nodes, r = inner_radius + edge_width * x;
      sum += 6.0 * x * (1.0 - x) * r * ::j1(2.0 * pi * f * r);
    }
    return sum / (nodes * f);
  }

  /// Radius in the edge outside which the light (divided by 2 pi) is `left`, by bisection.
  double radius_leaving(double left) const {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; ++i) {
      const double x = 0.5 * (low + high);
      (ring_light(1.0) - ring_light(x) > left ? low : high) = x;
    }
    return inner_radius + edge_width * 0.5 * (low + high);
  }

  /// Radius inside which the share square_radius^2 of the light lies.
  float radius_from_share(float square_radius) const {
    const double share = double(square_radius) * double(square_radius);
    const double r = std::sqrt(2.0 * total_ * share);
    if (r <= inner_radius) return float(r);
    const double position = std::cbrt(std::max(0.0, 1.0 - share)) / root_step_;
    const size_t i = std::min(size_t(position), edge_radii_.size() - 2);
    const float fraction = float(position - double(i));
    return edge_radii_[i] + (edge_radii_[i + 1] - edge_radii_[i]) * fraction;
  }

  double total_;            ///< integral of T(r) r dr
  double root_step_ = 0.0;  ///< of the cube root of the share of light left outside
  std::array<float, 513> edge_radii_{};
};

}  // namespace

std::unique_ptr<LensProfile> make_smooth_lens() { return std::make_unique<SmoothLens>(); }

}  // namespace tessera
