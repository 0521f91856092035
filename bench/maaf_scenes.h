#pragma once
/// The scenes of bench/maaf.cpp by name.

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "bench/maaf_atrium.h"
#include "bench/maaf_conference.h"
#include "bench/maaf_still_life.h"
#include "bench/maaf_toasters.h"
#include "bench/read_scene.h"

namespace tessera {

inline std::vector<std::string> maaf_scene_names() {
  return {"conference", "still_life", "atrium", "toasters"};
}

/// Throws Error for a name that is none of maaf_scene_names().
inline std::string maaf_scene_text(const std::string& name, const MaafSceneRequest& request) {
  if (name == "conference") return Conference(request).text();
  if (name == "still_life") return StillLife(request).text();
  if (name == "atrium") return Atrium(request).text();
  if (name == "toasters") return Toasters(request).text();
  throw Error(
      fmt::format("no scene \"{}\"; expected conference, still_life, atrium or toasters", name));
}

inline std::unique_ptr<const Scene> read_maaf_scene(const std::string& name,
                                                    const MaafSceneRequest& request) {
  return read_generated_scene(maaf_scene_text(name, request), name);
}

}  // namespace tessera
