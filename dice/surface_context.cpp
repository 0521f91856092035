#include "dice/surface_context.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

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

DiceRate dice_rate(const Attributes& attributes, const MovingPoints& points, const Camera& camera,
                   const RasterProjection& projection, const DiceSettings& settings) {
  DiceRate rate;
  rate.projection = &projection;
  rate.key_times = points.times();
  rate.max_grid_size = std::max(1, settings.max_grid_size);
  // A rate of (nearly) zero would never end; a hundredth of a pixel a side is finer than any use.
  const float area = settings.dicing_rate.value_or(micropolygon_area(attributes));
  rate.step = std::sqrt(std::max(area * settings.shading_rate_scale, 1e-4f));
  if (!std::isfinite(rate.step)) rate.step = 1;
  // While the shutter is closed keys blur nothing.
  const bool blurs =
      points.key_count() > 1 && camera.settings().shutter_close > camera.settings().shutter_open;
  // What displacement does to an outline is not to be seen in the surface that is measured here:
  // only on demand.
  const bool by_default = !attributes.displacement || !settings.displacer;
  const auto factor = [&](const std::optional<float>& given, float usual) {
    return given.value_or(by_default ? usual : 0.0f);
  };
  if (blurs) rate.motion_factor = factor(attributes.motion_factor, settings.motion_factor);
  if (camera.lens_open())
    rate.focus_factor = factor(attributes.focus_factor, settings.focus_factor);
  return rate;
}

}  // namespace

float micropolygon_area(const Attributes& attributes) {
  const auto given = attributes.user.find("dice:rate");
  const bool has_rate = given != attributes.user.end() && !given->second.numbers.empty();
  return has_rate ? given->second.numbers.front() : attributes.shading_rate;
}

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
  context.rate = dice_rate(attributes, *context.points, camera, projection, settings);
  context.wants_primvar = [&attributes, &settings](std::string_view name) {
    if (name == "P" || name == "N" || name == "st" || name == "s" || name == "t") return false;
    return !settings.wants_primvar || settings.wants_primvar(attributes, name);
  };
  return context;
}

std::vector<SurfaceContext> make_surface_contexts(const Scene& scene, const Camera& camera,
                                                  const RasterProjection& projection,
                                                  const DiceSettings& settings,
                                                  TopologyCache& topologies,
                                                  Diagnostics& diagnostics,
                                                  bool (*wanted)(const Surface&)) {
  std::vector<SurfaceContext> contexts(scene.surfaces.size());
  std::vector<std::string> failures(scene.surfaces.size());
  tbb::parallel_for(size_t(0), scene.surfaces.size(), [&](size_t s) {
    if (wanted && !wanted(scene.surfaces[s])) return;
    try {
      contexts[s] = make_surface_context(scene.surfaces[s], uint32_t(s), camera, projection,
                                         settings, topologies);
    } catch (const Error& error) {
      failures[s] = error.what();
    }
  });
  for (const std::string& failure : failures) {
    if (!failure.empty()) {
      diagnostics.warn_once(failure, failure + "; the surface is left out");
    }
  }
  return contexts;
}

}  // namespace tessera
