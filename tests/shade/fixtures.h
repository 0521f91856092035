#pragma once
/// Scenes, grids and batches of points made by hand for the tests of shade/.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "shade/bindings.h"
#include "shade/grid_points.h"

namespace tessera::test {

inline Parameter number(const std::string& name, float value) {
  return {.name = name, .type = ValueType::scalar, .numbers = {value}, .strings = {}};
}
inline Parameter triple(const std::string& name, ValueType type, glm::vec3 v) {
  return {.name = name, .type = type, .numbers = {v.x, v.y, v.z}, .strings = {}};
}
inline Parameter text(const std::string& name, const std::string& value) {
  return {.name = name, .type = ValueType::string, .numbers = {}, .strings = {value}};
}

inline ShaderCall call(const std::string& name, std::vector<Parameter> parameters = {},
                       const glm::dmat4& world_from_shader = glm::dmat4(1.0)) {
  return {name, std::move(parameters), MovingTransform(world_from_shader), {"scene.rib", 7}};
}

/// A scene whose camera space is world space: perspective, 90 degrees, 100 x 100 pixels.
struct TestScene {
  Scene scene;
  std::unique_ptr<Camera> camera;
  Diagnostics diagnostics;
  std::function<std::shared_ptr<TextureSampler>()> texture_sampler;

  TestScene() {
    scene.surfaces.reserve(16);  // surfaces are handed out by reference
    scene.camera.projection = Projection::perspective;
    scene.camera.fov_degrees = 90.0;
    scene.camera.x_resolution = scene.camera.y_resolution = 100;
  }

  int add_light(ShaderCall shader, bool area = false) {
    scene.lights.push_back({std::move(shader), area, ""});
    return int(scene.lights.size()) - 1;
  }

  /// Adds a surface lit by all the lights there are so far.
  Surface& add_surface(Attributes attributes) {
    for (int i = 0; i < int(scene.lights.size()); ++i) attributes.lights.push_back(i);
    Surface surface;
    surface.id = int(scene.surfaces.size());
    surface.geometry = std::make_shared<Geometry>();
    surface.attributes = std::make_shared<Attributes>(std::move(attributes));
    scene.surfaces.push_back(surface);
    return scene.surfaces.back();
  }
  Surface& add_surface(const std::string& shader, std::vector<Parameter> parameters = {}) {
    Attributes attributes;
    attributes.surface = call(shader, std::move(parameters));
    return add_surface(attributes);
  }

  std::shared_ptr<const ShaderBindings> bind() {
    camera = std::make_unique<Camera>(scene.camera);
    return bind_shaders({&scene, camera.get(), &diagnostics, texture_sampler});
  }

  bool warned(const std::string& part) const {
    for (const std::string& line : diagnostics.lines()) {
      if (line.find(part) != std::string::npos) return true;
    }
    return false;
  }
};

/// A grid over (u, v) in [0, 1]^2, st = (u, v), facing the eye with normal (0, 0, -1).
inline std::shared_ptr<Grid> make_grid(const Surface& surface, int u_count, int v_count,
                                       const std::function<glm::vec3(float u, float v)>& P,
                                       uint32_t face = 0) {
  auto grid = std::make_shared<Grid>();
  grid->id = {uint32_t(surface.id), face, 1};
  grid->surface = &surface;
  grid->u_count = u_count, grid->v_count = v_count;
  const size_t stride = grid->stride();
  grid->P_camera.resize(3 * stride);
  grid->N_camera.resize(3 * stride);
  grid->uv.resize(2 * stride);
  for (int j = 0; j <= v_count; ++j) {
    for (int i = 0; i <= u_count; ++i) {
      const float u = float(i) / float(u_count), v = float(j) / float(v_count);
      const size_t k = size_t(j * (u_count + 1) + i);
      for (int axis = 0; axis < 3; ++axis) grid->P(0, axis)[k] = P(u, v)[axis];
      grid->N_camera[2 * stride + k] = -1.0f;
      grid->uv[k] = u, grid->uv[stride + k] = v;
    }
  }
  grid->st = grid->uv;
  return grid;
}

/// The square [-1, 1]^2 at depth z.
inline std::shared_ptr<Grid> make_square(const Surface& surface, int count, float z,
                                         uint32_t face = 0) {
  return make_grid(
      surface, count, count,
      [z](float u, float v) { return glm::vec3(2.0f * u - 1.0f, 2.0f * v - 1.0f, z); }, face);
}

/// Adds a motion key at shutter time `time` to a grid: where `move` takes each vertex from its
/// place at the first key.
inline void add_key(Grid& grid, float time,
                    const std::function<glm::vec3(const glm::vec3&)>& move) {
  const int key = grid.key_count();
  grid.key_times.push_back(time);
  grid.P_camera.resize(3 * size_t(key + 1) * grid.stride());
  for (int k = 0; k < grid.vertex_count(); ++k) {
    const glm::vec3 moved = move({grid.P(0, 0)[k], grid.P(0, 1)[k], grid.P(0, 2)[k]});
    for (int axis = 0; axis < 3; ++axis) grid.P(key, axis)[k] = moved[axis];
  }
}

/// Adds a primitive variable made from (u, v); returns its source for changes.
inline std::shared_ptr<Parameter> add_primvar(
    Grid& grid, const std::string& name, ValueType type,
    const std::function<std::vector<float>(float u, float v)>& value) {
  auto source = std::make_shared<Parameter>();
  source->name = name;
  source->type = type;
  source->storage = StorageClass::varying;
  const size_t stride = grid.stride();
  GridPrimvar primvar{source.get(), component_count(type), {}};
  primvar.values.resize(size_t(primvar.components) * stride);
  for (size_t k = 0; k < size_t(grid.vertex_count()); ++k) {
    const std::vector<float> values = value(grid.uv[k], grid.uv[stride + k]);
    for (size_t c = 0; c < size_t(primvar.components); ++c) {
      primvar.values[c * stride + k] = values[c];
    }
  }
  grid.primvars.push_back(std::move(primvar));
  return source;
}

/// What the surface shader gives at the vertices of `grid`, over micropolygons or at bare points.
inline SurfaceColors run_surface(const ShaderBindings& bindings, const Grid& grid,
                                 Footprints footprints = Footprints::over_micropolygons) {
  const GridPoints batch(grid, bindings.camera(), footprints);
  ShadeCounters counters;
  const SurfaceBinding& binding = bindings.of(grid.attributes());
  const ShaderContext context(binding.surface, batch.points(),
                              {binding.lights, &bindings.textures(), &counters});
  SurfaceColors out{Vec3Array(grid.vertex_count()), Vec3Array(grid.vertex_count())};
  out.light_terms.assign(bindings.light_term_count(), Vec3Array(grid.vertex_count()));
  binding.surface.definition->surface(context, out);
  return out;
}

/// Points with a normal and nothing else.
struct BarePoints {
  Vec3Array P, N;
  ShadingPoints points;

  BarePoints(const std::vector<glm::vec3>& places, const glm::vec3& normal)
      : P(int(places.size())), N(int(places.size())) {
    for (int i = 0; i < P.count(); ++i) P.set(i, places[size_t(i)]), N.set(i, normal);
    points.count = P.count();
    points.P = P, points.N = N;
  }
};

/// One sample a pixel over a row of pixels, and fragments put in by hand.
struct TestBucket {
  SampleBlock samples;
  FragmentList fragments;
  std::vector<std::shared_ptr<const Grid>> grids;

  explicit TestBucket(int sample_count) {
    samples.rect = {0, 0, sample_count, 1};
    samples.samples_per_pixel = 1;
    fragments.first_of_sample = {0};
  }
  /// A fragment of the sample that finish_sample() will end.
  void add(uint32_t grid, uint32_t triangle, float b1, float b2, float z) {
    fragments.sample.push_back(uint32_t(fragments.first_of_sample.size()) - 1);
    fragments.grid.push_back(grid);
    fragments.triangle.push_back(triangle);
    fragments.b1.push_back(b1);
    fragments.b2.push_back(b2);
    fragments.z.push_back(z);
    fragments.weight.push_back(1.0f);
  }
  void finish_sample() { fragments.first_of_sample.push_back(uint32_t(fragments.size())); }
  ShadeInput input() const { return {&fragments, grids, &samples}; }
};

}  // namespace tessera::test
