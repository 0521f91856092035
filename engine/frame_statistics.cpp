#include "engine/frame_statistics.h"

#include <fmt/format.h>

namespace tessera {
namespace {

template <class Counters>
void append_counts(const char* stage, const Counters& counters, Statistics& statistics) {
  for (const auto& field : Counters::fields()) {
    // A count that two stages share carries the stage's name.
    std::string name = field.name;
    for (const auto& [taken, value] : statistics.counts)
      if (taken == name) name = fmt::format("{}_{}", stage, field.name);
    statistics.counts.emplace_back(std::move(name), counters.*field.member);
  }
}

double ratio(uint64_t part, uint64_t whole) { return whole ? double(part) / double(whole) : 0.0; }

/// Every option in force, whether the scene file or the user set it.
std::vector<std::pair<std::string, std::string>> options_in_force(const Scene& scene,
                                                                  const Settings& settings,
                                                                  int threads) {
  const CameraSettings& camera = scene.camera;
  std::vector<std::pair<std::string, std::string>> options{
      {"scene", scene.file},
      {"frame", std::to_string(scene.frame_number)},
      {"format",
       fmt::format("{} {} {}", camera.x_resolution, camera.y_resolution, camera.pixel_aspect)},
      {"crop", fmt::format("{} {} {} {}", camera.crop.x_min, camera.crop.x_max, camera.crop.y_min,
                           camera.crop.y_max)},
      {"projection", camera.projection == Projection::perspective
                         ? fmt::format("perspective, fov {} degrees", camera.fov_degrees)
                         : std::string("orthographic")},
      {"clipping", fmt::format("{} {}", camera.near_clip, camera.far_clip)},
      {"shutter",
       fmt::format("{} {} {}", camera.shutter_open, camera.shutter_close, camera.shutter_profile)},
      {"depth_of_field", camera.lens
                             ? fmt::format("f-stop {}, focal length {}, focal distance {}, {} lens",
                                           camera.lens->f_stop, camera.lens->focal_length,
                                           camera.lens->focal_distance, camera.lens_profile)
                             : std::string("pinhole")},
      {"exposure", fmt::format("{} {}", scene.options.exposure_gain, scene.options.exposure_gamma)},
      {"threads", std::to_string(threads)},
      {"seed", std::to_string(settings.seed)},
      {"memory_budget_bytes", std::to_string(settings.memory_bytes)}};
  const auto add = [&options](const char* name, const std::optional<float>& value) {
    if (value) options.emplace_back(name, fmt::format("{}", *value));
  };
  add("shading_rate", settings.shading_rate);
  add("dicing_rate", settings.dicing_rate);
  add("ray_dicing_rate", settings.ray_dicing_rate);
  add("motion_factor", settings.motion_factor);
  add("focus_factor", settings.focus_factor);
  if (settings.quality) options.emplace_back("quality", *settings.quality);
  if (settings.texture_filter) options.emplace_back("texture_filter", *settings.texture_filter);
  if (settings.heatmap) options.emplace_back("heatmap", *settings.heatmap);
  return options;
}

std::string why_empty(const HeatmapDefinition& map, const FramePlan& plan) {
  if (map.extra())
    return fmt::format("no pixel takes more samples than the others: the heat map '{}' is empty",
                       map.name);
  const auto& [kind, method] =
      map.hide_counts ? std::pair("hider", plan.hider) : std::pair("shading mode", plan.shading);
  return fmt::format("the {} {} does not fill the heat map '{}'", kind, method, map.name);
}

}  // namespace

void FrameStatistics::add(const BucketRenderer& worker) {
  std::lock_guard lock(mutex_);
  for (const auto& [name, member] : StageTimes::fields()) times_.*member += worker.times().*member;
  merge_counters(hide_, worker.hide_counters());
  merge_counters(shade_, worker.shade_counters());
  extra_samples_ += worker.extra_samples();
}

void FrameStatistics::add(const Reconstruction& reconstruction, long pixels) {
  merge_counters(film_, reconstruction.counters());
  filter_s_ += reconstruction.filter_s();
  bound_samples_ += double(pixels) * reconstruction.bound_samples();
  bound_pixels_ += double(pixels);
}

void FrameStatistics::add(const GridSource& grids) {
  merge_counters(dice_, grids.counters());
  peak_grid_bytes_ = grids.peak_bytes();
}

void FrameStatistics::add(const HeatmapScale& scale, const Heatmap& map, const FramePlan& plan,
                          Diagnostics& diagnostics) {
  const std::string name = map.definition().name;
  heatmap_ = {{name + "_min", scale.min}, {name + "_max", scale.max}, {name + "_mean", scale.mean}};
  if (!map.filled() && hide_.samples_tested > 0)
    diagnostics.warn_once("heat map", why_empty(map.definition(), plan));
}

Statistics FrameStatistics::finish(const FramePlan& plan, const Scene& scene,
                                   const Settings& settings, int threads,
                                   const Diagnostics& diagnostics) const {
  Statistics statistics;
  statistics.times_s = {{"frame_s", elapsed_s()}, {"setup_s", setup_s_}, {"filter_s", filter_s_}};
  for (const auto& [name, member] : StageTimes::fields())
    statistics.times_s.emplace_back(name, times_.*member);
  append_counts("dice", dice_, statistics);
  append_counts("hide", hide_, statistics);
  append_counts("shade", shade_, statistics);
  append_counts("film", film_, statistics);
  statistics.counts.emplace_back("extra_samples", extra_samples_);
  statistics.heatmap = heatmap_;
  statistics.ratios = {{"ste", ratio(hide_.samples_covered, hide_.samples_tested)}};
  if (bound_samples_ > 0)
    statistics.ratios.emplace_back("aaf_bound_spp", bound_samples_ / bound_pixels_);
  statistics.memory_bytes = {{"peak_resident_bytes", peak_resident_bytes()},
                             {"peak_grid_bytes", peak_grid_bytes_},
                             {"ray_bytes", ray_bytes_},
                             {"bounce_bytes", bounce_bytes_}};
  statistics.plan = plan.entries();
  statistics.options = options_in_force(scene, settings, threads);
  statistics.warnings = diagnostics.lines();
  return statistics;
}

}  // namespace tessera
