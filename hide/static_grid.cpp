#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/static_grid.cpp"
#include <algorithm>
#include <bit>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/compaction.h"
#include "hide/depth_margin.h"
#include "hide/pixel_test.h"
#include "hide/static_grid.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Vertices on the raster, relative to the bucket. What W <= 0 makes of them is not used.
void project_vertices(const ClipGrid& clip, const PixelRect& rect, PixelBoxes& boxes) {
  const FloatTag d;
  const ClipSegment& s = clip.segments().front();
  const size_t count = size_t(clip.grid().vertex_count());
  boxes.x.resize(padded(count) + simd_padding), boxes.y.resize(padded(count) + simd_padding);
  const FloatVec x0 = hn::Set(d, float(rect.x0)), y0 = hn::Set(d, float(rect.y0));
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const FloatVec W = hn::LoadU(d, s.W + i);
    hn::StoreU(hn::Sub(hn::Div(hn::LoadU(d, s.X + i), W), x0), d, boxes.x.data() + i);
    hn::StoreU(hn::Sub(hn::Div(hn::LoadU(d, s.Y + i), W), y0), d, boxes.y.data() + i);
  }
}

struct Extremes {
  FloatVec min, max;
};

/// Over the four corners of the micropolygons whose corners a are at `p`, p + 1, ...
HWY_INLINE Extremes corner_extremes(const float* p, size_t row) {
  const FloatTag d;
  const FloatVec a = hn::LoadU(d, p), b = hn::LoadU(d, p + 1);
  const FloatVec c = hn::LoadU(d, p + row), e = hn::LoadU(d, p + row + 1);
  return {hn::Min(hn::Min(a, b), hn::Min(c, e)), hn::Max(hn::Max(a, b), hn::Max(c, e))};
}

/// First and last pixel of [0, size) that the extremes touch, packed, and who touches none; with
/// `parts` (a power of two), in as many equal parts of a pixel.
///
/// A covered sample lies between the extremes of X / W (docs/visibility.md); these are off by the
/// roundings of one division and one subtraction, and its stratum by that of its position, less
/// than the margin.
HWY_INLINE hn::Vec<hn::RebindToUnsigned<FloatTag>> pixel_range(Extremes e, float origin, int size,
                                                               int parts, FloatMask in_front,
                                                               FloatMask& outside) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  const hn::RebindToUnsigned<FloatTag> du;
  const FloatVec zero = hn::Zero(d), end = hn::Set(d, float(size * parts)),
                 last = hn::Set(d, float(size * parts - 1)), scale = hn::Set(d, float(parts));
  const FloatVec relative = hn::Set(d, 0x1p-21f), absolute = hn::Set(d, (origin + 1.0f) * 0x1p-21f);
  const FloatVec margin_min = hn::MulAdd(hn::Abs(e.min), relative, absolute);
  const FloatVec margin_max = hn::MulAdd(hn::Abs(e.max), relative, absolute);
  const FloatVec min = hn::Mul(scale, hn::Sub(e.min, margin_min));
  const FloatVec max = hn::Mul(scale, hn::Add(e.max, margin_max));
  outside = hn::And(in_front, hn::Or(hn::Lt(max, zero), hn::Ge(min, end)));
  const FloatVec first = hn::IfThenElse(in_front, hn::Min(hn::Max(min, zero), last), zero);
  const FloatVec final = hn::IfThenElse(in_front, hn::Min(hn::Max(max, zero), last), last);
  const auto lo = hn::BitCast(du, hn::ConvertTo(di, first));
  const auto hi = hn::BitCast(du, hn::ConvertTo(di, final));
  return hn::Or(lo, hn::ShiftLeft<16>(hi));
}

/// Finds the micropolygons that may touch the bucket between the clipping planes.
void find_boxes(const StaticGridJob& job) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  const ClipGrid& clip = *job.clip;
  const ClipSegment& s = clip.segments().front();
  PixelBoxes& boxes = *job.boxes;
  const size_t row = size_t(clip.u_count()) + 1, count = size_t(clip.grid().micropolygon_count());
  for (auto* a : {&boxes.index, &boxes.columns, &boxes.rows}) a->resize(count + simd_padding);
  const FloatVec near = hn::Set(d, job.test.frame.near_clip),
                 far = hn::Set(d, job.test.frame.far_clip);
  const FloatVec margin = hn::Set(d, depth_margin);
  size_t found = 0;
  for (size_t j = 0; j < size_t(clip.v_count()); ++j)
    for (size_t i = 0; i < size_t(clip.u_count()); i += hn::Lanes(d)) {
      const size_t vertex = j * row + i;
      const Extremes z = corner_extremes(s.z + vertex, row);
      const FloatMask in_front = hn::Gt(corner_extremes(s.W + vertex, row).min, hn::Zero(d));
      FloatMask x_outside, y_outside;
      const auto columns =
          pixel_range(corner_extremes(boxes.x.data() + vertex, row), std::abs(float(job.rect.x0)),
                      job.rect.width(), 1, in_front, x_outside);
      const auto rows =
          pixel_range(corner_extremes(boxes.y.data() + vertex, row), std::abs(float(job.rect.y0)),
                      job.rect.height(), job.strips_per_pixel, in_front, y_outside);
      const FloatVec z_error = hn::Mul(margin, hn::Max(hn::Abs(z.min), hn::Abs(z.max)));
      const FloatMask clipped =
          hn::Or(hn::Lt(hn::Add(z.max, z_error), near), hn::Gt(hn::Sub(z.min, z_error), far));
      const FloatMask outside = hn::Or(clipped, hn::Or(x_outside, y_outside));
      const Compaction kept(hn::AndNot(outside, hn::FirstN(d, size_t(clip.u_count()) - i)));
      kept.store(hn::Iota(du, uint32_t(j * size_t(clip.u_count()) + i)),
                 boxes.index.data() + found);
      kept.store(columns, boxes.columns.data() + found);
      kept.store(rows, boxes.rows.data() + found);
      found += kept.count();
    }
  boxes.count = found;
}

/// A corner at or behind the eye has no place on the raster. Of such a micropolygon nothing can be
/// seen in the bucket if all its corners are beyond one of the bucket's sides, a plane through the
/// eye: X < x0 W, say.
bool beyond_a_side(const Quad& q, const PixelRect& rect) {
  int left = 0, right = 0, above = 0, below = 0;
  for (int k = 0; k < 4; ++k) {
    const double X = q.X[k], Y = q.Y[k], W = q.W[k];
    const double x_error = 0x1p-20 * (std::abs(X) + std::abs(W) * (1 + std::abs(rect.x0)));
    const double y_error = 0x1p-20 * (std::abs(Y) + std::abs(W) * (1 + std::abs(rect.y0)));
    left += X + x_error<rect.x0 * W, right += X - x_error> rect.x1 * W;
    above += Y + y_error<rect.y0 * W, below += Y - y_error> rect.y1 * W;
  }
  return left == 4 || right == 4 || above == 4 || below == 4;
}

/// Tests the strips [first, last] of the pixels [x0, x1). A row of pixels all of whose strips are
/// wanted is one run of samples; else each pixel has its own.
template <bool kOpaque>
HWY_INLINE void test_strips(const StaticGridJob& job, const Quad& quad, uint32_t id, int x0, int x1,
                            int first, int last, CoverageCounts& counts) {
  const size_t spp = job.test.samples_per_pixel, strips = size_t(job.strips_per_pixel);
  const size_t per_strip = spp / strips;
  for (int strip = first; strip <= last;) {
    const size_t y = size_t(strip) / strips, begin = size_t(strip) % strips;
    const size_t end = std::min(strips, size_t(last) + 1 - y * strips);
    const size_t sample = (y * job.test.pixels_per_row + size_t(x0)) * spp + begin * per_strip;
    strip += int(end - begin);
    if (end - begin == strips) {
      test_run<false, false, kOpaque>(job.test, quad, id, sample, size_t(x1 - x0) * spp, counts);
      continue;
    }
    for (size_t x = 0; x < size_t(x1 - x0); ++x)
      test_run<false, false, kOpaque>(job.test, quad, id, sample + x * spp,
                                      (end - begin) * per_strip, counts);
  }
}

/// Adds the strips [first, last] of the pixels [x0, x1) to the tests of each pixel.
void count_strips(const StaticGridJob& job, int x0, int x1, int first, int last) {
  const size_t strips = size_t(job.strips_per_pixel);
  const uint32_t per_strip = uint32_t(job.test.samples_per_pixel / strips);
  for (size_t strip = size_t(first); strip <= size_t(last); ++strip)
    for (size_t x = size_t(x0); x < size_t(x1); ++x)
      job.test.tests_per_pixel[strip / strips * job.test.pixels_per_row + x] += per_strip;
}

template <bool kOpaque>
uint64_t test_boxes(const StaticGridJob& job) {
  const ClipGrid& clip = *job.clip;
  const ClipSegment& segment = clip.segments().front();
  const PixelBoxes& boxes = *job.boxes;
  const bool cull = job.depth->useful();
  const int strips = job.strips_per_pixel;
  const size_t per_strip = job.test.samples_per_pixel / size_t(strips);
  CoverageCounts counts;
  uint64_t tested = 0, micropolygons = 0;
  for (size_t n = 0; n < boxes.count; ++n) {
    const int m = int(boxes.index[n]), j = m / clip.u_count(), i = m - j * clip.u_count();
    const Quad quad = load_quad(segment, clip.u_count(), i, j);
    const int x0 = int(boxes.columns[n] & 0xffff), x1 = int(boxes.columns[n] >> 16) + 1;
    const int first = int(boxes.rows[n] & 0xffff), last = int(boxes.rows[n] >> 16);
    const float w_min = std::min(std::min(quad.W[0], quad.W[1]), std::min(quad.W[2], quad.W[3]));
    if (clip.dropped(m) || (w_min <= 0 && beyond_a_side(quad, job.rect)) ||
        (cull &&
         nearest_depth(quad.z) > job.depth->farthest({x0, first / strips, x1, last / strips + 1})))
      continue;
    ++micropolygons;
    tested += size_t(x1 - x0) * size_t(last - first + 1) * per_strip;
    if (!job.test.tests_per_pixel.empty()) count_strips(job, x0, x1, first, last);
    test_strips<kOpaque>(job, quad, job.id0 + 2 * uint32_t(m), x0, x1, first, last, counts);
  }
  job.counters->samples_tested += tested;
  job.counters->samples_covered += counts.covered;
  job.counters->nonfinite_dropped += counts.nonfinite;
  return micropolygons;
}

/// As many strips as a pixel has vectors, if the samples of each lie in one.
int strips_of(const StaticGridJob& job) {
  const size_t lanes = hn::Lanes(FloatTag()), spp = job.test.samples_per_pixel;
  if (!job.y_stratified || spp <= lanes) return 1;
  // Rows of strips are packed into 16 bits.
  const size_t most = std::bit_floor(size_t(0xffff) / size_t(job.rect.height()));
  return int(std::clamp<size_t>(spp / lanes, 1, std::max<size_t>(most, 1)));
}

uint64_t hide_static(StaticGridJob job) {
  job.strips_per_pixel = strips_of(job);
  project_vertices(*job.clip, job.rect, *job.boxes);
  find_boxes(job);
  return job.test.opaque ? test_boxes<true>(job) : test_boxes<false>(job);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(hide_static);

uint64_t hide_static_grid(const StaticGridJob& job) {
  return HWY_DYNAMIC_DISPATCH(hide_static)(job);
}

}  // namespace tessera
#endif
