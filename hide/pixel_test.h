/// The sample test over all samples of some pixels. Included once for each SIMD target.

#include "hide/pixel_test_job.h"

#if defined(TESSERA_HIDE_PIXEL_TEST_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_PIXEL_TEST_H_
#undef TESSERA_HIDE_PIXEL_TEST_H_
#else
#define TESSERA_HIDE_PIXEL_TEST_H_
#endif

#include "hide/hit_sinks.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

template <bool kMotion, bool kLens>
HWY_INLINE SampleVec load_samples(const SampleArrays& s, size_t i) {
  const FloatTag d;
  SampleVec v;
  v.x = hn::LoadU(d, s.x + i), v.y = hn::LoadU(d, s.y + i);
  v.u = v.v = v.t = hn::Zero(d);
  if constexpr (kLens) v.u = hn::LoadU(d, s.u + i), v.v = hn::LoadU(d, s.v + i);
  if constexpr (kMotion) v.t = hn::LoadU(d, s.t + i);
  return v;
}

/// Tests the samples [begin, begin + length) of the block against one micropolygon.
template <bool kMotion, bool kLens, bool kOpaque>
HWY_INLINE void test_run(const PixelTestJob& job, const Quad& quad, uint32_t id0, size_t begin,
                         size_t length, CoverageCounts& counts) {
  for (size_t k = 0; k < length; k += hn::Lanes(FloatTag())) {
    const size_t i = begin + k;
    const SampleVec s = load_samples<kMotion, kLens>(job.samples, i);
    test_vector<kMotion, kLens>(
        job.frame, quad, s, length - k, counts, [&](const Hit& hit) HWY_ATTR {
          if constexpr (kOpaque) {
            store_opaque(hit, i, id0, *job.buffer);
          } else {
            for_each_hit(hit, [&](size_t lane, float z, float b1, float b2, uint32_t triangle) {
              job.buffer->add(i + lane, z, b1, b2, id0 + triangle);
            });
          }
        });
  }
}

/// Tests every sample of `pixels` (within the block, in its pixel coordinates relative to its first
/// pixel) against one micropolygon. The pixels of a row are one run of samples.
template <bool kMotion, bool kLens, bool kOpaque>
HWY_INLINE void test_pixels(const PixelTestJob& job, const Quad& quad, uint32_t id0,
                            const PixelRect& pixels, CoverageCounts& counts) {
  for (int y = pixels.y0; y < pixels.y1; ++y)
    test_run<kMotion, kLens, kOpaque>(
        job, quad, id0,
        (size_t(y) * job.pixels_per_row + size_t(pixels.x0)) * job.samples_per_pixel,
        size_t(pixels.width()) * job.samples_per_pixel, counts);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
