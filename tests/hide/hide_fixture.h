#pragma once
/// Grids, cameras and samples for the tests of the hiders.

#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "cameras/camera.h"
#include "hide/hide.h"

namespace tessera {

/// Position of a grid vertex: (u, v in [0, 1], key index) to camera space.
using VertexFunction = std::function<glm::vec3(float u, float v, int key)>;

inline std::unique_ptr<Grid> make_grid(int u_count, int v_count, std::vector<float> key_times,
                                       const VertexFunction& position) {
  auto grid = std::make_unique<Grid>();
  grid->u_count = u_count, grid->v_count = v_count;
  grid->key_times = std::move(key_times);
  grid->P_camera.assign(size_t(grid->key_count()) * 3 * grid->stride(), 0.0f);
  grid->raster_bounds = RasterBounds::everything();
  for (int key = 0; key < grid->key_count(); ++key)
    for (int j = 0; j <= v_count; ++j)
      for (int i = 0; i <= u_count; ++i) {
        const glm::vec3 p = position(float(i) / float(u_count), float(j) / float(v_count), key);
        for (int axis = 0; axis < 3; ++axis) grid->P(key, axis)[j * (u_count + 1) + i] = p[axis];
      }
  return grid;
}

inline CameraSettings perspective_settings(int width, int height, double fov_degrees = 60) {
  CameraSettings s;
  s.projection = Projection::perspective;
  s.fov_degrees = fov_degrees;
  s.x_resolution = width, s.y_resolution = height;
  s.near_clip = 1e-3;
  return s;
}

/// One bucket over `rect`, with everything that hide() reads.
struct TestBucket {
  Camera camera;
  std::vector<std::unique_ptr<Grid>> grids;
  std::vector<bool> opaque;  ///< empty: all
  SampleBlock samples;
  bool motion = false, lens = false;

  explicit TestBucket(const CameraSettings& settings) : camera(settings) {}

  void add(std::unique_ptr<Grid> grid) {
    motion |= grid->key_count() > 1;
    grids.push_back(std::move(grid));
  }
  void make_samples(const PixelRect& rect, int samples_per_pixel, uint32_t seed,
                    const SampleTuples& tuples = {}) {
    lens = camera.lens_open();
    const SamplePattern pattern(samples_per_pixel, seed, lens ? &camera.lens_profile() : nullptr,
                                motion ? &camera.shutter_profile() : nullptr, tuples);
    pattern.fill(rect, samples);
  }
  FragmentList hide(const std::string& hider, HideCounters* counters = nullptr,
                    std::span<uint32_t> tests_per_pixel = {}) const {
    std::vector<HideGrid> hide_grids;
    HideInput input;
    for (size_t g = 0; g < grids.size(); ++g) {
      hide_grids.push_back({grids[g].get(), opaque.empty() || opaque[g]});
      input.features.transparency |= !hide_grids.back().opaque;
    }
    input.samples = &samples;
    input.grids = hide_grids;
    input.raster_clip = camera.raster_clip();
    input.near_clip = camera.near_clip(), input.far_clip = camera.far_clip();
    input.lens_extent = camera.lens_profile().extent();
    input.features.motion = motion, input.features.lens = lens;
    input.tests_per_pixel = tests_per_pixel;
    const auto made = make_hider(hider);
    const auto scratch = made->make_scratch();
    HideCounters local;
    FragmentList out;
    made->hide(input, *scratch, out, counters ? *counters : local);
    return out;
  }
};

inline bool same_fragments(const FragmentList& a, const FragmentList& b) {
  return a.sample == b.sample && a.grid == b.grid && a.triangle == b.triangle && a.b1 == b.b1 &&
         a.b2 == b.b2 && a.z == b.z && a.weight == b.weight &&
         a.first_of_sample == b.first_of_sample;
}

/// Camera-space vertex of a grid at shutter time t, in double precision.
inline glm::dvec3 vertex_at(const Grid& grid, int vertex, double t) {
  const auto at = [&](int key) {
    return glm::dvec3(grid.P(key, 0)[vertex], grid.P(key, 1)[vertex], grid.P(key, 2)[vertex]);
  };
  if (grid.key_count() == 1) return at(0);
  int key = 0;
  while (key + 2 < grid.key_count() && t >= grid.key_times[size_t(key) + 1]) ++key;
  const double begin = grid.key_times[size_t(key)], end = grid.key_times[size_t(key) + 1];
  const double share = (t - begin) / (end - begin);
  return at(key) + share * (at(key + 1) - at(key));
}

/// Vertices of triangle `triangle` (2 * micropolygon + 0 or 1) in the order of dice/grid.h.
inline std::array<int, 3> triangle_vertices(const Grid& grid, int triangle) {
  const int m = triangle / 2, j = m / grid.u_count, i = m % grid.u_count;
  const int a = j * (grid.u_count + 1) + i, b = a + 1, c = a + grid.u_count + 1, d = c + 1;
  return triangle % 2 == 0 ? std::array{a, b, d} : std::array{a, d, c};
}

}  // namespace tessera
