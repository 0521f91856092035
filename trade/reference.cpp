#include "trade/reference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "images/exr.h"
#include "trade/content_hash.h"
#include "trade/measure.h"

namespace tessera::trade {

namespace fs = std::filesystem;

namespace {

constexpr const char* scene_attribute = "tessera:trade:scene_hash";
constexpr const char* spp_attribute = "tessera:trade:spp";
constexpr const char* time_attribute = "tessera:trade:frame_s";
constexpr const char* error_attribute = "tessera:trade:rel_mse";

/// Runs use the default seed, 0.
constexpr const char* seeds[] = {"1013904223", "1664525"};

std::string attribute(const Image& image, const std::string& name) {
  const auto entry = image.metadata.find(name);
  return entry == image.metadata.end() ? std::string() : entry->second;
}

double number(const std::string& text) {
  return text.empty() ? unknown : std::strtod(text.c_str(), nullptr);
}

Reference described(const std::string& file, const Image& image) {
  Reference reference;
  reference.file = file;
  reference.spp = std::atoi(attribute(image, spp_attribute).c_str());
  reference.frame_s = number(attribute(image, time_attribute));
  reference.rel_mse = number(attribute(image, error_attribute));
  return reference;
}

std::string cache_key(const Renderer& renderer, const ReferenceRequest& request,
                      const std::vector<std::string>& options) {
  ContentHash hash;
  hash.add_item(request.scene_hash);
  hash.add_item(renderer.software());
  hash.add_item(renderer.build());
  hash.add_item("common");
  for (size_t i = 0; i < renderer.common().size(); ++i) {
    // How many threads there are shows in no bit of the image.
    if (renderer.common()[i] == "--threads") {
      ++i;
    } else {
      hash.add_item(renderer.common()[i]);
    }
  }
  hash.add_item("options");
  for (const std::string& option : options) hash.add_item(option);
  return hash.text();
}

int half_of(int spp) { return std::max(spp / 2, 1); }

/// Options of both halves.
std::vector<std::string> half_options(const Renderer& renderer, int spp) {
  std::vector<std::string> options = reference_options(renderer.common());
  options.insert(options.end(), {"--spp", std::to_string(half_of(spp))});
  return options;
}

/// Where the cache keeps a reference, whether or not it does.
fs::path cached_file(const Renderer& renderer, const ReferenceRequest& request) {
  const auto options = half_options(renderer, request.spp);
  return fs::path(request.cache) / (cache_key(renderer, request, options) + ".exr");
}

struct Half {
  Image image;
  double frame_s = 0;
};

Half render_half(const Renderer& renderer, const ReferenceRequest& request, const char* seed) {
  const std::string file = (fs::path(request.folder) / "reference_half.exr").string();
  std::vector<std::string> options = half_options(renderer, request.spp);
  options.insert(options.end(), {"--seed", seed});
  const Rendered rendered = renderer.render(options, file, request.left_s());
  if (!rendered.failure.empty())
    throw Error(fmt::format("the reference could not be rendered: {}", rendered.failure));
  Half half{read_exr(file), rendered.statistics.at("times_s").at("frame_s").get<double>()};
  fs::remove(file);
  return half;
}

/// The first half: it is kept in `file` until there is a second, so that what interrupts that costs
/// no more than the second.
Half first_half(const Renderer& renderer, const ReferenceRequest& request,
                const std::string& file) {
  if (fs::exists(file)) {
    Image image = read_exr(file);
    const double frame_s = number(attribute(image, time_attribute));
    request.say("one half of the reference is there already");
    return {std::move(image), frame_s};
  }
  Half half = render_half(renderer, request, seeds[0]);
  half.image.metadata[time_attribute] = fmt::format("{}", half.frame_s);
  write_exr(file, half.image);
  return half;
}

void check_same(const std::string& file, const std::string& what, const std::string& its,
                const std::string& expected) {
  if (!its.empty() && !expected.empty() && its != expected)
    throw Error(fmt::format("{} is no reference for this scene: its {} is '{}', expected '{}'",
                            file, what, its, expected));
}

std::string window_text(const PixelRect& window) {
  return fmt::format("{} {} to {} {}", window.x0, window.y0, window.x1, window.y1);
}

}  // namespace

std::vector<std::string> reference_options(const std::vector<std::string>& common) {
  const std::vector<std::pair<std::string, std::string>> accurate = {{"--shading", "sample"},
                                                                     {"--reconstruct", "filter"},
                                                                     {"--dicing-rate", "0.25"},
                                                                     {"--ray-dicing-rate", "1"}};
  std::vector<std::string> options;
  for (const auto& [name, value] : accurate)
    if (std::find(common.begin(), common.end(), name) == common.end())
      options.insert(options.end(), {name, value});
  return options;
}

MeanOfTwo mean_of_two(const Image& a, const Image& b) {
  constexpr double floor = 0.01;  // as in images/compare.h
  MeanOfTwo result{a, 0};
  double sum = 0;
  size_t count = 0;
  for (Image::Channel& channel : result.image.channels) {
    const Image::Channel* other = b.find_channel(channel.name);
    if (!other || other->values.size() != channel.values.size())
      throw Error("the halves of a reference have different channels");
    const bool colour = channel.name == "R" || channel.name == "G" || channel.name == "B";
    for (size_t i = 0; i < channel.values.size(); ++i) {
      const double x = channel.values[i], y = other->values[i], mean = 0.5 * (x + y);
      channel.values[i] = float(mean);
      if (!colour || !std::isfinite(mean)) continue;
      sum += 0.25 * (x - y) * (x - y) / (mean * mean + floor);
      ++count;
    }
  }
  if (count > 0) result.rel_mse = sum / double(count);
  return result;
}

Reference make_reference(const Renderer& renderer, const ReferenceRequest& request) {
  const std::vector<std::string> options = half_options(renderer, request.spp);
  std::error_code error;
  fs::create_directories(request.cache, error);
  if (error)
    throw Error(fmt::format("cannot keep references in {}: {}; --cache names another folder",
                            request.cache, error.message()));
  const std::string file = cached_file(renderer, request).string();
  Reference reference;
  if (fs::exists(file)) {
    reference = described(file, read_exr(file));
    reference.cached = true;
  } else {
    request.say(fmt::format("rendering the reference, twice {} samples per pixel: {}",
                            half_of(request.spp), fmt::join(options, " ")));
    const std::string half_file = fs::path(file).replace_extension(".half.exr").string();
    const Half first = first_half(renderer, request, half_file);
    const Half second = render_half(renderer, request, seeds[1]);
    MeanOfTwo mean = mean_of_two(first.image, second.image);
    mean.image.metadata[scene_attribute] = request.scene_hash;
    mean.image.metadata[spp_attribute] = std::to_string(2 * half_of(request.spp));
    mean.image.metadata[time_attribute] = fmt::format("{}", first.frame_s + second.frame_s);
    mean.image.metadata[error_attribute] = fmt::format("{}", mean.rel_mse);
    for (Image::Channel& channel : mean.image.channels) channel.type = PixelType::float32;
    write_exr(file, mean.image);
    fs::remove(half_file, error);
    reference = described(file, mean.image);
  }
  reference.options = options;
  return reference;
}

bool is_cached(const Renderer& renderer, const ReferenceRequest& request) {
  return fs::exists(cached_file(renderer, request));
}

double predict_reference_s(const std::vector<Pilot>& pilots, int spp) {
  return 2 * LinearCost::from(pilots.front(), pilots.back()).of(half_of(spp));
}

std::optional<Reference> kept_reference(const Renderer& renderer, const std::string& file,
                                        const std::string& expected_hash) {
  if (!fs::exists(file)) return std::nullopt;
  const Image image = read_exr(file);
  if (hash_pixels(image) != expected_hash) return std::nullopt;
  Reference reference = described(file, image);
  reference.cached = true;
  // An image that was given says nothing of how it was made.
  if (reference.spp > 0) reference.options = half_options(renderer, reference.spp);
  return reference;
}

Reference take_reference(const std::string& file, const std::string& probe,
                         const std::string& scene_hash) {
  const Image image = read_exr(file), expected = read_exr(probe);
  colours_of(image, file);
  check_same(file, "picture", window_text(image.display_window),
             window_text(expected.display_window));
  check_same(file, "crop", window_text(image.data_window), window_text(expected.data_window));
  check_same(file, "scene hash", attribute(image, scene_attribute), scene_hash);
  const auto file_name = [](const Image& of) {
    return fs::path(attribute(of, "tessera:scene")).filename().string();
  };
  check_same(file, "scene", file_name(image), file_name(expected));
  for (const char* option :
       {"frame", "projection", "clipping", "shutter", "depth_of_field", "exposure"}) {
    const std::string name = std::string("tessera:option:") + option;
    check_same(file, option, attribute(image, name), attribute(expected, name));
  }
  const std::string complete = attribute(image, "tessera:complete");
  if (complete.starts_with("no"))
    throw Error(fmt::format("{} is no reference: its rendering was interrupted", file));
  return described(file, image);
}

}  // namespace tessera::trade
