#include "report/scale_down.h"

#include <algorithm>

namespace tessera {
namespace {

/// Mean of the pixels [x0, x1) x [y0, y1), counted from the top left one held.
float mean_of(const std::vector<float>& values, int width, int x0, int x1, int y0, int y1) {
  double sum = 0.0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) sum += values[size_t(y) * size_t(width) + size_t(x)];
  return float(sum / (double(x1 - x0) * double(y1 - y0)));
}

}  // namespace

int report_reduction(const Image& image) {
  const int side = std::max(image.width(), image.height());
  return std::max(1, (side + largest_report_side - 1) / largest_report_side);
}

Image scaled_down(const Image& image, int n, std::span<const std::string> names) {
  const int width = image.width(), height = image.height();
  Image small((width + n - 1) / n, (height + n - 1) / n);
  for (const std::string& name : names) {
    const Image::Channel* channel = image.find_channel(name);
    if (!channel) continue;
    std::vector<float>& means = small.add_channel(name).values;
    for (int y = 0; y < small.height(); ++y)
      for (int x = 0; x < small.width(); ++x)
        means[small.index(x, y)] =
            mean_of(channel->values, width, x * n, std::min(width, x * n + n), y * n,
                    std::min(height, y * n + n));
  }
  return small;
}

}  // namespace tessera
