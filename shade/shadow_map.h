#pragma once
/// Depth maps seen from a light, and the share of a surface that they leave lit.

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "images/image.h"
#include "shade/points.h"

namespace tessera {

/// How a map is looked up.
struct ShadowFilter {
  int samples = 16;    ///< places of the map compared for a point, at least 1
  float width = 1.0f;  ///< multiplies the footprint of the shading cell
  float blur = 0.0f;   ///< further width of the filter, share of the map's width and height
  float bias =
      0.0f;  ///< how much nearer than the surface a blocker must be, depth units of the map
};

/// Immutable and thread safe.
class ShadowMap {
 public:
  /// `depth` holds camera depth in channel Z (or in its only channel) and the matrices
  /// "worldToCamera" and "worldToNDC" of the camera it was rendered with. Throws Error when one is
  /// missing, or when the matrices are not those of one perspective or orthographic camera.
  explicit ShadowMap(const Image& depth);

  /// Writes the share of light, in [0, 1], that reaches each point: the share of texels within its
  /// footprint that hold nothing nearer (percentage closer filtering: W. Reeves, D. Salesin,
  /// R. Cook, "Rendering antialiased shadows with depth maps", SIGGRAPH 1987). A point behind the
  /// map's camera or outside the map is lit. Of `points` P, N, dPdx and dPdy are read; without
  /// footprints only `blur` spreads the samples. A function of the point's values alone.
  ///
  /// Each texel is compared with the plane through the point that its normal spans, where that is
  /// nearest within the texel, less the width of a texel there: flat surfaces do not shadow
  /// themselves at any angle, nor do those whose curvature a texel cannot show.
  void light_share(const ShadingPoints& points, const glm::dmat4& world_from_camera,
                   const ShadowFilter& filter, std::span<float> share) const;

 private:
  /// The tangent plane of a point as the map sees it. `nearness` is 1 / depth in a perspective map
  /// and -depth in an orthographic one, an affine function of raster position on any plane.
  struct Receiver {
    glm::dvec2 raster{0.0};
    double w = 1.0;  ///< depth in a perspective map, 1 in an orthographic one
    double nearness = 0.0;
    glm::dvec2 nearness_slope{0.0};  ///< per pixel
    double allowance = 0.0;          ///< depth by which a blocker must be nearer
  };
  /// How raster position and nearness change along a world vector.
  struct Change {
    glm::dvec2 raster;
    double nearness;
  };

  void read_matrices(const Image& depth);
  /// False when the point is not in front of the map's camera.
  bool receive(const glm::dvec3& P_world, double bias, Receiver& receiver) const;
  Change change(const Receiver& receiver, const glm::dvec3& along) const;
  void tilt(const glm::dvec3& across, const glm::dvec3& along, Receiver& receiver) const;
  bool blocked(int x, int y, const Receiver& receiver) const;
  double lit_around(const glm::dvec2& raster, const Receiver& receiver) const;

  /// Rows of the map from world space to homogeneous raster position, and to depth.
  glm::dvec4 x_row_{0.0}, y_row_{0.0}, w_row_{0.0}, depth_row_{0.0};
  bool perspective_ = false;
  double texel_ = 0.0;  ///< width of a texel at w = 1, depth units
  PixelRect frame_, held_;
  std::vector<float> depth_;  ///< row after row of held_
};

}  // namespace tessera
