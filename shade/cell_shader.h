#pragma once
/// Runs surface shaders over cells of any grids, and hands their colours to fragments.

#include <memory>
#include <span>
#include <vector>

#include "shade/bindings.h"
#include "shade/cell_points.h"

namespace tessera {

/// A cell's colours as a run of floats: Ci, Oi, then three for each light term.
class CellShader {
 public:
  explicit CellShader(std::shared_ptr<const ShaderBindings> bindings)
      : bindings_(std::move(bindings)) {}

  const ShaderBindings& bindings() const { return *bindings_; }
  size_t floats_per_cell() const { return 6 + 3 * bindings_->light_term_count(); }

  /// Shades cells in batches, one surface after the other. `values` is [cell][float]. Where a
  /// shader fails, Ci is NaN.
  void shade(std::span<const CellPoint> cells, std::span<float> values,
             ShadeCounters& counters) const;
  /// Gives each fragment the colours of its cell: values[cell_of_fragment[fragment]][float].
  void give(std::span<const uint32_t> cell_of_fragment, std::span<const float> values,
            ShadedFragments& out) const;

 private:
  void shade_batch(std::span<const CellPoint> cells, std::span<const uint32_t> places,
                   std::span<float> values, ShadeCounters& counters) const;

  std::shared_ptr<const ShaderBindings> bindings_;
};

}  // namespace tessera
