/// Intervals of the tiles of one micropolygon, and the samples inside them. Included once for each
/// SIMD target.

#include <algorithm>

#include "hide/dual_grid.h"

#if defined(TESSERA_HIDE_DUAL_TILES_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_DUAL_TILES_H_
#undef TESSERA_HIDE_DUAL_TILES_H_
#else
#define TESSERA_HIDE_DUAL_TILES_H_
#endif

#include <hwy/highway.h>

#include "hide/compaction.h"
#include "hide/dual_setup.h"
#include "hide/pixel_test.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// What of the lens, along one axis, and of the shutter a column (axis 0) or row (1) of tiles is
/// left with, for all the columns or rows of the box of lane n.
template <bool kMotion, bool kLens>
HWY_INLINE void bound_tiles(const DualGridJob& job, const DualLanes& l, int axis, int n,
                            TileIntervals& out) {
  const FloatTag d;
  const CoverageFrame& f = job.test.frame;
  const int count = l.last[axis][n] - l.first[axis][n] + 1;
  for (int k = 0; k < count; k += int(hn::Lanes(d))) {
    const FloatVec tile = hn::Iota(d, float(k));
    TimeSpan tau{hn::Set(d, l.tau_min[n]), hn::Set(d, l.tau_max[n])};
    if constexpr (kMotion) {  // equation 4
      FloatVec delta[4];
      for (int line = 0; line < 4; ++line)
        delta[line] = hn::MulAdd(tile, hn::Set(d, l.delta_step[axis][line][n]),
                                 hn::Set(d, l.delta_at[axis][line][n]));
      clip_to_negative(delta[0], delta[1], tau);
      clip_to_negative(delta[2], delta[3], tau);
    }
    FloatMask empty = hn::Gt(tau.min, tau.max);
    if constexpr (kLens) {  // equation 2
      const FloatVec centre = hn::Mul(hn::Add(tile, hn::Set(d, float(l.first[axis][n]) + 0.5f)),
                                      hn::Set(d, float(job.tile_size)));
      const auto line = [&](int k_line) HWY_ATTR {
        return hn::MulAdd(centre, hn::Set(d, l.lens_scale[axis][k_line][n]),
                          hn::Set(d, l.lens_offset[axis][k_line][n]));
      };
      const FloatVec max = hn::Min(line(0), line(1)), min = hn::Max(line(2), line(3));
      const FloatVec lens = hn::Set(d, job.lens);
      empty = hn::Or(
          empty, hn::Or(hn::Gt(min, max), hn::Or(hn::Gt(min, lens), hn::Lt(max, hn::Neg(lens)))));
      hn::StoreU(min, d, out.l_min.data() + k), hn::StoreU(max, d, out.l_max.data() + k);
    }
    // tau back to t, widened by more than it rounds, then cut to what the segment owns.
    const FloatVec begin = hn::Set(d, f.t_begin), slack = hn::Set(d, root_slack);
    const FloatVec duration = hn::Set(d, 1.0f / f.inverse_duration);
    const FloatVec t_min = hn::Max(begin, hn::Sub(hn::MulAdd(tau.min, duration, begin), slack));
    const FloatVec t_max =
        hn::Min(hn::Set(d, f.t_last), hn::Add(hn::MulAdd(tau.max, duration, begin), slack));
    hn::StoreU(hn::IfThenElse(empty, hn::Set(d, 2.0f), t_min), d, out.t_min.data() + k);
    hn::StoreU(t_max, d, out.t_max.data() + k);
  }
}

/// The box of samples of one tile.
struct TileBox {
  float u[2], v[2], t[2];
};

template <bool kMotion, bool kLens>
HWY_INLINE FloatMask inside_tile_box(const TileBox& box, const SampleVec& s, FloatMask mask) {
  const FloatTag d;
  const auto between = [&](FloatVec value, const float(&range)[2]) HWY_ATTR {
    mask = hn::And(
        mask, hn::And(hn::Ge(value, hn::Set(d, range[0])), hn::Le(value, hn::Set(d, range[1]))));
  };
  if constexpr (kMotion) between(s.t, box.t);
  if constexpr (kLens) between(s.u, box.u), between(s.v, box.v);
  return mask;
}

/// Tests the samples of the batch against the micropolygon and empties it.
template <bool kMotion, bool kLens>
HWY_NOINLINE void test_batch(const DualGridJob& job, const Quad& quad, uint32_t id,
                             CoverageCounts& counts) {
  SampleBatch& batch = job.scratch->batch;
  FragmentBuffer& buffer = *job.test.buffer;
  const SampleArrays samples{batch.x, batch.y, batch.u, batch.v, batch.t};
  for (size_t k = 0; k < batch.count; k += hn::Lanes(FloatTag())) {
    const SampleVec s = load_samples<kMotion, kLens>(samples, k);
    test_vector<kMotion, kLens>(
        job.test.frame, quad, s, batch.count - k, counts, [&](const Hit& hit) HWY_ATTR {
          for_each_hit(hit, [&](size_t lane, float z, float b1, float b2, uint32_t triangle) {
            if (job.test.opaque)
              buffer.put(batch.index[k + lane], z, b1, b2, id + triangle);
            else
              buffer.add(batch.index[k + lane], z, b1, b2, id + triangle);
          });
        });
  }
  job.counters->samples_tested += batch.count;
  if (!job.tests_per_pixel.empty())
    for (size_t k = 0; k < batch.count; ++k)
      ++job.tests_per_pixel[batch.index[k] / job.test.samples_per_pixel];
  batch.count = 0;
}

/// Puts the samples [begin, begin + length), pixels of one row of a tile, that are inside its box
/// into the batch. `test` empties a full one.
template <bool kMotion, bool kLens, class Test>
HWY_INLINE void gather_run(const DualGridJob& job, size_t begin, size_t length, const TileBox& box,
                           const Test& test) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  SampleBatch& batch = job.scratch->batch;
  const float* t = job.test.samples.t;
  // The samples of a pixel ascend in time.
  const bool one_pixel = kMotion && length == job.test.samples_per_pixel;
  size_t k = 0;
  if (one_pixel && length > 4 * hn::Lanes(d))
    k = size_t(std::lower_bound(t + begin, t + begin + length, box.t[0]) - (t + begin));
  for (; k < length; k += hn::Lanes(d)) {
    const size_t i = begin + k;
    if (one_pixel && t[i] > box.t[1]) break;
    const SampleVec s = load_samples<kMotion, kLens>(job.test.samples, i);
    const FloatMask keep = inside_tile_box<kMotion, kLens>(box, s, hn::FirstN(d, length - k));
    if (hn::AllFalse(d, keep)) continue;
    if (batch.count + hn::Lanes(d) > SampleBatch::capacity) test();
    const Compaction chosen(keep);
    chosen.store(s.x, batch.x + batch.count), chosen.store(s.y, batch.y + batch.count);
    if constexpr (kLens) {
      chosen.store(s.u, batch.u + batch.count), chosen.store(s.v, batch.v + batch.count);
    }
    if constexpr (kMotion) chosen.store(s.t, batch.t + batch.count);
    chosen.store(hn::Iota(du, uint32_t(i)), batch.index + batch.count);
    batch.count += chosen.count();
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
