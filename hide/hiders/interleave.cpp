/// One 2D rasterisation for each of N tuples (u, v, t), which every tile of 2 x 2 pixels deals out
/// to its samples anew. Cheap whatever the blur; the image has N lens positions and times only, and
/// boxes grow to whole tiles.

#include "hide/tuple_hider.h"

namespace tessera {

HiderDefinition hider_interleave() {
  return {"interleave",
          "one rasterisation for each of N tuples (u, v, t) shared by tiles of 2 x 2 pixels; "
          "interleave:N, by default 4 * spp",
          [](std::string_view arguments) {
            return make_tuple_hider("interleave", SampleTuples::Kind::interleaved, arguments);
          }};
}

}  // namespace tessera
