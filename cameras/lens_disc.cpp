#include <cmath>
#include <numbers>

#include "cameras/concentric.h"
#include "cameras/lens_shapes.h"
#include "cameras/spectrum.h"

namespace tessera {
namespace {

constexpr double pi = std::numbers::pi;

class DiscLens final : public LensProfile {
 public:
  const char* name() const override { return "disc"; }
  float extent() const override { return 1.0f; }

  glm::vec2 sample(float a, float b) const override {
    const ConcentricPoint p = concentric_from_square(a, b);
    const float angle = 2.0f * float(pi) * p.turn;
    return {p.radius * std::cos(angle), p.radius * std::sin(angle)};
  }

  double band_limit(double energy_share) const override {
    // The transform of the unit disc is J1(2 pi f) / f; its energy is the area, by Parseval.
    return frequency_holding(energy_share, pi, [](double f) {
      if (f == 0.0) return 0.0;
      const double amplitude = ::j1(2.0 * pi * f) / f;
      return 2.0 * pi * f * amplitude * amplitude;
    });
  }
};

}  // namespace

std::unique_ptr<LensProfile> make_disc_lens() { return std::make_unique<DiscLens>(); }

}  // namespace tessera
