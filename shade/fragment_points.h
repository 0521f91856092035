#pragma once
/// The surface points of fragments, as a batch for lights whose shadows have a rate of their own.

#include <span>

#include "shade/fragment_geometry.h"
#include "shade/points.h"

namespace tessera {

/// When surfaces are looked at.
enum class PointTime {
  shutter_open,  ///< where they were shaded: for shadows that were made then
  of_sample      ///< when the sample saw them: for rays, which meet what moves where it is then
};

/// Points lie on the curved surface that the normals of their triangle's corners tell of, not on
/// the triangle: with coarse micropolygons, blockers made from fine ones would shadow the
/// triangles.
///
/// At PointTime::of_sample the points have a time and a surface, normals are carried along with
/// their triangle, and they point to the side that the eye sees.
class FragmentPoints {
 public:
  /// With `pixel_footprints` dPdx and dPdy are what a pixel spans, otherwise there are none.
  FragmentPoints(const ShadeInput& input, std::span<const uint32_t> fragments, PointTime when,
                 const Camera& camera, bool pixel_footprints);
  FragmentPoints(const FragmentPoints&) = delete;
  FragmentPoints& operator=(const FragmentPoints&) = delete;

  const ShadingPoints& points() const { return points_; }

 private:
  void fill_footprints(const Camera& camera);

  Vec3Array P_, N_, dPdx_, dPdy_;
  std::vector<float> time_;
  std::vector<int32_t> surface_;
  ShadingPoints points_;
};

}  // namespace tessera
