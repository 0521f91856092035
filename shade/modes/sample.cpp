#include <cmath>

#include "shade/cell_name.h"
#include "shade/fragment_shading.h"
#include "shade/mode_arguments.h"

namespace tessera {
namespace {

/// Every fragment is a cell, and would need a block of hardware's own. Named by its place in the
/// frame, not in the bucket.
ShadingRequest key_of(const ShadeInput& input, size_t fragment) {
  const FragmentList& fragments = *input.fragments;
  const size_t sample = fragments.sample[fragment];
  const glm::ivec2 pixel = pixel_of(input, fragment);
  const size_t behind = fragment - fragments.first_of_sample[sample];
  const uint64_t name = cell_name(cell_name(3, uint64_t(pixel.x), uint64_t(pixel.y)),
                                  sample % size_t(input.samples->samples_per_pixel), behind);
  return {name, name};
}

/// The samples of a pixel share its area.
float footprint_pixels(const SampleBlock& samples) {
  return 1.0f / std::sqrt(float(samples.samples_per_pixel));
}

}  // namespace

ShadingModeDefinition shading_mode_sample() {
  return {"sample", "shade every sample: the reference for all others",
          [](std::string_view arguments, const ShadingFrame& frame) -> std::unique_ptr<Shading> {
            read_mode_arguments("sample", arguments, {});
            return std::make_unique<FragmentShading>(frame, key_of, footprint_pixels);
          }};
}

}  // namespace tessera
