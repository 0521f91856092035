#include "shade/shadow_source.h"

#include <algorithm>
#include <filesystem>

#include "images/exr.h"

namespace tessera {
namespace {

std::string find_file(const std::string& file, const std::vector<std::string>& search_path) {
  const std::filesystem::path name(file);
  std::error_code ignored;
  // Frames write to the working folder, so a map that an earlier frame has made comes first.
  if (name.is_absolute() || std::filesystem::exists(name, ignored)) return file;
  for (const std::string& folder : search_path) {
    const std::filesystem::path candidate = folder / name;
    if (std::filesystem::exists(candidate, ignored)) return candidate.string();
  }
  return file;
}

}  // namespace

void ShadowSource::read() {
  try {
    map_ = std::make_unique<const ShadowMap>(read_exr(find_file(file_, search_path_)));
  } catch (const std::exception& error) {
    diagnostics_.warn_once(
        "shadow map " + file_, where_,
        fmt::format("cannot use shadow map \"{}\" ({}); nothing is shadowed", file_, error.what()));
  }
}

void ShadowSource::light_share(const ShadingPoints& points, const ShadowFilter& filter,
                               std::span<float> share) {
  std::call_once(asked_, [&] { read(); });
  if (map_) return map_->light_share(points, world_from_camera_, filter, share);
  std::ranges::fill(share, 1.0f);
}

ShadowSource& FrameShadows::source(const std::string& file, const SourceLocation& where) {
  std::unique_ptr<ShadowSource>& found = sources_[file];
  if (!found) {
    found =
        std::make_unique<ShadowSource>(file, where, search_path_, world_from_camera_, diagnostics_);
  }
  return *found;
}

}  // namespace tessera
