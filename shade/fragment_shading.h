#pragma once
/// Shading tied to samples: the first fragment of each cell is shaded where it lies, and no cell
/// reaches beyond its bucket.

#include "shade/cell_memo.h"
#include "shade/cell_shader.h"
#include "shade/fragment_geometry.h"
#include "shade/grid_attachments.h"

namespace tessera {

class FragmentShading : public Shading {
 public:
  /// Names the cell of a fragment: fragments of a bucket with equal keys share it.
  using KeyOf = ShadingRequest (*)(const ShadeInput& input, size_t fragment);
  /// `footprint_pixels` gives the side of the square on the raster that a cell stands for.
  using FootprintPixels = float (*)(const SampleBlock& samples);
  FragmentShading(const ShadingFrame& frame, KeyOf key_of, FootprintPixels footprint_pixels)
      : shader_(frame.bindings), key_of_(key_of), footprint_pixels_(footprint_pixels) {}

  void shade(const ShadeInput& input, ShadedFragments& out, ShadeCounters& counters) override;
  void requests(const ShadeInput& input, size_t fragment,
                std::vector<ShadingRequest>& out) override;

 private:
  const ShadingSpace& space_of(const Grid& grid, ShadeCounters& counters);

  CellShader shader_;
  KeyOf key_of_;
  FootprintPixels footprint_pixels_;
  GridAttachments attachments_;
};

}  // namespace tessera
