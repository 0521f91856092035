/// Finding the samples that a block of micropolygons may cover. Included once for each SIMD target.

#include <algorithm>

#include "hide/blurred_grid.h"

#if defined(TESSERA_HIDE_CANDIDATES_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_CANDIDATES_H_
#undef TESSERA_HIDE_CANDIDATES_H_
#else
#define TESSERA_HIDE_CANDIDATES_H_
#endif

#include "hide/compaction.h"
#include "hide/pixel_test.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Appends the chosen lanes to a list.
template <bool kMotion, bool kLens>
HWY_INLINE void append(CandidateList& list, const SampleVec& s,
                       hn::Vec<hn::RebindToUnsigned<FloatTag>> index, const Compaction& chosen) {
  const size_t at = list.count;
  chosen.store(s.x, list.x.data() + at);
  chosen.store(s.y, list.y.data() + at);
  if constexpr (kLens) {
    chosen.store(s.u, list.u.data() + at);
    chosen.store(s.v, list.v.data() + at);
  }
  if constexpr (kMotion) chosen.store(s.t, list.t.data() + at);
  chosen.store(index, list.index.data() + at);
  list.count += chosen.count();
}

/// A vector of samples in the sheared space of a block.
struct Sheared {
  FloatVec x, y;
};

template <bool kMotion, bool kLens>
HWY_INLINE Sheared shear(const SampleBox& box, const CoverageFrame& frame, const ShearFrame& f,
                         const SampleVec& s) {
  const FloatTag d;
  FloatVec tau = hn::Zero(d);
  if constexpr (kMotion)
    tau = hn::Mul(hn::Sub(s.t, hn::Set(d, frame.t_begin)), hn::Set(d, frame.inverse_duration));
  const auto along = [&](FloatVec position, FloatVec lens, int axis) HWY_ATTR {
    const FloatVec p = hn::Sub(position, hn::Set(d, box.middle[axis]));
    FloatVec result = hn::Mul(p, hn::Set(d, f.per_p[axis]));
    if constexpr (kLens) result = hn::MulAdd(lens, hn::Set(d, f.per_l[axis]), result);
    if constexpr (kMotion) result = hn::MulAdd(tau, hn::Set(d, f.per_t[axis]), result);
    return result;
  };
  return {along(s.x, s.u, 0), along(s.y, s.v, 1)};
}

HWY_INLINE FloatMask inside(const Sheared& s, const float (&low)[2], const float (&high)[2]) {
  const FloatTag d;
  const FloatMask x = hn::And(hn::Ge(s.x, hn::Set(d, low[0])), hn::Le(s.x, hn::Set(d, high[0])));
  const FloatMask y = hn::And(hn::Ge(s.y, hn::Set(d, low[1])), hn::Le(s.y, hn::Set(d, high[1])));
  return hn::And(x, y);
}

/// Samples within the interval of a tile: the cheap test before the forms.
template <bool kMotion, bool kLens>
HWY_INLINE FloatMask within(const SampleInterval& column, const SampleInterval& row,
                            const CoverageFrame& frame, const SampleVec& s, FloatMask mask) {
  const FloatTag d;
  const auto between = [&](FloatVec value, float low, float high) HWY_ATTR {
    mask = hn::And(mask, hn::And(hn::Ge(value, hn::Set(d, low)), hn::Le(value, hn::Set(d, high))));
  };
  if constexpr (kMotion) {
    // Rounding t back from tau: widened by more than the error, then cut to the segment.
    const float duration = 1.0f / frame.inverse_duration;
    const float low = std::max(column.t_min, row.t_min), high = std::min(column.t_max, row.t_max);
    between(s.t, std::max(frame.t_begin, frame.t_begin + low * duration - 0x1p-20f),
            std::min(frame.t_last, frame.t_begin + high * duration + 0x1p-20f));
  }
  if constexpr (kLens) between(s.u, column.l_min, column.l_max), between(s.v, row.l_min, row.l_max);
  return mask;
}

/// Candidates of the whole grid. Tiles whose intervals are empty are skipped; in the others,
/// samples inside the intervals and not behind something opaque are held against the grid's bounds.
template <bool kMotion, bool kLens>
void gather_candidates(const BlurredGridJob& job, const BlockBounds& bounds, CandidateList& list) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  const PixelRect& rect = job.rect;
  const size_t spp = job.test.samples_per_pixel;
  const FloatVec nearest = hn::Set(d, job.z_nearest);
  const SampleInterval& span = job.time_span;
  list.count = 0;
  for (int ty = rect.y0; ty < rect.y1; ty += job.tile_size) {
    const int y_end = std::min(ty + job.tile_size, rect.y1);
    SampleInterval row = tile_interval(bounds, job.box, 1, float(ty), float(y_end));
    row.t_min = std::max(row.t_min, span.t_min), row.t_max = std::min(row.t_max, span.t_max);
    if (row.empty()) continue;
    for (int tx = rect.x0; tx < rect.x1; tx += job.tile_size) {
      const int x_end = std::min(tx + job.tile_size, rect.x1);
      const SampleInterval column = tile_interval(bounds, job.box, 0, float(tx), float(x_end));
      if (column.empty() || column.t_min > row.t_max || row.t_min > column.t_max) continue;
      ++job.counters->tiles_visited;
      const size_t length = size_t(x_end - tx) * spp;
      for (int y = ty; y < y_end; ++y) {
        const size_t begin =
            (size_t(y - rect.y0) * job.test.pixels_per_row + size_t(tx - rect.x0)) * spp;
        for (size_t k = 0; k < length; k += hn::Lanes(d)) {
          const SampleVec s = load_samples<kMotion, kLens>(job.test.samples, begin + k);
          const FloatVec z = hn::LoadU(d, job.test.buffer->z() + begin + k);
          FloatMask keep = hn::And(hn::FirstN(d, length - k), hn::Ge(z, nearest));
          keep = within<kMotion, kLens>(column, row, job.test.frame, s, keep);
          if constexpr (kMotion)
            keep = hn::And(keep, hn::And(hn::Ge(s.t, hn::Set(d, job.t_first)),
                                         hn::Le(s.t, hn::Set(d, job.t_last))));
          if (hn::AllFalse(d, keep)) continue;
          const Sheared sheared = shear<kMotion, kLens>(job.box, job.test.frame, bounds.shear, s);
          keep = hn::And(keep, inside(sheared, bounds.low, bounds.high));
          if (hn::AllFalse(d, keep)) continue;
          append<kMotion, kLens>(list, s, hn::Iota(du, uint32_t(begin + k)), Compaction(keep));
        }
      }
    }
  }
}

/// The candidates of a block that part of it, of these bounds, may cover. With kPatch, their
/// sheared positions are kept too.
template <bool kMotion, bool kLens, bool kPatch>
void filter(const BlurredGridJob& job, const BlockBounds& bounds, const CandidateList& from,
            CandidateList& to) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  to.count = 0;
  const SampleArrays samples = from.samples();
  for (size_t i = 0; i < from.count; i += hn::Lanes(d)) {
    const SampleVec s = load_samples<kMotion, kLens>(samples, i);
    const Sheared sheared = shear<kMotion, kLens>(job.box, job.test.frame, bounds.shear, s);
    const FloatMask keep =
        hn::And(inside(sheared, bounds.low, bounds.high), hn::FirstN(d, from.count - i));
    if (hn::AllFalse(d, keep)) continue;
    const Compaction chosen(keep);
    if constexpr (kPatch) {
      chosen.store(sheared.x, to.shear_x.data() + to.count);
      chosen.store(sheared.y, to.shear_y.data() + to.count);
    }
    append<kMotion, kLens>(to, s, hn::LoadU(du, from.index.data() + i), chosen);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
