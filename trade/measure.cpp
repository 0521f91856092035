#include "trade/measure.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "images/compare.h"
#include "images/exr.h"
#include "images/perceptual.h"
#include "trade/content_hash.h"

namespace tessera::trade {
namespace {

using Json = nlohmann::ordered_json;

/// A number of the statistics; `missing` when it is not there.
template <class T>
T value_of(const Json& statistics, const char* section, const char* name, T missing) {
  const auto part = statistics.find(section);
  if (part == statistics.end() || !part->contains(name)) return missing;
  const Json& value = part->at(name);
  return value.is_number() ? value.get<T>() : missing;
}

void read_statistics(const Json& statistics, Measurement& measurement) {
  measurement.frame_s = value_of(statistics, "times_s", "frame_s", unknown);
  measurement.rays = value_of(statistics, "counts", "rays", uint64_t(0));
  measurement.shaded_points = value_of(statistics, "counts", "points_shaded", uint64_t(0));
  measurement.samples = value_of(statistics, "counts", "samples", uint64_t(0));
  measurement.ste = value_of(statistics, "ratios", "ste", unknown);
}

/// Images are read here alone and gone before the next process starts.
void read_image(const std::string& path, const MeasureFiles& files, Measurement& measurement) {
  const Image image = read_exr(path);
  measurement.pixels = hash_pixels(image);
  if (measurement.round > 0) return;
  const ImageError error =
      error_of(colours_of(image, path), colours_of(read_exr(files.reference), files.reference));
  measurement.rmse = error.rmse;
  measurement.rel_mse = error.rel_mse;
  measurement.visible = error.visible;
}

}  // namespace

Image colours_of(const Image& image, const std::string& path) {
  Image colours(image.display_window, image.data_window);
  for (const char* name : {"R", "G", "B"}) {
    const Image::Channel* channel = image.find_channel(name);
    if (!channel) throw Error(fmt::format("{}: no channel {}", path, name));
    colours.channels.push_back(*channel);
  }
  return colours;
}

ImageError error_of(const Image& image, const Image& reference) {
  const ImageDifference difference = compare_images(image, reference);
  if (difference.nonfinite_mismatches > 0)
    throw Error(fmt::format("{} values are not finite in the image or the reference only",
                            difference.nonfinite_mismatches));
  return {difference.rmse, difference.rel_mse, visible_share(image, reference)};
}

Measurement measure(const Renderer& renderer, const Configuration& configuration, int round,
                    double limit_s, const MeasureFiles& files) {
  Measurement measurement;
  measurement.label = configuration.label();
  measurement.id = configuration.id;
  measurement.round = round;
  const std::string path = round == 0 ? files.image : files.image + ".repeat.exr";
  const Rendered rendered =
      renderer.render(configuration.options, path, std::min(limit_s, renderer.timeout_s()));
  measurement.wall_s = rendered.process.wall_s;
  measurement.cpu_s = rendered.process.cpu_s;
  measurement.peak_bytes = rendered.process.peak_bytes;
  measurement.error = rendered.failure;
  // Stopped before its own time limit, it says nothing about the configuration.
  measurement.stopped =
      rendered.process.cancelled || (rendered.process.timed_out && limit_s < renderer.timeout_s());
  if (measurement.error.empty()) {
    try {
      read_statistics(rendered.statistics, measurement);
      read_image(path, files, measurement);
    } catch (const Error& error) {
      measurement.error = error.what();
    }
  }
  measurement.ok = measurement.error.empty();
  std::error_code ignored;
  if (round > 0) std::filesystem::remove(path, ignored);
  return measurement;
}

}  // namespace tessera::trade
