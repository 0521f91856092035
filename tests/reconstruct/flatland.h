#pragma once
/// Flatland: one image axis under a uniform light behind random blockers, with the exact image, to
/// measure methods of reconstruction by. Shares no code with them.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "reconstruct/method.h"

namespace tessera::flatland {

/// Blocks light at y for the place x where first <= x + shift * y <= last; pixels.
struct Blocker {
  double shift, first, last;
};

struct Scene {
  AxisWedge wedge;
  int pixels = 0;
  std::vector<Blocker> blockers;

  double visible(double x, double y) const {
    for (const Blocker& b : blockers) {
      const double z = x + b.shift * y;
      if (b.first <= z && z <= b.last) return 0.0;
    }
    return 1.0;
  }

  /// The share of y in [-1, 1] that is not blocked at x, in closed form: blockers cut intervals
  /// out.
  double exact(double x) const {
    std::vector<std::pair<double, double>> cuts;
    for (const Blocker& b : blockers) {
      if (b.shift == 0.0) {
        if (b.first <= x && x <= b.last) return 0.0;
        continue;
      }
      const double p = (b.first - x) / b.shift, q = (b.last - x) / b.shift;
      const double low = std::max(-1.0, std::min(p, q)), high = std::min(1.0, std::max(p, q));
      if (low < high) cuts.push_back({low, high});
    }
    std::sort(cuts.begin(), cuts.end());
    double blocked = 0.0, end = -1.0;
    for (const auto& [low, high] : cuts) {
      blocked += std::max(0.0, high - std::max(low, end));
      end = std::max(end, high);
    }
    return 1.0 - 0.5 * blocked;
  }

  /// `exact` averaged over the pixel around x.
  double exact_pixel(int x) const {
    constexpr int steps = 32;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += exact(x + (i + 0.5) / steps - 0.5);
    return sum / steps;
  }
};

/// Blockers of 2 to 40 pixels with shifts uniform in the wedge, covering about half the line.
inline Scene make_scene(const AxisWedge& wedge, int pixels, uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (random() + 0.5) / 4294967296.0;
  };
  const double margin = std::max(std::abs(wedge.low), std::abs(wedge.high)) + 64.0;
  Scene scene{wedge, pixels, {}};
  for (int i = 0, count = int((pixels + 2 * margin) / 30.0); i < count; ++i) {
    const double first = uniform(-margin, pixels + margin), size = uniform(2.0, 40.0);
    scene.blockers.push_back({uniform(wedge.low, wedge.high), first, first + size});
  }
  return scene;
}

inline std::unique_ptr<ReconstructionMethod> make_method(std::string_view name,
                                                         std::string_view arguments = "") {
  for (const auto& definition : reconstruction_method_registry())
    if (name == definition.name) return definition.make(arguments);
  throw Error("no such method");
}

/// [pixel][k] moments of what is seen, and of 1.
struct Moments {
  std::vector<double> seen, one;
};

inline Moments take_moments(const Scene& scene, const ReconstructionMethod& method, int samples,
                            int margin, uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return (random() + 0.5) / 4294967296.0; };
  const size_t count = size_t(method.basis_count());
  Moments moments;
  std::vector<float> basis(count);
  for (int x = -margin; x < scene.pixels + margin; ++x) {
    std::vector<double> seen(count), one(count);
    for (int j = 0; j < samples; ++j) {
      const double place = x + uniform() - 0.5, y = 2.0 * uniform() - 1.0;
      const double f = scene.visible(place, y);
      BasisPoint at;
      at.y = float(y);
      at.wedge = scene.wedge;
      method.basis(at, basis.data());
      for (size_t k = 0; k < count; ++k) {
        seen[k] += basis[k] * f / samples;
        one[k] += basis[k] / double(samples);
      }
    }
    moments.seen.insert(moments.seen.end(), seen.begin(), seen.end());
    moments.one.insert(moments.one.end(), one.begin(), one.end());
  }
  return moments;
}

struct Errors {
  double filtered = 0, unfiltered = 0;  ///< mean squares against the exact image
};

/// `assumed`: the number of samples the filter is told, `samples` taken.
inline Errors measure(const Scene& scene, const std::vector<double>& exact,
                      const ReconstructionMethod& method, int samples, uint32_t seed,
                      double assumed = 0) {
  const int reach = method.reach(), row = 2 * reach + 1, count = method.basis_count();
  std::vector<float> weights(size_t(count * row));
  method.weights(scene.wedge, float(assumed > 0 ? assumed : samples), weights.data());
  const Moments moments = take_moments(scene, method, samples, reach, seed);
  Errors errors;
  for (int x = 0; x < scene.pixels; ++x) {
    double sum = 0, norm = 0;
    for (int i = 0; i < row; ++i) {
      for (int k = 0; k < count; ++k) {
        const double a = weights[size_t(k * row + i)];
        sum += a * moments.seen[size_t((x + i) * count + k)];
        norm += a * moments.one[size_t((x + i) * count + k)];
      }
    }
    const double filtered = sum / norm - exact[size_t(x)];
    const double unfiltered = moments.seen[size_t((x + reach) * count)] - exact[size_t(x)];
    errors.filtered += filtered * filtered / scene.pixels;
    errors.unfiltered += unfiltered * unfiltered / scene.pixels;
  }
  return errors;
}

}  // namespace tessera::flatland
