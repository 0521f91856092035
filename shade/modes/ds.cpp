#include <cmath>

#include "shade/lattice_shading.h"
#include "shade/mode_arguments.h"

namespace tessera {

/// J. Ragan-Kelley et al., "Decoupled sampling for graphics pipelines", ACM TOG 30 (3), 2011: cells
/// are those of the raster, whatever the blur.
ShadingModeDefinition shading_mode_ds() {
  return {"ds", "decoupled sampling: square cells of the shading rate's area, at shutter open",
          [](std::string_view arguments, const ShadingFrame& frame) -> std::unique_ptr<Shading> {
            read_mode_arguments("ds", arguments, {});
            const int per_edge = cells_per_edge(frame);
            return std::make_unique<LatticeShading>(frame, [per_edge](const Grid& grid) {
              const float d = 1.0f / std::sqrt(grid.attributes().shading_rate);
              return ShadingSpaceSettings{{{1, 0}, d, d}, LatticeAnchor::raster, per_edge};
            });
          }};
}

}  // namespace tessera
