#pragma once
/// Stage header: the calls a scene format makes. A reader (scenes/rib/ is one) turns its input into
/// these calls; SceneBuilder turns the calls into Scenes and RibWriter prints them back. Names and
/// meanings follow the RenderMan Interface 3.2, with matrices in the column-vector convention and
/// every angle already part of a matrix.
///
/// A reader promises: numbers are finite, parameters carry their resolved type and hold a whole
/// number of values. Everything else (ranges, counts, indices, nesting) is for the receiver to
/// check.

#include <array>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "cameras/camera_settings.h"
#include "scenes/geometry.h"
#include "scenes/scene.h"

namespace tessera {

/// Options: frozen when a world begins.
namespace option_call {
struct Format {
  int x_resolution, y_resolution;  ///< pixels; not positive: the default
  double pixel_aspect;             ///< not positive: the default
};
struct FrameAspectRatio {
  double ratio;
};
struct ScreenWindow {
  CameraSettings::ScreenWindow window;
};
struct CropWindow {
  CameraSettings::CropWindow window;
};
struct Projection {
  std::string name;  ///< "perspective" (with "fov", degrees) or "orthographic"
  std::vector<Parameter> parameters;
};
struct Clipping {
  double near_z, far_z;
};
struct DepthOfField {
  std::optional<CameraSettings::ThinLens> lens;  ///< absent: pinhole
};
struct Shutter {
  double open, close;  ///< scene time
};
struct PixelSamples {
  double x, y;
};
struct PixelFilter {
  std::string name;
  double x_width, y_width;  ///< pixels
};
struct Exposure {
  double gain, gamma;
};
/// Replaces the displays declared so far unless `add` is set.
struct AddDisplay {
  Display display;
  bool add = false;
};
struct Hider {
  std::string name;
  std::vector<Parameter> parameters;
};
struct User {
  std::string category;
  std::vector<Parameter> parameters;
};
/// Not part of the state: a job for once all frames before it are rendered.
struct MakeShadow {
  std::string picture;  ///< a depth file
  std::string shadow;   ///< the shadow map to make of it
};
}  // namespace option_call

using OptionCall =
    std::variant<option_call::Format, option_call::FrameAspectRatio, option_call::ScreenWindow,
                 option_call::CropWindow, option_call::Projection, option_call::Clipping,
                 option_call::DepthOfField, option_call::Shutter, option_call::PixelSamples,
                 option_call::PixelFilter, option_call::Exposure, option_call::AddDisplay,
                 option_call::Hider, option_call::User, option_call::MakeShadow>;

/// Attributes: hold for the shapes that follow, to the end of the attribute block.
namespace attribute_call {
struct Color {
  glm::vec3 rgb;
};
struct Opacity {
  glm::vec3 rgb;
};
/// A surface or displacement shader; an empty name removes it.
struct Shader {
  enum class Slot { surface, displacement };
  Slot slot;
  std::string name;
  std::vector<Parameter> parameters;
};
struct Illuminate {
  std::string handle;
  bool on;
};
struct ShadingRate {
  double area;  ///< pixels^2
};
struct ShadingInterpolation {
  bool smooth;
};
struct Sides {
  int count;  ///< 1 or 2
};
struct Orientation {
  enum class Kind { outside, inside, left_handed, right_handed };
  Kind kind;
};
struct ReverseOrientation {};
struct Matte {
  bool on;
};
struct TextureCoordinates {
  std::array<glm::vec2, 4> st;
};
struct GeometricApproximation {
  std::string kind;  ///< "motionfactor", "focusfactor"; others are kept unread
  double value;
};
struct Basis {
  PatchMesh::Basis u, v;
  int u_step, v_step;
};
struct User {
  std::string category;
  std::vector<Parameter> parameters;
};
}  // namespace attribute_call

using AttributeCall = std::variant<
    attribute_call::Color, attribute_call::Opacity, attribute_call::Shader,
    attribute_call::Illuminate, attribute_call::ShadingRate, attribute_call::ShadingInterpolation,
    attribute_call::Sides, attribute_call::Orientation, attribute_call::ReverseOrientation,
    attribute_call::Matte, attribute_call::TextureCoordinates,
    attribute_call::GeometricApproximation, attribute_call::Basis, attribute_call::User>;

/// Changes of the current transform, outer_from_current. "outer" is camera space before the world
/// begins, and world space or the space of the object definition after that.
namespace transform_call {
struct Set {
  glm::dmat4 matrix;
};
/// Applied to points before the current transform.
struct Concat {
  glm::dmat4 matrix;
};
struct Perspective {
  double fov_degrees;
};
/// Gives the current space a name.
struct NameSpace {
  std::string name;
};
/// Makes a named space, "world" or "camera" the current one.
struct UseSpace {
  std::string name;
};
}  // namespace transform_call

using TransformCall =
    std::variant<transform_call::Set, transform_call::Concat, transform_call::Perspective,
                 transform_call::NameSpace, transform_call::UseSpace>;

/// A light, switched on from here on. An area light with an empty name ends the current area light.
struct LightCall {
  std::string name, handle;
  std::vector<Parameter> parameters;
  bool area = false;
};

/// A shape with its control points ("P", "Pw" or "Pz") and primitive variables among `parameters`.
/// Of a PatchMesh the bases and steps, and of a Quadric all keys but the first, are left to the
/// receiver; NurbsPatch::weights too.
struct ShapeCall {
  Shape shape;
  std::vector<Parameter> parameters;
};

enum class BlockKind { frame, world, attribute, transform, object, motion };
/// The name of the request that begins such a block, without "Begin": "Frame", "World", ...
const char* name_of(BlockKind kind);

/// The start of a block. Only the member that belongs to `kind` is used.
struct BlockCall {
  BlockKind kind;
  int frame_number = 0;
  std::string object_handle;
  std::vector<double> motion_times;  ///< scene time; one call inside the block for each
};

/// The interface. Every call may throw Error with the location it is given.
class SceneCalls {
 public:
  virtual ~SceneCalls() = default;
  virtual void begin(const BlockCall& block, const SourceLocation& where) = 0;
  virtual void end(BlockKind kind, const SourceLocation& where) = 0;
  virtual void option(const OptionCall& call, const SourceLocation& where) = 0;
  virtual void attribute(const AttributeCall& call, const SourceLocation& where) = 0;
  virtual void transform(const TransformCall& call, const SourceLocation& where) = 0;
  virtual void light(const LightCall& call, const SourceLocation& where) = 0;
  virtual void shape(ShapeCall call, const SourceLocation& where) = 0;
  virtual void instance(const std::string& object_handle, const SourceLocation& where) = 0;
  /// The input has ended. Throws when a block is still open.
  virtual void finish(const SourceLocation& where) = 0;
  /// False once nobody wants the rest of the input.
  virtual bool wants_more() const { return true; }
};

}  // namespace tessera
