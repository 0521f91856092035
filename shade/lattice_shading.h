#pragma once
/// Decoupled shading: samples of a surface point find the cell that holds it in the shading space
/// of its grid, and each cell is shaded once, at the point of the grid nearest its centre.

#include <functional>

#include "shade/cell_memo.h"
#include "shade/cell_shader.h"
#include "shade/grid_attachments.h"

namespace tessera {

/// Cells along the edge of a micropolygon of the size that the settings ask for: what is left to go
/// by where a grid has no place on the raster.
int cells_per_edge(const ShadingFrame& frame);

class LatticeShading : public Shading {
 public:
  /// `settings_of` gives the cells of a grid, a function of the grid alone.
  using SettingsOf = std::function<ShadingSpaceSettings(const Grid&)>;
  LatticeShading(const ShadingFrame& frame, SettingsOf settings_of)
      : shader_(frame.bindings), settings_of_(std::move(settings_of)) {}

  void shade(const ShadeInput& input, ShadedFragments& out, ShadeCounters& counters) override;
  void requests(const ShadeInput& input, size_t fragment,
                std::vector<ShadingRequest>& out) override;

 private:
  struct BucketCells;

  CellMemo& memo_of(const Grid& grid, ShadeCounters* counters);
  BucketCells cells_of(const ShadeInput& input, ShadeCounters& counters);
  void show_cells(const ShadeInput& input, const BucketCells& bucket,
                  std::vector<uint32_t>& cells) const;
  void shade_claimed(const ShadeInput& input, BucketCells& bucket, ShadeCounters& counters) const;

  CellShader shader_;
  SettingsOf settings_of_;
  GridAttachments attachments_;
};

}  // namespace tessera
