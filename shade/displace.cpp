#include <algorithm>
#include <cmath>

#include "shade/bindings.h"
#include "shade/grid_points.h"

namespace tessera {
namespace {

/// Runs displacement shaders over freshly diced grids.
class ShaderDisplacer : public Displacer {
 public:
  explicit ShaderDisplacer(std::shared_ptr<const ShaderBindings> bindings)
      : bindings_(std::move(bindings)) {}

  void displace(const Grid& grid, std::span<float> distance) const override {
    std::fill(distance.begin(), distance.end(), 0.0f);
    const SurfaceBinding& binding = bindings_->of(grid.attributes());
    if (!binding.displacement) return;
    // No footprints: they differ between the two grids that share an edge, and the displaced
    // surface would tear there.
    const GridPoints batch(grid, bindings_->camera(), Footprints::none);
    const BoundShader& shader = *binding.displacement;
    ShadeCounters uncounted;  // displacement is part of dicing, not of shading
    const ShaderContext context(shader, batch.points(), {{}, &bindings_->textures(), &uncounted});
    shader.definition->displace(context, distance);
    finish(shader, distance.first(size_t(batch.points().count)));
  }

 private:
  /// World to camera units; what is not finite does not move.
  void finish(const BoundShader& shader, std::span<float> distance) const {
    const float scale = bindings_->camera_length_of_world();
    bool dropped = false;
    for (float& d : distance) {
      d *= scale;
      if (std::isfinite(d)) continue;
      d = 0.0f;
      dropped = true;
    }
    if (!dropped) return;
    bindings_->diagnostics().warn_once(
        "nonfinite " + shader.definition->name, shader.where,
        fmt::format("displacement shader \"{}\" gave distances that are not finite; such points "
                    "stay where they are",
                    shader.definition->name));
  }

  std::shared_ptr<const ShaderBindings> bindings_;
};

}  // namespace

std::unique_ptr<Displacer> make_displacer(std::shared_ptr<const ShaderBindings> bindings) {
  if (!bindings->any_displacement()) return nullptr;
  return std::make_unique<ShaderDisplacer>(std::move(bindings));
}

}  // namespace tessera
