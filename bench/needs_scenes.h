#pragma once
/// The scenes and the features of `tessera bench needs`.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "bench/harness/benchmark.h"
#include "bench/read_scene.h"
#include "engine/frame.h"
#include "images/image_module.h"

namespace tessera {

/// The last frame of a file; an empty name: a frame that holds nothing.
inline std::unique_ptr<const Scene> read_scene_to_measure(const std::string& file) {
  LastFrame sink;
  Diagnostics diagnostics;
  if (file.empty())
    read_rib_text("Format 960 540 1\nPixelSamples 4 4\nWorldBegin\nWorldEnd\n", "empty", sink,
                  diagnostics);
  else
    read_rib(file, sink, diagnostics);
  if (!sink.scene) throw Error(fmt::format("{} holds no frame", file));
  return std::move(sink.scene);
}

/// "" and the files of scenes/examples, which lies beside the folder that the program is built in.
inline std::vector<std::string> scenes_to_measure() {
  const auto folder = std::filesystem::path(program_folder()).parent_path() / "scenes/examples";
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".rib") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  files.insert(files.begin(), "");
  return files;
}

/// Something a frame may need. `force` makes it pay whether it does or not.
struct FrameFeature {
  const char* name;
  bool (*needed)(const FramePlan& plan);
  void (*force)(FramePlan& plan);  ///< null: cannot be had by one who does not need it
};

inline void force_textures(FramePlan& plan) {
  plan.textures = true;
  load_image_module()->make_texture_sampler({});  // the module stays loaded
}

inline const std::vector<FrameFeature>& frame_features() {
  static const std::vector<FrameFeature> features{
      {"motion", [](const FramePlan& p) { return p.motion; },
       [](FramePlan& p) { p.motion = true; }},
      {"lens", [](const FramePlan& p) { return p.lens; }, [](FramePlan& p) { p.lens = true; }},
      {"transparency", [](const FramePlan& p) { return p.transparency; },
       [](FramePlan& p) { p.transparency = true; }},
      // Without a shader there is nothing to displace by.
      {"displacement", [](const FramePlan& p) { return p.displacement; }, nullptr},
      {"textures", [](const FramePlan& p) { return p.textures; }, force_textures},
      {"area_lights", [](const FramePlan& p) { return p.area_lights; },
       [](FramePlan& p) { p.area_lights = true; }},
      {"bounce", [](const FramePlan& p) { return p.bounce; },
       [](FramePlan& p) { p.bounce = true; }},
      {"ray_tracing", [](const FramePlan& p) { return p.ray_tracing; },
       [](FramePlan& p) { p.ray_tracing = true; }},
      // Where there is an effect, to filter it or not is a choice of quality.
      {"reconstruct", [](const FramePlan& p) { return p.distribution().any(); },
       [](FramePlan& p) { p.reconstruct = "wiener"; }}};
  return features;
}

}  // namespace tessera
