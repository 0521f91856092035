#pragma once
/// Runs the surface shader of one binding over a batch. Every shading mode comes through here.

#include "shade/bindings.h"

namespace tessera {

/// Fills `out` with finite colours and opacities in [0, 1]. A point where the shader gave a value
/// that is not finite is dropped: it gets no colour and the surface's own opacity, so that nothing
/// spreads and the hole shows; it is counted, and the shader named once.
void shade_surface(const ShaderBindings& bindings, const SurfaceBinding& surface,
                   const ShadingPoints& points, SurfaceColors& out, ShadeCounters& counters);

}  // namespace tessera
