#include <cmath>
#include <mutex>

#include <fmt/format.h>

#include "base/error.h"
#include "reconstruct/exposure.h"
#include "reconstruct/groups.h"
#include "reconstruct/pixel_filter.h"
#include "reconstruct/product_sums.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/sample_block.h"
#include "reconstruct/sample_sums.h"

namespace tessera {
namespace {

float checked_width(const char* axis, float width) {
  if (!(width > 0) || width > 64)
    throw Error(fmt::format("pixel filter {} width must be above 0 and up to 64 pixels, found {}",
                            axis, width));
  return width;
}

}  // namespace

/// The buckets' samples while someone may still need them, and the image they go to.
class Film::Blocks {
 public:
  explicit Blocks(const FilmSettings& settings);

  void add(int i, int j, SampleValues&& values);
  Image finish();
  FilmCounters counters() const;
  int peak_blocks() const;
  std::vector<std::vector<float>> take_products() { return std::move(products_); }

 private:
  struct Slot {
    std::shared_ptr<const WeightedBlock> block;
    int missing = 0;  ///< buckets of the neighbourhood that have not arrived
    int waiting = 0;  ///< buckets of the neighbourhood whose pixels are not finished
    bool arrived = false, finished = false;
  };
  /// A channel that is filtered, by its place in SampleValues::groups.
  struct Filtered {
    size_t group, channel;
  };
  /// A bucket's neighbourhood while its pixels are summed; null where nothing arrived.
  struct View {
    PixelRect buckets;
    std::vector<std::shared_ptr<const WeightedBlock>> blocks;
  };

  int columns() const { return (sampled().width() + size() - 1) / size(); }
  int rows() const { return (sampled().height() + size() - 1) / size(); }
  int size() const { return settings_.bucket_size; }
  const PixelRect& sampled() const { return settings_.sampled; }
  Slot& slot(int i, int j) { return slots_[size_t(j) * size_t(columns()) + size_t(i)]; }
  PixelRect rect(int i, int j) const;
  PixelRect neighbourhood(int i, int j) const;
  template <class Visit>
  void for_neighbours(int i, int j, Visit visit);

  View view_of(int i, int j);
  void finish_bucket(int i, int j);
  void sum_pixel(int x, int y, const View& view, std::vector<PixelSamples>& pixels);
  PixelRect footprint(int x, int y) const;
  void sum_products_of(const PixelRect& row, const View& view, ProductSums& sums);
  const std::vector<float>& sum_products_at(int x, int y, const View& view, ProductSums& sums);
  void gather_footprint(int x, int y, size_t batch, const View& view,
                        std::vector<PixelSamples>& pixels) const;
  const WeightedBlock* block_of(int x, int y, const View& view) const;
  void take_closest(int x, int y, const WeightedBlock& block);

  FilmSettings settings_;
  FilterTable x_table_, y_table_;
  int depth_group_, color_group_;
  Image image_;
  std::vector<Filtered> filtered_;
  std::vector<std::vector<float>> products_;  ///< [product][pixel] of image_
  std::vector<std::vector<float*>> planes_;   ///< [group][channel] of image_
  std::vector<Slot> slots_;
  mutable std::mutex mutex_;  ///< guards slots_ and what follows
  FilmCounters counters_;
  int held_blocks_ = 0, peak_blocks_ = 0;
};

Film::Blocks::Blocks(const FilmSettings& settings)
    : settings_(settings),
      x_table_(find_pixel_filter(settings.filter), checked_width("x", settings.filter_x_width)),
      y_table_(find_pixel_filter(settings.filter), checked_width("y", settings.filter_y_width)),
      depth_group_(find_group(settings.groups, "z")),
      color_group_(find_group(settings.groups, "rgb")),
      image_(settings.display_window, settings.crop) {
  check_channels(settings.groups);
  if (settings_.sampled.empty()) settings_.sampled = settings_.crop;
  for (const AovDefinition* group : settings_.groups)
    for (const std::string& channel : group->channels)
      image_.add_channel(channel, PixelType::float32, group->background);
  for (size_t g = 0; g < settings_.groups.size(); ++g)
    if (settings_.groups[g]->filter == ChannelFilter::filtered)
      for (size_t c = 0; c < settings_.groups[g]->channels.size(); ++c) filtered_.push_back({g, c});
  size_t next = 0;
  for (const AovDefinition* group : settings_.groups) {
    planes_.emplace_back();
    for (size_t c = 0; c < group->channels.size(); ++c)
      planes_.back().push_back(image_.channels[next++].values.data());
  }
  products_.assign(ProductSums(settings_.products).count(),
                   std::vector<float>(size_t(image_.data_window.pixel_count())));
  slots_.resize(size_t(columns()) * size_t(rows()));
  for (int j = 0; j < rows(); ++j)
    for (int i = 0; i < columns(); ++i)
      slot(i, j).missing = slot(i, j).waiting = int(neighbourhood(i, j).pixel_count());
}

PixelRect Film::Blocks::rect(int i, int j) const {
  const int x = sampled().x0 + i * size(), y = sampled().y0 + j * size();
  return PixelRect{x, y, x + size(), y + size()}.intersect(sampled());
}

/// Buckets within the filter's reach of bucket (i, j), itself included, as a rectangle of buckets.
PixelRect Film::Blocks::neighbourhood(int i, int j) const {
  const int x_reach = (x_table_.reach_pixels() + size() - 1) / size();
  const int y_reach = (y_table_.reach_pixels() + size() - 1) / size();
  return PixelRect{i - x_reach, j - y_reach, i + x_reach + 1, j + y_reach + 1}.intersect(
      {0, 0, columns(), rows()});
}

template <class Visit>
void Film::Blocks::for_neighbours(int i, int j, Visit visit) {
  const PixelRect near = neighbourhood(i, j);
  for (int b = near.y0; b < near.y1; ++b)
    for (int a = near.x0; a < near.x1; ++a) visit(a, b);
}

void Film::Blocks::add(int i, int j, SampleValues&& values) {
  uint64_t dropped = 0;
  auto block = std::make_shared<const WeightedBlock>(std::move(values), settings_.groups, x_table_,
                                                     y_table_, dropped);
  std::vector<std::pair<int, int>> ready;
  {
    std::lock_guard lock(mutex_);
    slot(i, j).block = std::move(block);
    slot(i, j).arrived = true;
    counters_.nonfinite_samples_dropped += dropped;
    peak_blocks_ = std::max(peak_blocks_, ++held_blocks_);
    for_neighbours(i, j, [&](int a, int b) {
      if (--slot(a, b).missing == 0) ready.emplace_back(a, b);
    });
  }
  for (const auto& [a, b] : ready) finish_bucket(a, b);
}

Film::Blocks::View Film::Blocks::view_of(int i, int j) {
  View view{neighbourhood(i, j), {}};
  std::lock_guard lock(mutex_);
  for_neighbours(i, j, [&](int a, int b) { view.blocks.push_back(slot(a, b).block); });
  return view;
}

void Film::Blocks::finish_bucket(int i, int j) {
  const PixelRect pixels = rect(i, j).intersect(settings_.crop);
  {
    const View view = view_of(i, j);
    std::vector<PixelSamples> footprint;
    for (int y = pixels.y0; y < pixels.y1; ++y)
      for (int x = pixels.x0; x < pixels.x1; ++x) sum_pixel(x, y, view, footprint);
    if (ProductSums sums(settings_.products); sums.count() > 0)
      for (int y = pixels.y0; y < pixels.y1; ++y)
        sum_products_of({pixels.x0, y, pixels.x1, y + 1}, view, sums);
  }
  std::lock_guard lock(mutex_);
  slot(i, j).finished = true;
  counters_.pixels += uint64_t(pixels.pixel_count());
  for_neighbours(i, j, [&](int a, int b) {
    if (--slot(a, b).waiting > 0 || !slot(a, b).block) return;
    slot(a, b).block.reset();
    --held_blocks_;
  });
}

PixelRect Film::Blocks::footprint(int x, int y) const {
  const int x_reach = x_table_.reach_pixels(), y_reach = y_table_.reach_pixels();
  return PixelRect{x - x_reach, y - y_reach, x + x_reach + 1, y + y_reach + 1}.intersect(sampled());
}

/// The pixels in the footprint of (x, y) that have samples, in raster order, with the channels of
/// a batch. The last batch repeats its first channel, and the repeats go nowhere.
void Film::Blocks::gather_footprint(int x, int y, size_t batch, const View& view,
                                    std::vector<PixelSamples>& pixels) const {
  const PixelRect near = footprint(x, y);
  pixels.clear();
  for (int qy = near.y0; qy < near.y1; ++qy) {
    for (int qx = near.x0; qx < near.x1; ++qx) {
      const WeightedBlock* block = block_of(qx, qy, view);
      if (!block) continue;
      const size_t first = block->first_sample(qx, qy);
      PixelSamples& pixel = pixels.emplace_back();
      pixel.wx = block->x_weights(x - qx) + first;
      pixel.wy = block->y_weights(y - qy) + first;
      pixel.count = block->sample_count(qx, qy);
      for (size_t c = 0; c < sum_channels; ++c) {
        const size_t k = batch * sum_channels + c;
        const Filtered& f = filtered_[k < filtered_.size() ? k : batch * sum_channels];
        pixel.channels[c] = block->channel(f.group, f.channel) + first;
      }
    }
  }
}

void Film::Blocks::sum_pixel(int x, int y, const View& view, std::vector<PixelSamples>& pixels) {
  const WeightedBlock* own = block_of(x, y, view);
  if (own) take_closest(x, y, *own);
  const size_t at = image_.index(x, y);
  for (size_t first = 0; first < filtered_.size(); first += sum_channels) {
    gather_footprint(x, y, first / sum_channels, view, pixels);
    double sums[1 + sum_channels];
    sum_footprint(pixels.data(), pixels.size(), sums);
    if (std::abs(sums[0]) < 1e-20) return;
    for (size_t k = first; k < std::min(first + sum_channels, filtered_.size()); ++k) {
      const float value = float(sums[1 + k - first] / sums[0]);
      const Filtered& f = filtered_[k];
      planes_[f.group][f.channel][at] =
          int(f.group) == color_group_
              ? exposed(value, settings_.exposure_gain, settings_.exposure_gamma)
              : value;
    }
  }
}

/// A row at a time, so that planes, which lie far apart, are visited once a row.
void Film::Blocks::sum_products_of(const PixelRect& row, const View& view, ProductSums& sums) {
  std::vector<float> totals;
  for (int x = row.x0; x < row.x1; ++x) {
    const std::vector<float>& pixel = sum_products_at(x, row.y0, view, sums);
    totals.insert(totals.end(), pixel.begin(), pixel.end());
  }
  const size_t at = image_.index(row.x0, row.y0), count = sums.count();
  for (size_t p = 0; p < count; ++p)
    for (size_t x = 0; x < size_t(row.width()); ++x) products_[p][at + x] = totals[x * count + p];
}

/// Pixels that lie next to each other in a bucket are gathered at once.
const std::vector<float>& Film::Blocks::sum_products_at(int x, int y, const View& view,
                                                        ProductSums& sums) {
  const PixelRect near = footprint(x, y);
  sums.clear();
  for (int qy = near.y0; qy < near.y1; ++qy) {
    for (int qx = near.x0, end; qx < near.x1; qx = end) {
      end = std::min(near.x1, sampled().x0 + ((qx - sampled().x0) / size() + 1) * size());
      if (const WeightedBlock* block = block_of(qx, qy, view)) sums.add(*block, x, y, qx, end, qy);
    }
  }
  return sums.finish();
}

const WeightedBlock* Film::Blocks::block_of(int x, int y, const View& view) const {
  const int column = (x - sampled().x0) / size() - view.buckets.x0;
  const int row = (y - sampled().y0) / size() - view.buckets.y0;
  return view.blocks[size_t(row) * size_t(view.buckets.width()) + size_t(column)].get();
}

/// Channels that must not be averaged take the pixel's own sample of least depth. WeightedBlock has
/// put samples that are not finite at infinite depth.
void Film::Blocks::take_closest(int x, int y, const WeightedBlock& block) {
  if (depth_group_ < 0) return;
  const size_t first = block.first_sample(x, y), count = block.sample_count(x, y);
  const float* z = block.channel(size_t(depth_group_), 0) + first;
  size_t nearest = 0;
  for (size_t k = 1; k < count; ++k)
    if (z[k] < z[nearest]) nearest = k;
  const size_t pixel = image_.index(x, y);
  for (size_t g = 0; g < settings_.groups.size(); ++g)
    if (settings_.groups[g]->filter == ChannelFilter::closest)
      for (size_t c = 0; c < planes_[g].size(); ++c)
        planes_[g][c][pixel] = block.channel(g, c)[first + nearest];
}

Image Film::Blocks::finish() {
  for (int j = 0; j < rows(); ++j)
    for (int i = 0; i < columns(); ++i)
      if (slot(i, j).arrived && !slot(i, j).finished) finish_bucket(i, j);
  return std::move(image_);
}

FilmCounters Film::Blocks::counters() const {
  std::lock_guard lock(mutex_);
  return counters_;
}

int Film::Blocks::peak_blocks() const {
  std::lock_guard lock(mutex_);
  return peak_blocks_;
}

PixelRect sampled_pixels(const PixelRect& crop, const PixelRect& frame, float filter_x_width,
                         float filter_y_width) {
  const int x = FilterTable::reach_pixels(checked_width("x", filter_x_width));
  const int y = FilterTable::reach_pixels(checked_width("y", filter_y_width));
  return PixelRect{crop.x0 - x, crop.y0 - y, crop.x1 + x, crop.y1 + y}.intersect(frame);
}

Film::Film(const FilmSettings& settings) : blocks_(std::make_unique<Blocks>(settings)) {}
Film::~Film() = default;
void Film::add_bucket(int i, int j, SampleValues&& values) {
  blocks_->add(i, j, std::move(values));
}
Image Film::finish() { return blocks_->finish(); }
FilmCounters Film::counters() const { return blocks_->counters(); }
std::vector<std::vector<float>> Film::take_products() { return blocks_->take_products(); }
int Film::peak_blocks() const { return blocks_->peak_blocks(); }

}  // namespace tessera
