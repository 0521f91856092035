#include "scenes/rib/rib_writer.h"

#include <ostream>

#include "scenes/rib/rib_text.h"

namespace tessera {

namespace {

using namespace rib_text;

struct OptionText {
  std::string operator()(const option_call::Format& c) const {
    return fmt::format("Format {} {} {}", c.x_resolution, c.y_resolution, c.pixel_aspect);
  }
  std::string operator()(const option_call::FrameAspectRatio& c) const {
    return fmt::format("FrameAspectRatio {}", c.ratio);
  }
  std::string operator()(const option_call::ScreenWindow& c) const {
    const auto& w = c.window;
    return fmt::format("ScreenWindow {} {} {} {}", w.left, w.right, w.bottom, w.top);
  }
  std::string operator()(const option_call::CropWindow& c) const {
    const auto& w = c.window;
    return fmt::format("CropWindow {} {} {} {}", w.x_min, w.x_max, w.y_min, w.y_max);
  }
  std::string operator()(const option_call::Projection& c) const {
    return "Projection " + quoted(c.name) + parameters(c.parameters);
  }
  std::string operator()(const option_call::Clipping& c) const {
    return fmt::format("Clipping {} {}", c.near_z, c.far_z);
  }
  std::string operator()(const option_call::DepthOfField& c) const {
    if (!c.lens) return "DepthOfField";
    return fmt::format("DepthOfField {} {} {}", c.lens->f_stop, c.lens->focal_length,
                       c.lens->focal_distance);
  }
  std::string operator()(const option_call::Shutter& c) const {
    return fmt::format("Shutter {} {}", c.open, c.close);
  }
  std::string operator()(const option_call::PixelSamples& c) const {
    return fmt::format("PixelSamples {} {}", c.x, c.y);
  }
  std::string operator()(const option_call::PixelFilter& c) const {
    return fmt::format("PixelFilter {} {} {}", quoted(c.name), c.x_width, c.y_width);
  }
  std::string operator()(const option_call::Exposure& c) const {
    return fmt::format("Exposure {} {}", c.gain, c.gamma);
  }
  std::string operator()(const option_call::AddDisplay& c) const {
    return fmt::format("Display {} {} {}{}", quoted((c.add ? "+" : "") + c.display.file),
                       quoted(c.display.type), quoted(c.display.mode),
                       parameters(c.display.parameters));
  }
  std::string operator()(const option_call::Hider& c) const {
    return "Hider " + quoted(c.name) + parameters(c.parameters);
  }
  std::string operator()(const option_call::User& c) const {
    return "Option " + quoted(c.category) + parameters(c.parameters);
  }
  std::string operator()(const option_call::MakeShadow& c) const {
    return "MakeShadow " + quoted(c.picture) + " " + quoted(c.shadow);
  }
};

struct AttributeText {
  std::string operator()(const attribute_call::Color& c) const {
    return fmt::format("Color [{} {} {}]", c.rgb.x, c.rgb.y, c.rgb.z);
  }
  std::string operator()(const attribute_call::Opacity& c) const {
    return fmt::format("Opacity [{} {} {}]", c.rgb.x, c.rgb.y, c.rgb.z);
  }
  std::string operator()(const attribute_call::Shader& c) const {
    const bool surface = c.slot == attribute_call::Shader::Slot::surface;
    return (surface ? "Surface " : "Displacement ") + quoted(c.name) + parameters(c.parameters);
  }
  std::string operator()(const attribute_call::Illuminate& c) const {
    return fmt::format("Illuminate {} {:d}", quoted(c.handle), c.on);
  }
  std::string operator()(const attribute_call::ShadingRate& c) const {
    return fmt::format("ShadingRate {}", c.area);
  }
  std::string operator()(const attribute_call::ShadingInterpolation& c) const {
    return fmt::format("ShadingInterpolation \"{}\"", c.smooth ? "smooth" : "constant");
  }
  std::string operator()(const attribute_call::Sides& c) const {
    return fmt::format("Sides {}", c.count);
  }
  std::string operator()(const attribute_call::Orientation& c) const {
    static constexpr const char* names[] = {"outside", "inside", "lh", "rh"};
    return fmt::format("Orientation \"{}\"", names[int(c.kind)]);
  }
  std::string operator()(const attribute_call::ReverseOrientation&) const {
    return "ReverseOrientation";
  }
  std::string operator()(const attribute_call::Matte& c) const {
    return fmt::format("Matte {:d}", c.on);
  }
  std::string operator()(const attribute_call::TextureCoordinates& c) const {
    std::vector<float> numbers;
    for (const glm::vec2& st : c.st) numbers.insert(numbers.end(), {st.x, st.y});
    return "TextureCoordinates " + array(numbers);
  }
  std::string operator()(const attribute_call::GeometricApproximation& c) const {
    return fmt::format("GeometricApproximation {} {}", quoted(c.kind), c.value);
  }
  std::string operator()(const attribute_call::Basis& c) const {
    return fmt::format("Basis {} {} {} {}", array(c.u), c.u_step, array(c.v), c.v_step);
  }
  std::string operator()(const attribute_call::User& c) const {
    return "Attribute " + quoted(c.category) + parameters(c.parameters);
  }
};

struct TransformText {
  std::string operator()(const transform_call::Set& c) const {
    return "Transform " + matrix(c.matrix);
  }
  std::string operator()(const transform_call::Concat& c) const {
    return "ConcatTransform " + matrix(c.matrix);
  }
  std::string operator()(const transform_call::Perspective& c) const {
    return fmt::format("Perspective {}", c.fov_degrees);
  }
  std::string operator()(const transform_call::NameSpace& c) const {
    return "CoordinateSystem " + quoted(c.name);
  }
  std::string operator()(const transform_call::UseSpace& c) const {
    return "CoordSysTransform " + quoted(c.name);
  }
};

/// The tags of a subdivision mesh, written one edge and one vertex at a time.
std::string subdivision_tags(const SubdivisionMesh& mesh) {
  std::vector<std::string> names;
  std::vector<int> counts, integers;
  std::vector<float> floats;
  const auto tag = [&](const char* name, std::vector<int> values, std::vector<float> sharpness) {
    names.push_back(name);
    counts.insert(counts.end(), {int(values.size()), int(sharpness.size())});
    integers.insert(integers.end(), values.begin(), values.end());
    floats.insert(floats.end(), sharpness.begin(), sharpness.end());
  };
  for (const auto& crease : mesh.creases) tag("crease", {crease.v0, crease.v1}, {crease.sharpness});
  for (const auto& corner : mesh.corners) tag("corner", {corner.vertex}, {corner.sharpness});
  if (!mesh.holes.empty()) tag("hole", mesh.holes, {});
  if (mesh.boundary != SubdivisionMesh::Boundary::none)
    tag("interpolateboundary", {int(mesh.boundary)}, {});
  if (mesh.facevarying_boundary != 0)
    tag("facevaryinginterpolateboundary", {mesh.facevarying_boundary}, {});
  return fmt::format("{} {} {} {}", string_array(names), array(counts), array(integers),
                     array(floats));
}

struct ShapeText {
  std::string operator()(const SubdivisionMesh& mesh) const {
    const bool loop = mesh.scheme == SubdivisionMesh::Scheme::loop;
    return fmt::format("SubdivisionMesh \"{}\" {} {} {}", loop ? "loop" : "catmull-clark",
                       array(mesh.face_vertex_counts), array(mesh.face_vertices),
                       subdivision_tags(mesh));
  }
  std::string operator()(const PolygonMesh& mesh) const {
    return fmt::format("PointsGeneralPolygons {} {} {}", array(mesh.loops_per_polygon),
                       array(mesh.vertices_per_loop), array(mesh.vertices));
  }
  std::string operator()(const PatchMesh& mesh) const {
    const auto wrap = [](bool periodic) { return periodic ? "periodic" : "nonperiodic"; };
    return fmt::format("PatchMesh \"{}\" {} \"{}\" {} \"{}\"",
                       mesh.bicubic ? "bicubic" : "bilinear", mesh.u_vertices,
                       wrap(mesh.u_periodic), mesh.v_vertices, wrap(mesh.v_periodic));
  }
  std::string operator()(const NurbsPatch& patch) const {
    return fmt::format("NuPatch {} {} {} {} {} {} {} {} {} {}", patch.u_vertices, patch.u_order,
                       array(patch.u_knots), patch.u_min, patch.u_max, patch.v_vertices,
                       patch.v_order, array(patch.v_knots), patch.v_min, patch.v_max);
  }
  std::string operator()(const Quadric& quadric) const {
    static constexpr const char* names[] = {"Sphere",     "Cone", "Cylinder", "Hyperboloid",
                                            "Paraboloid", "Disk", "Torus"};
    return fmt::format("{} {}", names[int(quadric.kind)], array(quadric.parameters.at(0)));
  }
};

}  // namespace

void RibWriter::line(const std::string& text) { out_ << text << '\n'; }

void RibWriter::begin(const BlockCall& block, const SourceLocation&) {
  std::string text = std::string(name_of(block.kind)) + "Begin";
  if (block.kind == BlockKind::frame) text += fmt::format(" {}", block.frame_number);
  if (block.kind == BlockKind::object) text += " " + quoted(block.object_handle);
  if (block.kind == BlockKind::motion) text += " " + array(block.motion_times);
  line(text);
}

void RibWriter::end(BlockKind kind, const SourceLocation&) {
  line(std::string(name_of(kind)) + "End");
}

void RibWriter::option(const OptionCall& call, const SourceLocation&) {
  line(std::visit(OptionText{}, call));
}

void RibWriter::attribute(const AttributeCall& call, const SourceLocation&) {
  line(std::visit(AttributeText{}, call));
}

void RibWriter::transform(const TransformCall& call, const SourceLocation&) {
  line(std::visit(TransformText{}, call));
}

void RibWriter::light(const LightCall& call, const SourceLocation&) {
  line(fmt::format("{} {} {}{}", call.area ? "AreaLightSource" : "LightSource", quoted(call.name),
                   quoted(call.handle), parameters(call.parameters)));
}

void RibWriter::shape(ShapeCall call, const SourceLocation&) {
  line(std::visit(ShapeText{}, call.shape) + parameters(call.parameters));
}

void RibWriter::instance(const std::string& object_handle, const SourceLocation&) {
  line("ObjectInstance " + quoted(object_handle));
}

}  // namespace tessera
