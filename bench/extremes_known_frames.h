#pragma once
/// The extremes table, shade: frames whose colour is known in advance.

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bench/extremes_table.h"
#include "bench/read_scene.h"
#include "engine/frame.h"

namespace tessera {

/// A frame lit by ambient light 1 alone: every pixel holds its coverage times `color`.
struct KnownFrame {
  std::string name, camera, world;
  float shading_rate = 1, dicing_rate = 1;
};

inline std::vector<KnownFrame> known_frames() {
  const std::string ball = "Sphere 1 -1 1 360\n";
  const std::string floor = "Polygon \"P\" [-9 -1 -9  -9 -1 9  9 -1 9  9 -1 -9]\n";
  const std::string wall = "Polygon \"P\" [-1e5 -1e5 1  -1e5 1e5 1  1e5 1e5 1  1e5 -1e5 1]\n";
  const auto moving = [&](double x) {
    return fmt::format("MotionBegin [0 1]\nTranslate {} 0 0\nTranslate {} 0 0\nMotionEnd\n", -x, x);
  };
  return {{"cells of 1e-3 pixels^2", "", ball, 1e-3f},
          {"cells of 1e12 pixels^2", "", ball, 1e12f},
          {"micropolygons of 1e-3 pixels^2", "", ball, 1, 1e-3f},
          {"patch without area before a ball", "",
           ball + "Patch \"bilinear\" \"P\" [-1 0 -2 1 0 -2 -1 0 -2 1 0 -2]\n"},
          {"ball that moves 1e5 pixels", "Shutter 0 1\n", moving(5e3) + "Scale 900 9 1\n" + ball},
          {"circles of confusion of 1e4 pixels", "DepthOfField 1e-3 0.5 1\n", wall},
          {"floor through the eye", "Shutter 0 1\nDepthOfField 1 0.5 3\n", moving(1) + floor},
          {"all 1e7 away and as large", "", "Translate 0 0 1e7\nScale 2e6 2e6 2e6\n" + ball}};
}

inline void add_known_frames(ExtremesTable& table) {
  const glm::vec3 color(0.8f, 0.5f, 0.2f);
  for (const KnownFrame& f : known_frames()) {
    const auto scene = read_generated_scene(
        fmt::format("Format 48 36 1\nPixelSamples 4 4\nProjection \"perspective\" \"fov\" [45]\n"
                    "{}Translate 0 0 4\nWorldBegin\nLightSource \"ambientlight\" \"a\"\n"
                    "Surface \"matte\"\nColor [{} {} {}]\nShadingRate {}\n{}WorldEnd\n",
                    f.camera, color.x, color.y, color.z, f.shading_rate, f.world),
        f.name);
    WorstError error;
    double covered = 0;
    for (const char* mode : {"aas", "ds", "reyes", "pixel", "sample"}) {
      Settings settings;
      settings.shading = mode;
      settings.dicing_rate = f.dicing_rate;
      Diagnostics diagnostics;
      const Image image = render_frame(*scene, settings, diagnostics).image;
      const auto& alpha = image.find_channel("A")->values;
      for (const float value : alpha) covered += double(value) / (5.0 * double(alpha.size()));
      for (size_t i = 0; i < alpha.size(); ++i)
        for (const auto& [channel, share] :
             {std::pair{"R", color.x}, {"G", color.y}, {"B", color.z}})
          error.see((long double)(image.find_channel(channel)->values[i]),
                    (long double)(share)*alpha[i]);
    }
    if (!(covered > 0)) error.see(INFINITY);  // nothing to compare
    table.add({"shade", f.name, "coverage times colour, 5 modes", error, "of white", 2e-6,
               fmt::format("mean coverage {:.3g}", covered)});
  }
}

/// Forty sheets of one opacity, one behind the other.
inline void add_layers(ExtremesTable& table) {
  for (const float opacity : {1e-7f, 1e-3f, 0.5f, 1 - 0x1p-24f}) {
    std::string world;
    for (int k = 0; k < 40; ++k)
      world += fmt::format("Polygon \"P\" [-9 -9 {0} -9 9 {0} 9 9 {0} 9 -9 {0}]\n", 2 + 0.1 * k);
    const auto scene = read_generated_scene(
        fmt::format("Format 32 24 1\nProjection \"perspective\" \"fov\" [45]\nWorldBegin\n"
                    "Surface \"constant\"\nOpacity [{0:.9g} {0:.9g} {0:.9g}]\n{1}WorldEnd\n",
                    opacity, world),
        "layers");
    Diagnostics diagnostics;
    const Image image = render_frame(*scene, {}, diagnostics).image;
    WorstError error;
    const long double expected = 1 - std::pow(1 - (long double)(opacity), 40.0L);
    for (const char* channel : {"R", "A"})
      for (const float value : image.find_channel(channel)->values)
        error.see((long double)(value), expected, expected);
    table.add({"shade", fmt::format("40 sheets of opacity {:g}", opacity), "1 - (1 - a)^40", error,
               "of the value", 1e-5});
  }
}

}  // namespace tessera
