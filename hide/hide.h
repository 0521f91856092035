#pragma once
/// Stage header: hide. The samples and the grids of a bucket go in; Fragments come out: who is
/// seen, where, with what weight. Hiders are interchangeable, and all that test samples with the
/// function of hide/coverage.h give the same fragments bit for bit.

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/counters.h"
#include "cameras/camera.h"
#include "dice/grid.h"
#include "hide/samples.h"

namespace tessera {

/// Visible pieces of a bucket, one entry of each array per fragment. Point-sampling hiders give
/// fragments of weight 1 / samples_per_pixel, ordered by sample and front to back within it;
/// fragments behind an opaque one are absent. The camera-space point a fragment shows is
/// (1 - b1 - b2) * A + b1 * B + b2 * C at the sample's time, with A, B, C the corners of its
/// triangle in the order of dice/grid.h.
struct FragmentList {
  std::vector<uint32_t> sample;           ///< index into the SampleBlock
  std::vector<uint32_t> grid;             ///< index into HideInput::grids
  std::vector<uint32_t> triangle;         ///< 2 * micropolygon + (0 or 1)
  std::vector<float> b1, b2;              ///< barycentric coordinates
  std::vector<float> z;                   ///< camera depth
  std::vector<float> weight;              ///< share of the pixel
  std::vector<uint32_t> first_of_sample;  ///< [sample]: its first fragment; one past the end last

  size_t size() const { return grid.size(); }
  void clear();
};

/// A grid as the hider meets it.
struct HideGrid {
  const Grid* grid = nullptr;
  bool opaque = true;  ///< false: fragments behind it are kept too
};

/// What the frame needs of visibility (engine/plan.h derives it). Chosen once per frame.
struct HideFeatures {
  bool motion = false;        ///< some grid has more than one key
  bool lens = false;          ///< the lens is open
  bool transparency = false;  ///< some grid is not opaque
  bool operator==(const HideFeatures&) const = default;
};

struct HideInput {
  const SampleBlock* samples = nullptr;
  /// In the order of GridSource::grids_of_bucket. At equal depth the earlier grid, then the earlier
  /// triangle, is in front.
  std::span<const HideGrid> grids;
  RasterClipMap raster_clip;
  float near_clip = 0, far_clip = 0;  ///< camera z; only hits within are seen
  float lens_extent = 1;              ///< largest |u|, |v|
  HideFeatures features;
  /// Samples tested in each pixel of the bucket are added here, row-major; empty: nobody asks.
  std::span<uint32_t> tests_per_pixel;
};

/// STE (sample test efficiency) is samples_covered / samples_tested, where a sample counts as
/// tested once for each micropolygon (both triangles) whose exact coverage test it enters, and as
/// covered when one of the two triangles covers it.
struct HideCounters {
  uint64_t samples = 0, samples_tested = 0, samples_covered = 0, tiles_visited = 0;
  uint64_t micropolygons = 0, micropolygons_culled = 0, fragments = 0, nonfinite_dropped = 0;
  static constexpr auto fields() {
    using C = HideCounters;
    return std::array{CounterField<C>{"samples", &C::samples},
                      CounterField<C>{"samples_tested", &C::samples_tested},
                      CounterField<C>{"samples_covered", &C::samples_covered},
                      CounterField<C>{"tiles_visited", &C::tiles_visited},
                      CounterField<C>{"micropolygons", &C::micropolygons},
                      CounterField<C>{"micropolygons_culled", &C::micropolygons_culled},
                      CounterField<C>{"fragments", &C::fragments},
                      CounterField<C>{"nonfinite_dropped", &C::nonfinite_dropped}};
  }
};

/// Visibility of one bucket at a time. Immutable and thread safe; what a bucket needs lives in the
/// caller's scratch space.
class Hider {
 public:
  virtual ~Hider() = default;
  /// Reusable buffers of one thread, so that a bucket allocates nothing once they have grown.
  class Scratch {
   public:
    virtual ~Scratch() = default;
  };
  virtual std::unique_ptr<Scratch> make_scratch() const = 0;
  /// The samples this hider is made for. Throws Error if it cannot take so many a pixel.
  virtual SampleTuples sample_tuples(int samples_per_pixel) const {
    (void)samples_per_pixel;
    return {};
  }
  /// Writes the visible fragments of the bucket into `out` (cleared first) and adds to `counters`.
  virtual void hide(const HideInput& input, Scratch& scratch, FragmentList& out,
                    HideCounters& counters) const = 0;
};

/// A kind of hider, one file of hide/hiders/ each. `--hider name:arguments` picks and tunes it.
struct HiderDefinition {
  const char* name;
  const char* help;
  std::unique_ptr<Hider> (*make)(std::string_view arguments);  ///< throws Error on bad arguments
};

std::span<const HiderDefinition> hider_registry();
/// `spec` is "name" or "name:arguments"; throws Error that lists the choices when unknown.
std::unique_ptr<Hider> make_hider(std::string_view spec);

}  // namespace tessera
