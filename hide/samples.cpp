#include "hide/samples.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "base/hash.h"
#include "hide/owen_points.h"
#include "hide/sobol.h"
#include "hide/tuple_table.h"

namespace tessera {

/// Working space for the samples of one pixel, before they are ordered in time.
struct PixelPoints {
  AlignedVector<float> coordinate[sobol_dimensions];
  AlignedVector<uint32_t> subset[sobol_dimensions];  ///< where a pixel uses some of the points only
  const uint32_t* sobol[sobol_dimensions];           ///< the points that the pixel uses
  std::vector<uint32_t> order, tuple;
};

namespace {

enum Dimension { x_dimension, y_dimension, u_dimension, v_dimension, t_dimension };

/// Sorts the samples of a pixel by a coordinate. A power of two of scrambled Sobol coordinates has
/// exactly one in each of as many equal strata, so each knows its rank at once.
void order_ascending(const float* t, size_t count, std::vector<uint32_t>& order) {
  if (std::has_single_bit(count)) {
    for (size_t k = 0; k < count; ++k) order[size_t(t[k] * float(count))] = uint32_t(k);
    return;
  }
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return t[a] < t[b] || (t[a] == t[b] && a < b); });
}

/// Sorts the samples of a pixel by tuple, and so by time.
void order_by_tuple(const std::vector<uint32_t>& tuple, std::vector<uint32_t>& order) {
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return tuple[a] < tuple[b] || (tuple[a] == tuple[b] && a < b);
  });
}

void pad_with_nan(AlignedVector<float>& values, size_t used) {
  std::fill(values.begin() + long(used), values.end(), std::numeric_limits<float>::quiet_NaN());
}

/// Writes the coordinates that the block has, sample `order[k]` at `first` + k.
void store_in_order(const PixelPoints& points, size_t count, SampleBlock& block, size_t first) {
  AlignedVector<float>* to[] = {&block.x, &block.y, &block.u, &block.v, &block.t};
  for (int d = 0; d < sobol_dimensions; ++d) {
    if (to[d]->empty()) continue;
    float* out = to[d]->data() + first;
    for (size_t k = 0; k < count; ++k) out[k] = points.coordinate[d][points.order[k]];
  }
  if (block.tuple.empty()) return;
  for (size_t k = 0; k < count; ++k) block.tuple[first + k] = points.tuple[points.order[k]];
}

uint32_t seed_of_pixel(uint32_t seed, int x, int y) {
  return hash_combine(hash_combine(seed, uint32_t(x)), uint32_t(y));
}

uint32_t seed_of_dimension(uint32_t pixel_seed, uint32_t dimension) {
  return mix32(pixel_seed + dimension * 0x9e3779b9u);
}

/// Kept below the next pixel, to which the sum may round.
float position_in_pixel(int pixel, float offset) {
  const float next = float(pixel + 1);
  return std::min(float(pixel) + offset, std::nextafter(next, float(pixel)));
}

/// The shuffle of the samples of a tile of 2 x 2 pixels over the sequence of tuples.
class TileShuffle {
 public:
  /// For the samples of pixel (x, y).
  TileShuffle(int x, int y, uint32_t samples_per_pixel, uint32_t frame_seed)
      : seed_(hash_combine(seed_of_pixel(frame_seed, x >> 1, y >> 1), 0x71e5u)),
        first_((uint32_t(y & 1) * 2 + uint32_t(x & 1)) * samples_per_pixel),
        count_(4 * samples_per_pixel) {}
  uint32_t index(uint32_t k) const { return permuted_index(first_ + k, count_, seed_); }

 private:
  uint32_t seed_, first_, count_;
};

/// Where on a lens line a sample is that is the `stratum`-th of `strata` on it, for a uniform
/// jitter in [0, 1): in [-1, 1], with density |s|. That is the density of the distance from the
/// centre over a disc, for as many lines as one likes.
float line_position(uint32_t stratum, uint32_t strata, float jitter) {
  const float a = 2.0f * (float(stratum) + jitter) / float(strata) - 1.0f;
  return std::copysign(std::sqrt(std::abs(a)), a);
}

}  // namespace

SamplePattern::SamplePattern(int samples_per_pixel, uint32_t seed, const LensProfile* lens,
                             const ShutterProfile* shutter, SampleTuples tuples,
                             SampleExtras extras)
    : samples_per_pixel_(samples_per_pixel),
      seed_(seed),
      warps_(lens, shutter),
      tuples_(tuples),
      extras_(extras) {
  if (samples_per_pixel < 1 || samples_per_pixel > 65536)
    throw Error(fmt::format("{} samples per pixel; expected 1 to 65536", samples_per_pixel));
  check_tuples(tuples, samples_per_pixel);
  table_ = make_tuple_table(tuples, seed, warps_);
  if (tuples.kind == SampleTuples::Kind::lens_lines && warps_.has_lens())
    for (int n = 0; n < tuples.count; ++n)
      line_.push_back(warps_.lens_extent() * lens_line_direction(n, tuples.count));
  index_bits_ = std::bit_width(uint32_t(samples_per_pixel) - 1);
  const size_t points = size_t(1) << index_bits_;
  sobol_.resize(sobol_dimensions * padded(points));
  for (int d = 0; d < sobol_dimensions; ++d)
    for (size_t k = 0; k < points; ++k)
      sobol_[size_t(d) * padded(points) + k] = sobol_reversed(d, uint32_t(k));
}

bool SamplePattern::y_stratified() const {
  return !warps_.has_lens() && !warps_.has_time() && tuples_.kind == SampleTuples::Kind::free &&
         std::has_single_bit(uint32_t(samples_per_pixel_));
}

void SamplePattern::fill(const PixelRect& rect, SampleBlock& block) const {
  block.rect = rect;
  block.samples_per_pixel = samples_per_pixel_;
  const size_t used = block.size(), stored = padded(used) + simd_padding;
  block.x.resize(stored), block.y.resize(stored);
  for (auto* a : {&block.u, &block.v}) a->resize(warps_.has_lens() ? stored : 0);
  block.t.resize(warps_.has_time() ? stored : 0);
  block.y_stratified = y_stratified();
  block.tuple.assign(tuples_.kind != SampleTuples::Kind::free ? stored : 0, 0);

  PixelPoints points;
  for (auto& c : points.coordinate) c.resize(padded(size_t(samples_per_pixel_)) + simd_padding);
  points.order.resize(size_t(samples_per_pixel_)), points.tuple.resize(size_t(samples_per_pixel_));
  size_t first = 0;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x, first += size_t(samples_per_pixel_))
      fill_pixel(x, y, block, first, points);
  fill_extras(block);
  // Whole vectors were written; what lies past the last sample must be covered by nothing.
  for (auto* a : {&block.x, &block.y, &block.u, &block.v, &block.t, &block.light_x, &block.light_y,
                  &block.bounce_x, &block.bounce_y})
    if (!a->empty()) pad_with_nan(*a, used);
}

void SamplePattern::fill_extras(SampleBlock& block) const {
  const auto fill_if = [&](bool wanted, uint32_t pair, auto& a, auto& b) {
    for (auto* values : {&a, &b}) values->resize(wanted ? block.x.size() : 0);
    if (wanted) fill_pair(block.rect, pair, a, b);
  };
  fill_if(extras_.light, 0, block.light_x, block.light_y);
  fill_if(extras_.bounce, 1, block.bounce_x, block.bounce_y);
}

void SamplePattern::fill_pair(const PixelRect& rect, uint32_t pair, AlignedVector<float>& a,
                              AlignedVector<float>& b) const {
  const size_t count = size_t(samples_per_pixel_), stride = padded(size_t(1) << index_bits_);
  AlignedVector<uint32_t> sobol_a(padded(count) + simd_padding), sobol_b(sobol_a.size());
  size_t first = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x, first += count) {
      const uint32_t seed = hash_combine(seed_of_pixel(seed_, x, y), 0xe87a5u + pair);
      for (size_t k = 0; k < count; ++k) {
        const uint32_t index = permuted_index(uint32_t(k), uint32_t(count), seed);
        sobol_a[k] = sobol_[index], sobol_b[k] = sobol_[stride + index];
      }
      scramble_points(sobol_a.data(), count, seed_of_dimension(seed, 1), a.data() + first);
      scramble_points(sobol_b.data(), count, seed_of_dimension(seed, 2), b.data() + first);
    }
  }
}

void SamplePattern::fill_pixel(int px, int py, SampleBlock& block, size_t first,
                               PixelPoints& points) const {
  switch (tuples_.kind) {
    case SampleTuples::Kind::free:
      return fill_free(px, py, block, first, points);
    case SampleTuples::Kind::interleaved:
    case SampleTuples::Kind::accumulated:
      return fill_tuples(px, py, block, first, points);
    case SampleTuples::Kind::lens_lines:
      return fill_lines(px, py, block, first, points);
  }
}

void SamplePattern::select_points(uint32_t pixel_seed, PixelPoints& points) const {
  const size_t count = size_t(samples_per_pixel_), stride = padded(size_t(1) << index_bits_);
  for (int d = 0; d < sobol_dimensions; ++d) points.sobol[d] = sobol_.data() + size_t(d) * stride;
  if (std::has_single_bit(uint32_t(count))) return;
  // Another subset of the points in each pixel. With a power of two all points are used, and
  // shuffling them would only reorder the samples.
  const uint32_t shuffle = hash_combine(pixel_seed, sobol_dimensions);
  for (auto& s : points.subset) s.resize(padded(count) + simd_padding);
  for (size_t k = 0; k < count; ++k) {
    const uint32_t index = shuffled_index(uint32_t(k), index_bits_, shuffle);
    for (int d = 0; d < sobol_dimensions; ++d) points.subset[d][k] = points.sobol[d][index];
  }
  for (int d = 0; d < sobol_dimensions; ++d) points.sobol[d] = points.subset[d].data();
}

void SamplePattern::fill_free(int px, int py, SampleBlock& block, size_t first,
                              PixelPoints& points) const {
  const size_t count = size_t(samples_per_pixel_);
  const uint32_t seed = seed_of_pixel(seed_, px, py);
  select_points(seed, points);
  const uint32_t* const* sobol = points.sobol;
  const auto dimension_seed = [&](uint32_t d) { return seed_of_dimension(seed, d); };
  if (y_stratified()) {
    auto& c = points.coordinate;
    scramble_positions(sobol[0], count, dimension_seed(0), float(px), c[x_dimension].data());
    scramble_points(sobol[1], count, dimension_seed(1), c[t_dimension].data());
    order_ascending(c[t_dimension].data(), count, points.order);
    scramble_positions(sobol[1], count, dimension_seed(1), float(py), c[y_dimension].data());
    for (size_t k = 0; k < count; ++k) {
      block.x[first + k] = c[x_dimension][points.order[k]];
      block.y[first + k] = c[y_dimension][points.order[k]];
    }
    return;
  }
  if (!warps_.has_time() && !warps_.has_lens()) {  // no order to keep: straight into the block
    scramble_positions(sobol[0], count, dimension_seed(0), float(px), block.x.data() + first);
    scramble_positions(sobol[1], count, dimension_seed(1), float(py), block.y.data() + first);
    return;
  }
  auto& c = points.coordinate;
  scramble_positions(sobol[0], count, dimension_seed(0), float(px), c[x_dimension].data());
  scramble_positions(sobol[1], count, dimension_seed(1), float(py), c[y_dimension].data());
  if (warps_.has_lens()) {
    scramble_points(sobol[2], count, dimension_seed(2), c[u_dimension].data());
    scramble_points(sobol[3], count, dimension_seed(3), c[v_dimension].data());
    // Before the warp, which keeps the order of u but roughly: sides of the lens stay apart.
    if (!warps_.has_time()) order_ascending(c[u_dimension].data(), count, points.order);
    warps_.lens(c[u_dimension].data(), c[v_dimension].data(), count);
  }
  if (warps_.has_time()) {
    scramble_points(sobol[4], count, dimension_seed(4), c[t_dimension].data());
    order_ascending(c[t_dimension].data(), count, points.order);
    warps_.time(c[t_dimension].data(), count);
  }
  store_in_order(points, count, block, first);
}

void SamplePattern::fill_tuples(int px, int py, SampleBlock& block, size_t first,
                                PixelPoints& points) const {
  const size_t count = size_t(samples_per_pixel_);
  auto& c = points.coordinate;
  const bool interleaved = tuples_.kind == SampleTuples::Kind::interleaved;
  if (interleaved) {
    const uint32_t seed = seed_of_pixel(seed_, px, py);
    select_points(seed, points);
    scramble_positions(points.sobol[0], count, seed_of_dimension(seed, 0), float(px),
                       c[x_dimension].data());
    scramble_positions(points.sobol[1], count, seed_of_dimension(seed, 1), float(py),
                       c[y_dimension].data());
  }
  const TileShuffle shuffle(px, py, uint32_t(count), seed_);
  for (size_t k = 0; k < count; ++k) {
    const uint32_t index = interleaved ? shuffle.index(uint32_t(k)) : uint32_t(k);
    const uint32_t tuple = table_.number[index % uint32_t(tuples_.count)];
    points.tuple[k] = tuple;
    if (!interleaved) {
      c[x_dimension][k] = position_in_pixel(px, table_.x[tuple]);
      c[y_dimension][k] = position_in_pixel(py, table_.y[tuple]);
    }
    if (warps_.has_lens()) c[u_dimension][k] = table_.u[tuple], c[v_dimension][k] = table_.v[tuple];
    if (warps_.has_time()) c[t_dimension][k] = table_.t[tuple];
  }
  if (warps_.has_time())
    order_by_tuple(points.tuple, points.order);
  else
    std::iota(points.order.begin(), points.order.end(), 0u);
  store_in_order(points, count, block, first);
}

void SamplePattern::fill_lines(int px, int py, SampleBlock& block, size_t first,
                               PixelPoints& points) const {
  const uint32_t count = uint32_t(samples_per_pixel_), lines = uint32_t(tuples_.count);
  const uint32_t seed = seed_of_pixel(seed_, px, py);
  select_points(seed, points);
  auto& c = points.coordinate;
  scramble_positions(points.sobol[0], count, seed_of_dimension(seed, 0), float(px),
                     c[x_dimension].data());
  scramble_positions(points.sobol[1], count, seed_of_dimension(seed, 1), float(py),
                     c[y_dimension].data());
  // Samples are dealt out to the lines round after round, from a line that the pixel chooses. The
  // jitters of one round, one for each line, are stratified among themselves.
  const uint32_t shuffle = hash_combine(seed, 0x11e5u), first_line = mix32(shuffle) % lines;
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t place = permuted_index(k, count, shuffle);
    const uint32_t round = place / lines, turn = place % lines;
    points.tuple[k] = (turn + first_line) % lines;
    if (!warps_.has_lens()) continue;
    const uint32_t strata = count / lines + (turn < count % lines);
    const uint32_t digits = owen_scramble_reversed(turn, hash_combine(shuffle, round));
    const float jitter = std::ldexp(float(reverse_bits(digits) >> 8), -24);
    const glm::vec2 at = line_position(round, strata, jitter) * line_[points.tuple[k]];
    c[u_dimension][k] = at.x, c[v_dimension][k] = at.y;
  }
  if (warps_.has_time()) {
    scramble_points(points.sobol[4], count, seed_of_dimension(seed, 4), c[t_dimension].data());
    order_ascending(c[t_dimension].data(), count, points.order);
    warps_.time(c[t_dimension].data(), count);
  } else {
    std::iota(points.order.begin(), points.order.end(), 0u);
  }
  store_in_order(points, count, block, first);
}

}  // namespace tessera
