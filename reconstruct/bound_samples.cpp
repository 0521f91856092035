#include <algorithm>

#include "reconstruct/pixel_facts.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/sampling_rate.h"

namespace tessera {
namespace {

/// What one ray effect asks for together with what blurs surfaces.
double bound_with(const PixelFacts& facts, size_t pixel, Blur ray_effect) {
  EffectWedges effects[3];
  size_t count = 0;
  for (const Blur blur : {ray_effect, Blur::lens, Blur::motion}) {
    const WedgePlanes& planes = facts.wedges[size_t(blur)];
    if (!planes.empty() && planes.known(pixel))
      effects[count++] = {planes.axis(0, pixel), planes.axis(1, pixel)};
  }
  return samples_by_bound({effects, count});
}

}  // namespace

double mean_bound_samples(const PixelFacts& facts, const PixelRect& crop) {
  double sum = 0;
  for (int y = crop.y0; y < crop.y1; ++y) {
    for (int x = crop.x0; x < crop.x1; ++x) {
      const size_t pixel = facts.index(x, y);
      const double bound =
          std::max(bound_with(facts, pixel, Blur::shadow), bound_with(facts, pixel, Blur::bounce));
      const double had = double(facts.samples[pixel]);
      sum += std::max(had, std::min(bound, Reconstruction::most_bound_samples));
    }
  }
  return crop.empty() ? 0.0 : sum / double(crop.pixel_count());
}

}  // namespace tessera
