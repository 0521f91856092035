#pragma once
/// The unit of sharing between buckets: one piece of a patch, or a few small patches.

#include <memory>
#include <mutex>
#include <vector>

#include "dice/grid.h"
#include "dice/grid_builder.h"
#include "dice/piece.h"

namespace tessera {

struct Chunk {
  uint32_t surface = 0;           ///< index into the contexts
  std::unique_ptr<Piece> piece;   ///< a piece of a split patch, or null:
  std::vector<uint32_t> patches;  ///< whole patches, each diced in one piece
  RasterBounds bounds;            ///< of all grids, conservative
};

/// The chunks of patches [begin, end) of a surface that may touch the crop rectangle. Adds to
/// faces, splits and culled of `counters`.
std::vector<Chunk> make_chunks(const SurfaceContext& context, uint32_t begin, uint32_t end,
                               int bucket_size, DiceCounters& counters, Diagnostics& diagnostics);

/// All grids of a chunk, in order of their ids. Adds to grids, micropolygons, vertices and
/// dropped_nonfinite of `counters`.
std::vector<std::unique_ptr<Grid>> dice(const Chunk& chunk, const SurfaceContext& context,
                                        DiceCounters& counters, Diagnostics& diagnostics);

}  // namespace tessera
