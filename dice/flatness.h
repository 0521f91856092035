#pragma once
/// Surfaces whose patches are each in a plane.

#include "dice/surface_context.h"

namespace tessera {

/// Whether every patch of the surface lies in a plane of its own at every key, but for rounding, so
/// that micropolygons of any size are exact but at curved edges. Displaced surfaces never do.
/// `context` has patches.
bool is_flat(const SurfaceContext& context);

}  // namespace tessera
