#pragma once
/// Lighting that several surface shaders share.

#include <vector>

#include "shade/shader.h"

namespace tessera {

/// Ka, Kd, Ks, roughness and specularcolor with the given defaults.
std::vector<ParameterDeclaration> plastic_parameters(float Kd = 0.5f, float Ks = 0.5f);

/// Ci = Os * (base * (Ka * ambient + Kd * diffuse) + specularcolor * Ks * specular), Oi = Os; the
/// shader declares plastic_parameters().
void shade_plastic(const ShaderContext& context, const Vec3Input& base, SurfaceColors& out);

}  // namespace tessera
