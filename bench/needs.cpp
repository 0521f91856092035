/// Does a frame pay only for what its scene needs? Each frame as planned, against the same frame
/// made to pay for one feature that it does not need, and for all of them.

#include <cmath>

#include "bench/needs_process.h"
#include "bench/needs_scenes.h"
#include "images/compare.h"

namespace tessera {
namespace {

using Forced = std::vector<const FrameFeature*>;

/// Renders the scene with `forced` features on.
FrameResult render(const Scene& scene, const Settings& settings, const Forced& forced) {
  FrameControl control;
  control.revise_plan = [&](FramePlan& plan) {
    for (const FrameFeature* feature : forced) feature->force(plan);
  };
  Diagnostics diagnostics;
  return render_frame(scene, settings, diagnostics, control);
}

/// A way of making the frame, and what its processes took.
struct Measured {
  std::string name;
  Forced forced;
  std::vector<double> seconds, peak_bytes;
  double largest = 0, rel_mse = 0;  ///< difference from the frame as planned

  void run(const Scene& scene, const Settings& settings) {
    const IsolatedResult result = run_isolated([&]() -> std::array<double, 2> {
      return {seconds_of([&] { render(scene, settings, forced); }), 0};
    });
    seconds.push_back(result.values[0]);
    peak_bytes.push_back(result.peak_bytes);
  }
  void compare(const Scene& scene, const Settings& settings) {
    const IsolatedResult result = run_isolated([&]() -> std::array<double, 2> {
      const Image planned = render(scene, settings, {}).image;
      const ImageDifference d = compare_images(render(scene, settings, forced).image, planned);
      return {std::min(d.largest, 1e30), d.rel_mse};
    });
    largest = result.values[0], rel_mse = result.values[1];
  }
};

/// As planned first, then each feature that is off and can be forced, then all of those.
std::vector<Measured> ways_of(const FramePlan& plan) {
  std::vector<Measured> ways{{"as_planned", {}, {}, {}}};
  Forced all;
  for (const FrameFeature& feature : frame_features()) {
    if (feature.needed(plan) || !feature.force) continue;
    ways.push_back({feature.name, {&feature}, {}, {}});
    all.push_back(&feature);
  }
  ways.push_back({"all", all, {}, {}});
  return ways;
}

std::string features_on(const FramePlan& plan) {
  std::vector<std::string> on;
  for (const FrameFeature& feature : frame_features())
    if (feature.needed(plan)) on.push_back(feature.name);
  return on.empty() ? "nothing" : fmt::format("{}", fmt::join(on, " "));
}

/// Median over the rounds of the ratio within each.
double ratio_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return median(ratios);
}

void add_row(BenchmarkContext& context, const std::string& scene, const std::string& on,
             const Measured& way, const Measured& planned) {
  const double time_ratio = ratio_of(way.seconds, planned.seconds);
  const double memory_ratio = ratio_of(way.peak_bytes, planned.peak_bytes);
  context.add_row(scene + "/" + way.name, {{"frame_s", median(way.seconds)},
                                           {"time_ratio", time_ratio},
                                           {"peak_mib", median(way.peak_bytes) / (1 << 20)},
                                           {"memory_ratio", memory_ratio},
                                           {"time_saved_percent", 100 * (1 - 1 / time_ratio)},
                                           {"memory_saved_percent", 100 * (1 - 1 / memory_ratio)},
                                           {"largest_difference", way.largest},
                                           {"rel_mse", way.rel_mse},
                                           {"needs", on}});
}

void measure(BenchmarkContext& context, const std::string& file) {
  const auto scene = read_scene_to_measure(file);
  Settings settings;
  if (context.quick) {
    settings.x_resolution = 96;
    settings.y_resolution = 54;
    settings.samples_per_pixel = 4;
  }
  Diagnostics diagnostics;
  const FramePlan plan = plan_frame(*scene, settings, diagnostics);
  std::vector<Measured> ways = ways_of(plan);
  // The comparison is the warm-up: it brings modules and files into memory.
  for (Measured& way : ways) way.compare(*scene, settings);
  for (int round = 0; round < context.scaled(5, 1); ++round)
    for (size_t turn = 0; turn < ways.size(); ++turn)
      ways[(size_t(round) + turn) % ways.size()].run(*scene, settings);
  const std::string name = file.empty() ? "empty" : std::filesystem::path(file).stem().string();
  for (const Measured& way : ways) add_row(context, name, features_on(plan), way, ways.front());
}

/// With an argument, that scene alone.
void run(BenchmarkContext& context) {
  if (!context.arguments.empty()) return measure(context, context.arguments[0]);
  for (const std::string& file : scenes_to_measure()) measure(context, file);
}

}  // namespace

BenchmarkDefinition benchmark_needs() {
  return {"needs",
          "time and memory of frames as planned, against frames made to pay for what they do not "
          "need; each frame in a process of its own, in turn",
          run,
          {"SCENE.rib"}};
}

}  // namespace tessera
