#include "cameras/shutter_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "cameras/spectrum.h"

namespace tessera {
namespace {

constexpr double pi = std::numbers::pi;

/// sin(pi x) / (pi x), the transform of the unit box.
double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(pi * x) / (pi * x); }

/// Open and shut in an instant.
class BoxShutter final : public ShutterProfile {
 public:
  const char* name() const override { return "box"; }
  float sample(float a) const override { return std::clamp(a, 0.0f, 1.0f); }
  double response(double t) const override { return t >= 0.0 && t <= 1.0 ? 1.0 : 0.0; }
  double band_limit(double energy_share) const override {
    return frequency_holding(energy_share, 1.0, [](double f) { return 2.0 * sinc(f) * sinc(f); });
  }
};

/// Opens linearly over the first quarter of the time and closes linearly over the last.
class TrapezoidShutter final : public ShutterProfile {
 public:
  const char* name() const override { return "trapezoid"; }

  float sample(float a) const override {
    const double share = std::clamp(double(a), 0.0, 1.0), mirrored = std::min(share, 1.0 - share);
    double t = mirrored * (1.0 - ramp) + ramp / 2;  // on the flat top
    if (t < ramp) t = std::sqrt(2.0 * ramp * (1.0 - ramp) * mirrored);
    return float(share <= 0.5 ? t : 1.0 - t);
  }
  double response(double t) const override {
    return std::clamp(std::min(t, 1.0 - t) / ramp, 0.0, 1.0) / (1.0 - ramp);
  }
  double band_limit(double energy_share) const override {
    // A box of width 1 - ramp convolved with one of width ramp. Energy of the ramps is a third of
    // that of a plateau of the same length.
    const double energy = (1.0 - 2.0 * ramp + 2.0 * ramp / 3.0) / ((1.0 - ramp) * (1.0 - ramp));
    return frequency_holding(energy_share, energy, [](double f) {
      const double amplitude = sinc((1.0 - ramp) * f) * sinc(ramp * f);
      return 2.0 * amplitude * amplitude;
    });
  }

 private:
  static constexpr double ramp = 0.25;
};

/// A Gaussian about t = 1/2 with a standard deviation of 1/6, cut at three deviations: at opening
/// and closing.
class GaussianShutter final : public ShutterProfile {
 public:
  GaussianShutter() {
    for (size_t i = 0; i < guesses_.size(); ++i) {
      double low = 0.0, high = 1.0;
      for (int k = 0; k < 60; ++k) {
        const double t = 0.5 * (low + high);
        (cumulative(t) < double(i) / double(guesses_.size() - 1) ? low : high) = t;
      }
      guesses_[i] = 0.5 * (low + high);
    }
  }

  const char* name() const override { return "gaussian"; }

  float sample(float a) const override {
    const double share = std::clamp(double(a), 0.0, 1.0);
    const double position = share * double(guesses_.size() - 1);
    const size_t i = std::min(size_t(position), guesses_.size() - 2);
    double t = guesses_[i] + (guesses_[i + 1] - guesses_[i]) * (position - double(i));
    // Converged to rounding, so that the result is monotonic.
    for (int k = 0; k < 4; ++k) t = std::clamp(t - (cumulative(t) - share) / response(t), 0.0, 1.0);
    return float(t);
  }
  double response(double t) const override {
    if (t < 0.0 || t > 1.0) return 0.0;
    const double x = (t - 0.5) / sigma;
    return std::exp(-0.5 * x * x) / (sigma * std::sqrt(2.0 * pi) * kept());
  }
  double band_limit(double energy_share) const override {
    const double inside = std::erf(0.5 / sigma);  // the square has a deviation of sigma / sqrt(2)
    const double energy = inside / (2.0 * std::sqrt(pi) * sigma * kept() * kept());
    return frequency_holding(energy_share, energy, [this](double f) {
      const double amplitude = transform(f);
      return 2.0 * amplitude * amplitude;
    });
  }

 private:
  static constexpr double sigma = 1.0 / 6.0;
  static double kept() { return std::erf(0.5 / sigma / std::sqrt(2.0)); }
  static double cumulative(double t) {
    return 0.5 + 0.5 * std::erf((t - 0.5) / (sigma * std::sqrt(2.0))) / kept();
  }
  /// Fourier transform about t = 1/2, by Simpson's rule with at least 32 panels in each period.
  double transform(double f) const {
    const int panels = 256 + 32 * int(f);
    double sum = 0.5 * (response(0.5) + response(1.0) * std::cos(pi * f));
    for (int i = 1; i < 2 * panels; ++i) {
      const double t = 0.25 * i / panels;
      sum += (i % 2 ? 2.0 : 1.0) * response(0.5 + t) * std::cos(2.0 * pi * f * t);
    }
    return 2.0 * sum / (3.0 * 2.0 * panels);
  }

  std::array<double, 257> guesses_;
};

}  // namespace

std::unique_ptr<ShutterProfile> make_shutter_profile(const std::string& name) {
  if (name == "box") return std::make_unique<BoxShutter>();
  if (name == "trapezoid") return std::make_unique<TrapezoidShutter>();
  if (name == "gaussian") return std::make_unique<GaussianShutter>();
  throw Error(
      fmt::format("shutter profile \"{}\" is unknown; expected box, trapezoid or gaussian", name));
}

}  // namespace tessera
