#include "hide/stratified_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera {
namespace {

/// More than the rounding of a sample's place among the strata, which is a few units of 2^-24.
constexpr double stratum_slack = 0x1p-18;

/// Stratum of `value` among `count` equal ones of [low, low + size].
int stratum_along(float value, float low, float size, int count) {
  return std::clamp(int((value - low) * (float(count) / size)), 0, count - 1);
}

/// The `k`-th of `count` equal parts of [low, high], and the slack.
void part_of(double low, double high, int k, int count, double (&part)[2]) {
  const double step = (high - low) / count, slack = stratum_slack * (high - low);
  part[0] = std::max(low, low + k * step - slack);
  part[1] = k + 1 == count ? high : std::min(high, low + (k + 1) * step + slack);
}

}  // namespace

int StratifiedSamples::stratum_of(const SampleBlock& block, size_t i) const {
  const auto E = float(lens_extent_);
  int stratum = counts_.t > 1 ? stratum_along(block.t[i], 0, 1, counts_.t) : 0;
  stratum = stratum * counts_.v + (lens_ ? stratum_along(block.v[i], -E, 2 * E, counts_.v) : 0);
  return stratum * counts_.u + (lens_ ? stratum_along(block.u[i], -E, 2 * E, counts_.u) : 0);
}

void StratifiedSamples::set(const SampleBlock& block, const StrataCounts& wanted,
                            float lens_extent) {
  lens_ = !block.u.empty();
  lens_extent_ = double(lens_extent);
  counts_ = {lens_ ? wanted.u : 1, lens_ ? wanted.v : 1, block.t.empty() ? 1 : wanted.t};
  pixels_ = size_t(block.rect.pixel_count()), pixels_per_row_ = size_t(block.rect.width());

  // A counting sort. Counts are kept two places on, so that after the sums and one increment for
  // each sample placed, offsets_[key] is where the key begins.
  const size_t samples = block.size(), spp = size_t(block.samples_per_pixel);
  keys_.resize(samples);
  offsets_.assign(size_t(count()) * pixels_ + 2, 0);
  for (size_t i = 0; i < samples; ++i) {
    keys_[i] = uint32_t(size_t(stratum_of(block, i)) * pixels_ + i / spp);
    ++offsets_[keys_[i] + 2];
  }
  for (size_t k = 1; k < offsets_.size(); ++k) offsets_[k] += offsets_[k - 1];
  index_.resize(padded(samples) + simd_padding);
  for (size_t i = 0; i < samples; ++i) index_[offsets_[keys_[i] + 1]++] = uint32_t(i);

  const auto arrange = [&](const AlignedVector<float>& from, AlignedVector<float>& to) {
    to.clear();
    if (from.empty()) return;
    to.resize(padded(samples) + simd_padding, std::numeric_limits<float>::quiet_NaN());
    for (size_t i = 0; i < samples; ++i) to[i] = from[index_[i]];
  };
  arrange(block.x, x_), arrange(block.y, y_);
  arrange(block.u, u_), arrange(block.v, v_), arrange(block.t, t_);
}

SampleArrays StratifiedSamples::arrays() const {
  const auto pointer = [](const AlignedVector<float>& a) { return a.empty() ? nullptr : a.data(); };
  return {x_.data(), y_.data(), pointer(u_), pointer(v_), pointer(t_)};
}

bool StratifiedSamples::range(int stratum, const CoverageFrame& frame, SweptRange& range) const {
  range = {};
  if (lens_) {
    part_of(-lens_extent_, lens_extent_, stratum % counts_.u, counts_.u, range.u);
    part_of(-lens_extent_, lens_extent_, stratum / counts_.u % counts_.v, counts_.v, range.v);
  }
  double t[2];
  part_of(0, 1, stratum / (counts_.u * counts_.v), counts_.t, t);
  if (t[0] > double(frame.t_last) || t[1] < double(frame.t_begin)) return false;
  const auto tau = [&](double time) {
    return (time - double(frame.t_begin)) * double(frame.inverse_duration);
  };
  // Shutter time in float is off by 2^-24, in a short segment by more of its own time.
  const double slack = 0x1p-22 * double(frame.inverse_duration);
  range.tau[0] = t[0] <= double(frame.t_begin) ? 0.0 : std::max(0.0, tau(t[0]) - slack);
  range.tau[1] = t[1] >= double(frame.t_last) ? 1.0 : std::min(1.0, tau(t[1]) + slack);
  return true;
}

}  // namespace tessera
