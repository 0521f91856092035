#include "images/compare.h"

#include <cmath>
#include <limits>

#include "base/error.h"

namespace tessera {
namespace {

struct Sums {
  double squared = 0.0, relative = 0.0;
};

void compare_channel(const Image& image, const Image::Channel& a, const Image::Channel& b,
                     Sums& sums, ImageDifference& result) {
  const auto note_largest = [&](double error, size_t i) {
    if (error <= result.largest) return;
    result.largest = error;
    result.largest_x = image.data_window.x0 + int(i % size_t(image.width()));
    result.largest_y = image.data_window.y0 + int(i / size_t(image.width()));
    result.largest_channel = a.name;
  };
  for (size_t i = 0; i < a.values.size(); ++i) {
    const double va = double(a.values[i]), vb = double(b.values[i]);
    ++result.values;
    if (!std::isfinite(va) || !std::isfinite(vb)) {
      if (va == vb || (std::isnan(va) && std::isnan(vb))) continue;
      ++result.nonfinite_mismatches;
      note_largest(std::numeric_limits<double>::infinity(), i);
      continue;
    }
    const double error = va - vb;
    sums.squared += error * error;
    sums.relative += error * error / (vb * vb + 0.01);
    note_largest(std::abs(error), i);
  }
}

}  // namespace

ImageDifference compare_images(const Image& a, const Image& b) {
  const PixelRect &wa = a.data_window, &wb = b.data_window;
  if (!(wa == wb))
    throw Error(
        fmt::format("the images cover different pixels: {} x {} at ({}, {}), {} x {} at "
                    "({}, {})",
                    wa.width(), wa.height(), wa.x0, wa.y0, wb.width(), wb.height(), wb.x0, wb.y0));
  ImageDifference result;
  Sums sums;
  for (const auto& channel : a.channels) {
    if (const auto* other = b.find_channel(channel.name))
      compare_channel(a, channel, *other, sums, result);
    else
      result.only_in_a.push_back(channel.name);
  }
  for (const auto& channel : b.channels)
    if (!a.find_channel(channel.name)) result.only_in_b.push_back(channel.name);
  if (result.values == 0) throw Error("the images have no pixel of a channel in common");

  const size_t counted = result.values - result.nonfinite_mismatches;
  if (counted > 0) {
    result.rmse = std::sqrt(sums.squared / double(counted));
    result.rel_mse = sums.relative / double(counted);
  }
  result.psnr_db = -20.0 * std::log10(result.rmse);
  return result;
}

}  // namespace tessera
