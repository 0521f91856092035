#include "shade/cell_name.h"
#include "shade/fragment_shading.h"
#include "shade/mode_arguments.h"

namespace tessera {
namespace {

ShadingRequest key_of(const ShadeInput& input, size_t fragment) {
  const FragmentList& fragments = *input.fragments;
  const glm::ivec2 pixel = pixel_of(input, fragment);
  const uint64_t x = uint64_t(pixel.x), y = uint64_t(pixel.y);
  const uint64_t micropolygon = cell_name(grid_name(input.grids[fragments.grid[fragment]]->id), 2,
                                          fragments.triangle[fragment] / 2);
  return {cell_name(micropolygon, x, y), cell_name(micropolygon, x / 2, y / 2)};
}

}  // namespace

/// As multisampling hardware does, with micropolygons for primitives.
ShadingModeDefinition shading_mode_pixel() {
  return {"pixel", "shade each micropolygon once in each pixel that sees it, as multisampling does",
          [](std::string_view arguments, const ShadingFrame& frame) -> std::unique_ptr<Shading> {
            read_mode_arguments("pixel", arguments, {});
            return std::make_unique<FragmentShading>(frame, key_of,
                                                     [](const SampleBlock&) { return 1.0f; });
          }};
}

}  // namespace tessera
