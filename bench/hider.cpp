/// Visibility of a frame of one-pixel micropolygons against Embree, which traces the same samples
/// through the same quads. Ours starts from diced grids with known bounds, Embree from the same
/// vertices; building its acceleration structure is part of its time, as clipping space, bounds and
/// lists of grids are part of ours. Making the samples is part of neither.

#include <algorithm>
#include <bit>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "base/error.h"
#include "bench/harness/benchmark.h"
#include "bench/hider_embree.h"
#include "bench/hider_scene.h"
#include "hide/hide.h"

namespace tessera {
namespace {

class TesseraFrame {
 public:
  TesseraFrame(const HiderScene& scene, const char* hider)
      : scene_(scene), hider_(make_hider(hider)), locals_([this] {
          return Local{hider_->make_scratch(), {}, {}};
        }) {}

  HideCounters render() {
    std::vector<std::vector<HideGrid>> grids = grids_of_buckets();
    for (Local& local : locals_) local.counters = {};
    tbb::parallel_for(size_t(0), grids.size(), [&](size_t b) {
      Local& local = locals_.local();
      HideInput input;
      input.samples = &scene_.buckets[b];
      input.grids = grids[b];
      input.raster_clip = scene_.camera.raster_clip();
      input.near_clip = scene_.camera.near_clip(), input.far_clip = scene_.camera.far_clip();
      input.lens_extent = scene_.camera.lens_profile().extent();
      input.features = {scene_.motion, scene_.lens, false};
      hider_->hide(input, *local.scratch, local.fragments, local.counters);
    });
    HideCounters total;
    for (const Local& local : locals_) merge_counters(total, local.counters);
    return total;
  }

 private:
  struct Local {
    std::unique_ptr<Hider::Scratch> scratch;
    FragmentList fragments;
    HideCounters counters;
  };

  /// Nearest first, as a grid source gives them.
  std::vector<std::vector<HideGrid>> grids_of_buckets() const {
    std::vector<const Grid*> ordered;
    for (const auto& grid : scene_.grids) ordered.push_back(grid.get());
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const Grid* a, const Grid* b) { return a->z_min < b->z_min; });
    std::vector<std::vector<HideGrid>> result(scene_.buckets.size());
    const int columns = scene_.bucket_columns, rows = int(result.size()) / columns;
    const auto bucket_at = [](float position, int count) {
      return int(std::clamp(position / HiderScene::bucket_size, 0.0f, float(count - 1)));
    };
    for (const Grid* grid : ordered) {
      const RasterBounds& r = grid->raster_bounds;
      for (int j = bucket_at(r.y_min, rows); j <= bucket_at(r.y_max, rows); ++j)
        for (int i = bucket_at(r.x_min, columns); i <= bucket_at(r.x_max, columns); ++i)
          result[size_t(j * columns + i)].push_back({grid, true});
    }
    return result;
  }

  const HiderScene& scene_;
  std::unique_ptr<Hider> hider_;
  tbb::enumerable_thread_specific<Local> locals_;
};

/// The fastest way to use Embree in this case, by trying each once.
EmbreeVariant best_variant(EmbreeFrame& embree) {
  EmbreeVariant best;
  double best_s = 1e30;
  for (const RTCBuildQuality quality : {RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM})
    for (const bool coherent : {false, true})
      for (const int packet : {8, 16}) {
        const EmbreeVariant variant{quality, coherent, packet};
        const double s = seconds_of([&] { embree.render(variant); });
        if (s < best_s) best = variant, best_s = s;
      }
  return best;
}

void run_case(BenchmarkContext& context, const char* name, double motion_pixels,
              double coc_pixels) {
  const int width = context.scaled(960, 480), height = context.scaled(540, 270);
  const HiderScene scene(width, height, 16, motion_pixels, coc_pixels);
  TesseraFrame tessera(scene, "shear");
  EmbreeFrame embree(scene);
  const EmbreeVariant variant = best_variant(embree);
  HideCounters counters;
  size_t hits = 0;
  const auto timings = interleave({{"tessera", [&] { counters = tessera.render(); }},
                                   {"embree", [&] { hits = embree.render(variant); }}},
                                  context.scaled(7, 3));
  const double difference = std::abs(double(hits) - double(counters.fragments));
  if (difference > 1e-4 * double(counters.samples))
    throw Error(
        fmt::format("case {}: Embree hits {} samples, the hider {}; expected the same but for "
                    "rounding",
                    name, hits, counters.fragments));
  context.add_row(name,
                  {{"tessera_s", timings[0].median_s()},
                   {"embree_s", timings[1].median_s()},
                   {"ratio", median_ratio(timings[1], timings[0])},
                   {"ste", double(counters.samples_covered) / double(counters.samples_tested)},
                   {"tessera_spread", timings[0].spread()},
                   {"embree_spread", timings[1].spread()},
                   {"samples", double(counters.samples)},
                   {"micropolygons", double(scene.micropolygon_count())}});
}

}  // namespace

BenchmarkDefinition benchmark_hider() {
  return {"hider", "visibility of one-pixel micropolygons at 16 samples a pixel, against Embree",
          [](BenchmarkContext& context) {
            run_case(context, "static", 0, 0);
            run_case(context, "motion_50px", 50, 0);
            run_case(context, "defocus_20px", 0, 20);
            run_case(context, "both", 50, 20);
          }};
}

}  // namespace tessera
