#include "scenes/option_state.h"

#include <algorithm>
#include <cmath>

#include "scenes/search_path.h"

namespace tessera {

namespace {

using namespace option_call;

constexpr int largest_resolution = 1 << 16;  ///< pixels; anything beyond is a slip of the pen
constexpr double largest_samples = 1 << 12;  ///< along one axis of a pixel
constexpr double infinite_f_stop = 1e30;     ///< RI_INFINITY is at least this

/// Applies one option. Overloaded by kind of call.
class Apply {
 public:
  Apply(OptionState& state, const SourceLocation& where, Diagnostics& diagnostics)
      : state_(state), camera_(state.camera), where_(where), diagnostics_(diagnostics) {}

  void operator()(const option_call::Format& call) const;
  void operator()(const FrameAspectRatio& call) const;
  void operator()(const ScreenWindow& call) const;
  void operator()(const CropWindow& call) const;
  void operator()(const option_call::Projection& call) const;
  void operator()(const Clipping& call) const;
  void operator()(const DepthOfField& call) const;
  void operator()(const Shutter& call) const;
  void operator()(const PixelSamples& call) const;
  void operator()(const PixelFilter& call) const;
  void operator()(const Exposure& call) const;
  void operator()(const AddDisplay& call) const;
  void operator()(const Hider& call) const;
  void operator()(const User& call) const;
  void operator()(const MakeShadow&) const {}

 private:
  void expect(bool condition, const std::string& message) const {
    if (!condition) throw Error(where_, message);
  }
  double number(const Parameter& parameter) const;
  const std::string& string(const Parameter& parameter) const;
  int integer(const Parameter& parameter, int least, int most) const;
  void search_path(const Parameter& parameter) const;
  bool limit(const Parameter& parameter) const;
  bool camera_option(const Parameter& parameter) const;

  OptionState& state_;
  CameraSettings& camera_;
  const SourceLocation& where_;
  Diagnostics& diagnostics_;
};

double Apply::number(const Parameter& parameter) const {
  expect(!parameter.numbers.empty(),
         fmt::format("\"{}\": expected a number, found none", parameter.name));
  return double(parameter.numbers.front());
}

const std::string& Apply::string(const Parameter& parameter) const {
  expect(!parameter.strings.empty(),
         fmt::format("\"{}\": expected a string, found none", parameter.name));
  return parameter.strings.front();
}

int Apply::integer(const Parameter& parameter, int least, int most) const {
  const double value = number(parameter);
  expect(value >= least && value <= most,
         fmt::format("\"{}\": expected {} to {}, found {}", parameter.name, least, most, value));
  return int(value);
}

void Apply::operator()(const option_call::Format& call) const {
  const CameraSettings defaults;
  expect(call.x_resolution <= largest_resolution && call.y_resolution <= largest_resolution,
         fmt::format("expected a resolution of at most {} pixels, found {} x {}",
                     largest_resolution, call.x_resolution, call.y_resolution));
  camera_.x_resolution = call.x_resolution > 0 ? call.x_resolution : defaults.x_resolution;
  camera_.y_resolution = call.y_resolution > 0 ? call.y_resolution : defaults.y_resolution;
  camera_.pixel_aspect = call.pixel_aspect > 0 ? call.pixel_aspect : defaults.pixel_aspect;
}

void Apply::operator()(const FrameAspectRatio& call) const {
  expect(call.ratio > 0, fmt::format("expected a positive aspect ratio, found {}", call.ratio));
  camera_.frame_aspect = call.ratio;
}

void Apply::operator()(const ScreenWindow& call) const {
  const auto& w = call.window;
  expect(w.left != w.right && w.bottom != w.top,
         fmt::format("expected a screen window with an area, found {} {} {} {}", w.left, w.right,
                     w.bottom, w.top));
  camera_.screen_window = w;
}

void Apply::operator()(const CropWindow& call) const {
  CameraSettings::CropWindow w = call.window;
  for (double* edge : {&w.x_min, &w.x_max, &w.y_min, &w.y_max}) *edge = std::clamp(*edge, 0.0, 1.0);
  expect(w.x_min < w.x_max && w.y_min < w.y_max,
         fmt::format("expected xmin < xmax and ymin < ymax within [0, 1], found {} {} {} {}",
                     call.window.x_min, call.window.x_max, call.window.y_min, call.window.y_max));
  camera_.crop = w;
}

void Apply::operator()(const option_call::Projection& call) const {
  const bool perspective = call.name == "perspective";
  expect(perspective || call.name == "orthographic",
         fmt::format("expected projection \"perspective\" or \"orthographic\", found \"{}\"",
                     call.name));
  camera_.projection =
      perspective ? tessera::Projection::perspective : tessera::Projection::orthographic;
  state_.projection_given = true;
  const Parameter* fov = find_parameter(call.parameters, "fov");
  if (!perspective || !fov) return;
  camera_.fov_degrees = number(*fov);
  expect(camera_.fov_degrees > 0 && camera_.fov_degrees < 180,
         fmt::format("\"fov\": expected degrees between 0 and 180, found {}", camera_.fov_degrees));
}

void Apply::operator()(const Clipping& call) const {
  expect(call.near_z < call.far_z,
         fmt::format("expected near < far, found {} and {}", call.near_z, call.far_z));
  camera_.near_clip = call.near_z;
  camera_.far_clip = call.far_z;
}

void Apply::operator()(const DepthOfField& call) const {
  camera_.lens.reset();
  if (!call.lens || call.lens->f_stop >= infinite_f_stop) return;
  const CameraSettings::ThinLens& lens = *call.lens;
  expect(lens.f_stop > 0 && lens.focal_length > 0 && lens.focal_distance > 0,
         fmt::format("expected a positive f-stop, focal length and focal distance, found {} {} {}",
                     lens.f_stop, lens.focal_length, lens.focal_distance));
  camera_.lens = lens;
}

void Apply::operator()(const Shutter& call) const {
  expect(call.open <= call.close,
         fmt::format("expected the shutter to close at or after its opening, found {} and {}",
                     call.open, call.close));
  camera_.shutter_open = call.open;
  camera_.shutter_close = call.close;
}

void Apply::operator()(const PixelSamples& call) const {
  expect(call.x > 0 && call.y > 0 && call.x <= largest_samples && call.y <= largest_samples,
         fmt::format("expected 1 to {} samples along each axis, found {} x {}", largest_samples,
                     call.x, call.y));
  state_.options.x_samples = std::max(1, int(std::lround(call.x)));
  state_.options.y_samples = std::max(1, int(std::lround(call.y)));
}

void Apply::operator()(const PixelFilter& call) const {
  expect(
      call.x_width > 0 && call.y_width > 0,
      fmt::format("expected positive filter widths, found {} and {}", call.x_width, call.y_width));
  state_.options.filter = call.name;
  state_.options.filter_x_width = float(call.x_width);
  state_.options.filter_y_width = float(call.y_width);
}

void Apply::operator()(const Exposure& call) const {
  expect(call.gain >= 0 && call.gamma > 0,
         fmt::format("expected a gain of at least 0 and a positive gamma, found {} and {}",
                     call.gain, call.gamma));
  state_.options.exposure_gain = float(call.gain);
  state_.options.exposure_gamma = float(call.gamma);
}

void Apply::operator()(const AddDisplay& call) const {
  if (!call.add) state_.displays.clear();
  state_.displays.push_back(call.display);
  state_.displays.back().where = where_;
}

void Apply::operator()(const Hider& call) const {
  state_.options.hider = call.name;
  state_.options.hider_parameters = call.parameters;
}

void Apply::search_path(const Parameter& parameter) const {
  SceneOptions& options = state_.options;
  std::vector<std::string>* path = parameter.name == "texture"      ? &options.texture_path
                                   : parameter.name == "shader"     ? &options.shader_path
                                   : parameter.name == "archive"    ? &options.archive_path
                                   : parameter.name == "procedural" ? &options.procedural_path
                                                                    : nullptr;
  if (path) *path = parse_search_path(string(parameter), *path);
}

bool Apply::limit(const Parameter& parameter) const {
  if (parameter.name == "bucketsize")
    state_.options.bucket_size = integer(parameter, 1, largest_resolution);
  else if (parameter.name == "gridsize")
    state_.options.grid_size = integer(parameter, 1, 1 << 24);
  else
    return false;
  return true;
}

bool Apply::camera_option(const Parameter& parameter) const {
  if (parameter.name == "shutterprofile")
    camera_.shutter_profile = string(parameter);
  else if (parameter.name == "lensprofile")
    camera_.lens_profile = string(parameter);
  else if (parameter.name == "lensblades")
    camera_.lens_blades = integer(parameter, 3, 64);
  else if (parameter.name == "lensrotation")
    camera_.lens_rotation_degrees = number(parameter);
  else
    return false;
  return true;
}

void Apply::operator()(const User& call) const {
  for (const Parameter& parameter : call.parameters) {
    bool known = false;
    if (call.category == "searchpath")
      search_path(parameter), known = true;
    else if (call.category == "limits")
      known = limit(parameter);
    else if (call.category == "camera" && !(known = camera_option(parameter)))
      diagnostics_.warn_once("camera-option:" + parameter.name, where_,
                             fmt::format("unknown camera option \"{}\"", parameter.name));
    if (!known) state_.options.user[call.category + ":" + parameter.name] = parameter;
  }
}

}  // namespace

void OptionState::apply(const OptionCall& call, const SourceLocation& where,
                        Diagnostics& diagnostics) {
  std::visit(Apply(*this, where, diagnostics), call);
}

}  // namespace tessera
