#pragma once
/// Everything that dicing one surface takes, made once a frame.

#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "dice/dice.h"
#include "dice/edge_span.h"
#include "dice/moving_points.h"
#include "dice/polygon_mesh.h"
#include "dice/subdivision.h"

namespace tessera {

struct SurfaceContext {
  const Surface* surface = nullptr;
  uint32_t index = 0;  ///< in Scene::surfaces
  std::unique_ptr<const MovingPoints> points;
  std::unique_ptr<const PatchSet> patches;
  DiceRate rate;
  const Displacer* displacer = nullptr;  ///< null unless this surface is displaced
  float displacement_bound = 0;          ///< camera units
  PrimvarFilter wants_primvar;           ///< besides P, N and texture coordinates
};

/// Topologies that instances share. Thread safe.
class TopologyCache {
 public:
  /// Throws Error as make_subdivision_topology does, for every instance of a bad mesh.
  std::shared_ptr<const SubdivisionTopology> subdivision(const Geometry& geometry);
  std::shared_ptr<const PolygonTopology> polygons(const Geometry& geometry);

 private:
  /// A geometry is prepared under its own lock, so that two of them can be in parallel.
  struct Entry {
    std::mutex mutex;
    std::shared_ptr<const SubdivisionTopology> subdivision;
    std::shared_ptr<const PolygonTopology> polygons;
  };
  Entry& entry(const Geometry& geometry);
  std::mutex mutex_;
  std::map<const Geometry*, Entry> entries_;
};

/// One a surface of the scene, made in parallel. Those that cannot be evaluated are reported and
/// stay without patches; so do those that are not `wanted`, if given. All arguments must outlive
/// the result.
std::vector<SurfaceContext> make_surface_contexts(const Scene& scene, const Camera& camera,
                                                  const RasterProjection& projection,
                                                  const DiceSettings& settings,
                                                  TopologyCache& topologies,
                                                  Diagnostics& diagnostics,
                                                  bool (*wanted)(const Surface&) = nullptr);

/// Throws Error when the surface cannot be evaluated. All arguments must outlive the result.
SurfaceContext make_surface_context(const Surface& surface, uint32_t index, const Camera& camera,
                                    const RasterProjection& projection,
                                    const DiceSettings& settings, TopologyCache& topologies);

}  // namespace tessera
