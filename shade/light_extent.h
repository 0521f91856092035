#pragma once
/// Measures of lights in a space of their own.

#include "shade/light.h"

namespace tessera {

/// The scalar parameter `name`; throws Error unless it is positive and finite.
double positive_size(const BoundParameters& parameters, const char* name);

/// The extent of a shape about the origin of the light's xy plane with those half lengths along x
/// and y and `area_factor` times their product as its area, shining along +z. Throws Error where
/// the transform leaves it no area, or one out of the range of floats.
LightExtent flat_extent(const glm::dvec2& half_lengths, double area_factor,
                        const glm::dmat4& camera_from_light);

/// The extent of a ball of that radius about the light's origin, which the transform makes an
/// ellipsoid. Throws Error where that has no volume or one out of the range of floats.
LightExtent ball_extent(double radius, const glm::dmat4& camera_from_light);

}  // namespace tessera
