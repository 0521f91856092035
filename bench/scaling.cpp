/// How the time of the exact hiders, those that give the same fragments from the same free samples,
/// grows with everything a scene can have more of. One base point, and around it one sweep of each
/// quantity, in rows "family/value". `auto_ratio` is what the choice of a hider by `auto` costs
/// over the best one of the row, `shear_ratio` what always taking the sheared one does.

#include <algorithm>
#include <cmath>

#include <tbb/global_control.h>

#include "base/error.h"
#include "bench/harness/benchmark.h"
#include "bench/hider_frame.h"
#include "bench/hider_scene.h"

namespace tessera {
namespace {

struct Case {
  std::string name;
  HiderSceneSettings scene;
  int threads = 2;
};

Case base_case(bool quick) {
  return {"",
          {.width = quick ? 320 : 960,
           .height = quick ? 180 : 540,
           .motion_pixels = 20,
           .coc_pixels = 10}};
}

/// Circles of confusion grow with motion, at the base point's proportion or nearly.
constexpr double coc_of_motion = 0.4;

std::vector<Case> cases(bool quick) {
  std::vector<Case> all;
  const auto add = [&](const char* family, const std::string& value, auto change) {
    Case c = base_case(quick);
    c.name = fmt::format("{}/{}", family, value);
    change(c);
    all.push_back(c);
  };
  const auto set_count = [](Case& c, int power) {
    c.scene.micropolygon_pixels = std::sqrt(c.scene.width * c.scene.height / std::pow(10, power));
  };
  for (const int power : {3, 4, 5, 6, 7})
    if (!quick || power < 7)
      add("micropolygons", fmt::format("1e{}", power), [&](Case& c) { set_count(c, power); });
  // Blur of a few pixels, less than the larger micropolygons: where bounds are hardly worth their
  // cost.
  for (const int power : {2, 3, 4, 5})
    add("little_blur", fmt::format("1e{}", power), [&](Case& c) {
      set_count(c, power);
      c.scene.motion_pixels = 5, c.scene.coc_pixels = 3;
    });
  for (const int spp : {1, 4, 16, 64, 256})
    add("spp", fmt::to_string(spp), [&](Case& c) { c.scene.samples_per_pixel = spp; });
  for (const int px : {0, 5, 50, 500})
    add("motion_px", fmt::to_string(px),
        [&](Case& c) { c.scene.motion_pixels = px, c.scene.coc_pixels = 0; });
  for (const int px : {0, 5, 20, 200})
    add("coc_px", fmt::to_string(px),
        [&](Case& c) { c.scene.motion_pixels = 0, c.scene.coc_pixels = px; });
  for (const int px : {5, 50, 500})
    add("both_px", fmt::to_string(px), [&](Case& c) {
      c.scene.motion_pixels = px, c.scene.coc_pixels = coc_of_motion * px;
      // A quarter of the frame: the whole would take as long as all other rows together.
      if (px >= 500) c.scene.width /= 2, c.scene.height /= 2;
    });
  for (const int layers : {1, 4, 16, 64})
    add("depth_complexity", fmt::to_string(layers), [&](Case& c) { c.scene.layers = layers; });
  for (const int threads : {1, 2})
    add("threads", fmt::to_string(threads), [&](Case& c) { c.threads = threads; });
  return all;
}

struct Method {
  const char *column, *hider;
};

/// shear first: the others are measured against it.
constexpr Method methods[] = {{"shear", "shear"}, {"dual", "dual"}, {"pixar", "pixar:2x2x4"},
                              {"tct", "tct"},     {"bbox", "bbox"}, {"auto", "auto"}};

bool hider_exists(const std::string& spec) {
  for (const HiderDefinition& definition : hider_registry())
    if (spec.substr(0, spec.find(':')) == definition.name) return true;
  return false;
}

/// A hider at work on a case, with what it takes and finds.
struct Runner {
  std::string column;
  std::unique_ptr<HiderFrame> frame;
  double guess_s = 0;
  HideCounters counters;

  bool is_fixed() const { return column != "auto"; }
  /// shear and auto are in every row.
  bool is_optional() const { return is_fixed() && column != "shear"; }
};

/// How long a row may take.
struct Patience {
  double slow_s;  ///< a hider that takes longer, and 10 times as long as shear, is left out
  double row_s;   ///< for all repeats
  int few, many;  ///< repeats; fewer where shear alone takes too long
};

/// The hiders worth running: brute force can take hours where others take seconds.
std::vector<Runner> make_runners(const HiderScene& scene, int threads, const Patience& patience) {
  std::vector<Runner> runners;
  for (const Method& m : methods) {
    if (!hider_exists(m.hider)) continue;
    Runner r{m.column,
             std::make_unique<HiderFrame>(HiderFrameInput{scene.camera,
                                                          scene.grids,
                                                          scene.buckets,
                                                          scene.bucket_columns,
                                                          HiderScene::bucket_size,
                                                          {scene.motion, scene.lens, false}},
                                          m.hider),
             0,
             {}};
    if (r.is_optional()) {
      const double enough_s = std::max(patience.slow_s, 10 * runners.front().guess_s);
      r.guess_s = r.frame->predict_s(threads);
      if (r.guess_s > enough_s) continue;
    } else {
      r.guess_s = seconds_of([&] { r.frame->render(); });
    }
    runners.push_back(std::move(r));
  }
  return runners;
}

double round_seconds(const std::vector<Runner>& runners) {
  double sum = 0;
  for (const Runner& r : runners) sum += r.guess_s;
  return sum;
}

/// Leaves out the slowest until a few repeats, and the warm-up of interleave(), fit the row's time;
/// returns the number of repeats.
int plan_repeats(std::vector<Runner>& runners, const Patience& patience) {
  while (round_seconds(runners) * (patience.few + 1) > patience.row_s) {
    const auto slowest =
        std::max_element(runners.begin(), runners.end(), [](const Runner& a, const Runner& b) {
          return a.is_optional() * a.guess_s < b.is_optional() * b.guess_s;
        });
    if (!slowest->is_optional()) break;
    runners.erase(slowest);
  }
  const double fitting = patience.row_s / round_seconds(runners) - 1;
  if (fitting < 1) return 1;
  return int(std::clamp(fitting, double(patience.few), double(patience.many)));
}

/// Exact hiders find the same fragments, but for the rounding of tct's edge functions of time: a
/// row in which they do not is worth nothing.
void check_alike(const std::string& name, const std::vector<Runner>& runners) {
  const HideCounters& shear = runners.front().counters;
  for (const Runner& r : runners) {
    const double difference = std::abs(double(r.counters.fragments) - double(shear.fragments));
    if (difference > (r.column == "tct" ? 1e-4 * double(shear.samples) : 0))
      throw Error(fmt::format("case {}: hider {} finds {} fragments, shear {}; expected the same",
                              name, r.column, r.counters.fragments, shear.fragments));
  }
}

BenchmarkContext::Columns columns_of(const std::vector<Runner>& runners,
                                     const std::vector<Timing>& timings, const Case& c,
                                     double micropolygons) {
  BenchmarkContext::Columns columns;
  size_t best = 0, chosen = 0;  // shear's, unless there is an automatic choice
  for (size_t i = 0; i < runners.size(); ++i) {
    columns.emplace_back(runners[i].column + "_s", timings[i].median_s());
    if (!runners[i].is_fixed())
      chosen = i;
    else if (timings[i].median_s() < timings[best].median_s())
      best = i;
  }
  columns.emplace_back("best_s", timings[best].median_s());
  columns.emplace_back("shear_ratio", median_ratio(timings[0], timings[best]));
  if (chosen) columns.emplace_back("auto_ratio", median_ratio(timings[chosen], timings[best]));
  const HideCounters& shear = runners.front().counters;
  const double covered = double(shear.samples_covered);
  columns.emplace_back("shear_ste", covered / double(shear.samples_tested));
  const double core_ns = 1e9 * c.threads * timings[chosen].median_s();
  columns.emplace_back("ns_per_covered", core_ns / covered);
  columns.emplace_back("ns_per_micropolygon", core_ns / micropolygons);
  columns.emplace_back("samples_covered", covered);
  columns.emplace_back("micropolygons", micropolygons);
  columns.emplace_back("shear_spread", timings[0].spread());
  return columns;
}

void run_case(BenchmarkContext& context, const Case& c) {
  const HiderScene scene(c.scene);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, size_t(c.threads));
  const Patience patience = context.quick ? Patience{0.7, 0.8, 1, 5} : Patience{4, 16, 2, 7};
  std::vector<Runner> runners = make_runners(scene, c.threads, patience);
  const int repeats = plan_repeats(runners, patience);
  std::vector<Contestant> contestants;
  for (Runner& r : runners)
    contestants.push_back({r.column, [&r] { r.counters = r.frame->render(); }});
  const std::vector<Timing> timings = interleave(contestants, repeats);
  check_alike(c.name, runners);
  context.add_row(c.name, columns_of(runners, timings, c, double(scene.micropolygon_count())));
}

}  // namespace

BenchmarkDefinition benchmark_scaling() {
  return {"scaling", "time of the exact hiders as one quantity at a time grows",
          [](BenchmarkContext& context) {
            for (const Case& c : cases(context.quick)) run_case(context, c);
          }};
}

}  // namespace tessera
