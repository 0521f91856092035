#include "report/embedding.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "images/exr.h"
#include "report/scale_down.h"

namespace tessera {
namespace {

using Json = nlohmann::ordered_json;

/// The text of a member; empty when it is not there or no text.
std::string text_of(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

bool flag_of(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_boolean() && found->get<bool>();
}

/// Whether nothing but the number of samples was set.
bool is_default(const Json& run) {
  const auto settings = run.find("settings");
  if (settings == run.end() || !settings->is_object()) return false;
  for (const auto& [name, value] : settings->items())
    if (name != "spp") return false;
  return true;
}

/// Appends what `wanted` runs have: their images, then their heat maps.
template <typename Wanted>
void append_runs(const Json& runs, Wanted wanted, std::vector<ReportImage>& images) {
  for (const Json& run : runs) {
    const std::string file = text_of(run, "image");
    if (!wanted(run) || file.empty()) continue;
    images.push_back({file, file, fmt::format("run {}", text_of(run, "id")), "", {}});
  }
  for (const Json& run : runs) {
    const auto maps = run.find("heatmaps");
    if (!wanted(run) || maps == run.end() || !maps->is_object()) continue;
    for (const auto& [measure, file] : maps->items()) {
      if (!file.is_string()) continue;
      const std::string name = file.template get<std::string>();
      images.push_back({name + "#" + measure,
                        name,
                        fmt::format("{} of run {}", measure, text_of(run, "id")),
                        measure,
                        {}});
    }
  }
}

/// The channel of a heat map: as the renderer names it, or as the measure.
std::string heatmap_channel_of(const Image& image, const ReportImage& wanted) {
  for (const std::string& name : {"heatmap." + wanted.measure, wanted.measure})
    if (image.find_channel(name)) return name;
  throw Error(fmt::format("{}: expected a channel 'heatmap.{}'", wanted.file, wanted.measure));
}

/// Reads and encodes an image, made smaller where it is large.
void encode(ReportImage& wanted, const std::filesystem::path& path) {
  Image image = read_exr(path.string());
  std::vector<std::string> channels = {"R", "G", "B"};
  if (!wanted.measure.empty())
    channels = {heatmap_channel_of(image, wanted)};
  else if (!std::ranges::all_of(channels, [&](const auto& c) { return image.find_channel(c); }))
    throw Error(fmt::format("{}: expected channels R, G and B", path.string()));
  wanted.reduction = report_reduction(image);
  if (wanted.reduction > 1) image = scaled_down(image, wanted.reduction, channels);
  wanted.encoded =
      wanted.measure.empty() ? encode_colour(image) : encode_scalar(image, channels[0]);
}

}  // namespace

std::vector<ReportImage> images_by_importance(const Json& table) {
  std::vector<ReportImage> images;
  if (const auto reference = table.find("reference");
      reference != table.end() && reference->is_object()) {
    const std::string file = text_of(*reference, "file");
    if (!file.empty()) images.push_back({file, file, "reference", "", {}});
  }
  const auto runs = table.find("runs");
  if (runs == table.end() || !runs->is_array()) return images;
  const auto front = [](const Json& run) { return !is_default(run) && flag_of(run, "pareto"); };
  append_runs(*runs, is_default, images);
  append_runs(*runs, front, images);
  append_runs(
      *runs, [&](const Json& run) { return !is_default(run) && !front(run); }, images);
  return images;
}

Embedding embed_images(const Json& table, const std::filesystem::path& folder,
                       size_t budget_bytes) {
  Embedding embedding;
  bool full[2] = {};  // of colour images, of heat maps
  for (ReportImage& image : images_by_importance(table)) {
    const std::filesystem::path path = folder / image.file;
    if (!std::filesystem::is_regular_file(path))
      throw Error(fmt::format("{} is missing: the image of the {}", path.string(), image.what));
    bool& kind_is_full = full[image.measure.empty() ? 0 : 1];
    if (!kind_is_full) {
      encode(image, path);
      kind_is_full = embedding.bytes + image.encoded.text.size() > budget_bytes;
    }
    if (kind_is_full) {
      image.encoded.text.clear();
      embedding.left_out.push_back(std::move(image));
    } else {
      embedding.bytes += image.encoded.text.size();
      embedding.images.push_back(std::move(image));
    }
  }
  return embedding;
}

}  // namespace tessera
