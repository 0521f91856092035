#pragma once
/// The frame of the hider benchmarks, shared by all contestants.

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "bench/frame_samples.h"
#include "dice/grid.h"

namespace tessera {

struct HiderSceneSettings {
  int width = 960, height = 540;
  int samples_per_pixel = 16;
  double motion_pixels = 0;        ///< mean path on screen over the shutter; 0: all stands still
  double coc_pixels = 0;           ///< mean radius of the circle of confusion; 0: a pinhole
  double micropolygon_pixels = 1;  ///< their edge
  int layers = 1;                  ///< opaque surfaces behind one another
  SampleTuples tuples = {};        ///< what the hider asks for
};

/// A surface of micropolygons in grids of 32 x 32 that fills the frame, in hills and valleys:
/// depth, velocity and circle of confusion vary over each grid. Further layers lie behind it, with
/// hills of their own that reach through their neighbours' where there are many; all grids then
/// come in random order.
class HiderScene {
 public:
  static constexpr int bucket_size = 64;  ///< pixels
  static constexpr int grid_size = 32;    ///< micropolygons along u and v

  explicit HiderScene(const HiderSceneSettings& settings)
      : motion(settings.motion_pixels > 0),
        lens(settings.coc_pixels > 0),
        camera(camera_settings(settings)),
        bucket_columns((settings.width + bucket_size - 1) / bucket_size),
        buckets(make_sample_blocks(
            camera, {settings.samples_per_pixel, motion, lens, settings.tuples}, bucket_size)),
        settings_(settings) {
    const double grid_pixels = grid_size * settings.micropolygon_pixels;
    const int columns = int(std::ceil(settings.width / grid_pixels));
    const int rows = int(std::ceil(settings.height / grid_pixels));
    grids.resize(size_t(columns) * size_t(rows) * size_t(settings.layers));
    tbb::parallel_for(size_t(0), grids.size(), [&](size_t g) {
      const int in_layer = int(g) % (columns * rows);
      grids[g] = make_grid(in_layer % columns * grid_size, in_layer / columns * grid_size,
                           int(g) / (columns * rows));
    });
    if (settings.layers > 1) std::shuffle(grids.begin(), grids.end(), std::mt19937(1));
  }

  size_t micropolygon_count() const { return grids.size() * grid_size * grid_size; }

  const bool motion, lens;
  const Camera camera;
  const int bucket_columns;
  std::vector<std::unique_ptr<Grid>> grids;
  const std::vector<SampleBlock> buckets;  ///< row-major, with their samples

 private:
  static constexpr double depth = 5.0;         // of the first layer
  static constexpr double layers_depth = 2.5;  // from the first layer to past the last

  static CameraSettings camera_settings(const HiderSceneSettings& settings) {
    CameraSettings s;
    s.projection = Projection::perspective;
    s.fov_degrees = 40;
    s.x_resolution = settings.width, s.y_resolution = settings.height;
    s.near_clip = 0.1;
    if (settings.coc_pixels <= 0) return s;
    // Focused at twice the mean depth, where |z / f - 1| / z is 1 / (2 z): the radius in pixels is
    // pixels_per_unit * aperture radius / (2 z).
    const double pixels_per_unit =
        settings.height / 2.0 / std::tan(s.fov_degrees / 2 * 3.14159265358979 / 180);
    const double aperture_radius = settings.coc_pixels * 2 * depth / pixels_per_unit;
    const double focal_length = 1.0;
    s.lens =
        CameraSettings::ThinLens{focal_length / (2 * aperture_radius), focal_length, 2 * depth};
    return s;
  }

  /// The point of a layer that projects to (x, y) at shutter open.
  glm::dvec3 surface(double x, double y, int layer) const {
    const RasterClipMap& m = camera.raster_clip();
    const double z = depth + layers_depth * layer / settings_.layers +
                     0.5 * std::sin(x * 0.021 + 2.4 * layer) * std::cos(y * 0.027 + 1.7 * layer);
    return {(x - m.x_from_w) * z / m.x_scale, (y - m.y_from_w) * z / m.y_scale, z};
  }

  /// Raster displacement in pixels and depth displacement in camera units over the shutter.
  static glm::dvec3 displacement(double x, double y, double motion_pixels) {
    const double turn = 0.6 + 0.5 * std::sin(x * 0.004) + 0.4 * std::cos(y * 0.006);
    const double length = motion_pixels * (1 + 0.3 * std::sin(x * 0.011 + y * 0.007));
    return {length * std::cos(turn), length * std::sin(turn), 0.15 * std::sin(y * 0.01)};
  }

  /// The grid whose first vertex is (i0, j0) of the lattice of all vertices.
  std::unique_ptr<Grid> make_grid(int i0, int j0, int layer) const {
    auto grid = std::make_unique<Grid>();
    grid->u_count = grid->v_count = grid_size;
    if (motion) grid->key_times = {0, 1};
    grid->P_camera.resize(size_t(grid->key_count()) * 3 * grid->stride());
    grid->z_min = 1e30f, grid->z_max = -1e30f;
    const double edge = settings_.micropolygon_pixels;
    for (int key = 0; key < grid->key_count(); ++key)
      for (int j = 0; j <= grid_size; ++j)
        for (int i = 0; i <= grid_size; ++i) {
          // A warped lattice, so that micropolygons are neither aligned with pixels nor all alike.
          const double x = edge * (i0 + i + 0.4 * std::sin(0.37 * (j0 + j)) + 0.31);
          const double y = edge * (j0 + j + 0.4 * std::cos(0.41 * (i0 + i)) + 0.17);
          add_vertex(*grid, key, j * (grid_size + 1) + i, vertex(x, y, key, layer));
        }
    return grid;
  }

  glm::dvec3 vertex(double x, double y, int key, int layer) const {
    const glm::dvec3 p = surface(x, y, layer);
    if (key == 0) return p;
    const glm::dvec3 by = displacement(x, y, settings_.motion_pixels);
    const glm::dvec3 beside = surface(x + by.x, y + by.y, layer);
    return glm::dvec3(beside.x, beside.y, beside.z) * ((p.z + by.z) / beside.z);
  }

  void add_vertex(Grid& grid, int key, int vertex, const glm::dvec3& p) const {
    for (int axis = 0; axis < 3; ++axis) grid.P(key, axis)[vertex] = float(p[axis]);
    const glm::vec3 clip = camera.raster_clip_from_camera(p);
    const glm::vec2 radius = lens ? glm::abs(camera.coc_raster(clip.z)) : glm::vec2(0.0f);
    const float x = clip.x / clip.z, y = clip.y / clip.z, slack = 0.01f;
    grid.raster_bounds.add(x - radius.x - slack, y - radius.y - slack);
    grid.raster_bounds.add(x + radius.x + slack, y + radius.y + slack);
    grid.z_min = std::min(grid.z_min, clip.z), grid.z_max = std::max(grid.z_max, clip.z);
  }

  const HiderSceneSettings settings_;
};

}  // namespace tessera
