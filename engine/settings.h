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
  std::optional<int> samples_per_pixel;
  std::optional<float> shading_rate;  ///< pixels^2; replaces every surface's own
  std::optional<float> dicing_rate;   ///< pixels^2; of micropolygons, whatever ShadingRate
  std::optional<float> motion_factor, focus_factor;  ///< replace GeometricApproximation's
  std::optional<CameraSettings::CropWindow> crop;
  std::optional<int> x_resolution, y_resolution;
  std::optional<std::string> hider;    ///< "name" or "name:arguments"
  std::optional<std::string> shading;  ///< "name" or "name:arguments"
  std::optional<std::string> filter;   ///< "name" or "name:XxY", full widths in pixels
  std::optional<std::string> reconstruct;  ///< "filter", or a method as "name" or "name:arguments"
  std::optional<int> bucket_size;      ///< pixels
  std::optional<int> grid_size;        ///< micropolygons along a side
  std::vector<std::string> aovs;  ///< channel groups; empty: rgb, a, z and those of the displays
  std::optional<std::string> heatmap;  ///< measure to map, one of engine/heatmap.h
  uint32_t seed = 0;
  int threads = 0;                        ///< 0: every core
  size_t memory_bytes = size_t(2) << 30;  ///< budget for diced grids
};

}  // namespace tessera
