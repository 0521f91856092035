#include "dice/whole_scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include "dice/chunk.h"
#include "dice/flatness.h"
#include "dice/surface_context.h"

namespace tessera {

namespace {

constexpr uint32_t patches_per_task = 64;
constexpr float nearest_part_of_extent = 1.0f / 64;
/// Factor on the step of a surface that needs too many micropolygons, and how often it is applied:
/// enough for 2^100 times too many.
constexpr float coarser = 1.5f;
constexpr int most_attempts = 86;

constexpr int emitter_grid_size = 128;
/// Slightly more than the whole turn's part, so that rounding does not add a segment to a circle.
constexpr float emitter_turn_radians =
    2 * std::numbers::pi_v<float> / (float(emitter_segments_of_turn) - 0.5f);

/// Micropolygons of one surface so far. What happens first between threads does not matter: the
/// limit is passed in every order or in none.
class Budget {
 public:
  explicit Budget(size_t most) : most_(most) {}
  void take(const Piece& piece) { taken_ += size_t(piece.u_count) * size_t(piece.v_count); }
  bool exceeded() const { return taken_ > most_; }

 private:
  const size_t most_;
  std::atomic<size_t> taken_{0};
};

/// Cuts patches into pieces that can be diced, until the budget is exceeded.
class WholePatches {
 public:
  WholePatches(const SurfaceContext& context, Budget& budget)
      : context_(context), cache_(*context.patches), budget_(budget) {}

  void add_patch(uint32_t index) {
    const std::optional<Piece> whole = whole_patch(index, cache_, context_.rate);
    if (!whole) return;
    if (decide(*whole, context_.rate) == SplitDecision::dice) {
      budget_.take(*whole);
      if (chunks_.empty() || chunks_.back().piece) chunks_.push_back(empty_chunk());
      chunks_.back().patches.push_back(index);
    } else {
      add_pieces(*whole);
    }
  }

  std::vector<Chunk> take() { return std::move(chunks_); }

 private:
  Chunk empty_chunk() const {
    Chunk chunk;
    chunk.surface = context_.index;
    return chunk;
  }

  void add_pieces(const Piece& whole) {
    std::vector<Piece> open{whole};
    while (!open.empty() && !budget_.exceeded()) {
      const Piece next = open.back();
      open.pop_back();
      const SplitDecision decision = decide(next, context_.rate);
      if (decision == SplitDecision::dice) {
        budget_.take(next);
        chunks_.push_back(empty_chunk());
        chunks_.back().piece = std::make_unique<Piece>(next);
        continue;
      }
      const std::array<Piece, 2> halves = split(next, decision, cache_, context_.rate);
      open.push_back(halves[1]);
      open.push_back(halves[0]);
    }
  }

  const SurfaceContext& context_;
  PatchCache cache_;
  Budget& budget_;
  std::vector<Chunk> chunks_;
};

/// Nothing if the surface needs more micropolygons than `most`.
std::optional<std::vector<Chunk>> chunks_within(const SurfaceContext& context, size_t most) {
  const uint32_t patches = context.patches->patch_count();
  const size_t tasks = (size_t(patches) + patches_per_task - 1) / patches_per_task;
  Budget budget(most);
  std::vector<std::vector<Chunk>> found(tasks);
  tbb::parallel_for(size_t(0), tasks, [&](size_t task) {
    WholePatches maker(context, budget);
    const uint32_t begin = uint32_t(task) * patches_per_task;
    const uint32_t end = std::min(begin + patches_per_task, patches);
    for (uint32_t p = begin; p < end && !budget.exceeded(); ++p) maker.add_patch(p);
    found[task] = maker.take();
  });
  if (budget.exceeded()) return std::nullopt;
  std::vector<Chunk> chunks;
  for (std::vector<Chunk>& some : found) {
    std::move(some.begin(), some.end(), std::back_inserter(chunks));
  }
  return chunks;
}

std::vector<Chunk> chunks_of_surface(SurfaceContext& context, size_t most_micropolygons,
                                     Diagnostics& diagnostics) {
  if (!context.patches) return {};
  const size_t most = std::max(most_micropolygons, 4 * size_t(context.patches->patch_count()));
  float times = 1;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    std::optional<std::vector<Chunk>> chunks = chunks_within(context, most);
    if (chunks && attempt > 0) {
      const SourceLocation& where = context.surface->geometry->where;
      diagnostics.warn_once(
          fmt::format("whole surface {}:{}", where.file, where.line), where,
          fmt::format(
              "for rays this surface would be diced into more than {} micropolygons; they "
              "are made {:.1f} times as long. Expected: {}",
              most, times,
              context.rate.shape ? "a simpler surface to shine" : "a larger ray dicing rate"));
    }
    if (chunks) return std::move(*chunks);
    times *= coarser;
    context.rate.step *= coarser;
    if (context.rate.shape) context.rate.shape->turn_radians *= coarser;
  }
  // Patches that have to be split whatever their size.
  return std::move(chunks_within(context, size_t(-1)).value());
}

bool is_emitter(const Surface& surface) { return surface.attributes->area_light.has_value(); }

/// `times` as long as those of dice_emitters() where few surfaces shine.
void dice_by_shape(SurfaceContext& context, size_t least_micropolygons, float times) {
  const double least = double(least_micropolygons) / double(times * times);
  const double of_patch = least / double(std::max(context.patches->patch_count(), 1u));
  context.rate.shape = ShapeRate{.turn_radians = emitter_turn_radians * times,
                                 .least_segments = std::max(1, int(std::sqrt(of_patch)))};
  context.rate.max_grid_size = emitter_grid_size;
}

/// How much longer the micropolygons of so many surfaces that are not flat are.
float coarseness(size_t curved_surfaces) {
  const double share = double(curved_surfaces) / double(emitters_at_full_rate);
  return float(std::sqrt(std::clamp(share, 1.0, double(emitter_most_area))));
}

/// All that shines and is not flat.
void dice_curved_emitters_by_shape(std::vector<SurfaceContext>& contexts) {
  std::vector<char> curved(contexts.size());
  tbb::parallel_for(size_t(0), contexts.size(), [&](size_t s) {
    const SurfaceContext& context = contexts[s];
    curved[s] = context.patches && is_emitter(*context.surface) && !is_flat(context);
  });
  const float times = coarseness(size_t(std::ranges::count(curved, 1)));
  for (size_t s = 0; s < contexts.size(); ++s) {
    const size_t least = contexts[s].displacer ? emitter_micropolygons_of_displaced
                                               : emitter_micropolygons_of_curved;
    if (curved[s]) dice_by_shape(contexts[s], least, times);
  }
}

/// Largest extent of the scene along an axis of camera space, at shutter open; 1 when it has none.
float extent_of(const std::vector<SurfaceContext>& contexts) {
  std::vector<glm::vec3> low(contexts.size(), glm::vec3(std::numeric_limits<float>::infinity()));
  std::vector<glm::vec3> high(contexts.size(), -low.front());
  tbb::parallel_for(size_t(0), contexts.size(), [&](size_t s) {
    std::vector<glm::vec3> hull;
    const uint32_t patches = contexts[s].patches ? contexts[s].patches->patch_count() : 0;
    for (uint32_t p = 0; p < patches; ++p) {
      const std::unique_ptr<Patch> patch = contexts[s].patches->patch(p);
      hull.clear();
      if (patch) patch->append_hull(0, ParameterRect{}, hull);
      for (const glm::vec3& point : hull) {
        const bool finite = std::isfinite(point.x + point.y + point.z);
        if (finite) low[s] = glm::min(low[s], point), high[s] = glm::max(high[s], point);
      }
    }
  });
  glm::vec3 least = low.front(), most = high.front();
  for (size_t s = 1; s < contexts.size(); ++s) {
    least = glm::min(least, low[s]), most = glm::max(most, high[s]);
  }
  const glm::vec3 size = most - least;
  const float extent = std::max({size.x, size.y, size.z});
  return std::isfinite(extent) && extent > 0 ? extent : 1.0f;
}

/// All grids of the surfaces, by surface.
std::vector<std::shared_ptr<const Grid>> dice_all(std::vector<SurfaceContext>& contexts,
                                                  size_t most_micropolygons,
                                                  Diagnostics& diagnostics) {
  std::vector<std::vector<Chunk>> by_surface(contexts.size());
  tbb::parallel_for(size_t(0), contexts.size(), [&](size_t s) {
    by_surface[s] = chunks_of_surface(contexts[s], most_micropolygons, diagnostics);
  });
  std::vector<Chunk> chunks;
  for (std::vector<Chunk>& some : by_surface) {
    std::move(some.begin(), some.end(), std::back_inserter(chunks));
  }
  std::vector<std::vector<std::unique_ptr<Grid>>> diced(chunks.size());
  tbb::parallel_for(size_t(0), chunks.size(), [&](size_t c) {
    DiceCounters uncounted;
    diced[c] = dice(chunks[c], contexts[chunks[c].surface], uncounted, diagnostics);
  });
  std::vector<std::shared_ptr<const Grid>> grids;
  for (std::vector<std::unique_ptr<Grid>>& some : diced) {
    std::move(some.begin(), some.end(), std::back_inserter(grids));
  }
  return grids;
}

}  // namespace

std::vector<std::shared_ptr<const Grid>> dice_whole_scene(const Scene& scene, const Camera& camera,
                                                          const DiceSettings& settings,
                                                          Diagnostics& diagnostics,
                                                          size_t most_micropolygons) {
  if (scene.surfaces.empty()) return {};
  RasterProjection projection(camera, camera.frame());
  TopologyCache topologies;
  std::vector<SurfaceContext> contexts =
      make_surface_contexts(scene, camera, projection, settings, topologies, diagnostics);
  const float least = extent_of(contexts) * nearest_part_of_extent;
  projection.turn_to_eye(std::max(least, std::numeric_limits<float>::min()));
  for (SurfaceContext& context : contexts) {
    context.rate.motion_factor = context.rate.focus_factor = 0;
  }
  dice_curved_emitters_by_shape(contexts);
  return dice_all(contexts, most_micropolygons, diagnostics);
}

std::vector<std::shared_ptr<const Grid>> dice_emitters(const Scene& scene, const Camera& camera,
                                                       const DiceSettings& settings,
                                                       Diagnostics& diagnostics) {
  const RasterProjection projection(camera, camera.frame());
  TopologyCache topologies;
  std::vector<SurfaceContext> contexts = make_surface_contexts(scene, camera, projection, settings,
                                                               topologies, diagnostics, is_emitter);
  dice_curved_emitters_by_shape(contexts);
  for (SurfaceContext& context : contexts) {
    if (context.patches && !context.rate.shape) dice_by_shape(context, 1, 1);
  }
  return dice_all(contexts, most_micropolygons_of_surface, diagnostics);
}

}  // namespace tessera
