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
/// nearest the pixel's middle, over the pixel's footprint. Points are those at shutter open, where
/// the rest was shaded. Fragments whose term is zero cost nothing.
void apply_light_terms(const ShadeInput& input, const ShaderBindings& bindings,
                       ShadedFragments& shaded, ShadeCounters& counters);

/// `mode`, followed by apply_light_terms().
std::unique_ptr<Shading> with_light_terms(std::unique_ptr<Shading> mode,
                                          std::shared_ptr<const ShaderBindings> bindings);

}  // namespace tessera
