/// The default: what is cheapest for each grid.

#include "hide/shear_hider.h"

namespace tessera {

HiderDefinition hider_auto() {
  return {"auto",
          "the default: shear, but boxes for grids whose micropolygons are larger than their blur",
          [](std::string_view arguments) {
            return make_shear_hider("auto", arguments, LittleBlur::boxed);
          }};
}

}  // namespace tessera
