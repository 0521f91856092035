/// tessera compare: how far one image is from another.

#include <cmath>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/command.h"
#include "engine/frame_files.h"
#include "images/compare.h"
#include "images/exr.h"
#include "images/file_kinds.h"
#include "images/image_module.h"
#include "images/perceptual.h"
#include "images/preview.h"

namespace tessera {
namespace {

struct CompareOptions {
  std::vector<std::string> channels;  // empty: all
  std::string a, b, difference;
  std::optional<double> fail_over_rmse;
};

Image read_image(const std::string& path) {
  return holds_exr(path) ? read_exr(path) : load_image_module()->read_image(path);
}

/// As read_image, but the code values of 8-bit pictures become linear.
Image linear_colors(Image image, const std::string& path) {
  if (holds_exr(path) || !named_8_bit(path)) return image;
  for (Image::Channel& channel : image.channels)
    for (float& value : channel.values) value = linear_from_srgb(value);
  return image;
}

/// The channels that are asked for, or all. Throws Error when one is missing.
Image read_channels(const std::string& path, const std::vector<std::string>& names) {
  Image image = read_image(path);
  if (names.empty()) return image;
  std::vector<Image::Channel> chosen;
  for (const std::string& name : names) {
    const Image::Channel* channel = image.find_channel(name);
    if (!channel) throw Error(fmt::format("{}: no channel {}", path, name));
    chosen.push_back(*channel);
  }
  image.channels = std::move(chosen);
  return image;
}

/// |a - b| of the channels both have.
Image absolute_difference(const Image& a, const Image& b) {
  Image difference(a.display_window, a.data_window);
  for (const Image::Channel& channel : a.channels) {
    const Image::Channel* other = b.find_channel(channel.name);
    if (!other) continue;
    std::vector<float>& values = difference.add_channel(channel.name).values;
    for (size_t i = 0; i < values.size(); ++i) {
      values[i] = std::abs(channel.values[i] - other->values[i]);
    }
  }
  return difference;
}

void write_difference(const Image& difference, const std::string& path) {
  if (named_exr(path)) return write_exr(path, difference);
  // A difference in alpha would hide the others.
  Image colours(difference.display_window, difference.data_window);
  for (const Image::Channel& channel : difference.channels) {
    if (channel.name != "A") colours.add_channel(channel.name).values = channel.values;
  }
  load_image_module()->write_image(path, colours);
}

void print(const ImageDifference& difference) {
  fmt::print("RMSE     {:.6g}\nrelMSE   {:.6g}\nPSNR     {:.4g} dB\n", difference.rmse,
             difference.rel_mse, difference.psnr_db);
  if (difference.largest_channel.empty()) {
    fmt::print("largest  0\n");
  } else {
    fmt::print("largest  {:.6g} at pixel {} {}, channel {}\n", difference.largest,
               difference.largest_x, difference.largest_y, difference.largest_channel);
  }
  if (difference.nonfinite_mismatches > 0) {
    fmt::print("{} of {} values are NaN or infinite in one image only\n",
               difference.nonfinite_mismatches, difference.values);
  }
  if (!difference.only_in_a.empty() || !difference.only_in_b.empty()) {
    fmt::print("not compared: only in the first: {}; only in the second: {}\n",
               fmt::join(difference.only_in_a, " "), fmt::join(difference.only_in_b, " "));
  }
}

int run(const CompareOptions& options) {
  if (!options.difference.empty()) {
    check_writable(options.difference);
    check_format(options.difference);
  }
  const Image a = read_channels(options.a, options.channels);
  const Image b = read_channels(options.b, options.channels);
  const ImageDifference difference = compare_images(a, b);
  print(difference);
  if (have_colors(a, b)) {
    const double share = visible_share(linear_colors(a, options.a), linear_colors(b, options.b));
    fmt::print("visible  {:.4g} % of pixels\n", 100.0 * share);
  }
  if (!options.difference.empty()) {
    write_difference(absolute_difference(a, b), options.difference);
  }
  if (!options.fail_over_rmse) return exit_success;
  // An RMSE that is not a number is past every limit, and so is a value that could not be compared.
  const bool within =
      difference.rmse <= *options.fail_over_rmse && difference.nonfinite_mismatches == 0;
  return within ? exit_success : exit_failure;
}

std::function<int()> set_up(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  app.add_option("a", options->a, "image to judge")->required()->type_name("A.exr");
  app.add_option("b", options->b, "reference")->required()->type_name("B.exr");
  app.add_option("--fail-over", options->fail_over_rmse, "exit with 1 when the RMSE is larger")
      ->check(CLI::NonNegativeNumber)
      ->type_name("RMSE");
  app.add_option("--channels", options->channels,
                 "channels to compare, separated by commas, as R,G,B; depths beside colours drown "
                 "them. Default: all that both have")
      ->delimiter(',')
      ->type_name("LIST");
  app.add_option("--diff", options->difference, "image of the absolute differences to write")
      ->type_name("OUT.png");
  app.footer(
      "RMSE: root of the mean squared difference. relMSE: mean of (a - b)^2 / (b^2 + 0.01). PSNR:\n"
      "for a peak of 1. Visible: pixels where a viewer would see the difference by Yee's "
      "perceptual\n"
      "metric (2004), for a picture of 45 degrees whose white is 100 cd/m^2; of R, G and B.");
  return [options] { return run(*options); };
}

}  // namespace

CommandDefinition command_compare() {
  return {"compare",
          "Print RMSE, relMSE, PSNR, the largest and the visible differences of two images",
          set_up};
}

}  // namespace tessera
