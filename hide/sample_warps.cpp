#include "hide/sample_warps.h"

#include <string_view>

#include "hide/owen_points.h"

namespace tessera {

SampleWarps::SampleWarps(const LensProfile* lens, const ShutterProfile* shutter)
    : lens_(lens),
      shutter_(shutter),
      disc_lens_(lens && std::string_view(lens->name()) == "disc"),
      box_shutter_(shutter && std::string_view(shutter->name()) == "box") {}

void SampleWarps::lens(float* u, float* v, size_t count) const {
  if (disc_lens_) {
    warp_to_disc(u, v, count);
    return;
  }
  for (size_t k = 0; k < count; ++k) {
    const glm::vec2 at = lens_->sample(u[k], v[k]);
    u[k] = at.x, v[k] = at.y;
  }
}

void SampleWarps::time(float* t, size_t count) const {
  if (box_shutter_) return;
  for (size_t k = 0; k < count; ++k) t[k] = shutter_->sample(t[k]);
}

}  // namespace tessera
