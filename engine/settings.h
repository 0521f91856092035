#pragma once
/// What the user asks for beyond the scene file. An unset option leaves the scene's own value.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cameras/camera_settings.h"

namespace tessera {

struct Settings {
  std::optional<std::string> quality;  ///< one of engine/qualities.h, for what is left unset
  std::optional<int> samples_per_pixel;
  /// Samples are taken until the frame's relative error is estimated to be below this
  /// (engine/accurate_frame.h), or until the mean of samples per pixel comes to max_samples.
  std::optional<double> error;
  std::optional<int> max_samples;  ///< only with `error` or `time_s`; unset: 1024
  std::optional<double> time_s;    ///< as many samples as fit into a frame of so many seconds
  /// Samples a pixel of the passes of each round, the mean over pixels: repeats a frame that was
  /// rendered to an error. Empty: they are found.
  std::vector<double> rounds;
  std::vector<int> passes;  ///< samples a pixel: repeats a frame that was rendered within a time
  std::optional<float> shading_rate;  ///< pixels^2; replaces every surface's own
  std::optional<float> dicing_rate;   ///< pixels^2; of micropolygons, whatever ShadingRate
  std::optional<float> motion_factor, focus_factor;  ///< replace GeometricApproximation's
  std::optional<CameraSettings::CropWindow> crop;
  std::optional<int> x_resolution, y_resolution;
  std::optional<std::string> hider;           ///< "name" or "name:arguments"
  std::optional<std::string> shading;         ///< "name" or "name:arguments"
  std::optional<std::string> texture_filter;  ///< one of images/texture_filters.h
  std::optional<std::string> filter;          ///< "name" or "name:XxY", full widths in pixels
  /// "filter" (the pixel filter alone) or "name" or "name:arguments" of a method for distribution
  /// effects.
  std::optional<std::string> reconstruct;
  std::optional<float> ray_dicing_rate;  ///< pixels^2; of the micropolygons that rays meet
  std::optional<int> extra_samples;  ///< most a pixel may have besides, where slopes change sign
  std::optional<int> bucket_size;    ///< pixels
  std::optional<int> grid_size;      ///< micropolygons along a side
  std::vector<std::string> aovs;     ///< channel groups; empty: rgb, a, z and those of the displays
  std::optional<std::string> heatmap;  ///< measure to map, one of engine/heatmap.h
  uint32_t seed = 0;
  int threads = 0;  ///< 0: every core
  size_t memory_bytes =
      size_t(2) << 30;  ///< budget for diced grids, not for what is shaded on them
  /// Budget for filters of distribution effects; frames that take more are filtered in strips.
  size_t filter_memory_bytes = size_t(4) << 30;
};

}  // namespace tessera
