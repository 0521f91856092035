#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/tuple_grid.cpp"
#include <algorithm>
#include <cmath>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/compaction.h"
#include "hide/depth_margin.h"
#include "hide/hit_sinks.h"
#include "hide/tile_depth.h"
#include "hide/tuple_grid.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// The vertices at the tuple's time and lens position, and where they are on the raster. These are
/// the operations of see() in hide/coverage.h, one by one: seen by the sample test as a static
/// micropolygon without a lens, the moved vertices give the very bits that the unmoved ones give to
/// samples with this u, v and t. A vertex is moved once a tuple rather than once a sample.
template <bool kMotion, bool kLens>
void move_vertices(const TupleGridJob& job, const TupleSamples::Point& p) {
  const FloatTag d;
  const ClipSegment& s = *job.segment;
  const CoverageFrame& f = job.frame;
  TupleGridScratch& to = *job.scratch;
  const PixelRect& rect = job.samples->rect();
  const FloatVec tau =
      hn::Mul(hn::Sub(hn::Set(d, p.t), hn::Set(d, f.t_begin)), hn::Set(d, f.inverse_duration));
  const FloatVec x0 = hn::Set(d, float(rect.x0)), y0 = hn::Set(d, float(rect.y0));
  // Beyond any raster, and finite: margins are added to it.
  const FloatVec beyond = hn::Set(d, 0x1p30f);
  const auto at_time = [&](const float* start, const float* delta, size_t i) HWY_ATTR {
    if constexpr (kMotion) return hn::MulAdd(tau, hn::LoadU(d, delta + i), hn::LoadU(d, start + i));
    (void)delta;
    return hn::LoadU(d, start + i);
  };
  const auto on_raster = [&](FloatVec X, FloatVec W, FloatVec origin) HWY_ATTR {
    return hn::Max(hn::Min(hn::Sub(hn::Div(X, W), origin), beyond), hn::Neg(beyond));
  };
  const size_t count = size_t(job.clip->grid().vertex_count());
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    FloatVec X = at_time(s.X, s.dX, i), Y = at_time(s.Y, s.dY, i);
    const FloatVec W = at_time(s.W, s.dW, i), z = at_time(s.z, s.dz, i);
    if constexpr (kLens) {
      X = hn::MulAdd(hn::Set(d, p.u),
                     hn::MulAdd(hn::Set(d, f.coc_x.scale), z, hn::Set(d, f.coc_x.offset)), X);
      Y = hn::MulAdd(hn::Set(d, p.v),
                     hn::MulAdd(hn::Set(d, f.coc_y.scale), z, hn::Set(d, f.coc_y.offset)), Y);
    }
    hn::StoreU(X, d, to.X.data() + i), hn::StoreU(Y, d, to.Y.data() + i);
    hn::StoreU(W, d, to.W.data() + i), hn::StoreU(z, d, to.z.data() + i);
    // What W <= 0 makes of these is not used.
    hn::StoreU(on_raster(X, W, x0), d, to.x.data() + i);
    hn::StoreU(on_raster(Y, W, y0), d, to.y.data() + i);
  }
}

struct CornerRange {
  FloatVec min, max;
};

/// Over the four corners of the micropolygons whose corners a are at `p`, p + 1, ...
HWY_INLINE CornerRange corner_range(const float* p, size_t row) {
  const FloatTag d;
  const FloatVec a = hn::LoadU(d, p), b = hn::LoadU(d, p + 1);
  const FloatVec c = hn::LoadU(d, p + row), e = hn::LoadU(d, p + row + 1);
  return {hn::Min(hn::Min(a, b), hn::Min(c, e)), hn::Max(hn::Max(a, b), hn::Max(c, e))};
}

/// First and last pixel of [0, size) in the range, packed, and who has none. Everything for who is
/// not in front of the eye.
///
/// The signs of the sample test are exact for the moved vertices, so a covered sample lies between
/// the extremes of X / W. Those are off by the roundings of a division and a subtraction, and where
/// the test cannot fuse x W - X by that of a product: at most 3 * 2^-24 of the position.
HWY_INLINE hn::Vec<hn::RebindToUnsigned<FloatTag>> pixels_of(CornerRange e, float origin, int size,
                                                             FloatMask in_front,
                                                             FloatMask& outside) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  const hn::RebindToUnsigned<FloatTag> du;
  const FloatVec zero = hn::Zero(d), last = hn::Set(d, float(size - 1));
  const FloatVec relative = hn::Set(d, 0x1p-21f);
  const FloatVec absolute = hn::Set(d, (std::abs(origin) + 1.0f) * 0x1p-21f);
  const FloatVec min = hn::Sub(e.min, hn::MulAdd(hn::Abs(e.min), relative, absolute));
  const FloatVec max = hn::Add(e.max, hn::MulAdd(hn::Abs(e.max), relative, absolute));
  outside = hn::And(in_front, hn::Or(hn::Lt(max, zero), hn::Ge(min, hn::Set(d, float(size)))));
  const FloatVec first = hn::IfThenElse(in_front, hn::Min(hn::Max(min, zero), last), zero);
  const FloatVec final = hn::IfThenElse(in_front, hn::Min(hn::Max(max, zero), last), last);
  const auto lo = hn::BitCast(du, hn::ConvertTo(di, first));
  const auto hi = hn::BitCast(du, hn::ConvertTo(di, final));
  return hn::Or(lo, hn::ShiftLeft<16>(hi));
}

/// Finds the micropolygons that may touch the bucket between the clipping planes, a row of them at
/// a time.
void find_tuple_boxes(const TupleGridJob& job) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  TupleGridScratch& s = *job.scratch;
  const PixelRect& rect = job.samples->rect();
  const size_t columns = size_t(job.clip->u_count()), row = columns + 1;
  const FloatVec near = hn::Set(d, job.frame.near_clip), far = hn::Set(d, job.frame.far_clip);
  const FloatVec margin = hn::Set(d, depth_margin);
  size_t found = 0;
  for (size_t j = 0; j < size_t(job.clip->v_count()); ++j)
    for (size_t i = 0; i < columns; i += hn::Lanes(d)) {
      const size_t vertex = j * row + i;
      const CornerRange z = corner_range(s.z.data() + vertex, row);
      const FloatMask in_front = hn::Gt(corner_range(s.W.data() + vertex, row).min, hn::Zero(d));
      FloatMask x_outside, y_outside;
      const auto x_pixels = pixels_of(corner_range(s.x.data() + vertex, row), float(rect.x0),
                                      rect.width(), in_front, x_outside);
      const auto y_pixels = pixels_of(corner_range(s.y.data() + vertex, row), float(rect.y0),
                                      rect.height(), in_front, y_outside);
      const FloatVec z_error = hn::Mul(margin, hn::Max(hn::Abs(z.min), hn::Abs(z.max)));
      const FloatVec nearest = hn::Sub(z.min, z_error);
      const FloatMask clipped = hn::Or(hn::Lt(hn::Add(z.max, z_error), near), hn::Gt(nearest, far));
      const FloatMask outside = hn::Or(clipped, hn::Or(x_outside, y_outside));
      const Compaction kept(hn::AndNot(outside, hn::FirstN(d, columns - i)));
      kept.store(hn::Iota(du, uint32_t(j * columns + i)), s.index.data() + found);
      kept.store(x_pixels, s.columns.data() + found);
      kept.store(y_pixels, s.rows.data() + found);
      kept.store(nearest, s.nearest.data() + found);
      found += kept.count();
    }
  s.count = found;
}

/// A micropolygon at the tuple, for the test without motion and lens.
HWY_INLINE Quad moved_quad(const TupleGridJob& job, int micropolygon) {
  ClipSegment moved;
  const TupleGridScratch& s = *job.scratch;
  moved.X = s.X.data(), moved.Y = s.Y.data(), moved.W = s.W.data(), moved.z = s.z.data();
  const int columns = job.clip->u_count();
  return load_quad(moved, columns, micropolygon % columns, micropolygon / columns);
}

/// Whether a micropolygon with corners behind the eye, which has no box on the raster, is beyond
/// one of the planes through the eye and a side of the bucket, so that its part before the eye is
/// too.
bool misses_bucket(const Quad& q, const PixelRect& rect) {
  const auto all_beyond = [&](const float(&P)[4], double side, double sign) {
    for (int k = 0; k < 4; ++k) {
      const double error =
          0x1p-20 * (std::abs(double(P[k])) + std::abs(double(q.W[k])) * (1 + std::abs(side)));
      if (!(sign * (double(P[k]) - side * double(q.W[k])) > error)) return false;
    }
    return true;
  };
  return all_beyond(q.X, rect.x0, -1) || all_beyond(q.X, rect.x1, 1) ||
         all_beyond(q.Y, rect.y0, -1) || all_beyond(q.Y, rect.y1, 1);
}

/// Tests the samples at [begin, end) of the tuple's against one micropolygon.
template <bool kOpaque>
HWY_INLINE void test_run(const TupleGridJob& job, const Quad& quad, uint32_t id0, size_t begin,
                         size_t end, CoverageCounts& counts) {
  const FloatTag d;
  for (size_t i = begin; i < end; i += hn::Lanes(d)) {
    SampleVec s;
    s.x = hn::LoadU(d, job.samples->x() + i), s.y = hn::LoadU(d, job.samples->y() + i);
    s.u = s.v = s.t = hn::Zero(d);
    test_vector<false, false>(job.frame, quad, s, end - i, counts, [&](const Hit& hit) HWY_ATTR {
      if constexpr (kOpaque) {
        store_opaque(hit, i, id0, *job.opaque_hits);
      } else {
        for_each_hit(hit, [&](size_t lane, float z, float b1, float b2, uint32_t triangle) {
          if (z > job.opaque_hits->z()[i + lane]) return;
          job.fragments->add(job.samples->source()[i + lane], z, b1, b2, id0 + triangle);
        });
      }
    });
  }
}

/// The cells of samples that a box of pixels touches: the box snapped outwards to whole cells.
HWY_INLINE PixelRect cells_of_box(const TupleSamples& samples, uint32_t columns, uint32_t rows) {
  const int shift = samples.cell_shift(), mask = (1 << shift) - 1;
  const int x = samples.rect().x0 & mask, y = samples.rect().y0 & mask;
  return {(int(columns & 0xffff) + x) >> shift, (int(rows & 0xffff) + y) >> shift,
          ((int(columns >> 16) + x) >> shift) + 1, ((int(rows >> 16) + y) >> shift) + 1};
}

void count_pixel_tests(const TupleGridJob& job, size_t tuple, const PixelRect& cells) {
  for (int row = cells.y0; row < cells.y1; ++row) {
    const size_t end = job.samples->begin(tuple, row, cells.x1);
    for (size_t i = job.samples->begin(tuple, row, cells.x0); i < end; ++i)
      ++job.pixel_tests[job.samples->source()[i] / job.samples_per_pixel];
  }
}

template <bool kOpaque>
void test_tuple_boxes(const TupleGridJob& job, size_t tuple) {
  const TupleSamples& samples = *job.samples;
  const TupleGridScratch& s = *job.scratch;
  CoverageCounts counts;
  for (size_t n = 0; n < s.count; ++n) {
    const int m = int(s.index[n]);
    if (s.nearest[n] > job.farthest[tuple] || job.clip->dropped(m)) continue;
    const Quad quad = moved_quad(job, m);
    const float w_min = std::min(std::min(quad.W[0], quad.W[1]), std::min(quad.W[2], quad.W[3]));
    if (w_min <= 0 && misses_bucket(quad, samples.rect())) continue;
    const PixelRect cells = cells_of_box(samples, s.columns[n], s.rows[n]);
    const uint32_t id0 = job.id0 + 2 * uint32_t(m);
    size_t tested = 0;
    for (int row = cells.y0; row < cells.y1; ++row) {
      const size_t begin = samples.begin(tuple, row, cells.x0);
      const size_t end = samples.begin(tuple, row, cells.x1);
      test_run<kOpaque>(job, quad, id0, begin, end, counts);
      tested += end - begin;
    }
    job.met[size_t(m)] |= tested > 0;
    job.counters->samples_tested += tested;
    job.counters->tiles_visited += uint64_t(cells.pixel_count());
    if (!job.pixel_tests.empty()) count_pixel_tests(job, tuple, cells);
  }
  job.counters->samples_covered += counts.covered;
  job.counters->nonfinite_dropped += counts.nonfinite;
  if (!kOpaque || counts.covered == 0) return;
  const size_t begin = samples.tuple_begin(tuple);
  job.farthest[tuple] =
      farthest_depth(job.opaque_hits->z() + begin, samples.tuple_begin(tuple + 1) - begin);
}

void resize_scratch(const TupleGridJob& job) {
  TupleGridScratch& s = *job.scratch;
  const size_t vertices = padded(size_t(job.clip->grid().vertex_count())) + simd_padding;
  // Corners are read a row and a vector past the last vertex.
  for (auto* a : {&s.X, &s.Y, &s.W, &s.z, &s.x, &s.y})
    if (a->size() < vertices) a->resize(vertices);
  const size_t boxes = size_t(job.clip->grid().micropolygon_count()) + simd_padding;
  for (auto* a : {&s.index, &s.columns, &s.rows})
    if (a->size() < boxes) a->resize(boxes);
  if (s.nearest.size() < boxes) s.nearest.resize(boxes);
}

template <bool kMotion, bool kLens>
void hide_tuples(const TupleGridJob& job) {
  resize_scratch(job);
  bool moved = false;
  for (size_t tuple = 0; tuple < job.samples->tuple_count(); ++tuple) {
    const TupleSamples::Point& point = job.samples->point(tuple);
    if (job.samples->tuple_begin(tuple) == job.samples->tuple_begin(tuple + 1)) continue;
    if (kMotion && !(point.t >= job.frame.t_begin && point.t <= job.frame.t_last)) continue;
    // A grid that neither moves nor is seen through a lens is the same at all tuples.
    if (kMotion || kLens || !moved) {
      move_vertices<kMotion, kLens>(job, point);
      find_tuple_boxes(job);
      moved = true;
    }
    job.opaque ? test_tuple_boxes<true>(job, tuple) : test_tuple_boxes<false>(job, tuple);
  }
}

void hide_any(const TupleGridJob& job) {
  if (job.motion)
    job.lens ? hide_tuples<true, true>(job) : hide_tuples<true, false>(job);
  else
    job.lens ? hide_tuples<false, true>(job) : hide_tuples<false, false>(job);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(hide_any);

void hide_tuple_grid(const TupleGridJob& job) { HWY_DYNAMIC_DISPATCH(hide_any)(job); }

}  // namespace tessera
#endif
