#include "engine/round_mean.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/image_mean.h"

namespace tessera {
namespace {

/// Share of the newest round in what is known of the noise.
constexpr double newest_share = 0.5;

std::array<const std::vector<float>*, 3> colours(const Image& image) {
  return {&image.find_channel("R")->values, &image.find_channel("G")->values,
          &image.find_channel("B")->values};
}

/// a * A + b * B, by colour.
std::vector<double> combined(double a, const Image& A, double b, const Image& B) {
  std::vector<double> result;
  const auto of_a = colours(A), of_b = colours(B);
  for (size_t c = 0; c < 3; ++c)
    for (size_t p = 0; p < of_a[c]->size(); ++p)
      result.push_back(a * double((*of_a[c])[p]) + b * double((*of_b[c])[p]));
  return result;
}

void mix(std::vector<double>& to, const std::vector<double>& from, double share) {
  for (size_t k = 0; k < to.size(); ++k) to[k] += share * (from[k] - to[k]);
}

/// Mean of square(k, value) / (value^2 + relative_floor) over pixels and colours.
template <class Square>
double relative_mean(const Image& image, Square square) {
  const auto values = colours(image);
  const size_t pixels = values[0]->size();
  double sum = 0;
  for (size_t c = 0; c < 3; ++c)
    for (size_t p = 0; p < pixels; ++p) {
      const double value = double((*values[c])[p]);
      sum += square(c * pixels + p, value) / (value * value + relative_floor);
    }
  return pixels > 0 ? sum / double(3 * pixels) : 0.0;
}

}  // namespace

double RoundMean::Estimate::variance() const {
  return relative_mean(image, [&](size_t k, double) { return differences[k] * differences[k]; });
}

double RoundMean::Estimate::error_squared() const {
  if (plain.empty()) return variance();
  const double biased = relative_mean(image, [&](size_t k, double value) {
    const double to_plain = value - plain[k], noise = plain_differences[k];
    return to_plain * to_plain - noise * noise + 2 * differences[k] * noise;
  });
  return std::max(biased, variance());
}

void RoundMean::add(RoundImages&& round, const SampleAllocation& allocation) {
  Estimate newest;
  newest.differences = combined(0.5, round.a, -0.5, round.b);
  if (round.plain_a && round.plain_b) {
    newest.plain = combined(0.5, *round.plain_a, 0.5, *round.plain_b);
    newest.plain_differences = combined(0.5, *round.plain_a, -0.5, *round.plain_b);
  }
  newest.image = std::move(round.a);
  take_closest(groups_, round.b, newest.image);
  average(groups_, round.b, 0.5, newest.image);
  count(allocation, newest.image.data_window);
  update_noise(newest, allocation);
  if (rounds_++ == 0)
    best_ = std::move(newest);
  else
    add(std::move(newest), 2 * allocation.mean_samples());
  variance_ = best_.variance(), error_squared_ = best_.error_squared();
}

/// Where there is bias, a round of more samples may be better alone than with those before it.
void RoundMean::add(Estimate&& newest, double samples) {
  take_closest(groups_, best_.image, newest.image);
  take_closest(groups_, newest.image, best_.image);
  const double old_variance = relative_mean(
      newest.image, [&](size_t k, double) { return best_.differences[k] * best_.differences[k]; });
  const double both = old_variance + newest.variance();
  const double share = both > 0 ? old_variance / both : samples / mean_samples();
  average(groups_, newest.image, share, best_.image);
  mix(best_.differences, newest.differences, share);
  mix(best_.plain, newest.plain, share);
  mix(best_.plain_differences, newest.plain_differences, share);
  if (!newest.plain.empty() && newest.error_squared() < best_.error_squared())
    best_ = std::move(newest);
}

double RoundMean::mean_samples() const {
  double sum = 0;
  for (const uint64_t n : samples_) sum += double(n);
  return samples_.empty() ? 0.0 : sum / double(samples_.size());
}

PixelNoise RoundMean::noise() const {
  PixelNoise scaled = noise_;
  if (variance_ > 0)
    for (double& variance : scaled.variance) variance *= error_squared_ / variance_;
  return scaled;
}

void RoundMean::count(const SampleAllocation& allocation, const PixelRect& rect) {
  samples_.resize(size_t(rect.pixel_count()));
  size_t at = 0;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x)
      samples_[at++] += 2 * uint64_t(allocation.samples(x, y));
}

void RoundMean::update_noise(const Estimate& newest, const SampleAllocation& allocation) {
  const auto values = colours(newest.image);
  const PixelRect& rect = newest.image.data_window;
  const size_t pixels = values[0]->size();
  const double share = empty() ? 1.0 : newest_share;
  noise_.rect = rect;
  noise_.variance.resize(pixels);
  for (size_t p = 0; p < pixels; ++p) {
    double sum = 0;
    for (size_t c = 0; c < 3; ++c) {
      const double value = double((*values[c])[p]), difference = newest.differences[c * pixels + p];
      sum += difference * difference / (value * value + relative_floor);
    }
    const int x = rect.x0 + int(p % size_t(rect.width()));
    const int y = rect.y0 + int(p / size_t(rect.width()));
    const double with_one = sum / 3 * double(allocation.samples(x, y));
    noise_.variance[p] += share * (with_one - noise_.variance[p]);
  }
}

}  // namespace tessera
