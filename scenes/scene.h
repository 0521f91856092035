#pragma once
/// Stage header: scenes. A scene file goes in, an immutable Scene comes out: one per frame, shared
/// between threads, owning all its memory. scenes/rib/ reads RIB through scene_builder.h, and any
/// other format would do the same.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cameras/camera_settings.h"
#include "scenes/geometry.h"

namespace tessera {

/// A shader (surface, displacement, light) called by name with parameters. Values of point, vector,
/// normal and matrix parameters are in the shader's own space.
struct ShaderCall {
  std::string name;
  std::vector<Parameter> parameters;
  MovingTransform world_from_shader;
  SourceLocation where;
};

/// Everything a surface carries besides its shape. Shared by all surfaces declared under it.
struct Attributes {
  glm::vec3 color{1.0f}, opacity{1.0f};
  std::optional<ShaderCall> surface, displacement;
  /// Indices into Scene::lights of the lights switched on, ascending.
  std::vector<int> lights;
  /// Index into Scene::lights of the area light this surface is part of, if any.
  std::optional<int> area_light;
  float shading_rate = 1.0f;   ///< area of a shading cell, pixels^2
  bool smooth_shading = true;  ///< ShadingInterpolation "smooth"; otherwise constant
  bool two_sided = true;       ///< Sides 2
  bool matte = false;
  std::array<glm::vec2, 4> texture_coordinates{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
  std::string name;                 ///< Attribute "identifier" "name"
  float displacement_bound = 0.0f;  ///< largest distance a point may move, world units
  std::optional<float> motion_factor, focus_factor;  ///< GeometricApproximation, if given
  /// Attribute requests nobody interpreted, as "category:name" -> parameter.
  std::map<std::string, Parameter> user;
};

/// One shape placed in the world. `id` is its place in Scene::surfaces, in scene-file order.
struct Surface {
  int id = 0;
  std::shared_ptr<const Geometry> geometry;
  std::shared_ptr<const Attributes> attributes;
  MovingTransform world_from_object;
  /// Orientation in force: the outward normal is cross(dP/du, dP/dv) computed in world space,
  /// times -1 when this is set. Covers Orientation, ReverseOrientation and reflections.
  bool flip_normal = false;
};

struct Light {
  ShaderCall shader;
  bool area =
      false;  ///< AreaLightSource: the surfaces that name it as Attributes::area_light shine
  std::string handle;  ///< as the scene file names it
  /// Attribute "light" "string shadow" (or "shadows") in force where it is declared; "" = not
  /// given.
  std::string shadow{};
};

/// One image to write. `mode` is rgb, rgba, a, z, or the name of one AOV or more ("rgbaz", "P",
/// "N", "st", "Ci", "Oi", "motion", "id").
struct Display {
  std::string file, type, mode;
  std::vector<Parameter> parameters;
  SourceLocation where;
};

struct SceneOptions {
  std::string hider;  ///< "" = not given
  std::vector<Parameter> hider_parameters;
  int x_samples = 4, y_samples = 4;  ///< samples per pixel is their product
  std::string filter = "gaussian";
  float filter_x_width = 2.0f, filter_y_width = 2.0f;  ///< full width, pixels
  float exposure_gain = 1.0f, exposure_gamma = 1.0f;
  std::optional<int> bucket_size;  ///< pixels, Option "limits" "bucketsize"
  std::optional<int> grid_size;    ///< micropolygons, Option "limits" "gridsize"
  std::vector<std::string> texture_path, shader_path, archive_path, procedural_path;
  /// Option requests nobody interpreted, as "category:name" -> parameter.
  std::map<std::string, Parameter> user;
};

struct Scene {
  std::string file;      ///< the scene file, as named by the user
  int frame_number = 0;  ///< argument of FrameBegin; 0 outside a frame block
  CameraSettings camera;
  SceneOptions options;
  std::vector<Display> displays;
  std::vector<Light> lights;
  std::vector<Surface> surfaces;
  /// Named coordinate systems, world_from_NAME.
  std::map<std::string, MovingTransform> coordinate_systems;
};

}  // namespace tessera
