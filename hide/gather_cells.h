/// Finding the samples that a block may cover, and their cells in the space of its shear map.
/// Included once for each SIMD target.

#include <algorithm>

#include "hide/sheared_grid.h"

#if defined(TESSERA_HIDE_GATHER_CELLS_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_GATHER_CELLS_H_
#undef TESSERA_HIDE_GATHER_CELLS_H_
#else
#define TESSERA_HIDE_GATHER_CELLS_H_
#endif

#include "hide/candidates.h"
#include "hide/shear_block.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Where the map carries a vector of samples, relative to the map's middle.
struct MappedSamples {
  FloatVec x, y;
};

/// The linear system of a vector of samples, for the step that takes in the bend.
struct ShearSystem {
  FloatVec xx, xy, yx, yy, inverse;  ///< the matrix, and 1 / its determinant
  FloatVec sigma;
};

/// Solves delta = 0 for (x0, y0): hide/shear_map.h has the equation.
template <bool kMotion, bool kLens>
HWY_INLINE MappedSamples map_samples(const ShearMap& m, const CoverageFrame& f, const SampleVec& s,
                                     ShearSystem& system) {
  const FloatTag d;
  const FloatVec x = hn::Sub(s.x, hn::Set(d, m.middle[0]));
  const FloatVec y = hn::Sub(s.y, hn::Set(d, m.middle[1]));
  const FloatVec one = hn::Set(d, 1.0f);
  FloatVec xx = one, xy = hn::Zero(d), yx = hn::Zero(d), yy = one, bx = x, by = y;
  FloatVec sigma = hn::Zero(d);
  if constexpr (kMotion) {
    const FloatVec tau =
        hn::Mul(hn::Sub(s.t, hn::Set(d, f.t_begin)), hn::Set(d, f.inverse_duration));
    sigma = hn::Sub(tau, hn::Set(d, m.tau));
    const auto &rx = m.fit[field_rx], &ry = m.fit[field_ry], &q = m.fit[field_q];
    // r - x q, the velocity on the raster of what is seen at x.
    const auto velocity = [&](float r, float rate, FloatVec at) HWY_ATTR {
      return hn::NegMulAdd(at, hn::Set(d, rate), hn::Set(d, r));
    };
    xx = hn::MulAdd(sigma, velocity(rx.per_x, q.per_x, x), one);
    xy = hn::Mul(sigma, velocity(rx.per_y, q.per_y, x));
    yx = hn::Mul(sigma, velocity(ry.per_x, q.per_x, y));
    yy = hn::MulAdd(sigma, velocity(ry.per_y, q.per_y, y), one);
    bx = hn::NegMulAdd(sigma, velocity(rx.at_middle, q.at_middle, x), x);
    by = hn::NegMulAdd(sigma, velocity(ry.at_middle, q.at_middle, y), y);
  }
  if constexpr (kLens) {
    const FloatVec v = hn::Mul(s.v, hn::Set(d, m.coc_ratio));
    const auto coc = [&](float AffineField::*part) HWY_ATTR {
      const FloatVec c = hn::Set(d, m.fit[field_c].*part);
      if constexpr (kMotion) return hn::MulAdd(sigma, hn::Set(d, m.fit[field_e].*part), c);
      return c;
    };
    const FloatVec c = coc(&AffineField::at_middle), c_x = coc(&AffineField::per_x),
                   c_y = coc(&AffineField::per_y);
    xx = hn::MulAdd(s.u, c_x, xx), xy = hn::MulAdd(s.u, c_y, xy);
    yx = hn::MulAdd(v, c_x, yx), yy = hn::MulAdd(v, c_y, yy);
    bx = hn::NegMulAdd(s.u, c, bx), by = hn::NegMulAdd(v, c, by);
  }
  const FloatVec determinant = hn::NegMulAdd(xy, yx, hn::Mul(xx, yy));
  const FloatVec inverse = hn::Div(one, determinant);
  system = {xx, xy, yx, yy, inverse, sigma};
  return {hn::Mul(hn::NegMulAdd(xy, by, hn::Mul(yy, bx)), inverse),
          hn::Mul(hn::NegMulAdd(yx, bx, hn::Mul(xx, by)), inverse)};
}

/// p - A^-1 Q(p).
template <bool kMotion, bool kLens>
HWY_INLINE MappedSamples take_in_bend(const ShearMap& m, const SampleVec& s, const ShearSystem& a,
                                      const MappedSamples& p) {
  const FloatTag d;
  const BendPoint at{p.x, p.y, hn::Mul(p.x, p.x), hn::Mul(p.x, p.y), hn::Mul(p.y, p.y)};
  FloatVec qx = hn::Zero(d), qy = qx;
  if constexpr (kMotion) {
    const FloatVec x = hn::Sub(s.x, hn::Set(d, m.middle[0]));
    const FloatVec y = hn::Sub(s.y, hn::Set(d, m.middle[1]));
    const FloatVec q = bend_at(m.bend[field_q], at);
    qx = hn::Mul(a.sigma, hn::NegMulAdd(x, q, bend_at(m.bend[field_rx], at)));
    qy = hn::Mul(a.sigma, hn::NegMulAdd(y, q, bend_at(m.bend[field_ry], at)));
  }
  if constexpr (kLens) {
    FloatVec c = bend_at(m.bend[field_c], at);
    if constexpr (kMotion) c = hn::MulAdd(a.sigma, bend_at(m.bend[field_e], at), c);
    qx = hn::MulAdd(s.u, c, qx);
    qy = hn::MulAdd(hn::Mul(s.v, hn::Set(d, m.coc_ratio)), c, qy);
  }
  const FloatVec dx = hn::NegMulAdd(a.xy, qy, hn::Mul(a.yy, qx));
  const FloatVec dy = hn::NegMulAdd(a.yx, qx, hn::Mul(a.xx, qy));
  return {hn::NegMulAdd(a.inverse, dx, p.x), hn::NegMulAdd(a.inverse, dy, p.y)};
}

HWY_INLINE FloatMask within_extent(const RasterBounds& extent, const MappedSamples& p) {
  const FloatTag d;
  const FloatMask x =
      hn::And(hn::Ge(p.x, hn::Set(d, extent.x_min)), hn::Le(p.x, hn::Set(d, extent.x_max)));
  const FloatMask y =
      hn::And(hn::Ge(p.y, hn::Set(d, extent.y_min)), hn::Le(p.y, hn::Set(d, extent.y_max)));
  return hn::And(x, y);
}

using IntVec = hn::Vec<hn::RebindToSigned<FloatTag>>;

/// Column (or row) of positions along one axis; too large ones go to the last.
HWY_INLINE IntVec lattice_index(FloatVec position, float first, float per_pixel, int count) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  const FloatVec cells = hn::Mul(hn::Sub(position, hn::Set(d, first)), hn::Set(d, per_pixel));
  return hn::ConvertTo(di, hn::Min(cells, hn::Set(d, float(count - 1))));
}

/// Times of a tile's samples that count, in the segment's own time.
struct TimeWindow {
  float first = 0, last = 1;
};

/// What the gathering of a block's candidates works with. Held by value, so that the compiler knows
/// that no store changes it and keeps its numbers as vectors throughout the loops.
struct GatherJob {
  ShearMap map;
  CoverageFrame frame;
  BlockBounds bounds;  ///< of the block, in dual space
  SampleBox box;
  RasterBounds extent;  ///< of the block, in the space of its map
  CellLattice lattice;
  TimeWindow window;    ///< the block owns samples with first <= t <= last
  float z_nearest = 0;  ///< samples with something opaque in front of this are settled
  SampleArrays samples;
  const float* z = nullptr;  ///< depth of what the samples see so far
  uint32_t *cell = nullptr, *found = nullptr;
};

/// Appends the candidates among the samples [begin, begin + length) to the `count` that there are
/// and returns how many that makes. Most samples fall to the block's dual-space bounds, which cost
/// a few operations; what these keep, mostly candidates, is mapped.
template <bool kMotion, bool kLens>
HWY_INLINE size_t gather_run(const GatherJob& job, size_t begin, size_t length, size_t count) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  const hn::RebindToSigned<FloatTag> di;
  const CellLattice& l = job.lattice;
  for (size_t k = 0; k < length; k += hn::Lanes(d)) {
    const SampleVec s = load_samples<kMotion, kLens>(job.samples, begin + k);
    FloatMask keep = hn::Ge(hn::LoadU(d, job.z + begin + k), hn::Set(d, job.z_nearest));
    if (HWY_UNLIKELY(length - k < hn::Lanes(d))) keep = hn::And(keep, hn::FirstN(d, length - k));
    const Sheared sheared = shear<kMotion, kLens>(job.box, job.frame, job.bounds.shear, s);
    keep = hn::And(keep, inside(sheared, job.bounds.low, job.bounds.high));
    if constexpr (kMotion)
      keep = hn::And(keep, hn::And(hn::Ge(s.t, hn::Set(d, job.window.first)),
                                   hn::Le(s.t, hn::Set(d, job.window.last))));
    if (hn::AllFalse(d, keep)) continue;
    ShearSystem system;
    MappedSamples p = map_samples<kMotion, kLens>(job.map, job.frame, s, system);
    p = take_in_bend<kMotion, kLens>(job.map, s, system, p);
    keep = hn::And(keep, within_extent(job.extent, p));
    const IntVec cell_x = lattice_index(p.x, l.x_first, l.per_x, l.columns);
    const IntVec cell_y = lattice_index(p.y, l.y_first, l.per_y, l.rows);
    const auto cell = hn::Add(hn::Mul(cell_y, hn::Set(di, l.columns)), cell_x);
    const Compaction chosen(keep);
    chosen.store(hn::BitCast(du, cell), job.cell + count);
    chosen.store(hn::Iota(du, uint32_t(begin + k)), job.found + count);
    count += chosen.count();
  }
  return count;
}

/// Candidates of the block among all samples of the bucket; returns how many. Tiles whose intervals
/// are empty are skipped.
template <bool kMotion, bool kLens>
size_t gather_cells(const BlurredGridJob& blur, const GatherJob& gather) {
  const GatherJob job = gather;
  const PixelRect rect = blur.rect;
  const size_t spp = blur.test.samples_per_pixel, pixels_per_row = blur.test.pixels_per_row;
  const SampleInterval span = blur.time_span;
  size_t count = 0;
  for (int ty = rect.y0; ty < rect.y1; ty += blur.tile_size) {
    const int y_end = std::min(ty + blur.tile_size, rect.y1);
    SampleInterval row = tile_interval(gather.bounds, blur.box, 1, float(ty), float(y_end));
    row.t_min = std::max(row.t_min, span.t_min), row.t_max = std::min(row.t_max, span.t_max);
    if (row.empty()) continue;
    for (int tx = rect.x0; tx < rect.x1; tx += blur.tile_size) {
      const int x_end = std::min(tx + blur.tile_size, rect.x1);
      const SampleInterval column =
          tile_interval(gather.bounds, blur.box, 0, float(tx), float(x_end));
      if (column.empty() || column.t_min > row.t_max || row.t_min > column.t_max) continue;
      ++blur.counters->tiles_visited;
      for (int y = ty; y < y_end; ++y)
        count = gather_run<kMotion, kLens>(
            job, (size_t(y - rect.y0) * pixels_per_row + size_t(tx - rect.x0)) * spp,
            size_t(x_end - tx) * spp, count);
    }
  }
  return count;
}

/// Sorts the candidates by cell, keeping their order within one. `cell` becomes each one's rank.
template <bool kMotion, bool kLens>
void sort_cells(const SampleArrays& from, const CellLattice& lattice, CellSamples& c) {
  c.end.assign(size_t(lattice.columns) * size_t(lattice.rows) + 1, 0);
  uint32_t* const place = c.end.data() + 1;
  uint32_t* const cell = c.cell.data();
  const size_t count = c.count, cells = c.end.size() - 1;
  for (size_t k = 0; k < count; ++k) ++place[cell[k]];
  uint32_t before = 0;
  for (size_t i = 0; i < cells; ++i) {
    const uint32_t here = place[i];
    place[i] = before, before += here;
  }
  const uint32_t* const found = c.found.data();
  float *const x = c.x.data(), *const y = c.y.data(), *const t = c.t.data();
  float *const u = c.u.data(), *const v = c.v.data();
  for (size_t k = 0; k < count; ++k) {
    const uint32_t at = place[cell[k]]++, i = found[k];
    cell[k] = at;
    x[at] = from.x[i], y[at] = from.y[i];
    if constexpr (kLens) u[at] = from.u[i], v[at] = from.v[i];
    if constexpr (kMotion) t[at] = from.t[i];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
