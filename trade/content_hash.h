#pragma once
/// Hashes that tell whether a scene, a program or an image is the one it was.

#include <cstdint>
#include <string>
#include <string_view>

#include "images/image.h"

namespace tessera::trade {

/// 64-bit FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), fed piece by piece.
class ContentHash {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) state_ = (state_ ^ uint8_t(byte)) * 0x100000001b3u;
  }
  /// A string and its end, so that "ab" "c" is not "a" "bc".
  void add_item(std::string_view text) {
    add(text);
    add(std::string_view("\0", 1));
  }
  /// The bytes of a file. Throws Error when it cannot be read.
  void add_file(const std::string& path);
  uint64_t value() const { return state_; }
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  uint64_t state_ = 0xcbf29ce484222325u;
};

/// What a scene is made of: the bytes of the scene file and of every file that a string in it names
/// and that is there, found beside the file that names it, beside the scene file, in the folders of
/// searchpath options or as it stands, in each of these places; of archives (what ReadArchive
/// names, and names in .rib or .rib.gz) likewise, so that textures, shadow maps and archives of
/// archives are covered. Not covered: names that shaders make up at run time (there are none
/// today). Throws Error when a file cannot be read; a file that is not RIB counts with its bytes
/// alone.
std::string hash_scene(const std::string& scene);

/// Of a file's bytes. Throws Error when it cannot be read.
std::string hash_file(const std::string& path);

/// Of windows, channel names and values, bit for bit. Metadata, which hold times, do not count.
std::string hash_pixels(const Image& image);

}  // namespace tessera::trade
