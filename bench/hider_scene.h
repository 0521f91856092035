#pragma once
/// The frame of the hider benchmark, shared by the two contestants.

#include <cmath>
#include <memory>
#include <vector>

#include "cameras/camera.h"
#include "dice/grid.h"
#include "hide/samples.h"

namespace tessera {

/// A surface of one-pixel micropolygons in grids of 32 x 32 that fills the frame, in hills and
/// valleys: depth, velocity and circle of confusion vary over each grid.
class HiderScene {
 public:
  static constexpr int bucket_size = 64;  ///< pixels
  static constexpr int grid_size = 32;    ///< micropolygons along u and v

  /// `motion_pixels` is the mean path on screen over the shutter, `coc_pixels` the mean radius of
  /// the circle of confusion; 0 switches an effect off.
  HiderScene(int width, int height, int samples_per_pixel, double motion_pixels, double coc_pixels)
      : motion(motion_pixels > 0),
        lens(coc_pixels > 0),
        camera(settings(width, height, coc_pixels)),
        bucket_columns((width + bucket_size - 1) / bucket_size) {
    for (int y = 0; y < height; y += grid_size)
      for (int x = 0; x < width; x += grid_size) grids.push_back(make_grid(x, y, motion_pixels));
    const SamplePattern pattern(samples_per_pixel, 1, lens ? &camera.lens_profile() : nullptr,
                                motion ? &camera.shutter_profile() : nullptr);
    const PixelRect frame{0, 0, width, height};
    for (int y = 0; y < height; y += bucket_size)
      for (int x = 0; x < width; x += bucket_size)
        pattern.fill(PixelRect{x, y, x + bucket_size, y + bucket_size}.intersect(frame),
                     buckets.emplace_back());
  }

  size_t micropolygon_count() const { return grids.size() * grid_size * grid_size; }

  const bool motion, lens;
  const Camera camera;
  const int bucket_columns;
  std::vector<std::unique_ptr<Grid>> grids;
  std::vector<SampleBlock> buckets;  ///< row-major, with their samples

 private:
  static constexpr double depth = 5.0;

  static CameraSettings settings(int width, int height, double coc_pixels) {
    CameraSettings s;
    s.projection = Projection::perspective;
    s.fov_degrees = 40;
    s.x_resolution = width, s.y_resolution = height;
    s.near_clip = 0.1;
    if (coc_pixels <= 0) return s;
    // Focused at twice the mean depth, where |z / f - 1| / z is 1 / (2 z): the radius in pixels is
    // pixels_per_unit * aperture radius / (2 z).
    const double pixels_per_unit =
        height / 2.0 / std::tan(s.fov_degrees / 2 * 3.14159265358979 / 180);
    const double aperture_radius = coc_pixels * 2 * depth / pixels_per_unit;
    const double focal_length = 1.0;
    s.lens =
        CameraSettings::ThinLens{focal_length / (2 * aperture_radius), focal_length, 2 * depth};
    return s;
  }

  /// The point of the surface that projects to (x, y) at shutter open.
  glm::dvec3 surface(double x, double y) const {
    const RasterClipMap& m = camera.raster_clip();
    const double z = depth + 0.5 * std::sin(x * 0.021) * std::cos(y * 0.027);
    return {(x - m.x_from_w) * z / m.x_scale, (y - m.y_from_w) * z / m.y_scale, z};
  }

  /// Raster displacement in pixels and depth displacement in camera units over the shutter.
  static glm::dvec3 displacement(double x, double y, double motion_pixels) {
    const double turn = 0.6 + 0.5 * std::sin(x * 0.004) + 0.4 * std::cos(y * 0.006);
    const double length = motion_pixels * (1 + 0.3 * std::sin(x * 0.011 + y * 0.007));
    return {length * std::cos(turn), length * std::sin(turn), 0.15 * std::sin(y * 0.01)};
  }

  std::unique_ptr<Grid> make_grid(int x0, int y0, double motion_pixels) const {
    auto grid = std::make_unique<Grid>();
    grid->u_count = grid->v_count = grid_size;
    if (motion) grid->key_times = {0, 1};
    grid->P_camera.resize(size_t(grid->key_count()) * 3 * grid->stride());
    grid->z_min = 1e30f, grid->z_max = -1e30f;
    for (int key = 0; key < grid->key_count(); ++key)
      for (int j = 0; j <= grid_size; ++j)
        for (int i = 0; i <= grid_size; ++i) {
          // A warped lattice, so that micropolygons are neither aligned with pixels nor all alike.
          const double x = x0 + i + 0.4 * std::sin(0.37 * (y0 + j)) + 0.31;
          const double y = y0 + j + 0.4 * std::cos(0.41 * (x0 + i)) + 0.17;
          glm::dvec3 p = surface(x, y);
          if (key) {
            const glm::dvec3 by = displacement(x, y, motion_pixels);
            const glm::dvec3 beside = surface(x + by.x, y + by.y);
            p = glm::dvec3(beside.x, beside.y, beside.z) * ((p.z + by.z) / beside.z);
          }
          add_vertex(*grid, key, j * (grid_size + 1) + i, p);
        }
    return grid;
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
};

}  // namespace tessera
