#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/sheared_grid.cpp"
#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/block_bounds.h"
#include "hide/gather_cells.h"
#include "hide/shear_block.h"
#include "hide/sheared_grid.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Cells of micropolygons [0, count) of a row: first and last column, first and last row.
struct CellBoxes {
  int32_t *column0, *column1, *row0, *row1;
};

void find_cell_boxes(const ShearedBlock& b, const CellLattice& l, int row, size_t count,
                     const CellBoxes& boxes) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  const size_t first = size_t(row) * b.stride;
  for (size_t k = 0; k < count; k += hn::Lanes(d)) {
    const auto column = [&](const AlignedVector<float>& x) HWY_ATTR {
      return lattice_index(hn::LoadU(d, x.data() + first + k), l.x_first, l.per_x, l.columns);
    };
    const auto line = [&](const AlignedVector<float>& y) HWY_ATTR {
      return lattice_index(hn::LoadU(d, y.data() + first + k), l.y_first, l.per_y, l.rows);
    };
    hn::StoreU(column(b.boxes[0]), di, boxes.column0 + k);
    hn::StoreU(column(b.boxes[1]), di, boxes.column1 + k);
    hn::StoreU(line(b.boxes[2]), di, boxes.row0 + k);
    hn::StoreU(line(b.boxes[3]), di, boxes.row1 + k);
  }
}

/// The sorted candidates and their hits, by value: hide/gather_cells.h says why.
struct SortedSamples {
  SampleArrays samples;
  float *z, *b1, *b2;
  uint32_t* id;
  const uint32_t* index;

  explicit SortedSamples(CellSamples& c)
      : samples(c.samples()),
        z(c.z.data()),
        b1(c.b1.data()),
        b2(c.b2.data()),
        id(c.id.data()),
        index(c.index.data()) {}
};

/// Opaque hits on sorted candidates. Within a block micropolygons come in order of their ids, so on
/// equal depth what is there stays.
HWY_INLINE void store_sorted(const Hit& hit, size_t k, uint32_t id0, const SortedSamples& c) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  const FloatVec z = hn::LoadU(d, c.z + k);
  const FloatMask nearer = hn::And(hit.mask, hn::Lt(hit.z, z));
  if (hn::AllFalse(d, nearer)) return;
  const auto blend = [&](FloatVec value, float* to) HWY_ATTR {
    hn::StoreU(hn::IfThenElse(nearer, value, hn::LoadU(d, to)), d, to);
  };
  hn::StoreU(hn::IfThenElse(nearer, hit.z, z), d, c.z + k);
  blend(hit.b1, c.b1 + k);
  blend(hit.b2, c.b2 + k);
  const auto one = hn::IfThenElseZero(hn::RebindMask(du, hit.triangle1), hn::Set(du, 1u));
  const auto id = hn::Add(hn::Set(du, id0), one);
  hn::StoreU(hn::IfThenElse(hn::RebindMask(du, nearer), id, hn::LoadU(du, c.id + k)), du, c.id + k);
}

/// Tests the sorted candidates [begin, end) against one micropolygon.
template <bool kMotion, bool kLens, bool kOpaque>
HWY_INLINE void test_sorted(const CoverageFrame& frame, const Quad& quad, uint32_t id, size_t begin,
                            size_t end, const SortedSamples& c, FragmentBuffer& buffer,
                            CoverageCounts& counts) {
  for (size_t k = begin; k < end; k += hn::Lanes(FloatTag())) {
    const SampleVec s = load_samples<kMotion, kLens>(c.samples, k);
    test_vector<kMotion, kLens>(frame, quad, s, end - k, counts, [&](const Hit& hit) HWY_ATTR {
      if constexpr (kOpaque) {
        store_sorted(hit, k, id, c);
      } else {
        for_each_hit(hit, [&](size_t lane, float z, float b1, float b2, uint32_t triangle) {
          buffer.add(c.index[k + lane], z, b1, b2, id + triangle);
        });
      }
    });
  }
}

/// Adds the sorted candidates [begin, end) to the tests of their pixels.
void count_sorted(const PixelTestJob& test, const CellSamples& c, size_t begin, size_t end) {
  for (size_t k = begin; k < end; ++k) ++test.tests_per_pixel[c.index[k] / test.samples_per_pixel];
}

/// Tests every micropolygon of the block against the candidates in its cells. Returns how many had
/// any.
template <bool kMotion, bool kLens, bool kOpaque>
uint64_t test_cells(const ShearedGridJob& job, const ShearedBlock& sheared,
                    const CellLattice& lattice, const GridBlock& block) {
  const BlurredGridJob& blur = job.blur;
  CellSamples& c = job.scratch->cells;
  const SortedSamples sorted(c);
  const CoverageFrame frame = blur.test.frame;
  const int u_count = blur.clip->u_count();
  const size_t stride = padded(size_t(block.i1 - block.i0)) + simd_padding;
  std::vector<int32_t>& storage = job.scratch->boxes;
  if (storage.size() < 4 * stride) storage.resize(4 * stride);
  const CellBoxes boxes{storage.data(), storage.data() + stride, storage.data() + 2 * stride,
                        storage.data() + 3 * stride};
  const uint32_t* end = c.end.data();
  const bool counting = !blur.test.tests_per_pixel.empty();
  CoverageCounts counts;
  uint64_t tested = 0, micropolygons = 0;
  for (int j = block.j0; j < block.j1; ++j) {
    find_cell_boxes(sheared, lattice, j - block.j0, size_t(block.i1 - block.i0), boxes);
    for (int i = block.i0; i < block.i1; ++i) {
      const int m = j * u_count + i, k = i - block.i0;
      size_t found = 0;
      for (int row = boxes.row0[k]; row <= boxes.row1[k]; ++row) {
        const uint32_t* cells = end + row * lattice.columns;
        found += cells[boxes.column1[k] + 1] - cells[boxes.column0[k]];
      }
      if (found == 0 || blur.clip->dropped(m)) continue;
      tested += found, ++micropolygons;
      const Quad quad = load_quad(*blur.segment, u_count, i, j);
      for (int row = boxes.row0[k]; row <= boxes.row1[k]; ++row) {
        const uint32_t* cells = end + row * lattice.columns;
        const size_t first = cells[boxes.column0[k]], last = cells[boxes.column1[k] + 1];
        test_sorted<kMotion, kLens, kOpaque>(frame, quad, blur.id0 + 2 * uint32_t(m), first, last,
                                             sorted, *blur.test.buffer, counts);
        if (HWY_UNLIKELY(counting)) count_sorted(blur.test, c, first, last);
      }
    }
  }
  blur.counters->samples_tested += tested;
  blur.counters->samples_covered += counts.covered;
  blur.counters->nonfinite_dropped += counts.nonfinite;
  return micropolygons;
}

/// No hits yet. What the bucket already knows is asked on return: few candidates lie behind it.
void begin_hits(CellSamples& c) {
  std::fill_n(c.z.data(), c.count, std::numeric_limits<float>::infinity());
  std::fill_n(c.id.data(), c.count, CellSamples::no_hit);
}

/// Index in the bucket of the sorted candidates, for hits that go there at once.
void index_sorted(CellSamples& c) {
  for (size_t n = 0; n < c.count; ++n) c.index[c.cell[n]] = c.found[n];
}

/// In the order in which the candidates were found, which is that of the bucket's memory.
void return_hits(const CellSamples& c, FragmentBuffer& buffer) {
  for (size_t n = 0; n < c.count; ++n) {
    const uint32_t k = c.cell[n];
    if (c.id[k] != CellSamples::no_hit) buffer.put(c.found[n], c.z[k], c.b1[k], c.b2[k], c.id[k]);
  }
}

/// Cells an eighth of a micropolygon wide, and as high as it takes for a micropolygon to find a few
/// vectors of samples in each row of cells: high cells cost tests, low ones half-filled vectors.
/// Not so many that most stay empty.
CellLattice make_lattice(const ShearedBlock& b, const GridBlock& block, size_t samples_per_pixel) {
  CellLattice l;
  l.x_first = b.extent.x_min, l.y_first = b.extent.y_min;
  const float width = b.extent.x_max - b.extent.x_min, height = b.extent.y_max - b.extent.y_min;
  const float micropolygons = float(block.i1 - block.i0) * float(block.j1 - block.j0);
  const float size = std::sqrt(width * height / micropolygons);
  const float spacing = 1.0f / std::sqrt(float(samples_per_pixel));
  const float x_cell = std::max(0.125f * size, 0.5f * spacing);
  const float samples_per_height = 1.4f * size * float(samples_per_pixel);
  const float y_cell = std::max(
      0.125f * size, std::min(24.0f / samples_per_height, std::max(0.75f * size, 2.0f * spacing)));
  const auto count = [](float length, float cell) {
    return int(std::clamp(std::ceil(length / cell), 1.0f, 256.0f));
  };
  l.columns = count(width, x_cell), l.rows = count(height, y_cell);
  l.per_x = width > 0 ? float(l.columns) / width : 1.0f;
  l.per_y = height > 0 ? float(l.rows) / height : 1.0f;
  return l;
}

/// The way of a grid through its blocks and pieces of time.
template <bool kMotion, bool kLens>
class ShearedVisit {
 public:
  explicit ShearedVisit(const ShearedGridJob& job) : job_(job), blur_(job.blur) {}

  uint64_t visit(const GridBlock& block, const TimePiece& piece, size_t depth) {
    std::vector<ShearedBlock>& blocks = job_.scratch->blocks;
    if (blocks.size() <= depth) blocks.resize(depth + 1);
    ShearedBlock& sheared = blocks[depth];
    const Fit fit = try_fit(block, piece, sheared);
    if (fit == Fit::good) return hide(block, piece, sheared);
    if (fit == Fit::turning && kMotion && piece.end - piece.begin > 0.15f) {
      const float middle = 0.5f * (piece.begin + piece.end);
      return visit(block, {piece.begin, middle}, depth + 1) +
             visit(block, {middle, piece.end}, depth + 1);
    }
    if (std::max(block.i1 - block.i0, block.j1 - block.j0) <= 8)
      return hide_blurred_block(blur_in(piece), block);
    uint64_t micropolygons = 0;
    const int i_middle = (block.i0 + block.i1 + 1) / 2, j_middle = (block.j0 + block.j1 + 1) / 2;
    for (int child = 0; child < 4; ++child) {
      const GridBlock part{child & 1 ? i_middle : block.i0, child & 2 ? j_middle : block.j0,
                           child & 1 ? block.i1 : i_middle, child & 2 ? block.j1 : j_middle};
      if (part.i0 < part.i1 && part.j0 < part.j1) micropolygons += visit(part, piece, depth + 1);
    }
    return micropolygons;
  }

 private:
  enum class Fit { good, slack, turning };

  Fit try_fit(const GridBlock& block, const TimePiece& piece, ShearedBlock& sheared) const {
    const int u_count = blur_.clip->u_count();
    ShearPass pass;
    pass.segment = blur_.segment, pass.frame = &blur_.test.frame;
    if (!fit_shear(*blur_.segment, u_count, blur_.test.frame, blur_.box, block, piece, pass.map))
      return Fit::turning;
    for (int axis = 0; axis < 2; ++axis) {
      pass.reach[axis] =
          std::abs(blur_.box.middle[axis] - pass.map.middle[axis]) + blur_.box.half[axis];
      pass.raster_reach[axis] = std::abs(blur_.box.middle[axis]) + blur_.box.half[axis];
    }
    pass.lens = blur_.box.lens, pass.lens_y = blur_.box.lens * std::abs(pass.map.coc_ratio);
    pass.gain = shear_gain(pass.map, blur_.box.lens, pass.reach);
    if (!pass.gain.usable) return Fit::turning;
    if (!shear_block<kMotion, kLens>(pass, u_count, block, sheared)) return Fit::turning;
    const float area = (sheared.extent.x_max - sheared.extent.x_min) *
                       (sheared.extent.y_max - sheared.extent.y_min);
    const float size = std::sqrt(area / (float(block.i1 - block.i0) * float(block.j1 - block.j0)));
    // Slack costs tests, smaller blocks repeat the gathering. Three times as much slack would be a
    // fifth faster on small curved surfaces, for a fifth more tests than they take at rest.
    return sheared.slack <= 0.4f + 0.25f * size ? Fit::good : Fit::slack;
  }

  TimeWindow window(const TimePiece& piece) const {
    const CoverageFrame& f = blur_.test.frame;
    const float duration = 1.0f / f.inverse_duration;
    const auto at = [&](float tau) { return f.t_begin + tau * duration; };
    return {piece.begin > 0 ? at(piece.begin) : f.t_begin,
            piece.end < 1 ? std::nextafter(at(piece.end), -1.0f) : f.t_last};
  }

  BlurredGridJob blur_in(const TimePiece& piece) const {
    BlurredGridJob job = blur_;
    const TimeWindow w = window(piece);
    job.t_first = w.first, job.t_last = w.last;
    return job;
  }

  uint64_t hide(const GridBlock& block, const TimePiece& piece, const ShearedBlock& sheared) {
    CellSamples& cells = job_.scratch->cells;
    const CellLattice lattice = make_lattice(sheared, block, blur_.test.samples_per_pixel);
    const BlockBounds bounds = bound_vertices<kMotion, kLens>(*blur_.segment, blur_.clip->u_count(),
                                                              blur_.test.frame, blur_.box, block);
    cells.reserve(size_t(blur_.rect.pixel_count()) * blur_.test.samples_per_pixel);
    GatherJob gather;
    gather.map = sheared.map, gather.frame = blur_.test.frame, gather.bounds = bounds;
    gather.box = blur_.box, gather.extent = sheared.extent, gather.lattice = lattice;
    gather.window = window(piece), gather.z_nearest = blur_.z_nearest;
    gather.samples = blur_.test.samples, gather.z = blur_.test.buffer->z();
    gather.cell = cells.cell.data(), gather.found = cells.found.data();
    cells.count = gather_cells<kMotion, kLens>(blur_, gather);
    if (cells.count == 0) return 0;
    sort_cells<kMotion, kLens>(blur_.test.samples, lattice, cells);
    if (!blur_.test.opaque || !blur_.test.tests_per_pixel.empty()) index_sorted(cells);
    if (!blur_.test.opaque) {
      return test_cells<kMotion, kLens, false>(job_, sheared, lattice, block);
    }
    begin_hits(cells);
    const uint64_t tested = test_cells<kMotion, kLens, true>(job_, sheared, lattice, block);
    return_hits(cells, *blur_.test.buffer);
    return tested;
  }

  const ShearedGridJob& job_;
  const BlurredGridJob& blur_;
};

uint64_t hide_sheared(const ShearedGridJob& job) {
  const GridBlock whole{0, 0, job.blur.clip->u_count(), job.blur.clip->v_count()};
  const TimePiece shutter;
  if (!job.blur.test.motion) return ShearedVisit<false, true>(job).visit(whole, shutter, 0);
  return job.blur.test.lens ? ShearedVisit<true, true>(job).visit(whole, shutter, 0)
                            : ShearedVisit<true, false>(job).visit(whole, shutter, 0);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(hide_sheared);

uint64_t hide_sheared_grid(const ShearedGridJob& job) {
  return HWY_DYNAMIC_DISPATCH(hide_sheared)(job);
}

void ShearedBlock::begin(int u_count, const GridBlock& block) {
  const auto grow = [](AlignedVector<float>& a, size_t wanted) {
    if (a.size() < wanted) a.resize(wanted);
  };
  const size_t vertices = (size_t(u_count) + 1) * (size_t(block.j1) + 1);
  for (auto* a : {&x_low, &x_high, &y_low, &y_high}) grow(*a, vertices + 2 * simd_padding);
  stride = padded(size_t(block.i1 - block.i0));
  for (auto& a : boxes) grow(a, stride * size_t(block.j1 - block.j0) + simd_padding);
}

void CellSamples::reserve(size_t capacity) {
  const size_t wanted = capacity + simd_padding;
  const auto grow = [&](auto& a) {
    if (a.size() < wanted) a.resize(wanted);
  };
  for (auto* a : {&x, &y, &u, &v, &t, &z, &b1, &b2}) grow(*a);
  for (auto* a : {&index, &id}) grow(*a);
  for (auto* a : {&cell, &found}) grow(*a);
}

}  // namespace tessera
#endif
