#pragma once
/// The files that a frame becomes, and the state they are in on disk.

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// The files of one frame. Empty names: not wanted.
struct FrameFiles {
  std::vector<std::string> images;
  std::string preview, statistics, heatmap;
  bool from_displays = false;  ///< the images are those of the scene's Displays

  std::vector<std::string> all() const;
};

/// Image attribute that begins with "no" when the frame was interrupted; engine/outputs.cpp sets
/// it.
inline constexpr const char* complete_attribute = "tessera:complete";

/// Whether `path` holds an image that needs no more work: an EXR that can be read to
/// its end and is not marked as interrupted; any other kind of file that exists and is not empty.
bool is_finished_image(const std::string& path);

/// Throws Error unless a file can be made at `path`: its folder exists and can be written, and it
/// is no folder itself. Called before rendering, so that hours are not spent in vain.
void check_writable(const std::string& path);

/// Writes through a temporary name in the same folder, so that `path` is never half-written.
/// Throws Error.
void write_text_file(const std::string& path, std::string_view text);

}  // namespace tessera
