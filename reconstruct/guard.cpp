#include "reconstruct/guard.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace tessera {
namespace {

constexpr int window_reach = 4;
static_assert(guard_reach == window_reach + 1);  // and the steps to neighbours

/// Pixels whose squares would come near the end of floats say nothing.
constexpr float largest_sum = 1e30f;

/// How far the sum of squared differences may exceed what noise explains before it counts as bias,
/// chosen on rendered scenes: between 1 and 1.4 it matters little.
constexpr float chance = 1.15f;
/// The lesser of two noisy estimates is too low on average; this makes up for a part of that.
constexpr float rough_chance = 1.05f;

/// What one pixel adds to the sums over a window.
struct Sums {
  explicit Sums(size_t pixels)
      : gain(pixels), rough_gain(pixels), difference(pixels), noise(pixels) {}
  std::vector<float> gain;        ///< (1 - w) s2, s2 from halves of the samples
  std::vector<float> rough_gain;  ///< the same, s2 from how rough F - y is
  std::vector<float> difference;  ///< (F - y)^2
  std::vector<float> noise;       ///< s2 from halves of the samples
};

class PixelSums {
 public:
  PixelSums(const Component& component, const Candidate& candidate,
            const NoiseCorrelation& correlation)
      : c_(component),
        candidate_(candidate),
        width_(size_t(component.width)),
        x_scale_(0.5f / std::max(0.1f, 1 - correlation.x[1])),
        y_scale_(0.5f / std::max(0.1f, 1 - correlation.y[1])) {}

  void store(size_t p, Sums& out) const {
    float gain = 0, rough = 0, difference = 0, noise = 0;
    for (size_t channel = 0; channel < 3; ++channel) {
      const float d = error(channel, p), variance = c_.variance[channel][p];
      difference += d * d;
      gain += variance < 0 ? d * d : others_share(p) * variance;
      noise += variance < 0 ? d * d : variance;
      rough += variance < 0 ? d * d : others_share(p) * roughness(channel, p);
    }
    const bool sane = difference < largest_sum && gain < largest_sum;
    out.gain[p] = sane ? gain : 0.0f;
    out.difference[p] = sane ? difference : 0.0f;
    out.noise[p] = sane ? noise : 0.0f;
    out.rough_gain[p] = rough < largest_sum ? rough : largest_sum;
  }

 private:
  float error(size_t channel, size_t p) const {
    return candidate_.filtered[channel][p] - c_.plain[channel][p];
  }
  float others_share(size_t p) const { return std::max(0.0f, 1 - candidate_.own_weight[p]); }

  /// The variance of noise from the steps to the next pixels (at the end of a row, the last): those
  /// of noise correlated by r have a mean square of 2 (1 - r) s2.
  float roughness(size_t channel, size_t p) const {
    const float here = error(channel, p);
    const size_t right = (p + 1) % width_ != 0 ? p + 1 : p - (width_ > 1);
    const size_t below = p + width_ < c_.pixels() ? p + width_ : p - (p >= width_ ? width_ : 0);
    const float x_step = here - error(channel, right), y_step = here - error(channel, below);
    return 0.5f * (x_scale_ * x_step * x_step + y_scale_ * y_step * y_step);
  }

  const Component& c_;
  const Candidate& candidate_;
  size_t width_;
  float x_scale_, y_scale_;
};

/// Sums over 2 window_reach + 1 pixels along one axis, each afresh, so that a crop has the sums of
/// the whole frame.
std::vector<float> box_sums(const std::vector<float>& in, int width, int height, bool rows) {
  std::vector<float> out(in.size());
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const int at = rows ? x : y, size = rows ? width : height;
      const int first = std::max(0, at - window_reach),
                last = std::min(size - 1, at + window_reach);
      float sum = 0;
      for (int k = first; k <= last; ++k)
        sum += in[size_t(rows ? y : k) * size_t(width) + size_t(rows ? k : x)];
      out[size_t(y) * size_t(width) + size_t(x)] = sum;
    }
  });
  return out;
}

std::vector<float> window_sums(const std::vector<float>& in, int width, int height) {
  return box_sums(box_sums(in, width, height, false), width, height, true);
}

/// What is known of one candidate, a value a pixel.
struct Risk {
  explicit Risk(size_t pixels) : share(pixels), error(pixels) {}
  std::vector<float> share;  ///< that is best if there were no other candidate
  std::vector<float> error;  ///< expected of it then, in units of that of the unfiltered value
};

/// Errors are not told apart below this share of the unfiltered one.
constexpr float least_error = 0.02f;

Risk risk_of(const Component& component, const Candidate& candidate,
             const NoiseCorrelation& correlation, const std::vector<float>* shared) {
  const size_t pixels = component.pixels();
  Sums sums(pixels);
  const PixelSums pixel_sums(component, candidate, correlation);
  tbb::parallel_for(0, component.height, [&](int y) {
    const size_t first = size_t(y) * size_t(component.width);
    for (size_t p = first; p < first + size_t(component.width); ++p)
      if (!shared || (*shared)[p] != 0.0f) pixel_sums.store(p, sums);
  });
  const auto window = [&](const std::vector<float>& in) {
    return window_sums(in, component.width, component.height);
  };
  const std::vector<float> halves = window(sums.gain), rough = window(sums.rough_gain);
  const std::vector<float> difference = window(sums.difference), noise = window(sums.noise);
  Risk risk(pixels);
  for (size_t p = 0; p < pixels; ++p) {
    const float gain = std::min(halves[p], rough_chance * rough[p]);
    if (gain > 0) risk.share[p] = gain / (gain + std::max(0.0f, difference[p] - chance * gain));
    const float saved = noise[p] > 0 ? risk.share[p] * gain / noise[p] : risk.share[p];
    risk.error[p] = std::max(least_error, 1.0f - saved);
  }
  return risk;
}

}  // namespace

std::vector<std::vector<float>> filtered_shares(const Component& component,
                                                const NoiseCorrelation& correlation,
                                                const std::vector<float>* shared) {
  std::vector<Risk> risks;
  for (const Candidate& candidate : component.candidates)
    risks.push_back(risk_of(component, candidate, correlation, shared));
  std::vector<std::vector<float>> shares(risks.size(), std::vector<float>(component.pixels()));
  for (size_t p = 0; p < component.pixels(); ++p) {
    if (shared && (*shared)[p] == 0.0f) continue;
    float sum = 0;
    for (const Risk& risk : risks) sum += 1.0f / (risk.error[p] * risk.error[p]);
    for (size_t k = 0; k < risks.size(); ++k)
      shares[k][p] = risks[k].share[p] / (risks[k].error[p] * risks[k].error[p] * sum);
  }
  return shares;
}

}  // namespace tessera
