/// The accumulation buffer: N images, each with one lens position, time and offset in the pixel,
/// averaged. All pixels see the same N, so blur shows as N ghosts.

#include "hide/tuple_hider.h"

namespace tessera {

HiderDefinition hider_accumulate() {
  return {"accumulate",
          "an accumulation buffer of N images, each at one (x, y, u, v, t); accumulate:N, by "
          "default spp",
          [](std::string_view arguments) {
            return make_tuple_hider("accumulate", SampleTuples::Kind::accumulated, arguments);
          }};
}

}  // namespace tessera
