#pragma once
/// A RayScene as an Embree scene.

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <embree3/rtcore.h>

#include "rays/embree/ray_query.h"
#include "rays/ray_module.h"

namespace tessera {

/// Grids whose keys lie at the same times share a geometry of triangles, in the order of
/// Grid::triangle_corners, so that a hit's barycentric coordinates are those of FragmentList.
///
/// Embree wants keys at equal distances. Keys at other times are replaced by the fewest of at most
/// 65 at equal distances that hold them all to within 1e-4 of the shutter, or else by 65; vertices
/// are then off their way by at most 1/256 of the shutter's time at the fastest change of speed.
class EmbreeScene {
 public:
  /// Throws Error when Embree reports one.
  explicit EmbreeScene(RayScene&& scene);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCScene embree() const { return scene_; }
  std::span<const std::shared_ptr<const Grid>> grids() const { return grids_; }
  /// Whether every grid stops all light.
  bool is_opaque() const { return opaque_; }
  /// Embree's units in a camera unit: a power of two that brings the scene to a size of 1 or 2, for
  /// Embree multiplies three lengths in float.
  float scale() const { return scale_; }
  const MetGeometry& geometry(unsigned id) const { return *geometries_[id]; }
  /// Of Embree, the grids and the tables beside them.
  size_t memory_bytes() const;

 private:
  static bool count_memory(void* self, ssize_t bytes, bool after);
  void describe_grids(const RayScene& scene);
  void add_geometry(std::span<const uint32_t> grids, RayScene& scene);
  void fill_triangles(RTCGeometry geometry, std::span<const uint32_t> grids) const;
  void fill_vertices(RTCGeometry geometry, std::span<const uint32_t> grids) const;
  void release();
  /// Throws Error if Embree has failed since the last call.
  void check(const char* doing) const;

  std::vector<std::shared_ptr<const Grid>> grids_;
  std::vector<MetGrid> met_grids_;
  std::vector<std::unique_ptr<MetGeometry>> geometries_;  ///< by Embree's id
  bool opaque_ = true;
  float scale_ = 1;
  std::atomic<ssize_t> embree_bytes_{0};
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

/// Intervals between the keys that replace keys at `times` (ascending from 0 to 1, two or more).
int even_intervals(std::span<const float> times);

}  // namespace tessera
