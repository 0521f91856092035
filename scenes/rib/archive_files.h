#pragma once
/// Finding the files that ReadArchive names.

#include <string>
#include <vector>

#include "base/error.h"

namespace tessera {

/// Where to look for archives. A relative name is tried beside the file that refers to it, then in
/// each folder of `search_path`, then in `extra`; relative folders are tried as they stand and
/// beside the scene file.
struct ArchiveFolders {
  std::string scene_file;
  std::vector<std::string> search_path, extra;
};

/// The path of the archive `name` named at `where`. Throws Error listing where it was looked for.
std::string find_archive(const std::string& name, const ArchiveFolders& folders,
                         const SourceLocation& where);

}  // namespace tessera
