#pragma once
/// A frame of diced patches under camera and object motion and defocus, for bench/ste.cpp.

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "cameras/camera.h"
#include "dice/grid.h"

namespace tessera {

/// Multiples of a scene's own shutter time and aperture; 0 switches an effect off.
struct SteEffects {
  double motion = 0, defocus = 0;
};

class SteScene {
 public:
  /// World position (x right, y up, z away from the camera) of a patch at (u, v) in [0, 1]^2.
  using Surface = std::function<glm::dvec3(double u, double v)>;

  /// `far_coc_pixels` is the radius of the circle of confusion that depth goes to far away.
  SteScene(int width, int height, const SteEffects& effects, double focus_depth,
           double far_coc_pixels)
      : scale(height / 2.0 / std::tan(fov_degrees / 2 * pi / 180)),
        camera(settings(width, height, focus_depth,
                        effects.defocus * far_coc_pixels * focus_depth / scale)),
        effects_(effects) {}

  const double scale;  ///< pixels that a unit at depth 1 takes
  const Camera camera;
  std::vector<std::unique_ptr<Grid>> grids;

  bool moves() const { return effects_.motion > 0; }
  bool lens() const { return camera.lens_open(); }
  /// The camera's movement over the scene's shutter: world units, and radians of yaw.
  void move_camera(const glm::dvec3& dolly, double yaw) { dolly_ = dolly, yaw_ = yaw; }
  /// Dices a patch into quads of about `edge` pixels, in grids of up to 32 x 32. It moves by
  /// `velocity` over the scene's shutter; `surface` is where it is at mid-shutter.
  void add(const Surface& surface, double edge, const glm::dvec3& velocity = glm::dvec3(0.0)) {
    const int u_total = quads_along(surface, true, edge);
    const int v_total = quads_along(surface, false, edge);
    for (int j = 0; j < v_total; j += grid_size)
      for (int i = 0; i < u_total; i += grid_size)
        add_grid(surface, velocity, glm::ivec2(i, j), glm::ivec2(u_total, v_total));
  }
  /// Mean screen area, in pixels, of the triangles in the frame at mid-shutter.
  double mean_triangle_pixels() const { return area_ / (2 * quads_in_frame_); }
  size_t micropolygon_count() const {
    size_t count = 0;
    for (const auto& grid : grids) count += size_t(grid->micropolygon_count());
    return count;
  }

 private:
  static constexpr double fov_degrees = 40, pi = 3.14159265358979, near_clip = 0.1;
  static constexpr int grid_size = 32;

  static CameraSettings settings(int width, int height, double focus_depth,
                                 double aperture_radius) {
    CameraSettings s;
    s.projection = Projection::perspective;
    s.fov_degrees = fov_degrees;
    s.x_resolution = width, s.y_resolution = height;
    s.near_clip = near_clip;
    if (aperture_radius > 0)
      s.lens = CameraSettings::ThinLens{0.5 / aperture_radius, 1.0, focus_depth};
    return s;
  }

  /// Camera-space position at `time` shutters of the scene after mid-shutter.
  glm::dvec3 seen_at(const glm::dvec3& world, const glm::dvec3& velocity, double time) const {
    const glm::dvec3 p = world + (velocity - dolly_) * time;
    const double c = std::cos(yaw_ * time), s = std::sin(yaw_ * time);
    return {c * p.x - s * p.z, p.y, s * p.x + c * p.z};
  }
  /// What is nearer than the near plane counts as on it: dicing needs no more.
  glm::dvec2 raster(const glm::dvec3& p) const {
    const glm::vec3 clip = camera.raster_clip_from_camera(p);
    return glm::dvec2(clip.x, clip.y) / std::max(double(clip.z), near_clip);
  }

  /// From the longest of a few lines of the patch on screen.
  int quads_along(const Surface& surface, bool along_u, double edge) const {
    constexpr int lines = 4, steps = 16;
    double longest = 0;
    for (int line = 0; line <= lines; ++line) {
      double length = 0;
      const double across = double(line) / lines;
      for (int k = 0; k < steps; ++k) {
        const double a = double(k) / steps, b = double(k + 1) / steps;
        length += along_u ? glm::distance(raster(surface(a, across)), raster(surface(b, across)))
                          : glm::distance(raster(surface(across, a)), raster(surface(across, b)));
      }
      longest = std::max(longest, length);
    }
    return std::max(1, int(std::ceil(longest / edge)));
  }

  void add_grid(const Surface& surface, const glm::dvec3& velocity, glm::ivec2 first,
                glm::ivec2 total) {
    auto grid = std::make_unique<Grid>();
    grid->u_count = std::min(grid_size, total.x - first.x);
    grid->v_count = std::min(grid_size, total.y - first.y);
    if (moves()) grid->key_times = {0, 1};
    grid->P_camera.assign(size_t(grid->key_count()) * 3 * grid->stride(), 0.0f);
    grid->z_min = 1e30f, grid->z_max = -1e30f;
    const auto world = [&](int i, int j) {
      return surface(double(first.x + i) / total.x, double(first.y + j) / total.y);
    };
    for (int key = 0; key < grid->key_count(); ++key)
      for (int j = 0; j <= grid->v_count; ++j)
        for (int i = 0; i <= grid->u_count; ++i) {
          const double time = moves() ? effects_.motion * (key - 0.5) : 0.0;
          const glm::dvec3 p = seen_at(world(i, j), velocity, time);
          const int vertex = j * (grid->u_count + 1) + i;
          for (int axis = 0; axis < 3; ++axis) grid->P(key, axis)[vertex] = float(p[axis]);
          add_to_bounds(*grid, p);
        }
    // Bounds of positions divided by W hold only for what stays in front of the eye.
    if (grid->z_min < float(near_clip)) grid->raster_bounds = RasterBounds::everything();
    for (int j = 0; j < grid->v_count; ++j)
      for (int i = 0; i < grid->u_count; ++i)
        measure(world(i, j), world(i + 1, j), world(i, j + 1), world(i + 1, j + 1));
    grids.push_back(std::move(grid));
  }

  void add_to_bounds(Grid& grid, const glm::dvec3& p) const {
    const glm::dvec2 at = raster(p);
    const auto depth = float(std::max(p.z, near_clip));
    const glm::vec2 radius = lens() ? glm::abs(camera.coc_raster(depth)) : glm::vec2(0.0f);
    const float slack = 0.01f, x = float(at.x), y = float(at.y);
    grid.raster_bounds.add(x - radius.x - slack, y - radius.y - slack);
    grid.raster_bounds.add(x + radius.x + slack, y + radius.y + slack);
    grid.z_min = std::min(grid.z_min, float(p.z)), grid.z_max = std::max(grid.z_max, float(p.z));
  }

  /// Adds a quad's screen area, half the cross product of its diagonals, if it is in the frame.
  void measure(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    if (std::min({a.z, b.z, c.z, d.z}) < near_clip) return;
    const glm::dvec2 ad = raster(d) - raster(a), bc = raster(c) - raster(b);
    const glm::dvec2 middle = 0.5 * (raster(a) + raster(d));
    if (!camera.frame().contains(int(middle.x), int(middle.y))) return;
    area_ += 0.5 * std::abs(ad.x * bc.y - ad.y * bc.x);
    ++quads_in_frame_;
  }

  SteEffects effects_;
  glm::dvec3 dolly_{0.0};
  double yaw_ = 0;
  double area_ = 0, quads_in_frame_ = 0;
};

}  // namespace tessera
