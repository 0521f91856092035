#pragma once
/// From displacements on a surface that receives light to pixels of the picture.

#include "cameras/camera.h"
#include "shade/light.h"

namespace tessera {

/// The map J from small displacements at a point of a surface to raster displacements: onto the
/// tangent plane along the normal, then through the camera. Foreshortening is in it.
struct ReceiverFrame {
  std::array<glm::vec3, 2> row{glm::vec3(0.0f), glm::vec3(0.0f)};  ///< pixels per camera unit

  /// The frame of the surface point P with unit normal N of either sign, camera space. Zero, which
  /// says that nothing is known, where P lies on or behind the camera plane or anything is not
  /// finite.
  static ReceiverFrame at(const Camera& camera, const glm::vec3& P, const glm::vec3& N);

  glm::vec2 pixels(const glm::vec3& displacement_camera) const {
    return {glm::dot(row[0], displacement_camera), glm::dot(row[1], displacement_camera)};
  }
  /// Pixels along x and y that the unit disc of the tangent plane reaches.
  glm::vec2 reach_of_unit_disc() const { return {glm::length(row[0]), glm::length(row[1])}; }
  /// The frame that first carries displacements along the unit direction `L` to the tangent plane
  /// of N, as shadows are. Directions nearer than about 3 degrees to the plane count as that far
  /// from it.
  ReceiverFrame projected_along(const glm::vec3& L, const glm::vec3& N) const;
};

/// The effect coordinate of one sample (shade/effects.h).
struct EffectCoordinate {
  glm::vec2 y{0.0f}, extent{0.0f};
};

/// The coordinate of an offset that `pixels` carries by J, where offsets spread over `reach` pixels
/// along each axis. All zero along an axis where the reach is zero or not finite.
EffectCoordinate effect_coordinate(const glm::vec2& pixels, const glm::vec2& reach);

/// Makes it that of entry i.
void set_coordinate(size_t i, const EffectCoordinate& coordinate, ShareSamples& out);

/// Pixels along x and y that the offsets of a light from its centre spread over: the half width of
/// a uniform distribution of the same standard deviation.
glm::vec2 reach_of(const LightExtent& extent, const ReceiverFrame& frame);

}  // namespace tessera
