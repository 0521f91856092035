#include "hide/lens_lines.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace tessera {

void LensLines::arrange(const SampleBlock& block, int line_count) {
  pixels_ = size_t(block.rect.pixel_count());
  for (size_t s = 0; s < block.size(); ++s)
    if (block.tuple[s] >= uint32_t(line_count))
      throw Error(fmt::format("a sample is on lens line {}; expected less than {}", block.tuple[s],
                              line_count));
  regions_.resize(size_t(line_count));
  sort(block);
  copy(block);
  for (int line = 0; line < line_count; ++line) regions_[size_t(line)] = measure(line);
}

/// Counting sort by (line, pixel); within a pixel samples stay in order.
void LensLines::sort(const SampleBlock& block) {
  const size_t per_pixel = size_t(block.samples_per_pixel);
  first_.assign(regions_.size() * pixels_ + 1, 0);
  for (size_t s = 0; s < block.size(); ++s) ++first_[block.tuple[s] * pixels_ + s / per_pixel];
  size_t sum = 0;
  for (size_t& count : first_) sum += std::exchange(count, sum);
  index_.resize(block.size() + simd_padding);
  for (size_t s = 0; s < block.size(); ++s)
    index_[first_[block.tuple[s] * pixels_ + s / per_pixel]++] = uint32_t(s);
  // Every entry is now the first of the next.
  std::move_backward(first_.begin(), first_.end() - 1, first_.end());
  first_.front() = 0;
}

void LensLines::copy(const SampleBlock& block) {
  const auto gather = [&](const AlignedVector<float>& from, AlignedVector<float>& to) {
    to.clear();
    if (from.empty()) return;
    to.resize(block.size() + simd_padding);
    for (size_t s = 0; s < block.size(); ++s) to[s] = from[index_[s]];
  };
  gather(block.x, x_), gather(block.y, y_), gather(block.u, u_), gather(block.v, v_);
  gather(block.t, t_);
}

/// The line to the sample farthest from the lens centre, and how far others are beside it.
LensRegion LensLines::measure(int line) const {
  const size_t begin = first(line, 0), end = first(line, pixels_);
  LensRegion r;
  double farthest = 0;
  for (size_t s = begin; s < end; ++s) {
    const double u = u_[s], v = v_[s], distance = std::hypot(u, v);
    if (distance > farthest) farthest = distance, r.u = u, r.v = v;
  }
  for (size_t s = begin; farthest > 0 && s < end; ++s)
    r.box = std::max(r.box, std::abs(double(u_[s]) * r.v - double(v_[s]) * r.u) / farthest);
  r.box += 1e-12 * farthest;  // the rounding of this
  return r;
}

SampleArrays LensLines::samples() const {
  const auto pointer = [](const AlignedVector<float>& a) { return a.empty() ? nullptr : a.data(); };
  return {x_.data(), y_.data(), pointer(u_), pointer(v_), pointer(t_)};
}

}  // namespace tessera
