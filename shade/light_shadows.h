#pragma once
/// What lights with shadow maps have in common.

#include "shade/light.h"

namespace tessera {

/// `own` followed by shadowname, samples, width, blur, bias and shadowrate.
std::vector<ParameterDeclaration> with_shadow_parameters(std::vector<ParameterDeclaration> own);

/// The transmission of a light that declares those.
void shadow_map_transmission(const BoundLight& light, const ShadingPoints& points,
                             std::span<float> share);

/// The rates that "shadowrate" may name, as a light's parameters give it. Throws Error that lists
/// the choices.
TermRate term_rate(std::string_view name);

}  // namespace tessera
