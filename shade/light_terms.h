#pragma once
/// Shadows at rates of their own: what a light adds is kept apart from the rest of the colour in
/// every shading mode, and multiplied by its shadow here, once a pixel or once a sample, while the
/// rest of the shader runs at the mode's own rate.

#include <memory>

#include "shade/bindings.h"

namespace tessera {

/// Adds to shaded.Ci each of shaded.light_terms times the share of its light that arrives. At rate
/// `sample` shadows are looked up for every fragment at its own surface point; at rate `pixel` once
/// for all fragments of a grid in a pixel that the light reaches, at the one whose sample is
/// nearest the pixel's middle, over the pixel's footprint. Fragments whose term is zero cost
/// nothing.
///
/// Distributed lights are looked up at one place that the sample has of its own, and what they
/// bring is recorded in shaded.effects: every effect that some light has is sized to the fragments.
/// Where several lights of an effect reach a fragment, y, extent and slope are those of the light
/// with the largest unblocked luminance there.
///
/// Shadow maps are looked up where the surface was at shutter open, as they were made then and the
/// rest was shaded there. Rays (distributed lights and BoundLight::ray_traced) start where the
/// surface was when the sample saw it, and meet what moves where it was then, while the unblocked
/// term is that of shutter open. A share that is not finite counts as none, and is counted. Throws
/// Error if samples lack the coordinates that a light needs.
void apply_light_terms(const ShadeInput& input, const ShaderBindings& bindings,
                       ShadedFragments& shaded, ShadeCounters& counters);

/// `mode`, followed by apply_light_terms().
std::unique_ptr<Shading> with_light_terms(std::unique_ptr<Shading> mode,
                                          std::shared_ptr<const ShaderBindings> bindings);

}  // namespace tessera
