#pragma once
/// The hider that takes each grid the cheapest way it knows: grids that stand still and in focus by
/// boxes of pixels (hide/static_grid.h), blurred ones in the space of their shear map
/// (hide/sheared_grid.h) or, if asked to, by boxes where the blur is little. Nothing behind what is
/// known to be opaque is tested.

#include <memory>
#include <string_view>

#include "hide/hide.h"

namespace tessera {

/// What becomes of blurred grids whose micropolygons are larger than their blur.
enum class LittleBlur {
  sheared,  ///< as all others: what is measured against the other methods
  boxed,    ///< tested in all of the box they sweep, as set-up costs more than tests there
};

/// `arguments`: the side of tiles in pixels, or nothing. Throws Error, naming the hider, when they
/// are something else.
std::unique_ptr<Hider> make_shear_hider(std::string_view name, std::string_view arguments,
                                        LittleBlur little_blur);

}  // namespace tessera
