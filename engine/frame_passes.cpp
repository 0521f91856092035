#include "engine/frame_passes.h"

#include <algorithm>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "cameras/camera_matrices.h"
#include "dice/whole_scene.h"
#include "engine/bucket_queue.h"
#include "engine/frame_files.h"
#include "engine/overrides.h"
#include "engine/version.h"
#include "reconstruct/exposure.h"

namespace tessera {
namespace {

std::vector<const AovDefinition*> channel_groups(const FramePlan& plan) {
  std::vector<const AovDefinition*> groups;
  for (const std::string& name : plan.channel_groups) groups.push_back(&find_aov(name));
  return groups;
}

void add_metadata(FrameResult& frame, const Scene& scene) {
  std::map<std::string, std::string>& metadata = frame.image.metadata;
  metadata["software"] = fmt::format("Tessera {}", version);
  metadata["tessera:scene"] = scene.file;
  metadata["tessera:frame"] = std::to_string(scene.frame_number);
  metadata[complete_attribute] = frame.complete ? "yes" : "no, cancelled";
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

/// What the film alone makes of the colours that another reconstruction gets, too.
class PlainColours final : public Reconstruction {
 public:
  PlainColours(Reconstruction& filtered, const FilmSettings& settings)
      : filtered_(filtered),
        group_(
            size_t(std::ranges::find(settings.groups, &find_aov("rgb")) - settings.groups.begin())),
        film_(of_colours(settings)) {}

  void add_bucket(int i, int j, SampleValues&& values) override {
    SampleValues colours;
    colours.rect = values.rect;
    colours.samples_per_pixel = values.samples_per_pixel;
    colours.first_of_pixel = values.first_of_pixel;
    colours.x = values.x, colours.y = values.y;
    colours.groups = {values.groups[group_]};
    film_.add_bucket(i, j, std::move(colours));
    filtered_.add_bucket(i, j, std::move(values));
  }
  Image finish() override { return film_.finish(); }
  FilmCounters counters() const override { return film_.counters(); }

 private:
  static FilmSettings of_colours(FilmSettings settings) {
    settings.groups = {&find_aov("rgb")};
    return settings;
  }

  Reconstruction& filtered_;
  size_t group_;
  Film film_;
};

void encode(Image& image, float exposure_gamma) {
  for (const char* name : {"R", "G", "B"})
    for (Image::Channel& channel : image.channels)
      if (channel.name == name)
        for (float& value : channel.values) value = exposed(value, 1.0f, exposure_gamma);
}

}  // namespace

FramePasses::FramePasses(const Scene& scene, const Settings& settings, Diagnostics& diagnostics,
                         const FrameControl& control, bool several)
    : settings_(settings),
      diagnostics_(diagnostics),
      control_(control),
      several_(several),
      scene_(apply_overrides(scene, settings)),
      camera_(scene_.camera),
      plan_([&] {
        const auto bindings = bind_shaders(shade_setup(scene_, camera_, settings, diagnostics));
        bindings_ = bindings;
        FramePlan plan = make_plan(scene_, scene_.camera, settings, *bindings);
        if (control.revise_plan) control.revise_plan(plan);
        return plan;
      }()),
      buckets_(bucket_layout(plan_, camera_)),
      threads_(thread_count(settings)),
      groups_(channel_groups(plan_)),
      hider_(make_hider(plan_.hider)),
      reconstruction_method_(make_reconstruction_method(plan_.reconstruct)),
      strips_(strips_that_fit()) {
  const ShadingFrame shaded = shading_frame(plan_, bindings_);
  shading_ = control.make_shading ? control.make_shading(plan_.shading, shaded)
                                  : make_shading(plan_.shading, shaded);
  if (settings.heatmap) heatmap_.emplace(find_heatmap(*settings.heatmap), camera_.crop());
  if (!scene_.surfaces.empty()) set_up_surfaces();
  statistics_.setup_done();
}

void FramePasses::set_up_surfaces() {
  if (plan_.displacement) displacer_ = make_displacer(bindings_);
  const DiceSettings dice = dice_settings(plan_, buckets_, settings_, displacer_.get(), bindings_);
  grids_ = make_grid_source(scene_, camera_, dice, diagnostics_);
  if (wants_emitters(*bindings_))
    use_emitters(*bindings_, dice_emitters(scene_, camera_, dice, diagnostics_));
  if (const auto rays =
          ray_tracer(plan_, scene_, camera_, settings_, dice, threads_, diagnostics_)) {
    use_rays(*bindings_, rays);
    statistics_.add(*rays);
  }
}

const ShutterProfile* FramePasses::shutter() const {
  return plan_.motion ? &camera_.shutter_profile() : nullptr;
}

const LensProfile* FramePasses::lens() const {
  return plan_.lens ? &camera_.lens_profile() : nullptr;
}

int FramePasses::known_passes() const {
  if (!settings_.rounds.empty()) return 2 * int(settings_.rounds.size());
  if (!settings_.passes.empty()) return int(settings_.passes.size());
  return several_ ? 0 : 1;
}

bool FramePasses::adaptive() const { return plan_.sample_tuples.kind == SampleTuples::Kind::free; }

int FramePasses::lowest_level() const {
  if (adaptive()) return 0;
  // Those of the plan can be had as they divide evenly, and so can every multiple.
  for (int level = 0; level < SampleAllocation::highest_level; ++level)
    if ((1 << level) % plan_.samples_per_pixel == 0) return level;
  throw Error(fmt::format(
      "hider {}: an error or a time takes powers of two of samples per pixel, and {} are none; "
      "expected another hider",
      plan_.hider, plan_.samples_per_pixel));
}

PassResult FramePasses::render(int samples, uint32_t seed) {
  const SamplePattern pattern(samples, seed, lens(), shutter(), hider_->sample_tuples(samples),
                              extras());
  std::optional<ExtraPatterns> extra;
  if (plan_.extra_samples > 0)
    extra.emplace(plan_.extra_samples, seed, lens(), shutter(), extras());
  return render({&pattern, extra ? &*extra : nullptr, nullptr, nullptr});
}

PassResult FramePasses::render(const SampleAllocation& allocation, uint32_t seed) {
  const LevelPatterns levels(allocation, seed, lens(), shutter(), extras(),
                             [&](int samples) { return hider_->sample_tuples(samples); });
  return render({nullptr, nullptr, &allocation, &levels});
}

ReconstructionSettings FramePasses::strip_settings(const Strip& strip) const {
  ReconstructionSettings settings = reconstruction_settings(
      plan_, buckets_, camera_, groups_, scene_.options.exposure_gain,
      several_ ? 1.0f : scene_.options.exposure_gamma, threads_, settings_.filter_memory_bytes);
  settings.method = reconstruction_method_;
  settings.film.crop = strip.crop;
  settings.film.sampled = strip.sampled(buckets_);
  return settings;
}

/// As few as the memory for moments allows; as many as there are rows of buckets if none do.
std::vector<Strip> FramePasses::strips_that_fit() const {
  for (int count = 1;; ++count) {
    auto strips = cut_into_strips(buckets_, camera_.crop(), rows_needed(plan_), count);
    const bool fits = std::ranges::all_of(strips, [&](const Strip& strip) {
      const ReconstructionSettings settings = strip_settings(strip);
      return reconstruction_bytes(settings) <= settings.memory_bytes;
    });
    if (fits || count >= buckets_.rows()) return strips;
  }
}

PassResult FramePasses::render(const Samples& samples) {
  int rows = 0;
  for (const Strip& strip : strips_) rows += strip.end_row - strip.first_row;
  std::optional<BucketQueue> queue;
  if (grids_) queue.emplace(buckets_, control_, ++pass_count_, known_passes(), rows);
  PassResult result;
  const double diced_s = statistics_.dice_s();
  for (const Strip& strip : strips_) render_strip(samples, strip, queue, result);
  if (queue) result.complete = queue->complete();
  result.dice_s = (statistics_.dice_s() - diced_s) / threads_;
  return result;
}

void FramePasses::render_strip(const Samples& samples, const Strip& strip,
                               std::optional<BucketQueue>& queue, PassResult& result) {
  const ReconstructionSettings settings = strip_settings(strip);
  const auto film = make_reconstruction(settings);
  std::optional<PlainColours> plain;
  if (samples.allocation && plan_.filters_distribution()) plain.emplace(*film, settings.film);
  if (queue) {
    const FrameParts parts{camera_,
                           buckets_,
                           strip,
                           samples.pattern,
                           *hider_,
                           {plan_.motion, plan_.lens, plan_.transparency},
                           *bindings_,
                           groups_,
                           *grids_,
                           *shading_,
                           plain ? static_cast<Reconstruction&>(*plain) : *film,
                           plan_.filters_distribution(),
                           samples.extra,
                           samples.allocation,
                           samples.levels,
                           several_,
                           heatmap_ ? &*heatmap_ : nullptr};
    queue->begin_rows(strip.first_row, strip.end_row);
    render_buckets(parts, threads_, *queue, statistics_);
  }
  append_strip(film->finish(), result.image);
  if (plain) append_strip(plain->finish(), result.plain ? *result.plain : result.plain.emplace());
  result.filter_s += film->filter_s();
  statistics_.add(*film, strip.crop.pixel_count());
}

FrameResult FramePasses::finish(PassResult&& pass, AccuracyStatistics&& accuracy, bool cancelled) {
  FrameResult result;
  result.whole = pass.complete;
  result.complete = pass.complete && !cancelled;
  result.image = std::move(pass.image);
  const float gamma = scene_.options.exposure_gamma;
  result.display_encoded = gamma != 1.0f;
  if (several_ && result.display_encoded) encode(result.image, gamma);
  result.image.pixel_aspect = scene_.camera.pixel_aspect;
  if (grids_) statistics_.add(*grids_);
  statistics_.add(*bindings_);
  if (heatmap_) {
    result.heatmap = heatmap_->definition().name;
    heatmap_->add_channel(result.image);
    statistics_.add(heatmap_scale(result.image, result.heatmap), *heatmap_, plan_, diagnostics_);
  }
  result.statistics = statistics_.finish(plan_, scene_, settings_, threads_, diagnostics_);
  result.statistics.accuracy = std::move(accuracy);
  add_metadata(result, scene_);
  add_matrices(result, camera_);
  return result;
}

double write_seconds(const FramePasses& passes) {
  constexpr double written_bytes_per_s = 4e7;
  const double pixels = double(passes.crop().pixel_count());
  return 4 * double(passes.plan().channel_groups.size() + 2) * pixels / written_bytes_per_s;
}

}  // namespace tessera
