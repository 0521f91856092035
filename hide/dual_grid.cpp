#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/dual_grid.cpp"
#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/dual_grid.h"
#include "hide/dual_tiles.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// A micropolygon that neither moves nor is out of focus: all samples of its box of pixels.
void test_still(const DualGridJob& job, const DualLanes& l, int n, const Quad& quad, uint32_t id,
                CoverageCounts& counts) {
  const PixelRect pixels{l.first[0][n], l.first[1][n], l.last[0][n] + 1, l.last[1][n] + 1};
  const auto spp = uint32_t(job.test.samples_per_pixel);
  job.counters->samples_tested += uint64_t(pixels.pixel_count()) * spp;
  if (job.test.opaque)
    test_pixels<false, false, true>(job.test, quad, id, pixels, counts);
  else
    test_pixels<false, false, false>(job.test, quad, id, pixels, counts);
  if (job.tests_per_pixel.empty()) return;
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x)
      job.tests_per_pixel[size_t(y) * job.test.pixels_per_row + size_t(x)] += spp;
}

/// Gathers the samples of column c and row r of the box of lane n.
template <bool kMotion, bool kLens, class Test>
HWY_INLINE void gather_tile(const DualGridJob& job, const DualLanes& l, int n, int c, int r,
                            const Test& test) {
  const TileIntervals &columns = job.scratch->columns, &rows = job.scratch->rows;
  TileBox box;
  if constexpr (kMotion) {
    box.t[0] = std::max(columns.t_min[size_t(c)], rows.t_min[size_t(r)]);
    box.t[1] = std::min(columns.t_max[size_t(c)], rows.t_max[size_t(r)]);
  }
  if constexpr (kLens) {
    box.u[0] = columns.l_min[size_t(c)], box.u[1] = columns.l_max[size_t(c)];
    box.v[0] = rows.l_min[size_t(r)], box.v[1] = rows.l_max[size_t(r)];
  }
  const int size = job.tile_size, x0 = (l.first[0][n] + c) * size, y0 = (l.first[1][n] + r) * size;
  const int x1 = std::min(x0 + size, job.rect.width()), y1 = std::min(y0 + size, job.rect.height());
  const size_t spp = job.test.samples_per_pixel, length = size_t(x1 - x0) * spp;
  for (int y = y0; y < y1; ++y)
    gather_run<kMotion, kLens>(job, (size_t(y) * job.test.pixels_per_row + size_t(x0)) * spp,
                               length, box, test);
}

/// Visits the tiles of lane n whose intervals are not empty. True if samples were tested.
template <bool kMotion, bool kLens>
bool visit_tiles(const DualGridJob& job, const DualLanes& l, int n, const Quad& quad, uint32_t id,
                 CoverageCounts& counts) {
  const FloatTag d;
  TileIntervals &columns = job.scratch->columns, &rows = job.scratch->rows;
  bound_tiles<kMotion, kLens>(job, l, 0, n, columns);
  bound_tiles<kMotion, kLens>(job, l, 1, n, rows);
  const uint64_t tested_before = job.counters->samples_tested;
  const auto test = [&] { test_batch<kMotion, kLens>(job, quad, id, counts); };
  const int column_count = l.last[0][n] - l.first[0][n] + 1;
  const int row_count = l.last[1][n] - l.first[1][n] + 1;
  for (int r = 0; r < row_count; ++r) {
    if (rows.t_min[size_t(r)] > rows.t_max[size_t(r)]) continue;
    const FloatVec row_min = hn::Set(d, rows.t_min[size_t(r)]),
                   row_max = hn::Set(d, rows.t_max[size_t(r)]);
    for (int c = 0; c < column_count; c += int(hn::Lanes(d))) {
      const FloatVec t_min = hn::Max(row_min, hn::LoadU(d, columns.t_min.data() + c));
      const FloatVec t_max = hn::Min(row_max, hn::LoadU(d, columns.t_max.data() + c));
      uint8_t bits[8] = {};
      hn::StoreMaskBits(d, hn::And(hn::Le(t_min, t_max), hn::FirstN(d, size_t(column_count - c))),
                        bits);
      for (uint32_t tiles = uint32_t(bits[0] | bits[1] << 8); tiles != 0; tiles &= tiles - 1) {
        ++job.counters->tiles_visited;
        gather_tile<kMotion, kLens>(job, l, n, c + __builtin_ctz(tiles), r, test);
      }
    }
  }
  if (job.scratch->batch.count > 0) test();
  return job.counters->samples_tested > tested_before;
}

inline void resize_intervals(int pixels, int tile_size, TileIntervals& intervals) {
  const size_t stored = padded(size_t((pixels + tile_size - 1) / tile_size)) + simd_padding;
  for (auto* a : {&intervals.l_min, &intervals.l_max, &intervals.t_min, &intervals.t_max})
    a->resize(stored);
}

template <bool kMotion, bool kLens>
uint64_t hide_dual(const DualGridJob& job) {
  const ClipGrid& clip = *job.clip;
  project_vertices<kMotion, kLens>(job);
  resize_intervals(job.rect.width(), job.tile_size, job.scratch->columns);
  resize_intervals(job.rect.height(), job.tile_size, job.scratch->rows);
  const DualAxis axes[2] = {dual_axis(job, 0), dual_axis(job, 1)};
  DualLanes lanes;
  CoverageCounts counts;
  uint64_t micropolygons = 0;
  for (int j = 0; j < clip.v_count(); ++j)
    for (int i = 0; i < clip.u_count(); i += int(hn::Lanes(FloatTag()))) {
      uint32_t seen = set_up<kMotion, kLens>(job, axes, i, j, lanes);
      for (; seen != 0; seen &= seen - 1) {
        const int n = __builtin_ctz(seen), m = j * clip.u_count() + i + n;
        if (clip.dropped(m)) continue;
        const Quad quad = load_quad(*job.segment, clip.u_count(), i + n, j);
        const uint32_t id = job.id0 + 2 * uint32_t(m);
        if constexpr (kMotion || kLens) {
          micropolygons += visit_tiles<kMotion, kLens>(job, lanes, n, quad, id, counts);
        } else {
          test_still(job, lanes, n, quad, id, counts);
          ++micropolygons;
        }
      }
    }
  job.counters->samples_covered += counts.covered;
  job.counters->nonfinite_dropped += counts.nonfinite;
  return micropolygons;
}

uint64_t hide_any(const DualGridJob& job) {
  if (job.test.motion)
    return job.test.lens ? hide_dual<true, true>(job) : hide_dual<true, false>(job);
  return job.test.lens ? hide_dual<false, true>(job) : hide_dual<false, false>(job);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(hide_any);

uint64_t hide_dual_grid(const DualGridJob& job) { return HWY_DYNAMIC_DISPATCH(hide_any)(job); }

}  // namespace tessera
#endif
