#pragma once
/// Writes the RIB text of generated scenes, for bench/shading.cpp. World units; y is up, and the
/// world is left-handed, as camera space is.

#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>

namespace tessera {

/// What a generated scene is asked for.
struct ShadingSceneRequest {
  int width = 1280, height = 720;
  int side_samples = 4;        ///< samples per pixel is their square
  std::string lens = "sharp";  ///< sharp (disc), smooth, pinhole
  /// Multiplies every movement; 0: nothing moves.
  double motion = 1;
  double place = 0;      ///< of the frame in a sequence, from -0.5 to 0.5
  std::string textures;  ///< folder that write_shading_textures() filled
};

/// Where a camera is and looks, and what is up there.
struct CameraPose {
  glm::dvec3 eye, target;
  double roll_degrees = 0;
};

class RibText {
 public:
  const std::string& text() const { return text_; }

  template <class... Arguments>
  RibText& add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
    return *this;
  }
  /// What `content` adds, between AttributeBegin and AttributeEnd.
  void attribute(const std::function<void()>& content) {
    add("AttributeBegin");
    content();
    add("AttributeEnd");
  }

  /// Everything before WorldBegin but the camera's place. `aperture_radius` in world units: a point
  /// at depth z is blurred over a disc of radius scale * aperture * |1 / focus - 1 / z| pixels,
  /// where scale = height / 2 / tan(fov / 2).
  void options(const ShadingSceneRequest& request, double fov_degrees, double aperture_radius,
               double focus_depth) {
    add("Format {} {} 1", request.width, request.height);
    add("PixelSamples {0} {0}", request.side_samples);
    add("PixelFilter \"gaussian\" 2 2");
    add("Projection \"perspective\" \"fov\" [{}]", fov_degrees);
    add("Clipping 0.1 1000");
    if (request.motion > 0) add("Shutter 0 1");
    if (request.lens == "pinhole") return;
    add("DepthOfField {} 1 {}", 0.5 / aperture_radius, focus_depth);
    add("Option \"camera\" \"string lensprofile\" [\"{}\"]",
        request.lens == "smooth" ? "smooth" : "disc");
  }

  /// The camera's place at mid-shutter moved by `motion` shutters before and after it.
  void camera(const std::function<CameraPose(double time)>& pose, double motion) {
    moving(motion, 2, [&](double time) { add("ConcatTransform {}", camera_matrix(pose(time))); });
  }

  /// What `content` adds at each of `keys` times spread evenly over [-motion / 2, motion / 2], as a
  /// motion block; once, at 0, if nothing moves.
  void moving(double motion, int keys, const std::function<void(double time)>& content) {
    if (motion <= 0) return content(0);
    text_ += "MotionBegin [";
    for (int k = 0; k < keys; ++k) fmt::format_to(std::back_inserter(text_), "{} ", at(k, keys));
    add("]");
    for (int k = 0; k < keys; ++k) content(motion * (at(k, keys) - 0.5));
    add("MotionEnd");
  }

  /// A subdivision surface whose control points are `rows` of `columns`, P(i, j) in row j; with
  /// `closed` rows are rings. st goes from 0 to `st_repeats` over it.
  struct Sheet {
    int columns = 2, rows = 2;
    bool closed = false;
    glm::dvec2 st_repeats{1, 1};
  };
  void sheet(const Sheet& shape, const std::function<glm::dvec3(int i, int j)>& P) {
    const int across = shape.closed ? shape.columns : shape.columns - 1, along = shape.rows - 1;
    std::string corners, st;
    for (int j = 0; j < along; ++j)
      for (int i = 0; i < across; ++i)
        for (const glm::ivec2 d : {glm::ivec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
          fmt::format_to(std::back_inserter(corners), "{} ",
                         (j + d.y) * shape.columns + (i + d.x) % shape.columns);
          fmt::format_to(std::back_inserter(st), "{:.6g} {:.6g} ",
                         shape.st_repeats.x * (i + d.x) / across,
                         shape.st_repeats.y * (j + d.y) / along);
        }
    text_ += "SubdivisionMesh \"catmull-clark\" [";
    for (int face = 0; face < across * along; ++face) text_ += "4 ";
    add("] [{}] [\"interpolateboundary\"] [0 0] [] []", corners);
    text_ += "\"P\" [";
    for (int j = 0; j < shape.rows; ++j)
      for (int i = 0; i < shape.columns; ++i) {
        const glm::dvec3 p = P(i, j);
        fmt::format_to(std::back_inserter(text_), "{:.6g} {:.6g} {:.6g} ", p.x, p.y, p.z);
      }
    add("] \"facevarying float[2] st\" [{}]", st);
  }

  /// A flat quadrilateral: corner, and two edges. st goes from 0 to `st_repeats`.
  void quad(const glm::dvec3& corner, const glm::dvec3& along_s, const glm::dvec3& along_t,
            const glm::dvec2& st_repeats = {1, 1}) {
    const auto text = [](const glm::dvec3& p) {
      return fmt::format("{:.6g} {:.6g} {:.6g}", p.x, p.y, p.z);
    };
    add("Patch \"bilinear\" \"P\" [{}  {}  {}  {}] \"st\" [0 0 {} 0 0 {} {} {}]", text(corner),
        text(corner + along_s), text(corner + along_t), text(corner + along_s + along_t),
        st_repeats.x, st_repeats.y, st_repeats.x, st_repeats.y);
  }

  /// A box around `center`, its half sizes in `half`; each side has the whole of st.
  void box(const glm::dvec3& center, const glm::dvec3& half,
           const glm::dvec2& st_repeats = {1, 1}) {
    const glm::dvec3 x(2 * half.x, 0, 0), y(0, 2 * half.y, 0), z(0, 0, 2 * half.z);
    const glm::dvec3 low = center - half, high = center + half;
    quad(low + y, x, -y, st_repeats);
    quad(high, -x, -y, st_repeats);
    quad(low + y + z, -z, -y, st_repeats);
    quad(high - z, z, -y, st_repeats);
    quad(low + y, z, x, st_repeats);
    quad(low, x, z, st_repeats);
  }

 private:
  static double at(int k, int keys) { return double(k) / (keys - 1); }

  /// Row vectors times this matrix are in camera space.
  static std::string camera_matrix(const CameraPose& pose) {
    const glm::dvec3 forward = glm::normalize(pose.target - pose.eye);
    const glm::dvec3 level = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), forward));
    const glm::dvec3 upright = glm::cross(forward, level);
    const double roll = pose.roll_degrees * std::numbers::pi / 180;
    const glm::dvec3 right = std::cos(roll) * level + std::sin(roll) * upright;
    const glm::dvec3 up = std::cos(roll) * upright - std::sin(roll) * level;
    std::string text = "[";
    for (int axis = 0; axis < 3; ++axis)
      fmt::format_to(std::back_inserter(text), "{:.12g} {:.12g} {:.12g} 0 ", right[axis], up[axis],
                     forward[axis]);
    return text + fmt::format("{:.12g} {:.12g} {:.12g} 1]", -glm::dot(right, pose.eye),
                              -glm::dot(up, pose.eye), -glm::dot(forward, pose.eye));
  }

  std::string text_;
};

/// The same for all: an even sky and two lights besides those of the scene.
inline void add_daylight(RibText& rib, double ambient, double sun) {
  rib.add("LightSource \"ambientlight\" 1 \"intensity\" [{}] \"lightcolor\" [0.85 0.92 1]",
          ambient);
  rib.add(
      "LightSource \"distantlight\" 2 \"intensity\" [{}] \"lightcolor\" [1 0.93 0.8] "
      "\"from\" [-5 8 -4] \"to\" [0 0 0]",
      sun);
  rib.add(
      "LightSource \"distantlight\" 3 \"intensity\" [{}] \"lightcolor\" [0.6 0.75 1] "
      "\"from\" [6 4 -3] \"to\" [0 0 0]",
      0.35 * sun);
}

}  // namespace tessera
