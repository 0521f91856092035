#include "engine/round_mean.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera {
namespace {

/// Share of the newest round in what is known of the noise.
constexpr double newest_share = 0.5;

std::array<const std::vector<float>*, 3> colours(const Image& image) {
  return {&image.find_channel("R")->values, &image.find_channel("G")->values,
          &image.find_channel("B")->values};
}

/// Half of a - b, by colour.
std::vector<double> half_differences(const Image& a, const Image& b) {
  std::vector<double> result;
  const auto ca = colours(a), cb = colours(b);
  for (size_t c = 0; c < 3; ++c)
    for (size_t p = 0; p < ca[c]->size(); ++p)
      result.push_back(0.5 * (double((*ca[c])[p]) - double((*cb[c])[p])));
  return result;
}

double relative(double difference, double value) {
  return difference * difference / (value * value + relative_floor);
}

}  // namespace

void RoundMean::add(Image&& a, Image&& b, const SampleAllocation& allocation) {
  Differences newest = half_differences(a, b);
  take_closest(a, b);
  average(a, b, 0.5);
  const size_t pixels = size_t(a.data_window.pixel_count());
  if (empty()) {
    samples_.assign(pixels, 0);
    image_ = std::move(a);
    differences_ = newest;
  } else {
    const double old_error = relative_error_squared(differences_, a);
    const double new_error = relative_error_squared(newest, a);
    const double both = old_error + new_error;
    const double passes = 2 * allocation.mean_samples();
    const double share =
        both > 0 ? old_error / both : passes / std::max(passes + mean_samples(), 1.0);
    take_closest(image_, a);
    average(image_, a, share);
    for (size_t k = 0; k < newest.size(); ++k)
      differences_[k] += share * (newest[k] - differences_[k]);
  }
  size_t at = 0;
  const PixelRect& rect = image_.data_window;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x)
      samples_[at++] += 2 * uint64_t(allocation.samples(x, y));
  update_noise(newest, allocation);
  error_squared_ = relative_error_squared(differences_, image_);
  ++rounds_;
}

double RoundMean::mean_samples() const {
  double sum = 0;
  for (const uint64_t n : samples_) sum += double(n);
  return samples_.empty() ? 0.0 : sum / double(samples_.size());
}

/// Where `from` saw something nearer, its channels that must not be averaged.
void RoundMean::take_closest(Image& to, const Image& from) const {
  const Image::Channel *z_to = to.find_channel("Z"), *z_from = from.find_channel("Z");
  if (!z_to || !z_from) return;
  std::vector<size_t> nearer;
  for (size_t p = 0; p < z_to->values.size(); ++p)
    if (z_from->values[p] < z_to->values[p]) nearer.push_back(p);
  size_t channel = 0;
  for (const AovDefinition* group : groups_)
    for (size_t c = 0; c < group->channels.size(); ++c, ++channel)
      if (group->filter == ChannelFilter::closest)
        for (const size_t p : nearer)
          to.channels[channel].values[p] = from.channels[channel].values[p];
}

/// `share` of `from` and the rest of `to`.
void RoundMean::average(Image& to, const Image& from, double share) const {
  size_t channel = 0;
  for (const AovDefinition* group : groups_)
    for (size_t c = 0; c < group->channels.size(); ++c, ++channel) {
      if (group->filter != ChannelFilter::filtered) continue;
      std::vector<float>& values = to.channels[channel].values;
      const std::vector<float>& other = from.channels[channel].values;
      for (size_t p = 0; p < values.size(); ++p)
        values[p] = float((1 - share) * double(values[p]) + share * double(other[p]));
    }
}

double RoundMean::relative_error_squared(const Differences& differences, const Image& image) const {
  const auto values = colours(image);
  const size_t pixels = values[0]->size();
  double sum = 0;
  for (size_t c = 0; c < 3; ++c)
    for (size_t p = 0; p < pixels; ++p)
      sum += relative(differences[c * pixels + p], double((*values[c])[p]));
  return pixels > 0 ? sum / double(3 * pixels) : 0.0;
}

void RoundMean::update_noise(const Differences& differences, const SampleAllocation& allocation) {
  const auto values = colours(image_);
  const PixelRect& rect = image_.data_window;
  const size_t pixels = values[0]->size();
  const double share = empty() ? 1.0 : newest_share;
  if (empty()) noise_ = {rect, std::vector<double>(pixels, 0.0)};
  for (size_t p = 0; p < pixels; ++p) {
    const int x = rect.x0 + int(p % size_t(rect.width()));
    const int y = rect.y0 + int(p / size_t(rect.width()));
    double sum = 0;
    for (size_t c = 0; c < 3; ++c)
      sum += relative(differences[c * pixels + p], double((*values[c])[p]));
    const double newest = sum / 3 * double(allocation.samples(x, y));
    noise_.variance[p] += share * (newest - noise_.variance[p]);
  }
}

}  // namespace tessera
