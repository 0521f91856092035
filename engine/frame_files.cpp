#include "engine/frame_files.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "images/atomic_file.h"
#include "images/exr.h"
#include "images/file_kinds.h"
#include "images/image_module.h"

namespace tessera {

namespace fs = std::filesystem;

std::vector<std::string> FrameFiles::all() const {
  std::vector<std::string> names = images;
  if (!preview.empty()) names.push_back(preview);
  if (!statistics.empty()) names.push_back(statistics);
  if (!heatmap.empty()) names.push_back(heatmap);
  return names;
}

bool is_interrupted(const Image& image) {
  const auto value = [&](const char* name) {
    const auto found = image.metadata.find(name);
    return found == image.metadata.end() ? std::string() : found->second;
  };
  return value(complete_attribute).starts_with("no") ||
         value(description_attribute) == interrupted_description;
}

bool is_finished_image(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  try {
    // The whole file: a truncated one has a sound header. Depth files are EXR under any name.
    const Image image = holds_exr(path) ? read_exr(path) : load_image_module()->read_image(path);
    return !is_interrupted(image);
  } catch (const Error&) {
    return false;  // no sound image whatever its name says: to be rendered again
  }
}

void check_writable(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  const fs::path folder = parent.empty() ? fs::path(".") : parent;
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw Error(fmt::format("cannot write {}: there is no folder {}", path, folder.string()));
  }
  if (fs::is_directory(path, ignored)) {
    throw Error(fmt::format("cannot write {}: it is a folder", path));
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(fmt::format("cannot write {}: {}", path, std::strerror(errno)));
  }
}

void write_text_file(const std::string& path, std::string_view text) {
  AtomicFile file(path);
  std::ofstream stream(file.temporary_path(), std::ios::binary);
  stream.write(text.data(), std::streamsize(text.size()));
  stream.close();
  if (!stream) throw Error(fmt::format("cannot write {}: {}", path, std::strerror(errno)));
  file.commit();
}

}  // namespace tessera
