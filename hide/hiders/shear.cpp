/// Samples carried back to where each blurred grid was, and tested there.

#include "hide/shear_hider.h"

namespace tessera {

HiderDefinition hider_shear() {
  return {"shear",
          "samples sheared back into each grid's own space; shear:N sets tiles of N pixels",
          [](std::string_view arguments) {
            return make_shear_hider("shear", arguments, LittleBlur::sheared);
          }};
}

}  // namespace tessera
