#pragma once
/// The files that a frame becomes, and the state they are in on disk.

#include <string>
#include <string_view>
#include <vector>

#include "images/image.h"

namespace tessera {

/// The files of one frame. Empty names: not wanted.
struct FrameFiles {
  std::vector<std::string> images;
  std::string preview, statistics, heatmap;
  bool from_displays = false;  ///< the images are those of the scene's Displays

  std::vector<std::string> all() const;
};

/// Image attribute that begins with "no" when the frame was interrupted, set with the frame's other
/// metadata.
inline constexpr const char* complete_attribute = "tessera:complete";
/// What says the same in formats that keep no attributes but those they know, as JPEG.
inline constexpr const char* description_attribute = "ImageDescription";
inline constexpr const char* interrupted_description = "interrupted: not a whole frame";

/// Whether an image says by either attribute that its frame was interrupted.
bool is_interrupted(const Image& image);

/// Whether `path` holds an image that needs no more work: one that can be read to its end, whatever
/// its format, and is not marked as interrupted. Readers of JPEG and TIFF take parts of files, too;
/// but none are left behind, as all are written through a temporary name.
bool is_finished_image(const std::string& path);

/// Throws Error unless a file can be made at `path`: its folder exists and can be written, and it
/// is no folder itself. Called before rendering, so that hours are not spent in vain.
void check_writable(const std::string& path);

/// Writes through a temporary name in the same folder, so that `path` is never half-written.
/// Throws Error.
void write_text_file(const std::string& path, std::string_view text);

}  // namespace tessera
