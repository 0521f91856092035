#pragma once
/// What the scenes of bench/maaf.cpp are built from: RIB text of rounded solids, turned shapes,
/// rods and lights. Units are metres; y is up, and the world is left-handed, as camera space is.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "bench/shading_rib.h"

namespace tessera {

/// What a scene is asked for.
struct MaafSceneRequest {
  int width = 720, height = 405;
  int side_samples = 4;  ///< samples per pixel is their square
  /// A pointlight of the same power in place of each light with extent, ambient light in place of
  /// bounces: what the scene looks like where no rays can be traced.
  bool stand_in_lights = false;
};

/// The share of each colour of light that a surface reflects.
using Albedo = glm::dvec3;

class MaafRib : public RibText {
 public:
  explicit MaafRib(const MaafSceneRequest& request) : request_(request) {}

  /// The frame, and a camera that is sharp at `focus_depth`; see RibText::options().
  void view(const CameraPose& pose, double fov_degrees, double aperture_radius,
            double focus_depth) {
    ShadingSceneRequest frame;
    frame.width = request_.width, frame.height = request_.height;
    frame.side_samples = request_.side_samples;
    frame.motion = 0;
    options(frame, fov_degrees, aperture_radius, focus_depth);
    camera([&](double) { return pose; }, 0);
  }

  // --- Materials ---

  void matte(const Albedo& color) { add("Surface \"matte\" Color {}", list(color)); }
  /// `frequency` squares per unit of st.
  void checker(const Albedo& color, const Albedo& other, double frequency) {
    add("Surface \"checker\" \"frequency\" [{}] \"color blackcolor\" {} Color {}", frequency,
        list(other), list(color));
  }
  void glow(const glm::dvec3& radiance) { add("Surface \"constant\" Color {}", list(radiance)); }

  // --- Lights ---

  /// Shines from `center` along `direction`, its width level. `radiance` in all directions.
  void rectangle_light(int handle, const glm::dvec3& center, const glm::dvec3& direction,
                       double width, double height, double radiance, const glm::dvec3& color) {
    if (request_.stand_in_lights)
      return point_light(handle, center, radiance * width * height, color);
    add("TransformBegin");
    frame_at(center, direction);
    add("LightSource \"rectanglelight\" {} \"float width\" [{}] \"float height\" [{}] {}", handle,
        width, height, strength(radiance, color));
    add("TransformEnd");
  }
  void sphere_light(int handle, const glm::dvec3& center, double radius, double radiance,
                    const glm::dvec3& color) {
    if (request_.stand_in_lights)
      return point_light(handle, center, radiance * std::numbers::pi * radius * radius, color);
    add("TransformBegin Translate {}", plain(center));
    add("LightSource \"spherelight\" {} \"float radius\" [{}] {}", handle, radius,
        strength(radiance, color));
    add("TransformEnd");
  }
  /// A sphere that is seen and shines. Call it outside of all attribute blocks.
  void shining_sphere(int handle, const glm::dvec3& center, double radius, double radiance,
                      const glm::dvec3& color) {
    attribute([&] {
      if (!request_.stand_in_lights)
        add("AreaLightSource \"arealight\" {} {}", handle, strength(radiance, color));
      // What shines adds its radiance to what the shader says.
      glow(request_.stand_in_lights ? color : glm::dvec3(0));
      add("Translate {} Sphere {r} {} {r} 360", plain(center), -radius, fmt::arg("r", radius));
    });
    if (request_.stand_in_lights)
      return point_light(handle, center, radiance * std::numbers::pi * radius * radius, color);
    add("Illuminate {} 1", handle);
  }
  /// One bounce of diffuse light; in its place `stand_in` of ambient light.
  void bounce(int handle, double stand_in) {
    if (request_.stand_in_lights)
      add("LightSource \"ambientlight\" {} \"intensity\" [{}]", handle, stand_in);
    else
      add("LightSource \"indirectlight\" {} \"float intensity\" [1]", handle);
  }

  // --- Shapes ---

  void ball(const glm::dvec3& center, const glm::dvec3& radii) {
    add("TransformBegin Translate {} Scale {} Sphere 1 -1 1 360 TransformEnd", plain(center),
        plain(radii));
  }
  /// A round bar from `a` to `b`, open at its ends.
  void rod(const glm::dvec3& a, const glm::dvec3& b, double radius_a, double radius_b) {
    add("TransformBegin");
    frame_at(a, b - a);
    add("Hyperboloid {} 0 0 {} 0 {} 360 TransformEnd", radius_a, radius_b, glm::length(b - a));
  }
  /// About the vertical axis through `center`.
  void ring(const glm::dvec3& center, double radius, double thickness) {
    add("TransformBegin Translate {} Rotate -90 1 0 0 Torus {} {} 0 360 360 TransformEnd",
        plain(center), radius, thickness);
  }
  void disk(const glm::dvec3& center, double radius) {
    add("TransformBegin Translate {} Rotate -90 1 0 0 Disk 0 {} 360 TransformEnd", plain(center),
        radius);
  }

  /// A box of six polygons around `center`.
  void block(const glm::dvec3& center, const glm::dvec3& half) {
    text_of_cage(Cage{{-half.x, half.x}, {-half.y, half.y}, {-half.z, half.z}}, center, false);
  }
  /// The cells that `solid` keeps of the grid of planes x[i], y[j] and z[k].
  struct Cage {
    std::vector<double> x, y, z;
    std::function<bool(int i, int j, int k)> solid = [](int, int, int) { return true; };
    std::function<glm::dvec3(const glm::dvec3&)> bend = [](const glm::dvec3& p) { return p; };
  };
  /// The subdivision surface of a cage: rounder the wider its outer cells.
  void smooth_cage(const Cage& cage, const glm::dvec3& center = glm::dvec3(0)) {
    text_of_cage(cage, center, true);
  }
  /// A box whose edges are rounded by about `round`.
  void pillow(const glm::dvec3& center, const glm::dvec3& half, double round) {
    const auto planes = [&](double h) {
      const double r = std::min(round, 0.9 * h);
      return std::vector<double>{-h, r - h, h - r, h};
    };
    smooth_cage({planes(half.x), planes(half.y), planes(half.z)}, center);
  }

  /// A solid of revolution about the vertical through `center`: a smooth surface near the profile's
  /// points (radius, height).
  void turned(const glm::dvec3& center, const std::vector<glm::dvec2>& profile,
              const glm::dvec2& st_repeats = {1, 1}) {
    constexpr int around = 12;
    sheet({around, int(profile.size()), true, st_repeats}, [&](int i, int j) {
      const double angle = 2 * std::numbers::pi * i / around;
      const glm::dvec2& p = profile[size_t(j)];
      // The limit surface runs inside its control points by about this share.
      const double r = 1.05 * std::max(p.x, 1e-4);
      return center + glm::dvec3(r * std::cos(angle), p.y, r * std::sin(angle));
    });
  }
  /// A tube along the control points of a smooth curve.
  void tube(const std::vector<glm::dvec3>& path, const std::function<double(double s)>& radius) {
    constexpr int around = 7;
    const int along = int(path.size());
    sheet({around, along, true}, [&](int i, int j) {
      const glm::dvec3 way = glm::normalize(path[size_t(std::min(j + 1, along - 1))] -
                                            path[size_t(std::max(j - 1, 0))]);
      const auto [x, y] = across(way);
      const double angle = 2 * std::numbers::pi * i / around;
      return path[size_t(j)] +
             radius(double(j) / (along - 1)) * (std::cos(angle) * x + std::sin(angle) * y);
    });
  }

  // --- Placing ---

  /// The origin at `origin`, z along `direction`, x level.
  void frame_at(const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec3 z = glm::normalize(direction);
    const auto [x, y] = across(z);
    add("ConcatTransform [{} 0 {} 0 {} 0 {} 1]", plain(x), plain(y), plain(z), plain(origin));
  }
  /// What `content` adds, moved and then turned about its own vertical.
  void placed(const glm::dvec3& origin, double turn_degrees, const std::function<void()>& content) {
    attribute([&] {
      add("Translate {} Rotate {} 0 1 0", plain(origin), turn_degrees);
      content();
    });
  }

  /// In [0, 1), the same for the same numbers.
  static double pick(int a, int b) {
    return std::abs(std::fmod(std::sin(12.9898 * a + 78.233 * b) * 43758.5453, 1.0));
  }

 private:
  static std::string plain(const glm::dvec3& v) {
    return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
  }
  static std::string list(const glm::dvec3& v) { return fmt::format("[{}]", plain(v)); }
  static std::string strength(double radiance, const glm::dvec3& color) {
    return fmt::format("\"float intensity\" [{:.6g}] \"color lightcolor\" {}", radiance,
                       list(color));
  }
  /// Two unit vectors that make a right-handed frame with `z`, of unit length; the first is level.
  static std::pair<glm::dvec3, glm::dvec3> across(const glm::dvec3& z) {
    const glm::dvec3 aside = std::abs(z.y) > 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(aside, z));
    return {x, glm::cross(z, x)};
  }
  /// A small light of radiance L and area A is a point of intensity L A / pi.
  void point_light(int handle, const glm::dvec3& center, double radiance_area,
                   const glm::dvec3& color) {
    add("LightSource \"pointlight\" {} \"intensity\" [{:.6g}] \"lightcolor\" {} \"from\" {}",
        handle, radiance_area / std::numbers::pi, list(color), list(center));
  }
  void text_of_cage(const Cage& cage, const glm::dvec3& center, bool smooth);

  MaafSceneRequest request_;
};

/// The faces between a solid cell and one that is none, their corners in one turning sense as seen
/// from outside.
inline void MaafRib::text_of_cage(const Cage& cage, const glm::dvec3& center, bool smooth) {
  const glm::ivec3 cells(cage.x.size() - 1, cage.y.size() - 1, cage.z.size() - 1);
  const auto solid = [&](const glm::ivec3& c) {
    for (int axis = 0; axis < 3; ++axis)
      if (c[axis] < 0 || c[axis] >= cells[axis]) return false;
    return cage.solid(c.x, c.y, c.z);
  };
  std::map<std::array<int, 3>, int> number;
  std::string corners, positions;
  int faces = 0;
  const auto corner = [&](const glm::ivec3& c) {
    const auto [entry, is_new] = number.try_emplace({c.x, c.y, c.z}, int(number.size()));
    if (is_new) {
      const glm::dvec3 P(cage.x[size_t(c.x)], cage.y[size_t(c.y)], cage.z[size_t(c.z)]);
      positions += plain(center + cage.bend(P)) + " ";
    }
    corners += std::to_string(entry->second) + " ";
  };
  const auto face = [&](const glm::ivec3& cell, int axis, int side) {
    glm::ivec3 neighbour = cell, u(0), v(0), low = cell;
    neighbour[axis] += side ? 1 : -1;
    if (solid(neighbour)) return;
    low[axis] += side;
    u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = 1;
    if (!side) std::swap(u, v);
    for (const glm::ivec3& c : {low, low + v, low + u + v, low + u}) corner(c);
    ++faces;
  };
  for (int k = 0; k < cells.z; ++k)
    for (int j = 0; j < cells.y; ++j)
      for (int i = 0; i < cells.x; ++i)
        if (solid({i, j, k}))
          for (int axis = 0; axis < 3; ++axis)
            for (const int side : {0, 1}) face({i, j, k}, axis, side);
  std::string fours;
  for (int f = 0; f < faces; ++f) fours += "4 ";
  if (smooth)
    add("SubdivisionMesh \"catmull-clark\" [{}] [{}] [\"interpolateboundary\"] [0 0] [] [] "
        "\"P\" [{}]",
        fours, corners, positions);
  else
    add("PointsPolygons [{}] [{}] \"P\" [{}]", fours, corners, positions);
}

}  // namespace tessera
