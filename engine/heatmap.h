#pragma once
/// Maps of what each pixel cost: `--heatmap NAME`. A map is a channel of the image and a picture in
/// false colours.

#include <array>
#include <atomic>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hide/hide.h"
#include "images/image.h"
#include "shade/shade.h"

namespace tessera {

/// A kind of heat map: a row of the table in heatmap.cpp.
struct HeatmapDefinition {
  const char* name;
  const char* help;
  const char* unit;  ///< of a pixel's value
  /// Where the stage that counts puts what it has. Both null: extra samples, which the engine
  /// counts.
  std::span<uint32_t> HideInput::*hide_counts;
  std::vector<glm::vec2>* ShadeInput::*shade_places;

  bool extra() const { return !hide_counts && !shade_places; }
};

std::span<const HeatmapDefinition> heatmap_registry();
/// Throws Error that lists the choices when unknown.
const HeatmapDefinition& find_heatmap(std::string_view name);

/// Counts for the pixels of a frame, gathered bucket by bucket.
class Heatmap {
 public:
  /// `pixels`: the frame's crop; what buckets count outside it is left out.
  Heatmap(const HeatmapDefinition& definition, const PixelRect& pixels);

  const HeatmapDefinition& definition() const { return definition_; }
  /// Whether anything was counted, inside the crop or not.
  bool filled() const { return filled_; }
  /// `counts` of the pixels of `rect`, row-major. May be called at once for buckets that do not
  /// overlap.
  void add_bucket(const PixelRect& rect, std::span<const uint32_t> counts);
  /// Counts one in the pixel of each raster position; those outside the crop are left out. Thread
  /// safe.
  void add_places(std::span<const glm::vec2> raster);
  /// Appends the channel heatmap_channel(name) to an image over the same pixels.
  void add_channel(Image& image) const;

 private:
  const HeatmapDefinition& definition_;
  PixelRect pixels_;
  std::vector<uint32_t> counts_;
  std::mutex places_mutex_;
  std::atomic<bool> filled_ = false;
};

/// "heatmap.NAME".
std::string heatmap_channel(std::string_view name);

/// What the colours of a map stand for: its lowest value above zero is darkest, its highest
/// brightest, with the logarithm in between. Zero is black.
struct HeatmapScale {
  double min = 0, lowest_above_zero = 0, max = 0, mean = 0;
};
HeatmapScale heatmap_scale(const Image& image, std::string_view name);
/// One line for people, with units.
std::string describe_scale(const HeatmapScale& scale, std::string_view name);

/// Linear R, G and B of the map `name`, which must be a channel of `image`.
Image heatmap_picture(const Image& image, std::string_view name);

/// sRGB code values in [0, 1] of the ramp at `position` in [0, 1]: from black over purple and
/// orange to yellow, lightness (CIE L*) rising evenly.
std::array<float, 3> heatmap_colour(float position);

}  // namespace tessera
