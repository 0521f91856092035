#pragma once
/// The samples of a frame, bucket by bucket, for benchmarks that hide without a renderer.

#include <vector>

#include <tbb/parallel_for.h>

#include "cameras/camera.h"
#include "hide/samples.h"

namespace tessera {

/// Which samples a frame is made of.
struct FrameSampling {
  int samples_per_pixel = 16;
  bool motion = false, lens = false;
  SampleTuples tuples = {};  ///< what the hider asks for: Hider::sample_tuples
  bool operator==(const FrameSampling&) const = default;
};

/// One block for each square bucket of `bucket_size` pixels, row-major.
inline std::vector<SampleBlock> make_sample_blocks(const Camera& camera,
                                                   const FrameSampling& sampling, int bucket_size) {
  const SamplePattern pattern(
      sampling.samples_per_pixel, 1, sampling.lens ? &camera.lens_profile() : nullptr,
      sampling.motion ? &camera.shutter_profile() : nullptr, sampling.tuples);
  const PixelRect frame = camera.frame();
  std::vector<PixelRect> rects;
  for (int y = 0; y < frame.y1; y += bucket_size)
    for (int x = 0; x < frame.x1; x += bucket_size)
      rects.push_back(PixelRect{x, y, x + bucket_size, y + bucket_size}.intersect(frame));
  std::vector<SampleBlock> blocks(rects.size());
  tbb::parallel_for(size_t(0), rects.size(), [&](size_t b) { pattern.fill(rects[b], blocks[b]); });
  return blocks;
}

/// The samples of one frame, remade only when others are wanted than last time.
class FrameSamples {
 public:
  const std::vector<SampleBlock>& get(const Camera& camera, const FrameSampling& sampling,
                                      int bucket_size) {
    if (blocks_.empty() || sampling != sampling_)
      blocks_ = make_sample_blocks(camera, sampling, bucket_size);
    sampling_ = sampling;
    return blocks_;
  }

 private:
  std::vector<SampleBlock> blocks_;
  FrameSampling sampling_;
};

}  // namespace tessera
