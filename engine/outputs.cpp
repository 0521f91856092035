#include "engine/outputs.h"

#include <cctype>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "engine/heatmap.h"
#include "images/exr.h"
#include "images/file_kinds.h"
#include "images/image_module.h"
#include "images/preview.h"
#include "shade/shade.h"
#include "shade/shadow_map.h"

namespace tessera {
namespace {

/// Displays of interactive windows have no place in a batch.
bool is_file(const Display& display) {
  return display.type != "framebuffer" && !display.file.empty();
}

/// Depth files keep their name whatever its extension; they are EXR inside.
bool is_depth_file(const Display& display) {
  return display.type == "zfile" || display.type == "shadow";
}

std::string display_path(const Display& display) {
  std::string path = display.file;
  // A leading + adds a display to those before it (RI 3.2, Display).
  if (!path.empty() && path.front() == '+') path.erase(0, 1);
  return path;
}

/// Channel names of a Display mode: a group's name, or letters of r, g, b, a, z run together.
std::vector<std::string> mode_channels(const Display& display) {
  for (const AovDefinition& group : aov_registry())
    if (display.mode == group.name) return group.channels;
  constexpr std::string_view letters = "rgbaz";
  if (display.mode.empty() || display.mode.find_first_not_of(letters) != std::string::npos)
    throw Error(display.where,
                fmt::format("Display mode '{}': expected letters of {} or the name of an auxiliary "
                            "channel group",
                            display.mode, letters));
  std::vector<std::string> channels;
  for (const char letter : display.mode) channels.emplace_back(1, char(std::toupper(letter)));
  return channels;
}

Image with_channels(const Image& image, const std::vector<std::string>& names) {
  Image picked(image.display_window, image.data_window);
  picked.pixel_aspect = image.pixel_aspect;
  picked.metadata = image.metadata;
  picked.matrices = image.matrices;
  for (const std::string& name : names)
    if (const Image::Channel* channel = image.find_channel(name))
      picked.channels.push_back(*channel);
  return picked;
}

/// Undoes, for colours that a scene's own Exposure has made fit for a display, the encoding that an
/// 8-bit file is about to apply.
void decode_colours(Image& image) {
  for (Image::Channel& channel : image.channels)
    if (channel.name == "R" || channel.name == "G" || channel.name == "B")
      for (float& value : channel.values) value = linear_from_srgb(value);
}

/// "cell.R" is R in a file that holds nothing else.
void drop_group_names(Image& image) {
  for (Image::Channel& channel : image.channels)
    for (const char* colour : {".R", ".G", ".B"})
      if (channel.name.ends_with(colour)) channel.name = colour + 1;
}

/// Writes through the image module: formats other than EXR.
void write_other(Image image, const std::string& path, bool display_encoded) {
  drop_group_names(image);
  if (display_encoded && named_8_bit(path)) decode_colours(image);
  if (is_interrupted(image)) image.metadata[description_attribute] = interrupted_description;
  load_image_module()->write_image(path, image);
}

}  // namespace

void check_formats(const FrameFiles& files, const Scene& scene) {
  if (!files.from_displays) check_format(files.images.front());
  if (!files.preview.empty()) check_format(files.preview);
  if (!files.from_displays) return;
  for (const Display& display : scene.displays) {
    if (!is_file(display)) continue;
    mode_channels(display);
    if (!is_depth_file(display)) check_format(display_path(display));
  }
}

void write_frame(const FrameResult& frame, const std::string& path) {
  if (named_exr(path)) return write_exr(path, frame.image);
  // Formats other than EXR hold one picture.
  write_other(with_channels(frame.image, {"R", "G", "B", "A"}), path, frame.display_encoded);
}

std::vector<std::string> display_outputs(const Scene& scene) {
  std::vector<std::string> paths;
  for (const Display& display : scene.displays)
    if (is_file(display)) paths.push_back(display_path(display));
  if (paths.empty()) paths.push_back(std::filesystem::path(scene.file).stem().string() + ".exr");
  return paths;
}

std::vector<std::string> write_displays(const FrameResult& frame, const Scene& scene) {
  std::vector<std::string> written;
  for (const Display& display : scene.displays) {
    if (!is_file(display)) continue;
    const std::string path = display_path(display);
    std::vector<std::string> channels = mode_channels(display);
    if (!frame.heatmap.empty() && named_exr(path) && !is_depth_file(display))
      channels.push_back(heatmap_channel(frame.heatmap));
    Image image = with_channels(frame.image, channels);
    if (is_depth_file(display) || named_exr(path))
      write_exr(path, image);
    else
      write_other(std::move(image), path, frame.display_encoded);
    written.push_back(path);
  }
  if (written.empty()) {
    written = display_outputs(scene);
    write_frame(frame, written.front());
  }
  return written;
}

void make_shadow(const std::string& picture, const std::string& shadow) {
  const Image depth = read_exr(picture);
  try {
    (void)ShadowMap(depth);
  } catch (const Error& error) {
    throw Error(fmt::format("{} is no depth file: {}", picture, error.what()));
  }
  write_exr(shadow, depth);
}

void write_preview(const FrameResult& frame, const std::string& path) {
  Image picture = with_channels(frame.image, {"R", "G", "B"});
  if (named_exr(path)) return write_exr(path, picture);
  write_other(std::move(picture), path, frame.display_encoded);
}

std::string heatmap_path(const std::string& image, std::string_view name) {
  return std::filesystem::path(image).replace_extension(fmt::format(".{}.png", name)).string();
}

void write_heatmap(const FrameResult& frame, const std::string& path) {
  load_image_module()->write_image(path, heatmap_picture(frame.image, frame.heatmap));
}

}  // namespace tessera
