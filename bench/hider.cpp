/// Visibility of a frame of one-pixel micropolygons against Embree, which traces the same samples
/// through the same quads. Ours starts from diced grids with known bounds, Embree from the same
/// vertices; building its acceleration structure is part of its time, as clipping space, bounds and
/// lists of grids are part of ours. Making the samples is part of neither.

#include "base/error.h"
#include "bench/harness/benchmark.h"
#include "bench/hider_embree.h"
#include "bench/hider_frame.h"
#include "bench/hider_scene.h"

namespace tessera {
namespace {

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
  const HiderScene scene(
      {.width = width, .height = height, .motion_pixels = motion_pixels, .coc_pixels = coc_pixels});
  HiderFrame tessera({scene.camera,
                      scene.grids,
                      scene.buckets,
                      scene.bucket_columns,
                      HiderScene::bucket_size,
                      {scene.motion, scene.lens, false}},
                     "auto");
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
