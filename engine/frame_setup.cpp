#include "engine/frame_setup.h"

#include <algorithm>
#include <filesystem>
#include <thread>

#include <fmt/format.h>

#include "base/error.h"
#include "engine/limits.h"
#include "engine/sample_spreads.h"
#include "images/image_module.h"
#include "reconstruct/pixel_filter.h"

namespace tessera {

ShadeSetup shade_setup(const Scene& scene, const Camera& camera, const Settings& settings,
                       Diagnostics& diagnostics) {
  ShadeSetup setup;
  setup.scene = &scene;
  setup.camera = &camera;
  setup.diagnostics = &diagnostics;
  const TextureFilter filter =
      find_texture_filter(settings.texture_filter.value_or("anisotropic")).filter;
  setup.texture_sampler = [&scene, filter] {
    TextureSettings textures;
    textures.filter = filter;
    textures.search_path = scene.options.texture_path;
    // Textures mostly lie near the scene file, from wherever it is rendered.
    textures.search_path.push_back(std::filesystem::path(scene.file).parent_path().string());
    return std::shared_ptr<TextureSampler>(load_image_module()->make_texture_sampler(textures));
  };
  return setup;
}

ShadingFrame shading_frame(const FramePlan& plan, std::shared_ptr<const ShaderBindings> bindings) {
  ShadingFrame frame{std::move(bindings), plan.motion, plan.lens};
  frame.pixel_filter_band_limit = [plan](double energy_share) {
    return pixel_filter_band_limit(find_pixel_filter(plan.filter), plan.filter_x_width,
                                   plan.filter_y_width, energy_share);
  };
  frame.dicing_ratio = plan.dicing_ratio;
  return frame;
}

DiceSettings dice_settings(const FramePlan& plan, const BucketLayout& buckets,
                           const Settings& settings, const Displacer* displacer,
                           std::shared_ptr<const ShaderBindings> bindings) {
  DiceSettings dice;
  dice.max_grid_size = plan.grid_size;
  dice.dicing_rate = settings.dicing_rate;
  dice.motion_factor = plan.motion_factor;
  dice.focus_factor = plan.focus_factor;
  dice.crop = buckets.sampled;
  dice.bucket_size = buckets.size;
  dice.memory_budget_bytes = settings.memory_bytes;
  dice.displacer = displacer;
  dice.wants_primvar = [bindings](const Attributes& attributes, std::string_view name) {
    return wants_primvar(*bindings, attributes, name);
  };
  return dice;
}

std::shared_ptr<const RayTracer> ray_tracer(const FramePlan& plan, const Scene& scene,
                                            const Camera& camera, const Settings& settings,
                                            const DiceSettings& seen, int threads,
                                            Diagnostics& diagnostics) {
  if (!plan.ray_tracing) return nullptr;
  RaySettings rays;
  rays.max_grid_size = seen.max_grid_size;
  rays.dicing_rate = settings.ray_dicing_rate;
  rays.displacer = seen.displacer;
  rays.wants_primvar = seen.wants_primvar;
  rays.threads = threads;
  return make_ray_tracer(scene, camera, rays, diagnostics);
}

namespace {

int filter_reach(const FramePlan& plan) {
  return plan.filters_distribution() ? reconstruction_reach(plan.reconstruct) : 0;
}

}  // namespace

int rows_needed(const FramePlan& plan) {
  constexpr int far = 1 << 10;
  const PixelRect around = sampled_pixels({0, 0, 1, 1}, {-far, -far, far, far}, plan.filter_x_width,
                                          plan.filter_y_width);
  return filter_reach(plan) + around.y1 - 1;
}

BucketLayout bucket_layout(const FramePlan& plan, const Camera& camera) {
  const int reach = filter_reach(plan);
  const PixelRect crop = camera.crop();
  const PixelRect filtered =
      PixelRect{crop.x0 - reach, crop.y0 - reach, crop.x1 + reach, crop.y1 + reach}.intersect(
          camera.frame());
  return {sampled_pixels(filtered, camera.frame(), plan.filter_x_width, plan.filter_y_width),
          plan.bucket_size};
}

ReconstructionSettings reconstruction_settings(const FramePlan& plan, const BucketLayout& buckets,
                                               const Camera& camera,
                                               const std::vector<const AovDefinition*>& groups,
                                               float exposure_gain, float exposure_gamma,
                                               int threads, size_t moment_bytes) {
  ReconstructionSettings settings;
  settings.features = plan.distribution();
  settings.memory_bytes = moment_bytes;
  settings.threads = threads;
  if (plan.lens) settings.spreads.lens = lens_spread(camera.lens_profile());
  if (plan.motion) settings.spreads.time = time_spread(camera.shutter_profile());
  FilmSettings& film = settings.film;
  film.display_window = camera.frame();
  film.crop = camera.crop();
  film.sampled = buckets.sampled;
  film.bucket_size = buckets.size;
  film.filter = plan.filter;
  film.filter_x_width = plan.filter_x_width;
  film.filter_y_width = plan.filter_y_width;
  for (const AovDefinition* group : groups) film.groups.push_back(group);
  film.exposure_gain = exposure_gain;
  film.exposure_gamma = exposure_gamma;
  return settings;
}

int thread_count(const Settings& settings) {
  if (settings.threads < 0 || settings.threads > max_threads)
    throw Error(
        fmt::format("threads must lie between 0 and {}, found {}", max_threads, settings.threads));
  // The library may not know how many cores there are, and then says 0.
  const int cores = std::max(1, int(std::thread::hardware_concurrency()));
  return settings.threads > 0 ? settings.threads : cores;
}

}  // namespace tessera
