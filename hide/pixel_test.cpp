#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/pixel_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/pixel_test.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

template <bool kMotion, bool kLens>
HWY_NOINLINE void test_rect(const PixelTestJob& job, const Quad& quad, uint32_t id0,
                            const PixelRect& pixels, CoverageCounts& counts) {
  if (job.opaque)
    test_pixels<kMotion, kLens, true>(job, quad, id0, pixels, counts);
  else
    test_pixels<kMotion, kLens, false>(job, quad, id0, pixels, counts);
}

void test_rect_any(const PixelTestJob& job, const Quad& quad, uint32_t id0, const PixelRect& pixels,
                   CoverageCounts& counts) {
  if (job.motion)
    job.lens ? test_rect<true, true>(job, quad, id0, pixels, counts)
             : test_rect<true, false>(job, quad, id0, pixels, counts);
  else
    job.lens ? test_rect<false, true>(job, quad, id0, pixels, counts)
             : test_rect<false, false>(job, quad, id0, pixels, counts);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(test_rect_any);

PixelTestJob pixel_test_job(const HideInput& input, const ClipGrid& grid,
                            const ClipSegment& segment, bool opaque, FragmentBuffer& buffer) {
  PixelTestJob job;
  job.frame = coverage_frame(input, grid.grid(), segment);
  job.samples = sample_arrays(*input.samples);
  job.samples_per_pixel = size_t(input.samples->samples_per_pixel);
  job.pixels_per_row = size_t(input.samples->rect.width());
  job.buffer = &buffer;
  job.tests_per_pixel = input.tests_per_pixel;
  job.motion = grid.moves(), job.lens = input.features.lens, job.opaque = opaque;
  return job;
}

void test_pixel_rect(const PixelTestJob& job, const Quad& quad, uint32_t id0,
                     const PixelRect& pixels, CoverageCounts& counts) {
  HWY_DYNAMIC_DISPATCH(test_rect_any)(job, quad, id0, pixels, counts);
}

}  // namespace tessera
#endif
