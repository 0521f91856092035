#pragma once
/// What lights without extent have in common that may cast shadows, by depth maps or by rays.

#include "shade/light.h"

namespace tessera {

/// `own` followed by shadowname, samples, width, blur, bias and shadowrate.
std::vector<ParameterDeclaration> with_shadow_parameters(std::vector<ParameterDeclaration> own);

/// The transmission of lights that declare those and a point "from": by rays if the light is
/// BoundLight::ray_traced, otherwise by its BoundLight::shadow.
void transmission_from_point(const BoundLight& light, const ShadingPoints& points,
                             std::span<float> share);
/// Of lights that shine in parallel from "from" to "to".
void transmission_from_distance(const BoundLight& light, const ShadingPoints& points,
                                std::span<float> share);

/// A "shadowname" that stands for rays instead of a file.
inline constexpr std::string_view ray_traced_name = "raytrace";

/// The rates that "shadowrate" may name, as a light's parameters give it. Throws Error that lists
/// the choices.
TermRate term_rate(std::string_view name);

}  // namespace tessera
