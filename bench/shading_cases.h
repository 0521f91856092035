#pragma once
/// The scenes, lenses and windows that bench/shading.cpp measures.

#include <stdlib.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/read_scene.h"
#include "bench/shading_arena.h"
#include "bench/shading_closeup.h"
#include "bench/shading_flythrough.h"
#include "bench/shading_textures.h"
#include "engine/frame.h"
#include "shade/shader.h"

namespace tessera {

/// The textures of the scenes, in a folder that goes with them.
class ShadingTextureFolder {
 public:
  ShadingTextureFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tessera-shading-XXXXXX").string();
    if (!mkdtemp(name.data())) throw Error("cannot make a temporary folder");
    path_ = name;
    write_shading_textures(path_);
  }
  ~ShadingTextureFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ShadingTextureFolder(const ShadingTextureFolder&) = delete;
  ShadingTextureFolder& operator=(const ShadingTextureFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A part of the frame, in fractions.
using Window = CameraSettings::CropWindow;

struct ShadingCase {
  std::string scene, lens;
  /// Where images are compared: motion and blur of several sizes, edges and smooth parts.
  Window compared{};
  std::string name() const { return scene + "/" + lens; }
};

inline std::vector<ShadingCase> shading_cases() {
  const Window arena{0.1, 0.4, 0.33, 0.58}, closeup{0.4, 0.7, 0.3, 0.55},
      flythrough{0.5, 0.8, 0.25, 0.5};
  return {{"arena", "sharp", arena},
          {"arena", "smooth", arena},
          {"closeup", "pinhole", closeup},
          {"flythrough", "sharp", flythrough},
          {"flythrough", "smooth", flythrough}};
}

inline std::string shading_scene_text(const std::string& scene,
                                      const ShadingSceneRequest& request) {
  if (scene == "arena") return Arena(request).text();
  if (scene == "closeup") return Closeup(request).text();
  if (scene == "flythrough") return Flythrough(request).text();
  throw Error(fmt::format("no scene \"{}\"; expected arena, closeup or flythrough", scene));
}

inline std::unique_ptr<const Scene> read_shading_scene(const std::string& name,
                                                       const ShadingSceneRequest& request) {
  return read_generated_scene(shading_scene_text(name, request), name);
}

/// The scene with another shader on all its surfaces.
inline Scene with_surface_shader(const Scene& scene, const ShaderCall& shader) {
  Scene changed = scene;
  std::map<const Attributes*, std::shared_ptr<const Attributes>> replaced;
  for (Surface& surface : changed.surfaces) {
    auto& slot = replaced[surface.attributes.get()];
    if (!slot) {
      auto copy = std::make_shared<Attributes>(*surface.attributes);
      copy->surface = shader;
      slot = std::move(copy);
    }
    surface.attributes = slot;
  }
  return changed;
}

/// Costs what a film's shader costs, or is plastic where this program has none such.
inline ShaderCall expensive_shader(float cost) {
  ShaderCall call;
  const bool known = find_shader(ShaderKind::surface, "expensive") != nullptr;
  call.name = known ? "expensive" : "plastic";
  if (known) {
    Parameter parameter;
    parameter.name = "cost";
    parameter.numbers = {cost};
    call.parameters.push_back(std::move(parameter));
  }
  return call;
}

}  // namespace tessera
