#include "dice/chunk.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

// More pieces than this of one patch are refused: hostile input must not fill the memory.
constexpr size_t most_pieces_of_patch = size_t(1) << 18;
constexpr size_t most_patches_of_chunk = 64;

class ChunkMaker {
 public:
  ChunkMaker(const SurfaceContext& context, int bucket_size, DiceCounters& counters,
             Diagnostics& diagnostics)
      : context_(context),
        cache_(*context.patches),
        bucket_size_(float(bucket_size)),
        counters_(counters),
        diagnostics_(diagnostics) {}

  void add_patch(uint32_t index) {
    const Patch* patch = cache_.get(index);
    if (!patch) return;
    ++counters_.faces;
    RasterBounds bounds;
    if (is_outside(*patch, ParameterRect{}, bounds)) return;
    const std::optional<Piece> whole = whole_patch(index, cache_, context_.rate);
    if (decide(*whole, context_.rate) == SplitDecision::dice) {
      add_small_patch(index, bounds);
    } else {
      add_pieces(*whole, bounds);
    }
  }

  std::vector<Chunk> take() { return std::move(chunks_); }

 private:
  // Whether a part cannot be seen or is not finite; finds the raster bounds of others.
  bool is_outside(const Patch& patch, const ParameterRect& rect, RasterBounds& bounds) {
    hull_.clear();
    for (int key = 0; key < context_.rate.key_count(); ++key) patch.append_hull(key, rect, hull_);
    const bool finite = std::all_of(hull_.begin(), hull_.end(), [](const glm::vec3& p) {
      return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
    if (!finite) {
      ++counters_.dropped_nonfinite;
      return true;
    }
    const RasterProjection& projection = *context_.rate.projection;
    if (projection.outside_crop(hull_, context_.displacement_bound)) {
      ++counters_.culled;
      return true;
    }
    float z_min = 0;
    bounds = projection.bounds(hull_, context_.displacement_bound, z_min);
    return false;
  }

  void add_small_patch(uint32_t index, const RasterBounds& bounds) {
    if (!chunks_.empty() && !chunks_.back().piece &&
        chunks_.back().patches.size() < most_patches_of_chunk) {
      RasterBounds joined = chunks_.back().bounds;
      joined.add(bounds);
      if (joined.x_max - joined.x_min <= bucket_size_ &&
          joined.y_max - joined.y_min <= bucket_size_) {
        chunks_.back().bounds = joined;
        chunks_.back().patches.push_back(index);
        return;
      }
    }
    Chunk chunk;
    chunk.surface = context_.index;
    chunk.patches.push_back(index);
    chunk.bounds = bounds;
    chunks_.push_back(std::move(chunk));
  }

  void add_pieces(const Piece& whole, const RasterBounds& whole_bounds) {
    struct Open {
      Piece piece;
      RasterBounds bounds;
    };
    const Patch& patch = *cache_.get(whole.patch);
    std::vector<Open> open{{whole, whole_bounds}};
    size_t pieces = 0;
    while (!open.empty()) {
      const Open next = std::move(open.back());
      open.pop_back();
      const SplitDecision decision = decide(next.piece, context_.rate);
      if (decision == SplitDecision::dice || pieces >= most_pieces_of_patch) {
        if (decision != SplitDecision::dice) warn_of_limit();
        Chunk chunk;
        chunk.surface = context_.index;
        chunk.piece = std::make_unique<Piece>(next.piece);
        chunk.bounds = next.bounds;
        chunks_.push_back(std::move(chunk));
        ++pieces;
        continue;
      }
      ++counters_.splits;
      const std::array<Piece, 2> halves = split(next.piece, decision, cache_, context_.rate);
      for (int h = 1; h >= 0; --h) {
        RasterBounds bounds;
        if (!is_outside(patch, halves[size_t(h)].vertex_rect(), bounds)) {
          open.push_back({halves[size_t(h)], bounds});
        }
      }
    }
  }

  void warn_of_limit() {
    const SourceLocation& where = context_.surface->geometry->where;
    diagnostics_.warn_once(
        fmt::format("piece limit {}:{}", where.file, where.line), where,
        fmt::format("a patch was cut into {} pieces and still asks for smaller micropolygons; it "
                    "is diced coarser than ShadingRate",
                    most_pieces_of_patch));
  }

  const SurfaceContext& context_;
  PatchCache cache_;
  float bucket_size_;
  DiceCounters& counters_;
  Diagnostics& diagnostics_;
  std::vector<Chunk> chunks_;
  std::vector<glm::vec3> hull_;
};

}  // namespace

std::vector<Chunk> make_chunks(const SurfaceContext& context, uint32_t begin, uint32_t end,
                               int bucket_size, DiceCounters& counters, Diagnostics& diagnostics) {
  ChunkMaker maker(context, bucket_size, counters, diagnostics);
  for (uint32_t index = begin; index < end; ++index) maker.add_patch(index);
  return maker.take();
}

std::vector<std::unique_ptr<Grid>> dice(const Chunk& chunk, const SurfaceContext& context,
                                        DiceCounters& counters, Diagnostics& diagnostics) {
  PatchCache cache(*context.patches);
  GridBuilder builder(context, cache, diagnostics);
  std::vector<std::unique_ptr<Grid>> grids;
  const auto add = [&](const Piece& piece) {
    std::unique_ptr<Grid> grid = builder.build(piece);
    if (!grid) {
      ++counters.dropped_nonfinite;
      return;
    }
    ++counters.grids;
    counters.micropolygons += uint64_t(grid->micropolygon_count());
    counters.vertices += uint64_t(grid->vertex_count());
    grids.push_back(std::move(grid));
  };
  if (chunk.piece) add(*chunk.piece);
  for (uint32_t patch : chunk.patches) {
    if (const auto piece = whole_patch(patch, cache, context.rate)) add(*piece);
  }
  return grids;
}

}  // namespace tessera
