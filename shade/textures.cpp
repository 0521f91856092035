#include "shade/textures.h"

#include <algorithm>

namespace tessera {

TextureSampler* FrameTextures::sampler() {
  std::call_once(made_, [&] {
    if (make_sampler_) sampler_ = make_sampler_();
  });
  return sampler_.get();
}

Vec3Array FrameTextures::color(const TextureRequest& request, const TexturePoints& points,
                               const SourceLocation& where) {
  const int count = int(points.s.size());
  Vec3Array colors(count);
  TextureSampler* const sampler = this->sampler();
  std::vector<float> sampled(3 * size_t(count));
  const TextureResult result = sampler ? sampler->sample(request, points, sampled)
                                       : TextureResult{false, "no image library"};
  if (!result.found) {
    diagnostics_.warn_once("texture " + request.file, where,
                           fmt::format("cannot read texture \"{}\" ({}); magenta is used",
                                       request.file, result.message));
    for (int i = 0; i < count; ++i) colors.set(i, {1.0f, 0.0f, 1.0f});
    return colors;
  }
  for (int c = 0; c < 3; ++c) {
    std::copy_n(sampled.data() + size_t(c) * size_t(count), count, colors.component(c));
  }
  return colors;
}

}  // namespace tessera
