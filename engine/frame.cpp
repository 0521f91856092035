#include "engine/frame.h"

#include <ctime>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "cameras/camera_matrices.h"
#include "engine/bucket_renderer.h"
#include "engine/frame_statistics.h"
#include "engine/overrides.h"
#include "engine/version.h"
#include "images/image_module.h"
#include "rays/rays.h"
#include "reconstruct/pixel_filter.h"

namespace tessera {
namespace {

/// Textures come from the image module, which is loaded at the first lookup only.
ShadeSetup shade_setup(const Scene& scene, const Camera& camera, Diagnostics& diagnostics) {
  ShadeSetup setup;
  setup.scene = &scene;
  setup.camera = &camera;
  setup.diagnostics = &diagnostics;
  setup.texture_sampler = [&scene] {
    TextureSettings textures;
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

/// Null when nothing asks for rays.
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

/// sqrt(3) times the root mean square of `distance_of(k)` over k < `count`.
template <class DistanceOf>
float spread(int count, const DistanceOf& distance_of) {
  double squares = 0;
  for (int k = 0; k < count; ++k) {
    const double distance = distance_of(k);
    squares += distance * distance;
  }
  return float(std::sqrt(3 * squares / count));
}

/// SampleSpreads::lens, by midpoints of 64 x 64 strata.
float lens_spread(const LensProfile& lens) {
  constexpr int side = 64;
  return spread(side * side, [&](int k) {
    const glm::vec2 at =
        lens.sample((float(k % side) + 0.5f) / side, (float(k / side) + 0.5f) / side);
    return std::sqrt(0.5 * double(glm::dot(at, at)));
  });
}

/// SampleSpreads::time, by midpoints of 1024 strata.
float time_spread(const ShutterProfile& shutter) {
  constexpr int strata = 1024;
  return spread(strata,
                [&](int k) { return double(shutter.sample((float(k) + 0.5f) / strata)) - 0.5; });
}

BucketLayout bucket_layout(const FramePlan& plan, const Camera& camera) {
  const int reach = plan.filters_distribution() ? reconstruction_reach(plan.reconstruct) : 0;
  const PixelRect crop = camera.crop();
  const PixelRect filtered =
      PixelRect{crop.x0 - reach, crop.y0 - reach, crop.x1 + reach, crop.y1 + reach}.intersect(
          camera.frame());
  return {sampled_pixels(filtered, camera.frame(), plan.filter_x_width, plan.filter_y_width),
          plan.bucket_size};
}

std::unique_ptr<Reconstruction> reconstruction(const FramePlan& plan, const BucketLayout& buckets,
                                               const Camera& camera,
                                               const std::vector<const AovDefinition*>& groups,
                                               const SceneOptions& options, int threads) {
  ReconstructionSettings settings;
  settings.method = plan.reconstruct;
  settings.features = plan.distribution();
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
  film.exposure_gain = options.exposure_gain;
  film.exposure_gamma = options.exposure_gamma;
  return make_reconstruction(settings);
}

int thread_count(const Settings& settings) {
  if (settings.threads < 0 || settings.threads > 1024)
    throw Error(fmt::format("threads must lie between 0 and 1024, found {}", settings.threads));
  return settings.threads > 0 ? settings.threads : int(std::thread::hardware_concurrency());
}

/// Hands out buckets row by row, so that the film and the grids hold a narrow front of the frame.
class BucketQueue {
 public:
  BucketQueue(const BucketLayout& buckets, const FrameControl& control)
      : buckets_(buckets), control_(control) {}

  /// False when none is left or the frame is cancelled.
  bool take(int& i, int& j) {
    if (control_.cancel && control_.cancel->load(std::memory_order_relaxed)) return false;
    const int index = next_.fetch_add(1);
    if (index >= buckets_.count()) return false;
    i = index % buckets_.columns(), j = index / buckets_.columns();
    return true;
  }
  void done() {
    std::lock_guard lock(mutex_);
    ++finished_;
    if (control_.progress) control_.progress(finished_, buckets_.count());
  }
  /// No further bucket is handed out.
  void stop() { next_ = buckets_.count(); }
  bool complete() const { return finished_ == buckets_.count(); }

 private:
  const BucketLayout& buckets_;
  const FrameControl& control_;
  std::atomic<int> next_{0};
  std::mutex mutex_;
  int finished_ = 0;
};

/// Renders every bucket on `threads` workers. An exception in one of them reaches the caller after
/// the others have stopped.
void render_buckets(const FrameParts& parts, int threads, BucketQueue& queue,
                    FrameStatistics& statistics) {
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::task_group workers;
    for (int k = 0; k < threads; ++k) {
      workers.run([&] {
        BucketRenderer renderer(parts);
        try {
          for (int i, j; queue.take(i, j); queue.done()) renderer.render(i, j);
        } catch (...) {
          queue.stop();
          throw;
        }
        statistics.add(renderer);
      });
    }
    workers.wait();
  });
}

void add_metadata(FrameResult& frame, const Scene& scene) {
  std::map<std::string, std::string>& metadata = frame.image.metadata;
  metadata["software"] = fmt::format("Tessera {}", version);
  metadata["tessera:scene"] = scene.file;
  metadata["tessera:frame"] = std::to_string(scene.frame_number);
  metadata["tessera:complete"] = frame.complete ? "yes" : "no, cancelled";
  metadata["tessera:summary"] = frame.statistics.summary();
  for (const auto& [name, value] : frame.statistics.plan) metadata["tessera:plan:" + name] = value;
  for (const auto& [name, value] : frame.statistics.options)
    metadata["tessera:option:" + name] = value;
  metadata["capDate"] = fmt::format("{:%Y:%m:%d %H:%M:%S}", fmt::localtime(std::time(nullptr)));
}

/// What a depth file needs to become a shadow map, under OpenEXR's standard names.
void add_matrices(FrameResult& frame, const Camera& camera) {
  const CameraMatrices maps = camera_matrices(camera);
  // The columns of a matrix for column vectors are the rows of one for row vectors.
  const auto store = [&](const char* name, const glm::dmat4& matrix) {
    std::array<float, 16>& rows = frame.image.matrices[name];
    for (int i = 0; i < 16; ++i) rows[size_t(i)] = float(matrix[i / 4][i % 4]);
  };
  store("worldToCamera", maps.camera_from_world);
  store("worldToNDC", maps.ndc_from_world);
}

}  // namespace

FrameResult render_frame(const Scene& original, const Settings& settings, Diagnostics& diagnostics,
                         const FrameControl& control) {
  FrameStatistics statistics;
  const Scene scene = apply_overrides(original, settings);
  const Camera camera(scene.camera);
  const auto bindings = bind_shaders(shade_setup(scene, camera, diagnostics));
  FramePlan plan = make_plan(scene, scene.camera, settings, *bindings);
  if (control.revise_plan) control.revise_plan(plan);
  const BucketLayout buckets = bucket_layout(plan, camera);
  const int threads = thread_count(settings);

  std::vector<const AovDefinition*> groups;
  for (const std::string& name : plan.channel_groups) groups.push_back(&find_aov(name));
  const auto film = reconstruction(plan, buckets, camera, groups, scene.options, threads);
  const auto hider = make_hider(plan.hider);
  const ShadingFrame shaded = shading_frame(plan, bindings);
  const auto shading = control.make_shading ? control.make_shading(plan.shading, shaded)
                                            : make_shading(plan.shading, shaded);
  std::optional<Heatmap> heatmap;
  if (settings.heatmap) heatmap.emplace(find_heatmap(*settings.heatmap), camera.crop());

  FrameResult result;
  if (!scene.surfaces.empty()) {
    const auto displacer = plan.displacement ? make_displacer(bindings) : nullptr;
    const SamplePattern pattern(plan.samples_per_pixel, settings.seed,
                                plan.lens ? &camera.lens_profile() : nullptr,
                                plan.motion ? &camera.shutter_profile() : nullptr,
                                plan.sample_tuples, {plan.area_lights, plan.bounce});
    const DiceSettings dice = dice_settings(plan, buckets, settings, displacer.get(), bindings);
    const auto grids = make_grid_source(scene, camera, dice, diagnostics);
    if (const auto rays = ray_tracer(plan, scene, camera, settings, dice, threads, diagnostics)) {
      use_rays(*bindings, rays);
      statistics.add(*rays);
    }
    std::optional<ExtraPatterns> extra;
    if (plan.extra_samples > 0)
      extra.emplace(plan.extra_samples, settings.seed, &camera.lens_profile(),
                    plan.motion ? &camera.shutter_profile() : nullptr,
                    SampleExtras{plan.area_lights, plan.bounce});
    statistics.setup_done();
    const HideFeatures features{plan.motion, plan.lens, plan.transparency};
    const FrameParts parts{camera,
                           buckets,
                           pattern,
                           *hider,
                           features,
                           *bindings,
                           groups,
                           *grids,
                           *shading,
                           *film,
                           plan.filters_distribution(),
                           extra ? &*extra : nullptr,
                           heatmap ? &*heatmap : nullptr};
    BucketQueue queue(buckets, control);
    render_buckets(parts, threads, queue, statistics);
    result.complete = queue.complete();
    statistics.add(*grids);
  }
  result.display_encoded = scene.options.exposure_gamma != 1.0f;
  result.image = film->finish();
  result.image.pixel_aspect = scene.camera.pixel_aspect;
  statistics.add(*film);
  if (heatmap) {
    result.heatmap = heatmap->definition().name;
    heatmap->add_channel(result.image);
    statistics.add(heatmap_scale(result.image, result.heatmap), *heatmap, plan, diagnostics);
  }
  result.statistics = statistics.finish(plan, scene, settings, threads, diagnostics);
  add_metadata(result, scene);
  add_matrices(result, camera);
  return result;
}

FramePlan plan_frame(const Scene& original, const Settings& settings, Diagnostics& diagnostics) {
  const Scene scene = apply_overrides(original, settings);
  const Camera camera(scene.camera);
  return make_plan(scene, scene.camera, settings,
                   *bind_shaders(shade_setup(scene, camera, diagnostics)));
}

}  // namespace tessera
