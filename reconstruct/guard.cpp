#include "reconstruct/guard.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace tessera {
namespace {

constexpr int window_reach = 4;
static_assert(guard_reach == window_reach + 1);  // and the steps to neighbours

/// Rows of pixels that one task looks at.
constexpr int band_rows = 32;

/// Sums of squares that are no numbers, or beyond all others, count as this: then nothing is
/// filtered as far as the window reaches.
constexpr double largest_sum = 1e100;

/// How far the sum of squared differences may exceed what noise explains before it counts as bias,
/// chosen on rendered scenes: between 1 and 1.4 it matters little.
constexpr double chance = 1.15;
/// The lesser of two noisy estimates is too low on average; this makes up for a part of that.
constexpr double rough_chance = 1.05;

/// What one pixel adds to the sums over a window, over three channels. Squares of floats, so that
/// the brightest and the darkest light are filtered alike.
struct Sums {
  double gain = 0;        ///< (1 - w) s2, s2 from halves of the samples
  double rough_gain = 0;  ///< the same, s2 from how rough F - y is
  double difference = 0;  ///< (F - y)^2
  double noise = 0;       ///< s2 from halves of the samples

  Sums& operator+=(const Sums& other) {
    gain += other.gain, rough_gain += other.rough_gain;
    difference += other.difference, noise += other.noise;
    return *this;
  }
};

class PixelSums {
 public:
  PixelSums(const Component& component, const Candidate& candidate,
            const NoiseCorrelation& correlation)
      : c_(component),
        candidate_(candidate),
        width_(size_t(component.width)),
        x_scale_(0.5 / std::max(0.1, 1.0 - double(correlation.x[1]))),
        y_scale_(0.5 / std::max(0.1, 1.0 - double(correlation.y[1]))) {}

  Sums at(size_t p) const {
    Sums out;
    const double others_share = std::max(0.0, 1.0 - double(candidate_.own_weight[p]));
    for (size_t channel = 0; channel < 3; ++channel) {
      const double d = error(channel, p), deviation = double(c_.deviation[channel][p]);
      const double rough = roughness(channel, p);
      const double variance = deviation >= 0 ? deviation * deviation : rough;
      out.difference += d * d, out.noise += variance;
      out.gain += others_share * variance, out.rough_gain += others_share * rough;
    }
    if (!(out.difference < largest_sum)) return {0, 0, largest_sum, 0};
    if (!(out.gain < largest_sum)) out.gain = out.noise = largest_sum;
    if (!(out.rough_gain < largest_sum)) out.rough_gain = largest_sum;
    return out;
  }

 private:
  double error(size_t channel, size_t p) const {
    return double(candidate_.filtered[channel][p]) - double(c_.plain[channel][p]);
  }

  /// The variance of noise from the steps to the next pixels (at the end of a row, the last): those
  /// of noise correlated by r have a mean square of 2 (1 - r) s2.
  double roughness(size_t channel, size_t p) const {
    const double here = error(channel, p);
    const size_t right = (p + 1) % width_ != 0 ? p + 1 : p - (width_ > 1);
    const size_t below = p + width_ < c_.pixels() ? p + width_ : p - (p >= width_ ? width_ : 0);
    const double x_step = here - error(channel, right), y_step = here - error(channel, below);
    return 0.5 * (x_scale_ * x_step * x_step + y_scale_ * y_step * y_step);
  }

  const Component& c_;
  const Candidate& candidate_;
  size_t width_;
  double x_scale_, y_scale_;
};

/// What is known of one candidate, a value a pixel.
struct Risk {
  explicit Risk(size_t pixels) : share(pixels), error(pixels) {}
  std::vector<float> share;  ///< that is best if there were no other candidate
  std::vector<float> error;  ///< expected of it then, in units of that of the unfiltered value
};

/// Errors are not told apart below this share of the unfiltered one.
constexpr float least_error = 0.02f;

/// Some rows of pixels and those that their windows reach.
class Band {
 public:
  Band(const Component& component, const PixelSums& pixel_sums, const std::vector<float>* shared,
       int y0, int y1)
      : width_(component.width),
        y0_(y0),
        y1_(y1),
        first_(std::max(0, y0 - window_reach)),
        end_(std::min(component.height, y1 + window_reach)),
        sums_(size_t(end_ - first_) * size_t(width_)),
        columns_(size_t(width_)) {
    const size_t first = size_t(first_) * size_t(width_);
    for (size_t p = first; p < first + sums_.size(); ++p)
      if (!shared || (*shared)[p] != 0.0f) sums_[p - first] = pixel_sums.at(p);
  }

  void store(Risk& risk) {
    for (int y = y0_; y < y1_; ++y) {
      sum_columns(y);
      for (int x = 0; x < width_; ++x)
        store(window_sum(x), risk, size_t(y) * size_t(width_) + size_t(x));
    }
  }

 private:
  // Each window is summed afresh, so that a crop has the sums of the whole frame.
  void sum_columns(int y) {
    std::fill(columns_.begin(), columns_.end(), Sums());
    const int last = std::min(end_ - 1, y + window_reach);
    for (int row = std::max(first_, y - window_reach); row <= last; ++row) {
      const Sums* at = &sums_[size_t(row - first_) * size_t(width_)];
      for (size_t x = 0; x < size_t(width_); ++x) columns_[x] += at[x];
    }
  }
  Sums window_sum(int x) const {
    Sums sum;
    const int last = std::min(width_ - 1, x + window_reach);
    for (int k = std::max(0, x - window_reach); k <= last; ++k) sum += columns_[size_t(k)];
    return sum;
  }
  static void store(const Sums& sum, Risk& risk, size_t p) {
    const double gain = std::min(sum.gain, rough_chance * sum.rough_gain);
    const double share =
        gain > 0 ? gain / (gain + std::max(0.0, sum.difference - chance * gain)) : 0.0;
    const double saved = sum.noise > 0 ? share * gain / sum.noise : share;
    risk.share[p] = float(share), risk.error[p] = std::max(least_error, float(1.0 - saved));
  }

  int width_, y0_, y1_, first_, end_;
  std::vector<Sums> sums_, columns_;
};

Risk risk_of(const Component& component, const Candidate& candidate,
             const NoiseCorrelation& correlation, const std::vector<float>* shared) {
  Risk risk(component.pixels());
  const PixelSums pixel_sums(component, candidate, correlation);
  const int bands = (component.height + band_rows - 1) / band_rows;
  tbb::parallel_for(0, bands, [&](int b) {
    const int y0 = b * band_rows, y1 = std::min(y0 + band_rows, component.height);
    Band(component, pixel_sums, shared, y0, y1).store(risk);
  });
  return risk;
}

}  // namespace

std::vector<std::vector<float>> filtered_shares(const Component& component,
                                                const NoiseCorrelation& correlation,
                                                const std::vector<float>* shared) {
  std::vector<Risk> risks;
  for (const Candidate& candidate : component.candidates)
    risks.push_back(risk_of(component, candidate, correlation, shared));
  std::vector<std::vector<float>> shares;
  for (Risk& risk : risks) shares.push_back(std::move(risk.share));
  tbb::parallel_for(0, component.height, [&](int y) {
    const size_t first = size_t(y) * size_t(component.width);
    for (size_t p = first; p < first + size_t(component.width); ++p) {
      const bool takes_part = !shared || (*shared)[p] != 0.0f;
      float sum = 0;
      for (const Risk& risk : risks) sum += 1.0f / (risk.error[p] * risk.error[p]);
      for (size_t k = 0; k < risks.size(); ++k)
        shares[k][p] *= takes_part ? 1.0f / (risks[k].error[p] * risks[k].error[p] * sum) : 0.0f;
    }
  });
  return shares;
}

}  // namespace tessera
