#include <algorithm>
#include <array>
#include <mutex>

#include "shade/cell_name.h"
#include "shade/grid_attachments.h"
#include "shade/grid_points.h"
#include "shade/mode_arguments.h"
#include "shade/surface_shading.h"

namespace tessera {
namespace {

/// The shaded vertices of a grid: made once, by whichever bucket first sees the grid, and freed
/// with it. A pure function of the grid, so it does not matter which bucket that was.
struct VertexColors : GridAttachment {
  std::once_flag shaded;
  /// One vertex after the other, so that a fragment touches three short runs of memory.
  std::vector<std::array<float, 3>> Ci;
  std::vector<std::array<float, 3>> Oi;  ///< empty when every vertex is opaque
  /// [term] As SurfaceColors::light_terms; empty where the light reaches no vertex.
  std::vector<std::vector<std::array<float, 3>>> light_terms;
};

/// The vertices of a triangle and the weights of a fragment inside it (dice/grid.h).
struct Place {
  std::array<int, 3> corner;
  std::array<float, 3> weight;
};

Place place_of(const Grid& grid, const FragmentList& fragments, size_t f) {
  const std::array<int, 3> corner = grid.triangle_corners(fragments.triangle[f]);
  if (!grid.attributes().smooth_shading) {
    return {{corner[0], corner[0], corner[0]}, {1.0f, 0.0f, 0.0f}};
  }
  const float b1 = fragments.b1[f], b2 = fragments.b2[f];
  return {corner, {1.0f - b1 - b2, b1, b2}};
}

uint32_t nearest_vertex_name(const Grid& grid, const Place& place) {
  const auto heaviest = std::max_element(place.weight.begin(), place.weight.end());
  const int vertex = place.corner[size_t(heaviest - place.weight.begin())];
  return uint32_t(cell_name(grid_name(grid.id), uint64_t(vertex), 0));
}

void interpolate(const std::vector<std::array<float, 3>>& values, const Place& place, size_t f,
                 std::array<std::vector<float>, 3>& out) {
  const auto& [p, q, r] = place.corner;
  const auto& [wp, wq, wr] = place.weight;
  for (size_t c = 0; c < 3; ++c) {
    out[c][f] = wp * values[size_t(p)][c] + wq * values[size_t(q)][c] + wr * values[size_t(r)][c];
  }
}

/// `otherwise` where there are no values.
void interpolate_unless_empty(const std::vector<std::array<float, 3>>& values, float otherwise,
                              const Place& place, size_t f,
                              std::array<std::vector<float>, 3>& out) {
  if (!values.empty()) return interpolate(values, place, f, out);
  for (size_t c = 0; c < 3; ++c) out[c][f] = otherwise;
}

std::vector<std::array<float, 3>> interleaved(const Vec3Array& values) {
  std::vector<std::array<float, 3>> result(size_t(values.count()));
  for (int i = 0; i < values.count(); ++i) {
    const glm::vec3 v = values[i];
    result[size_t(i)] = {v.x, v.y, v.z};
  }
  return result;
}

/// Nothing when every component is `usual`.
std::vector<std::array<float, 3>> interleaved_unless_all(float usual, const Vec3Array& values) {
  std::vector<std::array<float, 3>> result = interleaved(values);
  const std::array<float, 3> all{usual, usual, usual};
  if (std::ranges::all_of(result, [&](const auto& v) { return v == all; })) return {};
  return result;
}

/// Shades the vertices of a grid in one batch the first time a fragment of it is visible, and
/// interpolates between them.
class ReyesShading : public Shading {
 public:
  explicit ReyesShading(std::shared_ptr<const ShaderBindings> bindings)
      : bindings_(std::move(bindings)) {}

  void shade(const ShadeInput& input, ShadedFragments& out, ShadeCounters& counters) override {
    const FragmentList& fragments = *input.fragments;
    out.light_terms.resize(bindings_->light_term_count());
    for (size_t c = 0; c < 3; ++c) {
      out.Ci[c].resize(fragments.size());
      out.Oi[c].resize(fragments.size());
      for (auto& term : out.light_terms) term[c].resize(fragments.size());
    }
    out.cell.resize(input.wants_cells ? fragments.size() : 0);
    std::vector<const VertexColors*> colors(input.grids.size(), nullptr);
    for (size_t f = 0; f < fragments.size(); ++f) {
      const Grid& grid = *input.grids[fragments.grid[f]];
      const VertexColors*& shaded = colors[fragments.grid[f]];
      if (!shaded) shaded = &vertex_colors(grid, input.shaded_at, counters);
      const Place place = place_of(grid, fragments, f);
      if (input.wants_cells) out.cell[f] = nearest_vertex_name(grid, place);
      interpolate(shaded->Ci, place, f, out.Ci);
      interpolate_unless_empty(shaded->Oi, 1.0f, place, f, out.Oi);
      for (size_t k = 0; k < out.light_terms.size(); ++k) {
        interpolate_unless_empty(shaded->light_terms[k], 0.0f, place, f, out.light_terms[k]);
      }
    }
  }

  void requests(const ShadeInput& input, size_t fragment,
                std::vector<ShadingRequest>& out) override {
    const Grid& grid = *input.grids[input.fragments->grid[fragment]];
    const Place place = place_of(grid, *input.fragments, fragment);
    const uint64_t row = uint64_t(grid.u_count) + 1, name = grid_name(grid.id);
    for (size_t k = 0; k < (grid.attributes().smooth_shading ? 3 : 1); ++k) {
      const uint64_t i = uint64_t(place.corner[k]) % row, j = uint64_t(place.corner[k]) / row;
      out.push_back({cell_name(name, i, j), cell_name(name, i / 2, j / 2)});
    }
  }

 private:
  const VertexColors& vertex_colors(const Grid& grid, std::vector<glm::vec2>* shaded_at,
                                    ShadeCounters& counters) {
    VertexColors& colors =
        attachments_.of<VertexColors>(grid, [] { return std::make_unique<VertexColors>(); });
    // Not under the attachment's lock: other grids that share it need not wait for shaders.
    std::call_once(colors.shaded, [&] {
      shade_vertices(grid, colors, counters);
      if (shaded_at) append_places(grid, *shaded_at);
    });
    return colors;
  }

  void append_places(const Grid& grid, std::vector<glm::vec2>& places) const {
    for (int i = 0; i < grid.vertex_count(); ++i) {
      const glm::vec3 clip = bindings_->camera().raster_clip_from_camera(
          {grid.P(0, 0)[i], grid.P(0, 1)[i], grid.P(0, 2)[i]});
      if (clip.z > 0.0f) places.push_back({clip.x / clip.z, clip.y / clip.z});
    }
  }

  void shade_vertices(const Grid& grid, VertexColors& colors, ShadeCounters& counters) const {
    const GridPoints batch(grid, bindings_->camera(), Footprints::over_micropolygons);
    SurfaceColors shaded;
    shade_surface(*bindings_, bindings_->of(grid.attributes()), batch.points(), FailedPoint::black,
                  shaded, counters);
    colors.Ci = interleaved(shaded.Ci);
    colors.Oi = interleaved_unless_all(1.0f, shaded.Oi);
    for (const Vec3Array& term : shaded.light_terms) {
      colors.light_terms.push_back(interleaved_unless_all(0.0f, term));
    }
    ++counters.grids_shaded;
  }

  std::shared_ptr<const ShaderBindings> bindings_;
  GridAttachments attachments_;
};

}  // namespace

ShadingModeDefinition shading_mode_reyes() {
  return {"reyes", "shade the vertices of visible grids at the shading rate and interpolate",
          [](std::string_view arguments, const ShadingFrame& frame) -> std::unique_ptr<Shading> {
            read_mode_arguments("reyes", arguments, {});
            return std::make_unique<ReyesShading>(frame.bindings);
          }};
}

}  // namespace tessera
