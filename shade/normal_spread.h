#pragma once
/// How the unit normal varies within one shading cell, and what lighting averaged over such normals
/// gives: an evaluation at the centre shows highlights and terminators finer than the cell.

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "shade/points.h"

namespace tessera {

/// Normals of a cell: N + a * along + b * across for a and b in [-1/2, 1/2], normalised, and around
/// each of them an even scatter.
struct NormalSpread {
  glm::vec3 along{0.0f}, across{0.0f};  ///< tangent to N, `along` the longer
  float scatter = 0.0f;                 ///< variance in each tangential direction

  bool none() const { return along == glm::vec3(0.0f) && scatter == 0.0f; }
};

/// The change of the unit direction of view at point i for a step `dP` on the surface. Looking
/// along the camera's axis the view counts as parallel: only orthographic cameras have more than
/// one such point.
glm::vec3 view_change(const ShadingPoints& points, int i, const glm::vec3& dP);

/// The spread around the unit normal `N`, which may be points.N or its opposite, at point i.
NormalSpread normal_spread(const ShadingPoints& points, int i, const glm::vec3& N);

/// The spread of the normal against the half vector H = L - I, which turns with the view as the
/// normal does with the surface. The light counts as far away. None where dNdx or dPdx is not
/// known.
NormalSpread half_vector_spread(const ShadingPoints& points, int i, const glm::vec3& N,
                                const glm::vec3& H);

/// The mean over the cell of max(0, n . H / |H|)^exponent where N . H > 0 and of what is left of
/// that lobe in the cell's other normals; exponent > 0, `H` of any length. Without spread it is the
/// value at N, bit for bit.
///
/// In the coordinate x(angle) = sqrt(-2 ln cos(angle)) the lobe is a Gaussian of variance
/// 1 / exponent. The scatter widens it as M. Toksvig ("Mipmapping normal maps", 2005) and M. Olano
/// and D. Baker ("LEAN mapping", I3D 2010) do; the linear change is a box, whose mean is a
/// difference of error functions. The integral over half vectors is kept by both.
float mean_specular_lobe(const glm::vec3& N, const glm::vec3& H, float exponent,
                         const NormalSpread& spread);

/// The mean of max(0, x + y + z) over y in [-p / 2, p / 2] and z in [-q / 2, q / 2]; p or q > 0.
/// Only for |x| < (p + q) / 2: beyond, it is max(0, x), but the differences that give it lose
/// digits as (x / p)(x / q) grows, 1e-3 of it where both are 1e-7 of x, and all at 1e-9.
float mean_positive_part(float x, float p, float q);

/// The mean over the cell of max(0, n . L), with the shortening of the mean normal by its
/// scatter but not by its linear change. Exact, and
/// max(0, N . L) bit for bit, where the whole cell faces the light.
inline float mean_clamped_cosine(const glm::vec3& N, const glm::vec3& L,
                                 const NormalSpread& spread) {
  // The mean of scattered unit normals is shorter than they are.
  const float cosine = glm::dot(N, L) * (1.0f - std::min(spread.scatter, 1.0f));
  float p = std::abs(glm::dot(spread.along, L));
  const float q = std::abs(glm::dot(spread.across, L));
  if (spread.scatter > 0.0f) {  // widens p to a box with the variances of both
    p = std::sqrt(p * p + 12.0f * spread.scatter * std::max(0.0f, 1.0f - cosine * cosine));
  }
  if (std::abs(cosine) >= 0.5f * (p + q)) return std::max(0.0f, cosine);
  return mean_positive_part(cosine, p, q);
}

}  // namespace tessera
