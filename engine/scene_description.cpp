#include "engine/scene_description.h"

#include <map>
#include <set>

#include <fmt/format.h>

namespace tessera {
namespace {

struct Line {
  std::string text;
  template <class... Args>
  Line(const char* name, fmt::format_string<Args...> format, Args&&... args)
      : text(fmt::format("  {:<16} {}\n", name, fmt::format(format, std::forward<Args>(args)...))) {
  }
};

const char* kind_of(const Quadric& quadric) {
  switch (quadric.kind) {
    case Quadric::Kind::sphere:
      return "sphere";
    case Quadric::Kind::cone:
      return "cone";
    case Quadric::Kind::cylinder:
      return "cylinder";
    case Quadric::Kind::hyperboloid:
      return "hyperboloid";
    case Quadric::Kind::paraboloid:
      return "paraboloid";
    case Quadric::Kind::disk:
      return "disk";
    case Quadric::Kind::torus:
      return "torus";
  }
  return "quadric";
}

/// What a shape is called, and the number of its faces, polygons or patches.
struct ShapeSummary {
  std::string kind;
  size_t faces;
};

ShapeSummary summarize(const Shape& shape) {
  struct Visitor {
    ShapeSummary operator()(const SubdivisionMesh& mesh) const {
      const bool loop = mesh.scheme == SubdivisionMesh::Scheme::loop;
      return {loop ? "loop mesh" : "catmull-clark mesh", mesh.face_vertex_counts.size()};
    }
    ShapeSummary operator()(const PolygonMesh& mesh) const {
      return {"polygon mesh", mesh.loops_per_polygon.size()};
    }
    ShapeSummary operator()(const PatchMesh& mesh) const {
      return {mesh.bicubic ? "bicubic patch mesh" : "bilinear patch mesh",
              size_t(mesh.u_patches()) * size_t(mesh.v_patches())};
    }
    ShapeSummary operator()(const NurbsPatch&) const { return {"nurbs patch", 1}; }
    ShapeSummary operator()(const Quadric& quadric) const { return {kind_of(quadric), 1}; }
  };
  return std::visit(Visitor{}, shape);
}

struct KindTotals {
  size_t surfaces = 0, faces = 0, control_points = 0, moving = 0;
};

std::string describe_surfaces(const Scene& scene) {
  std::map<std::string, KindTotals> kinds;
  std::set<const Geometry*> distinct;
  KindTotals all;
  for (const Surface& surface : scene.surfaces) {
    const Geometry& geometry = *surface.geometry;
    const ShapeSummary summary = summarize(geometry.shape);
    const bool moves = surface.world_from_object.moves() || geometry.key_times.size() > 1;
    distinct.insert(&geometry);
    for (KindTotals* totals : {&kinds[summary.kind], &all}) {
      ++totals->surfaces;
      totals->faces += summary.faces;
      totals->control_points += geometry.P_object.empty() ? 0 : geometry.P_object.front().size();
      totals->moving += moves;
    }
  }
  std::string text =
      Line("surfaces", "{} ({} distinct shapes, {} moving), {} faces, {} control points",
           all.surfaces, distinct.size(), all.moving, all.faces, all.control_points)
          .text;
  for (const auto& [kind, totals] : kinds) {
    text += Line("", "{} {}: {} faces, {} control points", totals.surfaces, kind, totals.faces,
                 totals.control_points)
                .text;
  }
  return text;
}

/// "plastic (3), matte" for the shaders of all surfaces, each set of attributes counted once.
std::string describe_shaders(const Scene& scene) {
  std::set<const Attributes*> seen;
  std::map<std::string, int> surface, displacement;
  for (const Surface& s : scene.surfaces) {
    if (!seen.insert(s.attributes.get()).second) continue;
    ++surface[s.attributes->surface ? s.attributes->surface->name : "(default)"];
    if (s.attributes->displacement) ++displacement[s.attributes->displacement->name];
  }
  const auto list = [](const std::map<std::string, int>& counts) {
    std::string text;
    for (const auto& [name, count] : counts) {
      text += (text.empty() ? "" : ", ") + name;
      if (count > 1) text += fmt::format(" ({})", count);
    }
    return text;
  };
  std::string text = Line("surface shaders", "{}", list(surface)).text;
  if (!displacement.empty()) text += Line("displacements", "{}", list(displacement)).text;
  return text;
}

std::string describe_lights(const Scene& scene) {
  std::string names;
  for (const Light& light : scene.lights) {
    names += fmt::format("{}{}{}", names.empty() ? "" : ", ", light.shader.name,
                         light.area ? " (area)" : "");
  }
  return Line("lights", "{}{}{}", scene.lights.size(), names.empty() ? "" : ": ", names).text;
}

std::string describe_camera(const CameraSettings& camera) {
  std::string text = Line("format", "{} x {}, pixel aspect {}", camera.x_resolution,
                          camera.y_resolution, camera.pixel_aspect)
                         .text;
  const auto& crop = camera.crop;
  text += Line("crop", "{} {} {} {}", crop.x_min, crop.x_max, crop.y_min, crop.y_max).text;
  if (camera.projection == Projection::perspective) {
    text += Line("projection", "perspective, {} degrees", camera.fov_degrees).text;
  } else {
    text += Line("projection", "orthographic").text;
  }
  text += Line("clipping", "{} to {}", camera.near_clip, camera.far_clip).text;
  if (camera.lens) {
    text += Line("lens", "f/{}, focal length {}, focused at {}, {}", camera.lens->f_stop,
                 camera.lens->focal_length, camera.lens->focal_distance, camera.lens_profile)
                .text;
  }
  if (camera.shutter_close > camera.shutter_open) {
    text += Line("shutter", "{} to {}, {}", camera.shutter_open, camera.shutter_close,
                 camera.shutter_profile)
                .text;
  }
  if (camera.camera_from_world.moves()) {
    text += Line("camera motion", "{} keys", camera.camera_from_world.times().size()).text;
  }
  return text;
}

}  // namespace

std::string describe_scene(const Scene& scene) {
  const SceneOptions& options = scene.options;
  std::string text = fmt::format("{}\n", scene.file);
  if (scene.frame_number > 0) text += Line("frame", "{}", scene.frame_number).text;
  text += describe_camera(scene.camera);
  text += Line("samples", "{} x {}", options.x_samples, options.y_samples).text;
  text +=
      Line("filter", "{} {} x {}", options.filter, options.filter_x_width, options.filter_y_width)
          .text;
  text += Line("exposure", "gain {}, gamma {}", options.exposure_gain, options.exposure_gamma).text;
  text += describe_surfaces(scene);
  text += describe_shaders(scene);
  text += describe_lights(scene);
  for (const Display& display : scene.displays) {
    text += Line("display", "{} ({}, {})", display.file, display.type, display.mode).text;
  }
  return text;
}

}  // namespace tessera
