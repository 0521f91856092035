#include "reconstruct/reconstruction.h"

#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "base/error.h"
#include "reconstruct/bounded_values.h"
#include "reconstruct/effect_filter.h"
#include "reconstruct/exposure.h"
#include "reconstruct/filter_table.h"
#include "reconstruct/groups.h"
#include "reconstruct/sample_moments.h"
#include "reconstruct/weighted_taps.h"

namespace tessera {
namespace {

FilmCounters with_bounded(FilmCounters counters, uint64_t values) {
  counters.pixel_values_bounded += values;
  return counters;
}

/// The pixel filter alone.
class FilmReconstruction final : public Reconstruction {
 public:
  explicit FilmReconstruction(const FilmSettings& settings)
      : groups_(settings.groups), film_(settings) {}
  void add_bucket(int i, int j, SampleValues&& values) override {
    film_.add_bucket(i, j, std::move(values));
  }
  Image finish() override {
    Image image = film_.finish();
    bounded_ = bound_values(groups_, image);
    return image;
  }
  FilmCounters counters() const override { return with_bounded(film_.counters(), bounded_); }

 private:
  std::vector<const AovDefinition*> groups_;
  Film film_;
  uint64_t bounded_ = 0;
};

/// Autocorrelation of a pixel filter along one axis at whole pixels, 1 at 0.
std::array<float, NoiseCorrelation::reach + 1> autocorrelation(const FilmSettings& film,
                                                               float width) {
  const FilterTable table(find_pixel_filter(film.filter), width);
  constexpr int steps = 4096;
  std::array<double, NoiseCorrelation::reach + 1> sums{};
  for (int k = 0; k < steps; ++k) {
    const float x = width * ((float(k) + 0.5f) / steps - 0.5f);
    for (size_t d = 0; d < sums.size(); ++d) sums[d] += double(table(x)) * table(x - float(d));
  }
  std::array<float, NoiseCorrelation::reach + 1> out{};
  for (size_t d = 0; d < sums.size(); ++d) out[d] = float(sums[d] / sums[0]);
  return out;
}

/// Along either axis.
bool has_weights_below_zero(const FilmSettings& film) {
  constexpr int steps = 1024;
  for (const float width : {film.filter_x_width, film.filter_y_width}) {
    const FilterTable table(find_pixel_filter(film.filter), width);
    for (int k = 0; k < steps; ++k)
      if (table(width * ((float(k) + 0.5f) / steps - 0.5f)) < 0.0f) return true;
  }
  return false;
}

PixelRect sampled_rect(const ReconstructionSettings& settings) {
  return settings.film.sampled.empty() ? settings.film.crop : settings.film.sampled;
}
/// The pixels whose moments the crop needs, as far as samples reach.
PixelRect filtered_pixels(const ReconstructionSettings& settings) {
  return settings.film.crop.grown(reconstruction_reach(*settings.method))
      .intersect(sampled_rect(settings));
}

bool filters(const ReconstructionSettings& settings) {
  return settings.method && settings.features.any() && find_group(settings.film.groups, "rgb") >= 0;
}

/// A film that sums moments, and the filters that run over them in the end.
class FilteredReconstruction final : public Reconstruction {
 public:
  explicit FilteredReconstruction(const ReconstructionSettings& settings)
      : settings_(settings),
        layout_(settings.features, *settings.method),
        color_group_(size_t(find_group(settings.film.groups, "rgb"))),
        facts_(sampled(), settings.features),
        film_(film_settings()) {}

  void add_bucket(int i, int j, SampleValues&& values) override {
    facts_.add(values, settings_.spreads);
    carry_moments(layout_, facts_, color_group_, settings_.spreads, values);
    values.distribution = {};
    film_.add_bucket(i, j, std::move(values));
  }

  Image finish() override {
    const Image all = film_.finish();
    const auto start = std::chrono::steady_clock::now();
    Image image(all.display_window, settings_.film.crop);
    tbb::task_arena arena(std::max(settings_.threads, 1));
    arena.execute([&] { finish_image(all, image); });
    bounded_ = bound_values(settings_.film.groups, image);
    filter_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return image;
  }

  FilmCounters counters() const override { return with_bounded(film_.counters(), bounded_); }
  double filter_s() const override { return filter_s_; }
  double bound_samples() const override { return bound_samples_; }

 private:
  PixelRect sampled() const { return sampled_rect(settings_); }
  PixelRect filtered_rect() const { return filtered_pixels(settings_); }
  FilmSettings film_settings() const;
  void finish_image(const Image& all, Image& image);
  void write_colors(const FilteredColors& colors, const Image& all, Image& image) const;

  ReconstructionSettings settings_;
  MomentLayout layout_;
  size_t color_group_;
  PixelFacts facts_;
  Film film_;
  double filter_s_ = 0, bound_samples_ = 0;
  uint64_t bounded_ = 0;
};

/// The film's own colours are replaced in the end (write_colors).
FilmSettings FilteredReconstruction::film_settings() const {
  FilmSettings film = settings_.film;
  film.sampled = sampled();
  film.crop = filtered_rect();
  film.products = layout_.products();
  return film;
}

void FilteredReconstruction::finish_image(const Image& all, Image& image) {
  Planes planes = film_.take_products();
  for (std::vector<float>& plane : planes) plane.resize(plane.size() + tap_run);
  const PixelFacts facts = smoothed(facts_, all.data_window);
  bound_samples_ = mean_bound_samples(facts, settings_.film.crop);
  EffectFilterInput input{&layout_, settings_.method.get(), &facts, &planes, {}, 1};
  const FilmSettings& film = settings_.film;
  input.correlation = {autocorrelation(film, film.filter_x_width),
                       autocorrelation(film, film.filter_y_width)};
  input.cancels = has_weights_below_zero(film);
  input.noise_spread =
      int(std::ceil(std::max(film.filter_x_width, film.filter_y_width) - 1e-3f)) - 1;
  const FilteredColors colors = filter_effects(input);
  for (const Image::Channel& channel : all.channels) {
    Image::Channel& out = image.add_channel(channel.name, channel.type);
    for (int y = film.crop.y0; y < film.crop.y1; ++y)
      std::copy_n(channel.values.data() + all.index(film.crop.x0, y), film.crop.width(),
                  out.values.data() + image.index(film.crop.x0, y));
  }
  write_colors(colors, all, image);
}

/// Puts the filtered colours in place of the film's: rgb, exposed, and its parts if asked for.
void FilteredReconstruction::write_colors(const FilteredColors& colors, const Image& all,
                                          Image& image) const {
  const auto& groups = settings_.film.groups;
  const auto first_channel = [&](int group) {
    size_t channel = 0;
    for (int g = 0; g < group; ++g) channel += groups[size_t(g)]->channels.size();
    return channel;
  };
  const int direct = find_group(groups, "direct"), indirect = find_group(groups, "indirect");
  const size_t rgb = first_channel(int(color_group_));
  const PixelRect& crop = settings_.film.crop;
  const Planes& shadow = colors.received[size_t(RayEffect::shadow)];
  const Planes& bounce = colors.received[size_t(RayEffect::bounce)];
  for (int y = crop.y0; y < crop.y1; ++y) {
    for (int x = crop.x0; x < crop.x1; ++x) {
      const size_t from = all.index(x, y), to = image.index(x, y);
      for (size_t c = 0; c < 3; ++c) {
        const float by_shadow = shadow.empty() ? 0.0f : shadow[c][from];
        const float by_bounce = bounce.empty() ? 0.0f : bounce[c][from];
        const float sum = colors.base[c][from] + by_shadow + by_bounce;
        if (direct >= 0) image.channels[first_channel(direct) + c].values[to] = sum - by_bounce;
        if (indirect >= 0) image.channels[first_channel(indirect) + c].values[to] = by_bounce;
        image.channels[rgb + c].values[to] =
            exposed(sum, settings_.film.exposure_gain, settings_.film.exposure_gamma);
      }
    }
  }
}

}  // namespace

std::unique_ptr<ReconstructionMethod> make_method(
    std::string_view spec, std::span<const ReconstructionMethodDefinition> methods) {
  const size_t colon = std::min(spec.find(':'), spec.size());
  const std::string_view name = spec.substr(0, colon);
  const std::string_view arguments = spec.substr(std::min(colon + 1, spec.size()));
  if (name == "filter") {
    if (!arguments.empty())
      throw Error(fmt::format("reconstruction 'filter' takes no arguments, found '{}'", arguments));
    return nullptr;
  }
  std::string choices = "filter";
  for (const ReconstructionMethodDefinition& method : methods) {
    if (name == method.name) return method.make(arguments);
    choices += fmt::format(", {}", method.name);
  }
  throw Error(fmt::format("unknown reconstruction '{}', expected one of: {}", name, choices));
}

int reconstruction_reach(const ReconstructionMethod& method) {
  return method.reach() + effect_filter_margin();
}

size_t reconstruction_bytes(const ReconstructionSettings& settings) {
  if (!filters(settings)) return 0;
  const MomentLayout layout(settings.features, *settings.method);
  // Wedges of low and high along two axes, normal, surface and count; as met and smoothed.
  const size_t facts = 2 * (4 * layout.stacks().size() + 5);
  const size_t planes =
      layout.plane_count() + facts + effect_filter_planes(layout, *settings.method);
  return planes * sizeof(float) * size_t(filtered_pixels(settings).pixel_count());
}

std::unique_ptr<Reconstruction> make_reconstruction(const ReconstructionSettings& settings) {
  if (!filters(settings)) return std::make_unique<FilmReconstruction>(settings.film);
  if (const size_t bytes = reconstruction_bytes(settings); bytes > settings.memory_bytes)
    throw Error(fmt::format(
        "reconstruction needs {:.3g} GB for {} x {} pixels, {} moments each; {:.3g} GB are "
        "allowed: "
        "use fewer components, a smaller crop or more memory",
        double(bytes) * 1e-9, filtered_pixels(settings).width(), filtered_pixels(settings).height(),
        MomentLayout(settings.features, *settings.method).plane_count(),
        double(settings.memory_bytes) * 1e-9));
  return std::make_unique<FilteredReconstruction>(settings);
}

}  // namespace tessera
