#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "dice/dice.h"
#include "dice/grid_store.h"
#include "dice/surface_context.h"

namespace tessera {

namespace {

constexpr uint32_t patches_per_task = 64;

/// Buckets as dice/dice.h numbers them.
struct BucketArray {
  PixelRect crop;
  int size = 32, columns = 0, rows = 0;

  BucketArray(const PixelRect& rect, int bucket_size) : crop(rect), size(std::max(1, bucket_size)) {
    if (crop.empty()) return;
    columns = (crop.width() + size - 1) / size;
    rows = (crop.height() + size - 1) / size;
  }
  PixelRect pixels(int i, int j) const {
    const int x = crop.x0 + i * size, y = crop.y0 + j * size;
    return PixelRect{x, y, x + size, y + size}.intersect(crop);
  }
  /// Buckets whose closed pixel rectangle a box touches, as [x0, x1) x [y0, y1).
  PixelRect touched(const RasterBounds& box) const {
    const auto range = [this](float low, float high, int origin, int count, int& first, int& end) {
      // Boxes are closed: one that ends on a bucket's first pixel edge touches it, and the one
      // before. Clamped before the conversion, for bounds may be infinite.
      const double a = (double(low) - origin) / size, b = (double(high) - origin) / size;
      first = int(std::clamp(std::ceil(a) - 1, 0.0, double(count)));
      end = int(std::clamp(std::floor(b) + 1, 0.0, double(count)));
    };
    PixelRect r;
    range(box.x_min, box.x_max, crop.x0, columns, r.x0, r.x1);
    range(box.y_min, box.y_max, crop.y0, rows, r.y0, r.y1);
    return r;
  }
};

class SharedGridSource final : public GridSource {
 public:
  SharedGridSource(const Scene& scene, const Camera& camera, const DiceSettings& settings,
                   Diagnostics& diagnostics)
      : settings_(settings),
        projection_(camera, settings.crop),
        buckets_(settings.crop, settings.bucket_size) {
    contexts_ =
        make_surface_contexts(scene, camera, projection_, settings_, topologies_, diagnostics);
    prepared_.surfaces =
        uint64_t(std::count_if(contexts_.begin(), contexts_.end(),
                               [](const SurfaceContext& c) { return c.patches != nullptr; }));
    std::vector<Chunk> chunks = make_all_chunks(diagnostics);
    std::vector<int> buckets_of_chunk(chunks.size());
    chunks_of_bucket_.resize(size_t(buckets_.columns) * size_t(buckets_.rows));
    for (uint32_t c = 0; c < chunks.size(); ++c) {
      const PixelRect r = buckets_.touched(chunks[c].bounds);
      buckets_of_chunk[c] = int(r.pixel_count());
      for (int j = r.y0; j < r.y1; ++j) {
        for (int i = r.x0; i < r.x1; ++i) chunks_of_bucket_[index(i, j)].push_back(c);
      }
    }
    store_ = std::make_unique<GridStore>(std::move(chunks), contexts_, std::move(buckets_of_chunk),
                                         settings.memory_budget_bytes, diagnostics);
  }

  std::vector<std::shared_ptr<const Grid>> grids_of_bucket(int i, int j) override {
    if (!is_bucket(i, j)) return {};
    const PixelRect pixels = buckets_.pixels(i, j);
    std::vector<std::shared_ptr<const Grid>> found;
    for (uint32_t chunk : chunks_of_bucket_[index(i, j)]) {
      for (std::shared_ptr<const Grid>& grid : store_->grids_of(chunk)) {
        if (grid->raster_bounds.overlaps(pixels)) found.push_back(std::move(grid));
      }
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return a->z_min != b->z_min ? a->z_min < b->z_min : a->id < b->id;
    });
    return found;
  }

  void finish_bucket(int i, int j) override {
    if (!is_bucket(i, j)) return;
    for (uint32_t chunk : chunks_of_bucket_[index(i, j)]) store_->release(chunk);
  }

  DiceCounters counters() const override {
    DiceCounters sum = prepared_;
    merge_counters(sum, store_->counters());
    return sum;
  }
  size_t peak_bytes() const override { return store_->peak_bytes(); }

 private:
  bool is_bucket(int i, int j) const {
    return i >= 0 && j >= 0 && i < buckets_.columns && j < buckets_.rows;
  }
  size_t index(int i, int j) const { return size_t(j) * size_t(buckets_.columns) + size_t(i); }

  std::vector<Chunk> make_all_chunks(Diagnostics& diagnostics) {
    struct Task {
      const SurfaceContext* context;
      uint32_t begin, end;
      std::vector<Chunk> chunks;
      DiceCounters counters;
    };
    std::vector<Task> tasks;
    for (const SurfaceContext& context : contexts_) {
      const uint32_t count = context.patches ? context.patches->patch_count() : 0;
      for (uint32_t begin = 0; begin < count; begin += patches_per_task) {
        tasks.push_back({&context, begin, std::min(begin + patches_per_task, count), {}, {}});
      }
    }
    tbb::parallel_for(size_t(0), tasks.size(), [&](size_t k) {
      Task& task = tasks[k];
      task.chunks = make_chunks(*task.context, task.begin, task.end, buckets_.size, task.counters,
                                diagnostics);
    });
    // In the order of the scene, whichever task was first.
    std::vector<Chunk> chunks;
    for (Task& task : tasks) {
      merge_counters(prepared_, task.counters);
      std::move(task.chunks.begin(), task.chunks.end(), std::back_inserter(chunks));
    }
    return chunks;
  }

  const DiceSettings settings_;
  const RasterProjection projection_;
  const BucketArray buckets_;
  TopologyCache topologies_;
  std::vector<SurfaceContext> contexts_;  // by surface; without patches where one failed
  std::vector<std::vector<uint32_t>> chunks_of_bucket_;
  DiceCounters prepared_;
  std::unique_ptr<GridStore> store_;
};

}  // namespace

std::unique_ptr<GridSource> make_grid_source(const Scene& scene, const Camera& camera,
                                             const DiceSettings& settings,
                                             Diagnostics& diagnostics) {
  return std::make_unique<SharedGridSource>(scene, camera, settings, diagnostics);
}

}  // namespace tessera
