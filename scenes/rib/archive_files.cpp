#include "scenes/rib/archive_files.h"

#include <filesystem>

namespace tessera {

namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_directory(path, error);
}

}  // namespace

std::string find_archive(const std::string& name, const ArchiveFolders& folders,
                         const SourceLocation& where) {
  const fs::path file(name);
  if (name.empty()) throw Error(where, "expected the name of an archive, found an empty string");
  std::vector<fs::path> candidates;
  if (file.is_absolute()) {
    candidates.push_back(file);
  } else {
    const fs::path scene_folder = fs::path(folders.scene_file).parent_path();
    candidates.push_back(fs::path(where.file).parent_path() / file);
    for (const auto* path : {&folders.search_path, &folders.extra})
      for (const fs::path folder : *path) {
        candidates.push_back(folder / file);
        if (folder.is_relative()) candidates.push_back(scene_folder / folder / file);
      }
  }
  std::string tried;
  for (const fs::path& candidate : candidates) {
    if (is_file(candidate)) return candidate.lexically_normal().string();
    tried += (tried.empty() ? "" : ", ") + candidate.string();
  }
  throw Error(where,
              fmt::format("cannot find the archive \"{:.200}\"; looked for {:.1000}", name, tried));
}

}  // namespace tessera
