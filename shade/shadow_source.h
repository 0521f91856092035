#pragma once
/// Shadow maps of one frame: each file is read once, when a light first looks it up.

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "shade/shadow_map.h"

namespace tessera {

/// One file. Thread safe.
class ShadowSource {
 public:
  ShadowSource(std::string file, SourceLocation where, std::vector<std::string> search_path,
               const glm::dmat4& world_from_camera, Diagnostics& diagnostics)
      : file_(std::move(file)),
        where_(std::move(where)),
        search_path_(std::move(search_path)),
        world_from_camera_(world_from_camera),
        diagnostics_(diagnostics) {}

  /// As ShadowMap::light_share; all is lit when the file cannot be read, which is said once.
  void light_share(const ShadingPoints& points, const ShadowFilter& filter, std::span<float> share);

 private:
  void read();

  std::string file_;
  SourceLocation where_;
  std::vector<std::string> search_path_;
  glm::dmat4 world_from_camera_;
  Diagnostics& diagnostics_;
  std::once_flag asked_;
  std::unique_ptr<const ShadowMap> map_;
};

/// The files that the lights of a frame name.
class FrameShadows {
 public:
  /// Relative names are looked for in the working folder, then in the folders of `search_path`.
  FrameShadows(std::vector<std::string> search_path, const glm::dmat4& world_from_camera,
               Diagnostics& diagnostics)
      : search_path_(std::move(search_path)),
        world_from_camera_(world_from_camera),
        diagnostics_(diagnostics) {}

  /// The same source for the same name; `where` is the first light that names it. Lives as long as
  /// this object. Not thread safe.
  ShadowSource& source(const std::string& file, const SourceLocation& where);

 private:
  std::vector<std::string> search_path_;
  glm::dmat4 world_from_camera_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::unique_ptr<ShadowSource>> sources_;
};

}  // namespace tessera
