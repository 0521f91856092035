#include "shade/lattice_shading.h"

#include <algorithm>
#include <cmath>

#include "shade/cell_name.h"
#include "shade/fragment_geometry.h"

namespace tessera {
namespace {

SurfacePoint point_of(const FragmentList& fragments, size_t f) {
  return {fragments.triangle[f], fragments.b1[f], fragments.b2[f]};
}

/// The cells of one grid that a bucket sees.
struct GridCells {
  CellMemo* memo = nullptr;
  uint64_t name = 0;  ///< of the grid
  std::vector<uint64_t> keys;
  std::vector<ShadingCell> cells;
  std::vector<uint32_t> places;  ///< of each among the cells of the bucket
  std::vector<uint32_t> slots;   ///< in the memo
  std::vector<uint32_t> mine;    ///< those that this bucket shades
};

}  // namespace

int cells_per_edge(const ShadingFrame& frame) {
  return int(std::clamp(std::round(std::sqrt(frame.dicing_ratio)), 1.0f, 64.0f));
}

struct LatticeShading::BucketCells {
  std::vector<GridCells> grids;            ///< as the input's
  std::vector<uint32_t> cell_of_fragment;  ///< place among the cells of the bucket
  size_t count = 0;
};

CellMemo& LatticeShading::memo_of(const Grid& grid, ShadeCounters* counters) {
  CellMemo& memo = attachments_.of<CellMemo>(
      grid, [&] { return std::make_unique<CellMemo>(shader_.floats_per_cell()); });
  std::call_once(memo.made, [&] {
    memo.space.emplace(grid, shader_.bindings().camera(), settings_of_(grid));
    memo.space->prepare_search();
    if (counters) ++counters->grids_shaded;
  });
  return memo;
}

LatticeShading::BucketCells LatticeShading::cells_of(const ShadeInput& input,
                                                     ShadeCounters& counters) {
  const FragmentList& fragments = *input.fragments;
  BucketCells bucket;
  bucket.grids.resize(input.grids.size());
  bucket.cell_of_fragment.resize(fragments.size());
  FlatIndex index(fragments.size() / 4);
  // Neighbouring samples mostly see the same cell.
  uint64_t last_key = ~uint64_t(0);
  uint32_t last_grid = ~0u, last_place = 0;
  for (size_t f = 0; f < fragments.size(); ++f) {
    const uint32_t g = fragments.grid[f];
    GridCells& grid = bucket.grids[g];
    if (!grid.memo) {
      grid.memo = &memo_of(*input.grids[g], &counters);
      grid.name = grid_name(input.grids[g]->id);
    }
    const ShadingCell cell = grid.memo->space->cell_of(point_of(fragments, f));
    const uint64_t key = cell.key();
    if (key != last_key || g != last_grid) {
      const auto [place, is_new] = index.insert(cell_name(grid.name, key, 0));
      if (is_new) {
        grid.keys.push_back(key), grid.cells.push_back(cell), grid.places.push_back(place);
      }
      last_key = key, last_grid = g, last_place = place;
    }
    bucket.cell_of_fragment[f] = last_place;
  }
  bucket.count = index.size();
  return bucket;
}

/// Shades what no other bucket has claimed, and publishes it.
void LatticeShading::shade_claimed(const ShadeInput& input, BucketCells& bucket,
                                   ShadeCounters& counters) const {
  std::vector<CellPoint> points;
  for (size_t g = 0; g < bucket.grids.size(); ++g) {
    const GridCells& grid = bucket.grids[g];
    for (const uint32_t k : grid.mine) {
      const ShadingSpace& space = *grid.memo->space;
      const SurfacePoint at = space.shading_point(grid.cells[k]);
      points.push_back({input.grids[g].get(), at, space.footprint(at)});
      if (input.shaded_at && !space.parametric()) input.shaded_at->push_back(space.raster_of(at));
    }
  }
  if (points.empty()) return;
  const size_t stride = shader_.floats_per_cell();
  std::vector<float> values(points.size() * stride);
  shader_.shade(points, values, counters);
  size_t next = 0;
  std::vector<float> of_grid;
  for (GridCells& grid : bucket.grids) {
    if (grid.mine.empty()) continue;
    of_grid.resize(grid.keys.size() * stride);
    for (const uint32_t k : grid.mine)
      std::copy_n(&values[next++ * stride], stride, &of_grid[k * stride]);
    grid.memo->publish(grid.slots, grid.mine, of_grid);
  }
}

void LatticeShading::shade(const ShadeInput& input, ShadedFragments& out, ShadeCounters& counters) {
  BucketCells bucket = cells_of(input, counters);
  try {
    for (GridCells& grid : bucket.grids)
      if (grid.memo) grid.memo->claim(grid.keys, grid.slots, grid.mine);
    shade_claimed(input, bucket, counters);
  } catch (...) {
    // Others would wait for ever. They stop for the same reason, so that whoever is heard first
    // tells it.
    for (GridCells& grid : bucket.grids)
      if (grid.memo) grid.memo->give_up(std::current_exception());
    throw;
  }

  const size_t stride = shader_.floats_per_cell();
  std::vector<float> values(bucket.count * stride), of_grid;
  for (GridCells& grid : bucket.grids) {
    if (!grid.memo) continue;
    of_grid.resize(grid.slots.size() * stride);
    grid.memo->read(grid.slots, of_grid);
    for (size_t k = 0; k < grid.slots.size(); ++k)
      std::copy_n(&of_grid[k * stride], stride, &values[grid.places[k] * stride]);
  }
  shader_.give(bucket.cell_of_fragment, values, out);
  out.cell.clear();
  if (input.wants_cells) show_cells(input, bucket, out.cell);
}

/// The lattice of the grid that each fragment sees, as it lies over the fragment's pixel: the cells
/// themselves, still and whole, where the samples' own would be scattered by the blur.
void LatticeShading::show_cells(const ShadeInput& input, const BucketCells& bucket,
                                std::vector<uint32_t>& cells) const {
  const FragmentList& fragments = *input.fragments;
  for (size_t f = 0; f < fragments.size(); ++f) {
    const uint32_t g = fragments.grid[f];
    const ShadingSpace& space = *bucket.grids[g].memo->space;
    const glm::vec2 centre = glm::vec2(pixel_of(input, f)) + 0.5f;
    const ShadingCell own = space.cell_of(point_of(fragments, f));
    const glm::ivec2 cell = space.parametric() ? glm::ivec2(own.x, own.y) : space.cell_over(centre);
    const uint64_t name = grid_name(input.grids[g]->id);
    cells.push_back(uint32_t(cell_name(name, uint64_t(cell.x), uint64_t(cell.y))));
  }
}

void LatticeShading::requests(const ShadeInput& input, size_t fragment,
                              std::vector<ShadingRequest>& out) {
  const Grid& grid = *input.grids[input.fragments->grid[fragment]];
  const ShadingCell cell =
      memo_of(grid, nullptr).space->cell_of(point_of(*input.fragments, fragment));
  const uint64_t name = grid_name(grid.id);
  const ShadingCell quad{cell.chart, cell.x / 2, cell.y / 2};
  out.push_back({cell_name(name, cell.key(), 0), cell_name(name, quad.key(), 1)});
}

}  // namespace tessera
