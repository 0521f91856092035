#include "images/file_kinds.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "base/error.h"

namespace tessera {

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

bool named_exr(const std::string& path) { return lower_extension(path) == ".exr"; }

bool named_8_bit(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

void check_format(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (named_exr(path) || named_8_bit(path) || extension == ".tif" || extension == ".tiff") return;
  throw Error(fmt::format(
      "cannot write {}: unknown format \"{}\"; expected .exr, .png, .jpg, .jpeg, .tif or .tiff",
      path, extension));
}

bool holds_exr(const std::string& path) {
  // OpenEXR File Layout, "Magic Number".
  constexpr std::array<char, 4> magic{0x76, 0x2f, 0x31, 0x01};
  std::array<char, 4> start{};
  std::ifstream file(path, std::ios::binary);
  return file.read(start.data(), start.size()) && start == magic;
}

}  // namespace tessera
