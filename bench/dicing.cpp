/// What dicing costs and what it does to the image: whole frames at several shading rates,
/// micropolygon areas, grid sizes and factors of GeometricApproximation. Errors are those of colour
/// against the finest setting of the same sweep on the same samples, to be read beside
/// `noise_rmse`, what another seed changes. Without a scene, scenes/examples/film_frame.rib: motion
/// and defocus.

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "bench/harness/benchmark.h"
#include "engine/frame.h"
#include "images/compare.h"
#include "scenes/rib/rib_reader.h"

namespace tessera {
namespace {

/// Noise at this many is what errors of dicing are to stay below.
constexpr int samples_per_pixel = 64;
constexpr double quick_pixels = 240 * 135;
constexpr float areas[] = {0.25f, 0.5f, 1, 2, 4, 8, 16, 32, 64};
constexpr float factors[] = {0, 1, 2, 4, 8, 16};
constexpr int grid_sizes[] = {8, 16, 32, 64};

class FirstScene : public SceneSink {
 public:
  bool frame(std::unique_ptr<const Scene> scene) override {
    found = std::move(scene);
    return false;
  }
  std::unique_ptr<const Scene> found;
};

std::unique_ptr<const Scene> read_scene(const std::string& file) {
  FirstScene sink;
  Diagnostics diagnostics;
  read_rib(file, sink, diagnostics);
  if (!sink.found) throw Error(fmt::format("{} holds no frame", file));
  return std::move(sink.found);
}

std::string default_scene() {
  const std::filesystem::path root = std::filesystem::path(program_folder()).parent_path();
  return (root / "scenes/examples/film_frame.rib").string();
}

double statistic(const FrameResult& frame, std::string_view name) {
  const Statistics& all = frame.statistics;
  for (const auto& [entry, value] : all.times_s)
    if (entry == name) return value;
  for (const auto& [entry, value] : all.counts)
    if (entry == name) return double(value);
  for (const auto& [entry, value] : all.memory_bytes)
    if (entry == name) return double(value);
  throw Error(fmt::format("no statistic '{}'", name));
}

/// Over the colour channels alone: depth is of another size.
ImageDifference color_difference(const Image& image, const Image& reference) {
  const auto colors = [](const Image& from) {
    Image only(from.display_window, from.data_window);
    for (const char* name : {"R", "G", "B"})
      if (const Image::Channel* channel = from.find_channel(name))
        only.channels.push_back(*channel);
    return only;
  };
  return compare_images(colors(image), colors(reference));
}

class Sweeps {
 public:
  Sweeps(BenchmarkContext& context, const Scene& scene) : context_(context), scene_(scene) {
    base_.samples_per_pixel = samples_per_pixel;
    if (context.arguments.size() > 1) base_.shading = context.arguments[1];
    base_.motion_factor = base_.focus_factor = 0.0f;
    const CameraSettings& camera = scene.camera;
    const double pixels = double(camera.x_resolution) * camera.y_resolution;
    if (context.quick && pixels > quick_pixels) {
      const double shrink = std::sqrt(quick_pixels / pixels);
      base_.x_resolution = std::max(1, int(std::lround(camera.x_resolution * shrink)));
      base_.y_resolution = std::max(1, int(std::lround(camera.y_resolution * shrink)));
    }
    full_rate_ = render(base_).image;
    Settings other_seed = base_;
    other_seed.seed = 1;
    noise_rmse_ = color_difference(render(other_seed).image, full_rate_).rmse;
  }

  void run() {
    sweep("shading_rate", areas, true, [](Settings& s, float area) { s.shading_rate = area; });
    sweep("dicing_rate", areas, true, [](Settings& s, float area) { s.dicing_rate = area; });
    sweep("grid_size", grid_sizes, false, [](Settings& s, int size) { s.grid_size = size; });
    sweep("motion_factor", factors, true, [](Settings& s, float f) { s.motion_factor = f; });
    sweep("focus_factor", factors, true, [](Settings& s, float f) { s.focus_factor = f; });
    sweep("both_factors", factors, true,
          [](Settings& s, float f) { s.motion_factor = s.focus_factor = f; });
    sweep("factors", std::array{"scene"}, false,
          [](Settings& s, const char*) { s.motion_factor = s.focus_factor = std::nullopt; });
  }

 private:
  FrameResult render(const Settings& settings) const {
    Diagnostics diagnostics;
    return render_frame(scene_, settings, diagnostics);
  }

  /// One row a value. The first value is the finest and the reference, or else it is the usual
  /// frame.
  template <class Values, class Change>
  void sweep(const char* family, const Values& values, bool first_is_reference,
             const Change& change) {
    std::optional<Image> reference;
    if (!first_is_reference) reference = full_rate_;
    for (const auto value : values) {
      Settings settings = base_;
      change(settings, value);
      const FrameResult frame = render(settings);
      if (!reference) reference = frame.image;
      const ImageDifference error = color_difference(frame.image, *reference);
      context_.add_row(fmt::format("{}/{}", family, value),
                       {{"micropolygons", statistic(frame, "micropolygons")},
                        {"dice_s", statistic(frame, "dice_s")},
                        {"hide_s", statistic(frame, "hide_s")},
                        {"shade_s", statistic(frame, "shade_s")},
                        {"frame_s", statistic(frame, "frame_s")},
                        {"peak_bytes", statistic(frame, "peak_grid_bytes")},
                        {"points", statistic(frame, "points_shaded")},
                        {"rel_mse", error.rel_mse},
                        {"rmse", error.rmse},
                        {"noise_rmse", noise_rmse_}});
    }
  }

  BenchmarkContext& context_;
  const Scene& scene_;
  Settings base_;
  Image full_rate_;
  double noise_rmse_ = 0;
};

void run(BenchmarkContext& context) {
  const auto scene = read_scene(context.arguments.empty() ? default_scene() : context.arguments[0]);
  Sweeps(context, *scene).run();
}

}  // namespace

BenchmarkDefinition benchmark_dicing() {
  return {"dicing",
          "frames at several shading rates, micropolygon sizes, grid sizes and blur factors",
          run,
          {"SCENE.rib", "SHADING"}};
}

}  // namespace tessera
