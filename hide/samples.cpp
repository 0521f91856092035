#include "hide/samples.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <string_view>

#include "base/error.h"
#include "base/hash.h"
#include "hide/owen_points.h"
#include "hide/sobol.h"

namespace tessera {

/// Working space for the samples of one pixel, before they are ordered in time.
struct PixelPoints {
  AlignedVector<float> coordinate[sobol_dimensions];
  AlignedVector<uint32_t> sobol[sobol_dimensions];  ///< the subset of points the pixel uses
  std::vector<uint32_t> order;
};

namespace {

enum Dimension { x_dimension, y_dimension, u_dimension, v_dimension, t_dimension };

/// A permutation of [0, 2^bits) that maps aligned blocks of a power of two to such blocks: nested
/// uniform scrambling of the index, whose own digits are reversed for that.
uint32_t shuffled_index(uint32_t index, int bits, uint32_t seed) {
  uint32_t reversed = 0;
  for (int i = 0; i < bits; ++i) reversed |= (index >> i & 1u) << (bits - 1 - i);
  const uint32_t scrambled = owen_scramble_reversed(reversed, seed);
  uint32_t result = 0;
  for (int i = 0; i < bits; ++i) result |= (scrambled >> i & 1u) << (bits - 1 - i);
  return result;
}

/// Sorts the samples of a pixel by time. A power of two of scrambled Sobol coordinates has exactly
/// one in each of as many equal strata, so each knows its rank at once.
void order_in_time(const float* t, size_t count, std::vector<uint32_t>& order) {
  if (std::has_single_bit(count)) {
    for (size_t k = 0; k < count; ++k) order[size_t(t[k] * float(count))] = uint32_t(k);
    return;
  }
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return t[a] < t[b] || (t[a] == t[b] && a < b); });
}

void pad_with_nan(AlignedVector<float>& values, size_t used) {
  std::fill(values.begin() + long(used), values.end(), std::numeric_limits<float>::quiet_NaN());
}

}  // namespace

SamplePattern::SamplePattern(int samples_per_pixel, uint32_t seed, const LensProfile* lens,
                             const ShutterProfile* shutter)
    : samples_per_pixel_(samples_per_pixel), seed_(seed), lens_(lens), shutter_(shutter) {
  if (samples_per_pixel < 1 || samples_per_pixel > 65536)
    throw Error(fmt::format("{} samples per pixel; expected 1 to 65536", samples_per_pixel));
  disc_lens_ = lens_ && std::string_view(lens_->name()) == "disc";
  box_shutter_ = shutter_ && std::string_view(shutter_->name()) == "box";
  index_bits_ = std::bit_width(uint32_t(samples_per_pixel) - 1);
  const size_t points = size_t(1) << index_bits_;
  sobol_.resize(sobol_dimensions * padded(points));
  for (int d = 0; d < sobol_dimensions; ++d)
    for (size_t k = 0; k < points; ++k)
      sobol_[size_t(d) * padded(points) + k] = sobol_reversed(d, uint32_t(k));
}

void SamplePattern::fill(const PixelRect& rect, SampleBlock& block) const {
  block.rect = rect;
  block.samples_per_pixel = samples_per_pixel_;
  const size_t used = block.size(), stored = padded(used) + simd_padding;
  block.x.resize(stored), block.y.resize(stored);
  for (auto* a : {&block.u, &block.v}) a->resize(lens_ ? stored : 0);
  block.t.resize(shutter_ ? stored : 0);

  PixelPoints points;
  for (auto& c : points.coordinate) c.resize(padded(size_t(samples_per_pixel_)) + simd_padding);
  points.order.resize(size_t(samples_per_pixel_));
  size_t first = 0;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x, first += size_t(samples_per_pixel_))
      fill_pixel(x, y, block, first, points);
  // Whole vectors were written; what lies past the last sample must be covered by nothing.
  for (auto* a : {&block.x, &block.y}) pad_with_nan(*a, used);
  if (lens_)
    for (auto* a : {&block.u, &block.v}) pad_with_nan(*a, used);
  if (shutter_) pad_with_nan(block.t, used);
}

void SamplePattern::warp_lens(float* u, float* v, size_t count) const {
  if (disc_lens_) {
    warp_to_disc(u, v, count);
    return;
  }
  for (size_t k = 0; k < count; ++k) {
    const glm::vec2 lens = lens_->sample(u[k], v[k]);
    u[k] = lens.x, v[k] = lens.y;
  }
}

void SamplePattern::fill_pixel(int px, int py, SampleBlock& block, size_t first,
                               PixelPoints& points) const {
  const size_t count = size_t(samples_per_pixel_), stride = padded(size_t(1) << index_bits_);
  const uint32_t seed = hash_combine(hash_combine(seed_, uint32_t(px)), uint32_t(py));
  const uint32_t* sobol[sobol_dimensions];
  for (int d = 0; d < sobol_dimensions; ++d) sobol[d] = sobol_.data() + size_t(d) * stride;
  if (!std::has_single_bit(uint32_t(count))) {
    // Another subset of the points in each pixel. With a power of two all points are used, and
    // shuffling them would only reorder the samples.
    const uint32_t shuffle = hash_combine(seed, sobol_dimensions);
    for (int d = 0; d < sobol_dimensions; ++d) points.sobol[d].resize(padded(count) + simd_padding);
    for (size_t k = 0; k < count; ++k) {
      const uint32_t index = shuffled_index(uint32_t(k), index_bits_, shuffle);
      for (int d = 0; d < sobol_dimensions; ++d) points.sobol[d][k] = sobol[d][index];
    }
    for (int d = 0; d < sobol_dimensions; ++d) sobol[d] = points.sobol[d].data();
  }
  const auto dimension_seed = [&](uint32_t d) { return mix32(seed + d * 0x9e3779b9u); };

  if (!shutter_) {  // no order to keep: straight into the block
    scramble_positions(sobol[0], count, dimension_seed(0), float(px), block.x.data() + first);
    scramble_positions(sobol[1], count, dimension_seed(1), float(py), block.y.data() + first);
    if (lens_) {
      float *u = block.u.data() + first, *v = block.v.data() + first;
      scramble_points(sobol[2], count, dimension_seed(2), u);
      scramble_points(sobol[3], count, dimension_seed(3), v);
      warp_lens(u, v, count);
    }
    return;
  }
  auto& c = points.coordinate;
  scramble_positions(sobol[0], count, dimension_seed(0), float(px), c[x_dimension].data());
  scramble_positions(sobol[1], count, dimension_seed(1), float(py), c[y_dimension].data());
  if (lens_) {
    scramble_points(sobol[2], count, dimension_seed(2), c[u_dimension].data());
    scramble_points(sobol[3], count, dimension_seed(3), c[v_dimension].data());
    warp_lens(c[u_dimension].data(), c[v_dimension].data(), count);
  }
  scramble_points(sobol[4], count, dimension_seed(4), c[t_dimension].data());
  order_in_time(c[t_dimension].data(), count, points.order);
  if (!box_shutter_)
    for (size_t k = 0; k < count; ++k) c[t_dimension][k] = shutter_->sample(c[t_dimension][k]);
  AlignedVector<float>* to[] = {&block.x, &block.y, &block.u, &block.v, &block.t};
  for (int d = 0; d < sobol_dimensions; ++d) {
    if (to[d]->empty()) continue;
    float* out = to[d]->data() + first;
    for (size_t k = 0; k < count; ++k) out[k] = c[d][points.order[k]];
  }
}

}  // namespace tessera
