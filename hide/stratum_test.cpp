#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/stratum_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/pixel_test.h"
#include "hide/stratum_test.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Samples [begin, end) of the arrangement. Hits go back, one by one, to where their samples are
/// in the bucket.
template <bool kMotion, bool kLens>
HWY_INLINE void test_run(const PixelTestJob& job, const uint32_t* index, const Quad& quad,
                         uint32_t id0, size_t begin, size_t end, CoverageCounts& counts) {
  FragmentBuffer& buffer = *job.buffer;
  for (size_t i = begin; i < end; i += hn::Lanes(FloatTag())) {
    const SampleVec s = load_samples<kMotion, kLens>(job.samples, i);
    test_vector<kMotion, kLens>(job.frame, quad, s, end - i, counts, [&](const Hit& hit) HWY_ATTR {
      for_each_hit(hit, [&](size_t lane, float z, float b1, float b2, uint32_t triangle) {
        if (job.opaque)
          buffer.put(index[i + lane], z, b1, b2, id0 + triangle);
        else
          buffer.add(index[i + lane], z, b1, b2, id0 + triangle);
      });
    });
  }
}

template <bool kMotion, bool kLens>
uint64_t test_boxes(const PixelTestJob& job, const StratifiedSamples& strata, const Quad& quad,
                    uint32_t id0, std::span<const StratumBox> boxes, CoverageCounts& counts) {
  uint64_t tested = 0;
  for (const StratumBox& box : boxes)
    for (int y = box.pixels.y0; y < box.pixels.y1; ++y) {
      const size_t begin = strata.first(box.stratum, box.pixels.x0, y);
      const size_t end = strata.first(box.stratum, box.pixels.x1, y);
      tested += end - begin;
      test_run<kMotion, kLens>(job, strata.index(), quad, id0, begin, end, counts);
    }
  return tested;
}

uint64_t test_any(const PixelTestJob& job, const StratifiedSamples& strata, const Quad& quad,
                  uint32_t id0, std::span<const StratumBox> boxes, CoverageCounts& counts) {
  if (job.motion)
    return job.lens ? test_boxes<true, true>(job, strata, quad, id0, boxes, counts)
                    : test_boxes<true, false>(job, strata, quad, id0, boxes, counts);
  return job.lens ? test_boxes<false, true>(job, strata, quad, id0, boxes, counts)
                  : test_boxes<false, false>(job, strata, quad, id0, boxes, counts);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(test_any);

uint64_t test_strata(const PixelTestJob& job, const StratifiedSamples& strata, const Quad& quad,
                     uint32_t id0, std::span<const StratumBox> boxes, CoverageCounts& counts) {
  return HWY_DYNAMIC_DISPATCH(test_any)(job, strata, quad, id0, boxes, counts);
}

}  // namespace tessera
#endif
