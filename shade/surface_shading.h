#pragma once
/// Runs the surface shader of one binding over a batch. Every shading mode comes through here.

#include "shade/bindings.h"

namespace tessera {

/// What becomes of a point where the shader gave a value that is not finite.
enum class FailedPoint {
  black,  ///< no colour: for points that are interpolated between, so that nothing spreads
  unseen  ///< NaN in Ci: the film leaves out every sample that sees it
};

/// Runs the shader, and adds to Ci what surfaces that are part of an area light send out, which is
/// in no light term. Fills `out` with finite colours and opacities in [0, 1]. A point where the
/// shader gave a value that is not finite is dropped: it gets the surface's own opacity and the
/// colour that `failed` says; it is counted, and the shader named once.
void shade_surface(const ShaderBindings& bindings, const SurfaceBinding& surface,
                   const ShadingPoints& points, FailedPoint failed, SurfaceColors& out,
                   ShadeCounters& counters);

/// Counts points of a surface that were dropped because its shader gave values that are not finite,
/// and names the shader once. Nothing for none.
void report_dropped(const ShaderBindings& bindings, const SurfaceBinding& surface, uint64_t dropped,
                    ShadeCounters& counters);

}  // namespace tessera
