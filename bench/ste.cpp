/// Sample test efficiency (samples covered over samples tested, in percent) of the hiders as motion
/// and defocus grow: Table 1 of Laine et al., "Clipless Dual-Space Bounds for Faster Stochastic
/// Rasterization", 2011, on scenes of our own. Strata are as in its section 4: in t alone, in (u,
/// v) alone, or in both, as many as there are samples in a pixel. Micropolygons are the
/// primitives. Grids come farthest first, so that all methods test all of them, whether they cull
/// by depth or not. The slowest methods are measured on every n-th bucket of the frame, their
/// counts and times scaled up to all of it.

#include <string>

#include "bench/frame_samples.h"
#include "bench/harness/benchmark.h"
#include "bench/hider_frame.h"
#include "bench/ste_scenes.h"

namespace tessera {
namespace {

constexpr int bucket_size = 64, usual_spp = 16;

/// One column of the table: a hider and the number of samples a pixel it is measured at.
struct Method {
  std::string column, hider;
  int spp = usual_spp;
  bool brute_force = false;  ///< so slow that a part of the buckets has to do
};

std::string strata(const SteScene& scene, int spp) {
  const int side = spp == 4 ? 2 : spp == 16 ? 4 : 8;
  if (scene.moves() && scene.lens()) return spp == 4 ? "2x2x1" : spp == 16 ? "2x2x4" : "4x4x4";
  if (scene.moves()) return fmt::format("1x1x{}", spp);
  return scene.lens() ? fmt::format("{0}x{0}x1", side) : "1x1x1";
}

bool hider_exists(const std::string& spec) {
  for (const HiderDefinition& definition : hider_registry())
    if (spec.substr(0, spec.find(':')) == definition.name) return true;
  return false;
}

/// Those of the table whose hiders this program has; methods on the same samples side by side.
std::vector<Method> methods(const SteScene& scene) {
  std::vector<Method> all{{"bbox", "bbox", usual_spp, true},
                          {"pixar_16", "pixar:" + strata(scene, 16)},
                          {"dual_1", "dual:1"},
                          {"dual_2", "dual:2"},
                          {"shear", "shear"},
                          {"tct", "tct", usual_spp, true},
                          {"interleave", "interleave:64"}};
  for (const int spp : {4, 64})
    all.push_back({fmt::format("pixar_{}", spp), "pixar:" + strata(scene, spp), spp});
  std::erase_if(all, [](const Method& m) { return !hider_exists(m.hider); });
  return all;
}

struct Measured {
  double percent = 0, tests = 0, tiles = 0, seconds = 0;
};

/// Hides every `every`-th bucket, and takes the others to be like them.
Measured measure(HiderFrame& frame, int every, double all_samples) {
  HideCounters c;
  const double seconds = seconds_of([&] { c = frame.render(every); });
  const double scale = all_samples / double(c.samples);
  return {100 * double(c.samples_covered) / double(c.samples_tested),
          scale * double(c.samples_tested), scale * double(c.tiles_visited), scale * seconds};
}

void run_case(BenchmarkContext& context, const std::string& name, const SteScene& scene) {
  BenchmarkContext::Columns columns, work;
  FrameSamples samples;
  const PixelRect pixels = scene.camera.frame();
  const int bucket_columns = (pixels.width() + bucket_size - 1) / bucket_size;
  // Strides that have no divisor in common with the buckets of a row, so that all columns are met.
  const int stride = context.scaled(7, 3);
  for (const Method& m : methods(scene)) {
    const FrameSampling sampling{m.spp, scene.moves(), scene.lens(),
                                 make_hider(m.hider)->sample_tuples(m.spp)};
    HiderFrame frame({scene.camera,
                      scene.grids,
                      samples.get(scene.camera, sampling, bucket_size),
                      bucket_columns,
                      bucket_size,
                      {scene.moves(), scene.lens(), false},
                      false},
                     m.hider);
    const Measured got =
        measure(frame, m.brute_force ? stride : 1, double(pixels.pixel_count()) * m.spp);
    columns.emplace_back(m.column, got.percent);
    if (m.spp != usual_spp) continue;
    work.emplace_back(m.column + "_tests", got.tests);
    work.emplace_back(m.column + "_tiles", got.tiles);
    work.emplace_back(m.column + "_s", got.seconds);
  }
  columns.emplace_back("micropolygons", double(scene.micropolygon_count()));
  columns.emplace_back("triangle_px", scene.mean_triangle_pixels());
  columns.insert(columns.end(), work.begin(), work.end());
  context.add_row(name, columns);
}

struct Variant {
  const char* name;
  SteEffects effects;
};

constexpr Variant variants[] = {{"static", {0, 0}},  {"motion", {1, 0}},     {"motion_x2", {2, 0}},
                                {"defocus", {0, 1}}, {"defocus_x2", {0, 2}}, {"both", {1, 1}},
                                {"both_x2", {2, 2}}};

void run(BenchmarkContext& context) {
  const int width = context.scaled(960, 480), height = context.scaled(540, 270);
  const int cars = context.scaled(8, 2), walls = context.scaled(36, 12);
  for (const char* scene : {"walls", "court", "cars"})
    for (const Variant& variant : variants) {
      const std::string name = scene;
      const auto made = name == "walls"   ? make_walls(width, height, variant.effects, walls)
                        : name == "court" ? make_court(width, height, variant.effects)
                                          : make_cars(width, height, variant.effects, cars);
      run_case(context, name + "/" + variant.name, *made);
    }
}

}  // namespace

BenchmarkDefinition benchmark_ste() {
  return {"ste", "sample test efficiency of the hiders as motion and defocus grow, in percent",
          run};
}

}  // namespace tessera
