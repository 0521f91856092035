#include "dice/surface_context.h"

#include <algorithm>
#include <cmath>

#include "dice/nurbs.h"
#include "dice/patch_mesh.h"
#include "dice/quadric.h"

namespace tessera {

TopologyCache::Entry& TopologyCache::entry(const Geometry& geometry) {
  const std::lock_guard lock(mutex_);
  return entries_[&geometry];
}

std::shared_ptr<const SubdivisionTopology> TopologyCache::subdivision(const Geometry& geometry) {
  Entry& e = entry(geometry);
  const std::lock_guard lock(e.mutex);
  if (!e.subdivision) e.subdivision = make_subdivision_topology(geometry);
  return e.subdivision;
}

std::shared_ptr<const PolygonTopology> TopologyCache::polygons(const Geometry& geometry) {
  Entry& e = entry(geometry);
  const std::lock_guard lock(e.mutex);
  if (!e.polygons) e.polygons = make_polygon_topology(geometry);
  return e.polygons;
}

namespace {

struct PatchSetMaker {
  const Surface& surface;
  const MovingPoints& points;
  TopologyCache& topologies;
  bool displaced;

  std::unique_ptr<PatchSet> operator()(const SubdivisionMesh&) const {
    return make_subdivision_patches(surface, points, topologies.subdivision(*surface.geometry));
  }
  std::unique_ptr<PatchSet> operator()(const PolygonMesh&) const {
    return make_polygon_patches(surface, points, topologies.polygons(*surface.geometry), displaced);
  }
  std::unique_ptr<PatchSet> operator()(const PatchMesh&) const {
    return make_patch_mesh_patches(surface, points);
  }
  std::unique_ptr<PatchSet> operator()(const NurbsPatch&) const {
    return make_nurbs_patches(surface, points);
  }
  std::unique_ptr<PatchSet> operator()(const Quadric&) const {
    return make_quadric_patches(surface, points);
  }
};

}  // namespace

SurfaceContext make_surface_context(const Surface& surface, uint32_t index, const Camera& camera,
                                    const RasterProjection& projection,
                                    const DiceSettings& settings, TopologyCache& topologies) {
  SurfaceContext context;
  const Attributes& attributes = *surface.attributes;
  context.surface = &surface;
  context.index = index;
  context.points = std::make_unique<MovingPoints>(surface, camera);
  if (settings.displacer && attributes.displacement) {
    context.displacer = settings.displacer;
    context.displacement_bound =
        attributes.displacement_bound * context.points->camera_units_per_world_unit();
  }
  context.patches =
      std::visit(PatchSetMaker{surface, *context.points, topologies, context.displacer != nullptr},
                 surface.geometry->shape);
  context.rate.projection = &projection;
  context.rate.key_count = context.points->key_count();
  context.rate.max_grid_size = std::max(1, settings.max_grid_size);
  // A rate of (nearly) zero would never end; a hundredth of a pixel a side is finer than any use.
  const float area = attributes.shading_rate * settings.shading_rate_scale;
  context.rate.step = std::sqrt(std::max(area, 1e-4f));
  if (!std::isfinite(context.rate.step)) context.rate.step = 1;
  context.wants_primvar = [&attributes, &settings](std::string_view name) {
    if (name == "P" || name == "N" || name == "st" || name == "s" || name == "t") return false;
    return !settings.wants_primvar || settings.wants_primvar(attributes, name);
  };
  return context;
}

}  // namespace tessera
