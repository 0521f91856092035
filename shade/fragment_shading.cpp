#include "shade/fragment_shading.h"

namespace tessera {

const ShadingSpace& FragmentShading::space_of(const Grid& grid, ShadeCounters& counters) {
  CellMemo& memo = attachments_.of<CellMemo>(
      grid, [&] { return std::make_unique<CellMemo>(shader_.floats_per_cell()); });
  std::call_once(memo.made, [&] {
    memo.space.emplace(grid, shader_.bindings().camera(), ShadingSpaceSettings{});
    ++counters.grids_shaded;
  });
  return *memo.space;
}

void FragmentShading::shade(const ShadeInput& input, ShadedFragments& out,
                            ShadeCounters& counters) {
  const FragmentList& fragments = *input.fragments;
  const float side = footprint_pixels_(*input.samples);
  std::vector<const ShadingSpace*> spaces(input.grids.size(), nullptr);
  std::vector<uint32_t> cell_of_fragment(fragments.size());
  std::vector<CellPoint> points;
  FlatIndex index(fragments.size() / 2);
  out.cell.clear();
  for (size_t f = 0; f < fragments.size(); ++f) {
    const uint64_t name = key_of_(input, f).point;
    const auto [place, is_new] = index.insert(name);
    cell_of_fragment[f] = place;
    if (input.wants_cells) out.cell.push_back(uint32_t(name));
    if (!is_new) continue;
    const Grid& grid = *input.grids[fragments.grid[f]];
    const ShadingSpace*& space = spaces[fragments.grid[f]];
    if (!space) space = &space_of(grid, counters);
    const SurfacePoint at{fragments.triangle[f], fragments.b1[f], fragments.b2[f]};
    CellFootprint footprint = space->footprint(at);
    footprint.ij_per_x *= side, footprint.ij_per_y *= side;
    points.push_back({&grid, at, footprint});
    if (input.shaded_at) input.shaded_at->push_back(glm::vec2(pixel_of(input, f)) + 0.5f);
  }
  std::vector<float> values(points.size() * shader_.floats_per_cell());
  shader_.shade(points, values, counters);
  shader_.give(cell_of_fragment, values, out);
}

void FragmentShading::requests(const ShadeInput& input, size_t fragment,
                               std::vector<ShadingRequest>& out) {
  out.push_back(key_of_(input, fragment));
}

}  // namespace tessera
