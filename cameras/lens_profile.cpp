#include "cameras/lens_profile.h"

#include "base/error.h"
#include "cameras/lens_shapes.h"

namespace tessera {

std::unique_ptr<LensProfile> make_lens_profile(const std::string& name, int blades,
                                               double rotation_degrees) {
  if (name == "disc") return make_disc_lens();
  if (name == "smooth") return make_smooth_lens();
  if (name == "polygon") return make_polygon_lens(blades, rotation_degrees);
  throw Error(
      fmt::format("lens profile \"{}\" is unknown; expected disc, smooth or polygon", name));
}

}  // namespace tessera
