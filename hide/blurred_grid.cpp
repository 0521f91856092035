#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/blurred_grid.cpp"
#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/block_bounds.h"
#include "hide/blurred_grid.h"
#include "hide/candidates.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Tallies of a grid.
struct BlurCounts {
  CoverageCounts coverage;
  uint64_t micropolygons = 0;
};

/// Tests one micropolygon against its candidates. Hits are written one by one, wherever their
/// samples lie, so whether they are opaque is asked only there.
template <bool kMotion, bool kLens>
void test_candidates(const BlurredGridJob& job, int i, int j, const CandidateList& list,
                     CoverageCounts& counts) {
  const int m = j * job.clip->u_count() + i;
  if (job.clip->dropped(m)) return;
  const Quad quad = load_quad(*job.segment, job.clip->u_count(), i, j);
  const uint32_t id = job.id0 + 2 * uint32_t(m);
  FragmentBuffer& buffer = *job.test.buffer;
  const SampleArrays samples = list.samples();
  job.counters->samples_tested += list.count;
  if (!job.test.tests_per_pixel.empty())
    for (size_t k = 0; k < list.count; ++k)
      ++job.test.tests_per_pixel[list.index[k] / job.test.samples_per_pixel];
  for (size_t k = 0; k < list.count; k += hn::Lanes(FloatTag())) {
    const SampleVec s = load_samples<kMotion, kLens>(samples, k);
    test_vector<kMotion, kLens>(
        job.test.frame, quad, s, list.count - k, counts, [&](const Hit& hit) HWY_ATTR {
          for_each_hit(hit, [&](size_t lane, float z, float b1, float b2, uint32_t triangle) {
            const size_t sample = list.index[k + lane];
            if (job.test.opaque)
              buffer.put(sample, z, b1, b2, id + triangle);
            else
              buffer.add(sample, z, b1, b2, id + triangle);
          });
        });
  }
}

/// Ranges of the vertices of a patch in its shear, [axis][row][column].
struct PatchRanges {
  static constexpr int row_size = 16;  // a whole vector from any vertex that is used
  float low[2][patch_size + 1][row_size], high[2][patch_size + 1][row_size];
};

template <bool kMotion, bool kLens>
BlockBounds bound_patch(const BlurredGridJob& job, const GridBlock& block, PatchRanges& ranges) {
  const FloatTag d;
  const ClipSegment& s = *job.segment;
  const size_t row = size_t(job.clip->u_count()) + 1;
  BlockBounds bounds;
  bounds.shear = shear_frame(s, job.clip->u_count(), job.test.frame, job.box, block);
  for (int axis = 0; axis < 2; ++axis) {
    const AxisJob a = axis_job(s, job.test.frame, job.box, bounds.shear, axis);
    float low = hwy::HighestValue<float>(), high = -low;
    for (int j = block.j0; j <= block.j1; ++j) {
      const size_t first = size_t(j) * row + size_t(block.i0);
      float *lows = ranges.low[axis][j - block.j0], *highs = ranges.high[axis][j - block.j0];
      const int count = block.i1 - block.i0 + 1;
      for (int k = 0; k < count; k += int(hn::Lanes(d))) {
        const VecRange range = vertex_range<kMotion, kLens>(s, a, job.box.lens, first + size_t(k));
        hn::StoreU(range.low, d, lows + k), hn::StoreU(range.high, d, highs + k);
      }
      for (int k = 0; k < count; ++k) low = std::min(low, lows[k]), high = std::max(high, highs[k]);
    }
    bounds.low[axis] = low, bounds.high[axis] = high;
  }
  return bounds;
}

/// Picks the candidates in the box of each micropolygon of a patch, and tests them.
template <bool kMotion, bool kLens>
void test_patch(const BlurredGridJob& job, const GridBlock& block, const CandidateList& from,
                BlurCounts& counts) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  CandidateList &patch = job.scratch->patch, &chosen = job.scratch->micropolygon;
  PatchRanges ranges;
  const BlockBounds bounds = bound_patch<kMotion, kLens>(job, block, ranges);
  filter<kMotion, kLens, true>(job, bounds, from, patch);
  if (patch.count == 0) return;
  const SampleArrays samples = patch.samples();
  for (int j = 0; j < block.j1 - block.j0; ++j)
    for (int i = 0; i < block.i1 - block.i0; ++i) {
      float low[2], high[2];
      for (int axis = 0; axis < 2; ++axis) {
        const auto& l = ranges.low[axis];
        const auto& h = ranges.high[axis];
        low[axis] = std::min({l[j][i], l[j][i + 1], l[j + 1][i], l[j + 1][i + 1]});
        high[axis] = std::max({h[j][i], h[j][i + 1], h[j + 1][i], h[j + 1][i + 1]});
      }
      chosen.count = 0;
      for (size_t k = 0; k < patch.count; k += hn::Lanes(d)) {
        const Sheared sheared{hn::LoadU(d, patch.shear_x.data() + k),
                              hn::LoadU(d, patch.shear_y.data() + k)};
        const FloatMask keep = hn::And(inside(sheared, low, high), hn::FirstN(d, patch.count - k));
        if (hn::AllFalse(d, keep)) continue;
        append<kMotion, kLens>(chosen, load_samples<kMotion, kLens>(samples, k),
                               hn::LoadU(du, patch.index.data() + k), Compaction(keep));
      }
      if (chosen.count == 0) continue;
      ++counts.micropolygons;
      test_candidates<kMotion, kLens>(job, block.i0 + i, block.j0 + j, chosen, counts.coverage);
    }
}

/// Hands the candidates of a block, in scratch list `depth`, to its quarters.
template <bool kMotion, bool kLens>
void visit_block(const BlurredGridJob& job, int depth, const GridBlock& block, BlurCounts& counts) {
  std::vector<CandidateList>& lists = job.scratch->blocks;
  const CandidateList& mine = lists[size_t(depth)];
  if (mine.count == 0) return;
  const int width = block.i1 - block.i0, height = block.j1 - block.j0;
  if (width <= patch_size && height <= patch_size) {
    test_patch<kMotion, kLens>(job, block, mine, counts);
    return;
  }
  const int i_middle = width > patch_size ? block.i0 + (width + 1) / 2 : block.i1;
  const int j_middle = height > patch_size ? block.j0 + (height + 1) / 2 : block.j1;
  for (int child = 0; child < 4; ++child) {
    const GridBlock part{child & 1 ? i_middle : block.i0, child & 2 ? j_middle : block.j0,
                         child & 1 ? block.i1 : i_middle, child & 2 ? block.j1 : j_middle};
    if (part.i0 == part.i1 || part.j0 == part.j1) continue;
    if (part.i1 - part.i0 <= patch_size && part.j1 - part.j0 <= patch_size) {
      test_patch<kMotion, kLens>(job, part, mine, counts);
      continue;
    }
    const BlockBounds bounds = bound_vertices<kMotion, kLens>(*job.segment, job.clip->u_count(),
                                                              job.test.frame, job.box, part);
    filter<kMotion, kLens, false>(job, bounds, mine, lists[size_t(depth) + 1]);
    visit_block<kMotion, kLens>(job, depth + 1, part, counts);
  }
}

template <bool kMotion, bool kLens>
uint64_t hide_blurred(const BlurredGridJob& job, const GridBlock& block) {
  BlurScratch& scratch = *job.scratch;
  const BlockBounds bounds = bound_vertices<kMotion, kLens>(*job.segment, job.clip->u_count(),
                                                            job.test.frame, job.box, block);
  size_t depths = 1;
  for (int size = std::max(block.i1 - block.i0, block.j1 - block.j0); size > patch_size;
       size = (size + 1) / 2)
    ++depths;
  if (scratch.blocks.size() < depths) scratch.blocks.resize(depths);
  CandidateList& all = scratch.blocks[0];
  all.reserve(size_t(job.rect.pixel_count()) * job.test.samples_per_pixel);
  gather_candidates<kMotion, kLens>(job, bounds, all);
  for (size_t k = 1; k < depths; ++k) scratch.blocks[k].reserve(all.count);
  scratch.patch.reserve(all.count), scratch.micropolygon.reserve(all.count);

  BlurCounts counts;
  visit_block<kMotion, kLens>(job, 0, block, counts);
  job.counters->samples_covered += counts.coverage.covered;
  job.counters->nonfinite_dropped += counts.coverage.nonfinite;
  return counts.micropolygons;
}

uint64_t hide_any(const BlurredGridJob& job, const GridBlock& block) {
  if (job.test.motion)
    return job.test.lens ? hide_blurred<true, true>(job, block)
                         : hide_blurred<true, false>(job, block);
  return hide_blurred<false, true>(job, block);
}

BlockBounds bound_any(const ClipSegment& segment, int u_count, const CoverageFrame& frame,
                      const SampleBox& box, const GridBlock& block) {
  const bool lens = box.lens > 0;
  if (segment.dX)
    return lens ? bound_vertices<true, true>(segment, u_count, frame, box, block)
                : bound_vertices<true, false>(segment, u_count, frame, box, block);
  return lens ? bound_vertices<false, true>(segment, u_count, frame, box, block)
              : bound_vertices<false, false>(segment, u_count, frame, box, block);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(hide_any);
HWY_EXPORT(bound_any);

uint64_t hide_blurred_block(const BlurredGridJob& job, const GridBlock& block) {
  return HWY_DYNAMIC_DISPATCH(hide_any)(job, block);
}

BlockBounds bound_block(const ClipSegment& segment, int u_count, const CoverageFrame& frame,
                        const SampleBox& box, const GridBlock& block) {
  return HWY_DYNAMIC_DISPATCH(bound_any)(segment, u_count, frame, box, block);
}

void CandidateList::reserve(size_t capacity) {
  const size_t wanted = capacity + simd_padding;
  const auto grow = [&](auto& a) {
    if (a.size() < wanted) a.resize(wanted);
  };
  for (auto* a : {&x, &y, &u, &v, &t, &shear_x, &shear_y}) grow(*a);
  grow(index);
}

}  // namespace tessera
#endif
