#include "shade/cell_shader.h"

#include <algorithm>
#include <numeric>

#include "shade/surface_shading.h"

namespace tessera {
namespace {

/// Points that a shader runs over at once: enough to hide what a call costs, and little enough for
/// its arrays to stay in the cache.
constexpr size_t batch_size = 1024;

}  // namespace

void CellShader::shade(std::span<const CellPoint> cells, std::span<float> values,
                       ShadeCounters& counters) const {
  std::vector<uint32_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto surface_of = [&](uint32_t k) { return cells[k].grid->surface->id; };
  std::ranges::stable_sort(order, {}, surface_of);
  for (size_t first = 0, last; first < order.size(); first = last) {
    const int surface = surface_of(order[first]);
    for (last = first; last < order.size() && last < first + batch_size; ++last)
      if (surface_of(order[last]) != surface) break;
    std::vector<CellPoint> batch;
    for (size_t k = first; k < last; ++k) batch.push_back(cells[order[k]]);
    shade_batch(batch, std::span(order).subspan(first, last - first), values, counters);
  }
}

void CellShader::shade_batch(std::span<const CellPoint> cells, std::span<const uint32_t> places,
                             std::span<float> values, ShadeCounters& counters) const {
  const CellPoints batch(cells, bindings_->camera());
  SurfaceColors shaded;
  shade_surface(*bindings_, bindings_->of(cells.front().grid->attributes()), batch.points(),
                FailedPoint::unseen, shaded, counters);
  const size_t stride = floats_per_cell();
  for (size_t k = 0; k < places.size(); ++k) {
    float* out = &values[places[k] * stride];
    const auto put = [&](const Vec3Array& array) {
      const glm::vec3 v = array[int(k)];
      *out++ = v.x, *out++ = v.y, *out++ = v.z;
    };
    put(shaded.Ci), put(shaded.Oi);
    for (const Vec3Array& term : shaded.light_terms) put(term);
  }
}

void CellShader::give(std::span<const uint32_t> cell_of_fragment, std::span<const float> values,
                      ShadedFragments& out) const {
  const size_t count = cell_of_fragment.size(), stride = floats_per_cell();
  const auto give_run = [&](std::array<std::vector<float>, 3>& to, size_t offset) {
    for (size_t c = 0; c < 3; ++c) {
      to[c].resize(count);
      for (size_t f = 0; f < count; ++f)
        to[c][f] = values[cell_of_fragment[f] * stride + offset + c];
    }
  };
  give_run(out.Ci, 0), give_run(out.Oi, 3);
  out.light_terms.resize(bindings_->light_term_count());
  for (size_t k = 0; k < out.light_terms.size(); ++k) give_run(out.light_terms[k], 6 + 3 * k);
}

}  // namespace tessera
