#pragma once
/// Stage header: dice. Surfaces of a Scene go in; Grids come out, diced when a bucket first needs
/// them, shared by the buckets they overlap, freed after the last one.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/counters.h"
#include "base/diagnostics.h"
#include "cameras/camera.h"
#include "dice/grid.h"

namespace tessera {

/// Moves the vertices of a freshly diced grid along their normals. Implemented by shade/, called by
/// dice/ for surfaces with a displacement shader.
class Displacer {
 public:
  virtual ~Displacer() = default;
  /// Writes one signed distance a vertex into `distance` (camera units, grid.stride() long), from
  /// the grid's positions, normals and primitive variables at shutter open. The same vertex of two
  /// neighbouring grids must get the same distance. Thread safe.
  virtual void displace(const Grid& grid, std::span<float> distance) const = 0;
};

struct DiceSettings {
  int max_grid_size = 32;           ///< micropolygons along u and v
  float shading_rate_scale = 1.0f;  ///< multiplies the area of every micropolygon
  /// Area of a micropolygon in pixels^2, in place of the surfaces' own: Attribute "dice" "rate" or,
  /// without one, ShadingRate.
  std::optional<float> dicing_rate;
  /// GeometricApproximation of surfaces that say nothing and are not displaced (DiceRate).
  float motion_factor = 0, focus_factor = 0;
  PixelRect crop;        ///< surfaces that cannot touch these pixels are never diced
  int bucket_size = 32;  ///< pixels; bucket (i, j) starts at crop.x0 + i * bucket_size, ...
  size_t memory_budget_bytes = size_t(2)
                               << 30;  ///< for grids; over it, idle grids are dropped and re-diced
  const Displacer* displacer = nullptr;  ///< null: displacement shaders are ignored
  /// Which primitive variables (besides P, N, st) a surface's shaders read; null: all.
  std::function<bool(const Attributes&, std::string_view name)> wants_primvar;
};

/// Area of a micropolygon of such a surface in pixels^2, without blur: Attribute "dice" "rate" or,
/// without one, ShadingRate.
float micropolygon_area(const Attributes& attributes);

struct DiceCounters {
  uint64_t surfaces = 0, faces = 0, splits = 0, grids = 0, micropolygons = 0, vertices = 0;
  uint64_t grids_diced_again = 0, culled = 0, dropped_nonfinite = 0;
  static constexpr auto fields() {
    using C = DiceCounters;
    return std::array{CounterField<C>{"surfaces", &C::surfaces},
                      CounterField<C>{"faces", &C::faces},
                      CounterField<C>{"splits", &C::splits},
                      CounterField<C>{"grids", &C::grids},
                      CounterField<C>{"micropolygons", &C::micropolygons},
                      CounterField<C>{"vertices", &C::vertices},
                      CounterField<C>{"grids_diced_again", &C::grids_diced_again},
                      CounterField<C>{"culled", &C::culled},
                      CounterField<C>{"dropped_nonfinite", &C::dropped_nonfinite}};
  }
};

/// Yields the grids of each bucket. Thread safe: buckets run in any order on any thread and always
/// get the same grids, bit for bit.
class GridSource {
 public:
  virtual ~GridSource() = default;

  /// Every grid whose raster bounds touch bucket (i, j), nearest z_min first, ties by id.
  virtual std::vector<std::shared_ptr<const Grid>> grids_of_bucket(int i, int j) = 0;
  /// Bucket (i, j) will not ask again: grids that no other bucket waits for are freed.
  virtual void finish_bucket(int i, int j) = 0;

  virtual DiceCounters counters() const = 0;
  virtual size_t peak_bytes() const = 0;  ///< high-water mark of grids held
};

/// `scene` and `camera` must outlive the source. Static work (topology, bounds) is done here, in
/// parallel. Surfaces that cannot be evaluated are reported to `diagnostics` and skipped.
std::unique_ptr<GridSource> make_grid_source(const Scene& scene, const Camera& camera,
                                             const DiceSettings& settings,
                                             Diagnostics& diagnostics);

}  // namespace tessera
