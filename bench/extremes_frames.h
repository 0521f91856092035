#pragma once
/// The extremes table, whole frames: lights with extent, bounces and the filters for them where
/// sizes, distances and slopes are at their ends, against many unfiltered samples.

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/extremes_table.h"
#include "bench/read_scene.h"
#include "engine/frame.h"
#include "images/compare.h"

namespace tessera {

/// A ball over a floor and before a wall, under a square light.
struct ExtremeFrame {
  std::string name;
  int side = 4;              ///< samples a pixel are its square
  double unit = 1;           ///< scale of the whole scene
  double light_width = 1.5;  ///< units; its power stays the same
  double power = 18;         ///< of the light: radiance times area
  double light_height = 4;   ///< above the floor
  double ball_height = 1;    ///< of its centre; the radius is 0.7
  std::string lens{};        ///< a DepthOfField request
  bool floor_only = false;   ///< nothing but the floor, all over the frame
  bool empty = false;
  /// Of filtered over unfiltered energy, less 1. More where few samples bring most of the light, of
  /// which the filter leaves out what look like outliers.
  double energy_bound = 0.01;
};

inline std::string extreme_frame_text(const ExtremeFrame& f) {
  const double u = f.unit, w = f.light_width;
  std::string text = fmt::format(
      "Format 48 36 1\nPixelSamples {} {}\nProjection \"perspective\" \"fov\" [45]\n{}\n"
      "Rotate -20 1 0 0\nTranslate 0 {} {}\nWorldBegin\nScale {} {} {}\n",
      f.side, f.side, f.lens, -2.5 * u, 6 * u, u, u, u);
  text += fmt::format(
      "TransformBegin\nTranslate 0.5 {} 0\nRotate 90 1 0 0\n"
      "LightSource \"rectanglelight\" \"r\" \"float width\" [{}] \"float height\" [{}]\n"
      "  \"float intensity\" [{}]\nTransformEnd\nLightSource \"indirectlight\" \"i\"\n"
      "Surface \"matte\"\nColor [0.8 0.7 0.6]\n",
      f.light_height, w, w, f.power / (w * w));
  if (f.empty) return text + "WorldEnd\n";
  const double far = f.floor_only ? 1000 : 4;
  text += fmt::format("Polygon \"P\" [{0} 0 {0}  {0} 0 {1}  {1} 0 {1}  {1} 0 {0}]\n", -far, far);
  if (f.floor_only) return text + "WorldEnd\n";
  return text + fmt::format(
                    "Polygon \"P\" [-4 0 3  -4 5 3  4 5 3  4 0 3]\nTranslate 0 {} 0\n"
                    "Sphere 0.7 -0.7 0.7 360\nWorldEnd\n",
                    f.ball_height);
}

inline std::vector<ExtremeFrame> extreme_frames() {
  return {{.name = "nothing extreme"},
          {.name = "one sample a pixel", .side = 1},
          {.name = "light 1e-5 wide", .light_width = 1e-5},
          {.name = "light 1e4 wide", .light_width = 1e4, .power = 1e8, .energy_bound = 0.5},
          {.name = "radiance 1e30", .power = 2.25e30},
          {.name = "ball touches the floor", .ball_height = 0.7},
          {.name = "ball reaches into the light", .light_height = 1.5, .energy_bound = 0.03},
          {.name = "all 1e-5 in size", .unit = 1e-5},
          {.name = "all 1e5 in size", .unit = 1e5},
          {.name = "focus in the ball", .lens = "DepthOfField 1 0.5 6.5"},
          {.name = "lens all but closed", .lens = "DepthOfField 1e6 0.5 6.5"},
          {.name = "lens as wide as the scene", .lens = "DepthOfField 0.1 0.5 6.5"},
          {.name = "all pixels of one object", .floor_only = true},
          {.name = "empty frame", .empty = true}};
}

inline FrameResult render_extreme(const Scene& scene, const char* method, int samples,
                                  uint32_t seed) {
  Settings settings;
  settings.reconstruct = method;
  settings.seed = seed;
  if (samples > 0) settings.samples_per_pixel = samples;
  Diagnostics diagnostics;
  FrameResult frame = render_frame(scene, settings, diagnostics);
  std::erase_if(frame.image.channels, [](const Image::Channel& c) {
    return c.name != "R" && c.name != "G" && c.name != "B";
  });
  return frame;
}

inline double sum_of(const Image& image) {
  double sum = 0;
  for (const Image::Channel& channel : image.channels)
    for (const float value : channel.values) sum += double(value);
  return sum;
}

/// Images of 1e30 are compared as images of 1 are: both are divided by the mean of the reference.
inline void normalise(Image& image, double reference_sum) {
  if (!(reference_sum > 0) || !std::isfinite(reference_sum)) return;
  const double scale = 3.0 * double(image.data_window.pixel_count()) / reference_sum;
  for (Image::Channel& channel : image.channels)
    for (float& value : channel.values) value = float(double(value) * scale);
}

/// An image's error, and whether all of it is finite.
inline void add_frame_row(ExtremesTable& table, const ExtremeFrame& extreme) {
  const auto scene = read_generated_scene(extreme_frame_text(extreme), extreme.name);
  Image reference = render_extreme(*scene, "filter", table.scaled(1024, 256), 1).image;
  Image plain = render_extreme(*scene, "filter", 0, 0).image;
  Image filtered = render_extreme(*scene, "wiener", 0, 0).image;
  const double whole = sum_of(reference), energy = sum_of(filtered);
  size_t nonfinite = 0;
  for (const Image::Channel& channel : filtered.channels)
    for (const float value : channel.values) nonfinite += !std::isfinite(value);
  for (Image* image : {&plain, &filtered, &reference}) normalise(*image, whole);
  const double noise = compare_images(plain, reference).rel_mse;
  WorstError error;
  error.see(nonfinite > 0 ? std::numeric_limits<double>::infinity()
                          : compare_images(filtered, reference).rel_mse);
  // The filter never makes a frame worse than its samples are by more than the reference's noise.
  table.add({"frame", extreme.name, "many unfiltered samples", error, "relMSE", noise + 1e-4,
             fmt::format("{} not finite, unfiltered {:.3g}, energy {:.4f} of the reference's",
                         nonfinite, noise, whole > 0 ? energy / whole : 1.0)});
}

/// What the filter does to a frame's energy: frames of the same samples with and without it, over
/// several seeds, as the noise of one frame's energy may be larger than what is asked for.
inline void add_energy_row(ExtremesTable& table, const ExtremeFrame& extreme) {
  const auto scene = read_generated_scene(extreme_frame_text(extreme), extreme.name);
  const int seeds = table.scaled(32, 8);
  double whole = 0, difference = 0, squares = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const double plain = sum_of(render_extreme(*scene, "filter", 0, uint32_t(seed)).image);
    const double d = sum_of(render_extreme(*scene, "wiener", 0, uint32_t(seed)).image) - plain;
    whole += plain / seeds, difference += d / seeds, squares += d * d / seeds;
  }
  const double scale = whole > 0 ? 1 / whole : 1;
  const double spread = std::sqrt(std::max(0.0, squares - difference * difference) / (seeds - 1));
  WorstError error;
  error.see(std::abs(difference) * scale);
  table.add({"frame", extreme.name + ", energy", "the same samples, unfiltered", error,
             "of the energy", extreme.energy_bound,
             fmt::format("{:+.4f}, standard error {:.4f}, over {} seeds", difference * scale,
                         spread * scale, seeds)});
}

inline void add_extreme_frames(ExtremesTable& table) {
  for (const ExtremeFrame& extreme : extreme_frames()) {
    add_frame_row(table, extreme);
    add_energy_row(table, extreme);
  }
}

}  // namespace tessera
