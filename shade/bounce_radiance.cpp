#include "shade/bounce_radiance.h"

#include <cmath>

#include "shade/fragment_geometry.h"
#include "shade/grid_points.h"
#include "shade/mathematics.h"
#include "shade/surface_shading.h"
#include "shade/thinned_grid.h"

namespace tessera {
namespace {

/// Copies of a surface's lights that are all taken together, shadows and all, without those whose
/// light has bounced. Ambient lights stay, however they are blocked.
std::vector<BoundLight> direct_lights(const SurfaceBinding& surface) {
  std::vector<BoundLight> lights;
  for (const BoundLight* light : surface.lights) {
    if (light->definition->hemisphere && !light->definition->ambient) continue;
    BoundLight& direct = lights.emplace_back(*light);
    direct.rate = TermRate::cell;
    direct.term.reset();
  }
  return lights;
}

/// Rows and columns of micropolygons from one shaded vertex to the next. What rays meet is diced
/// for its outline, which shadows need; what it sends out is averaged over the rays of a
/// hemisphere.
constexpr int shaded_step = 2;

/// Where grids meet in a corner of a room, a vertex of one lies on the other, and that would shadow
/// it. So vertices on the rim are shaded this share of a micropolygon further inside.
constexpr float inset = 1.0f / 32.0f;

/// The positions of a grid's vertices at shutter open, off the rim.
Vec3Array inset_positions(const Grid& grid) {
  Vec3Array P(grid.vertex_count());
  const int row = grid.u_count + 1;
  const auto inwards = [](int k, int last, int step) {
    return k == 0 ? step : (k == last ? -step : 0);
  };
  const auto at = [&](int k) {
    return glm::vec3(grid.P(0, 0)[k], grid.P(0, 1)[k], grid.P(0, 2)[k]);
  };
  for (int k = 0; k < grid.vertex_count(); ++k) {
    const glm::vec3 vertex = at(k);
    const glm::vec3 along_u = at(k + inwards(k % row, grid.u_count, 1)) - vertex;
    const glm::vec3 along_v = at(k + inwards(k / row, grid.v_count, row)) - vertex;
    P.set(k, vertex + inset * (along_u + along_v));
  }
  return P;
}

/// Views from straight over the side, so that shaders turn their normals there.
Vec3Array views_of_side(const ShadingPoints& points, float side) {
  Vec3Array views(points.count);
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 N = points.N[i];
    views.set(i, N == glm::vec3(0.0f) ? glm::vec3(0.0f, 0.0f, 1.0f) : -side * N);
  }
  return views;
}

}  // namespace

BounceRadiance::BounceRadiance(const ShaderBindings& bindings, const RayTracer& rays)
    : bindings_(bindings),
      rays_(rays),
      vertices_(std::make_unique<Vertices[]>(rays.grids().size())) {}

BounceRadiance::~BounceRadiance() = default;

void BounceRadiance::radiance(const Rays& rays, const RayHits& hits, Vec3Array& out,
                              ShadeCounters& counters) const {
  out.reset(rays.count());
  for (int i = 0; i < rays.count(); ++i) {
    const size_t k = size_t(i);
    if (!std::isfinite(hits.distance[k])) continue;
    const Grid& grid = *rays_.grids()[hits.grid[k]];
    const std::array<int, 3> corners = grid.triangle_corners(hits.triangle[k]);
    const Side side = side_met(grid, corners, rays.direction[i], rays.time[k]);
    const std::vector<glm::vec3>& vertices = vertices_of(hits.grid[k], side, counters);
    const float b1 = hits.b1[k], b2 = hits.b2[k];
    out.set(i, (1.0f - b1 - b2) * vertices[size_t(corners[0])] + b1 * vertices[size_t(corners[1])] +
                   b2 * vertices[size_t(corners[2])]);
  }
}

BounceRadiance::Side BounceRadiance::side_met(const Grid& grid, const std::array<int, 3>& corners,
                                              const glm::vec3& direction, float time) {
  const KeyBlend at(grid, time);
  const glm::dvec3 a(vertex_camera(grid, corners[0], at));
  const glm::dvec3 b(vertex_camera(grid, corners[1], at)), c(vertex_camera(grid, corners[2], at));
  const glm::dvec3 outward = double(grid.normal_sign) * glm::cross(b - a, c - a);
  return glm::dot(outward, glm::dvec3(direction)) > 0.0 ? Side::back : Side::front;
}

const std::vector<glm::vec3>& BounceRadiance::vertices_of(uint32_t grid, Side side,
                                                          ShadeCounters& counters) const {
  Vertices& vertices = vertices_[grid];
  std::call_once(vertices.shaded[size_t(side)], [&] {
    vertices.radiance[size_t(side)] = shade(*rays_.grids()[grid], side, counters);
  });
  return vertices.radiance[size_t(side)];
}

std::vector<glm::vec3> BounceRadiance::shade(const Grid& whole, Side side,
                                             ShadeCounters& counters) const {
  const ThinnedGrid thinned(whole, shaded_step);
  const Grid& grid = thinned.grid();
  const SurfaceBinding& surface = bindings_.of(grid.attributes());
  const GridPoints batch(grid, bindings_.camera(), Footprints::over_micropolygons);
  ShadingPoints points = batch.points();
  const Vec3Array views = views_of_side(points, side == Side::front ? 1.0f : -1.0f);
  const Vec3Array positions = inset_positions(grid);
  points.I = views;
  points.P = positions;
  const std::vector<int32_t> surfaces(size_t(points.count), int32_t(grid.surface->id));
  points.surface = surfaces.data();

  const std::vector<BoundLight> lights = direct_lights(surface);
  std::vector<const BoundLight*> views_of_lights;
  for (const BoundLight& light : lights) views_of_lights.push_back(&light);
  SurfaceColors colors{Vec3Array(points.count), Vec3Array(points.count)};
  colors.light_terms.resize(bindings_.light_term_count());  // nothing is written there
  const ShaderContext context(surface.surface, points,
                              {.lights = views_of_lights,
                               .textures = &bindings_.textures(),
                               .counters = &counters,
                               .diffuse_only = true});
  surface.surface.definition->surface(context, colors);
  counters.bounce_points_shaded += uint64_t(points.count);

  std::vector<glm::vec3> radiance;
  uint64_t failed = 0;
  for (int i = 0; i < points.count; ++i) {
    const bool finite = is_finite(colors.Ci[i]);
    radiance.push_back(finite ? colors.Ci[i] : glm::vec3(0.0f));
    failed += !finite;
  }
  report_dropped(bindings_, surface, failed, counters);
  return thinned.spread(radiance);
}

size_t BounceRadiance::memory_bytes() const {
  size_t bytes = rays_.grids().size() * sizeof(Vertices);
  for (size_t g = 0; g < rays_.grids().size(); ++g)
    for (const auto& side : vertices_[g].radiance) bytes += side.capacity() * sizeof(glm::vec3);
  return bytes;
}

}  // namespace tessera
