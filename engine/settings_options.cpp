#include "engine/settings_options.h"

#include <charconv>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/heatmap.h"
#include "engine/limits.h"
#include "engine/option_values.h"
#include "engine/qualities.h"
#include "hide/hide.h"
#include "images/texture_filters.h"
#include "reconstruct/method.h"
#include "reconstruct/pixel_filter.h"
#include "shade/shade.h"

namespace tessera {
namespace {

/// "640x480" -> both; false when it is anything else.
bool parse_format(std::string_view text, int& width, int& height) {
  const size_t cross = text.find('x');
  if (cross == text.npos) return false;
  const auto whole = [](std::string_view digits, int& value) {
    const auto [end, error] = std::from_chars(digits.begin(), digits.end(), value);
    return error == std::errc() && end == digits.end() && value >= 1 && value <= max_resolution;
  };
  return whole(text.substr(0, cross), width) && whole(text.substr(cross + 1), height);
}

/// As one_of() the methods for distribution effects, and "filter" for none of them.
CLI::Validator reconstruction() {
  return CLI::Validator(
      [](std::string& spec) -> std::string {
        if (spec == "filter") return "";
        const std::string problem =
            one_of(reconstruction_method_registry(), "reconstruction")(spec);
        return problem.empty() ? problem : problem + " filter";
      },
      "NAME");
}

/// How many samples: so many, or as many as something takes.
void add_sample_options(CLI::App& app, Settings& settings) {
  CLI::Option* quality = app.add_option("--quality", settings.quality,
                                        "settings with a name, for all that no other option says")
                             ->check(one_of(quality_registry(), "quality"));
  CLI::Option* samples = app.add_option("--spp", settings.samples_per_pixel, "samples per pixel")
                             ->check(CLI::Range(1, max_samples_per_pixel))
                             ->type_name("N");
  CLI::Option* error =
      app.add_option(
             "--error", settings.error,
             "as many samples as it takes, more of them where there is more noise: until "
             "the root of the mean of variance / (value^2 + 0.01), over pixels and R, G, B, "
             "is estimated to be E or less")
          ->check(number_above_0(max_error))
          ->excludes(samples)
          ->type_name("E");
  CLI::Option* time =
      app.add_option("--time", settings.time_s,
                     "as many samples as fit into a frame of so many seconds; the image depends on "
                     "how fast the machine was. With --error, the first to be reached counts")
          ->check(number_above_0(max_time_s))
          ->excludes(samples)
          ->type_name("SECONDS");
  CLI::Option* rounds =
      app.add_option_function<std::string>(
             "--rounds",
             [&settings](const std::string& list) {
               settings.rounds = positive_numbers("--rounds", list, max_samples_per_pixel);
             },
             "repeat a frame of --error: the statistics' \"repeat\", samples per pixel of each of "
             "the passes of a round")
          ->excludes(samples)
          ->excludes(error)
          ->excludes(time)
          ->type_name("N,N,...");
  app.add_option_function<std::string>(
         "--passes",
         [&settings](const std::string& list) {
           settings.passes = whole_numbers("--passes", list, max_samples_per_pixel);
         },
         "repeat a frame of --time: the statistics' \"repeat\", samples per pixel of each pass")
      ->excludes(samples)
      ->excludes(error)
      ->excludes(time)
      ->excludes(rounds)
      ->type_name("N,N,...");
  app.add_option_function<int>(
         "--max-spp",
         [&settings, quality, error, time](const int& samples_at_most) {
           if (quality->count() + error->count() + time->count() == 0)
             throw CLI::RequiresError("--max-spp", "--error or --time");
           settings.max_samples = samples_at_most;
         },
         "most samples per pixel with --error and --time, the mean over pixels (1024)")
      ->check(CLI::Range(2, max_samples_per_pixel))
      ->type_name("N");
}

void add_rate_options(CLI::App& app, Settings& settings) {
  const auto add = [&app](const char* option, std::optional<float>& setting, const char* help,
                          const CLI::Validator& valid, const char* value) {
    app.add_option(option, setting, help)->check(valid)->type_name(value);
  };
  const CLI::Validator area = number_between(1e-4f, 1e6f), factor = number_between(0, 1e6f);
  add("--shading-rate", settings.shading_rate,
      "area of a shading cell in pixels^2, for every surface", area, "R");
  add("--dicing-rate", settings.dicing_rate,
      "area of a micropolygon in pixels^2, for every surface (its ShadingRate); in the shading "
      "mode "
      "reyes, which shades the vertices, that of a shading cell, too",
      area, "R");
  add("--motion-factor", settings.motion_factor,
      "how fast micropolygons grow with motion blur beyond 16 pixels / M, 0: never", factor, "M");
  add("--focus-factor", settings.focus_factor,
      "how fast micropolygons grow with circles of confusion beyond 16 pixels / F, 0: never",
      factor, "F");
  add("--ray-dicing-rate", settings.ray_dicing_rate,
      "area of the micropolygons that rays meet in pixels^2, for every surface (4 times that of "
      "those that are seen)",
      area, "R");
}

void add_raster_options(CLI::App& app, Settings& settings) {
  app.add_option_function<std::string>(
         "--format",
         [&settings](const std::string& text) {
           int width = 0, height = 0;
           if (!parse_format(text, width, height)) {
             throw CLI::ValidationError(
                 "--format", fmt::format("'{}': expected WIDTHxHEIGHT, each 1 to {} pixels", text,
                                         max_resolution));
           }
           settings.x_resolution = width;
           settings.y_resolution = height;
         },
         "resolution in pixels")
      ->type_name("WxH");
  app.add_option_function<std::vector<double>>(
         "--crop",
         [&settings](const std::vector<double>& x) {
           if (!(0 <= x[0] && x[0] < x[1] && x[1] <= 1 && 0 <= x[2] && x[2] < x[3] && x[3] <= 1)) {
             throw CLI::ValidationError(
                 "--crop", fmt::format("{} {} {} {}: expected 0 <= X0 < X1 <= 1 and the same of Y",
                                       x[0], x[1], x[2], x[3]));
           }
           settings.crop = CameraSettings::CropWindow{x[0], x[1], x[2], x[3]};
         },
         "part of the frame to render, as fractions of it, y down")
      ->type_name("X0 X1 Y0 Y1")
      ->expected(4);
}

void add_choice_options(CLI::App& app, Settings& settings) {
  app.add_option("--hider", settings.hider, "how visibility is found")
      ->check(one_of(hider_registry(), "hider"));
  app.add_option("--shading", settings.shading, "how shading is placed")
      ->check(one_of(shading_mode_registry(), "shading mode"));
  app.add_option("--filter", settings.filter, "pixel filter, with its full widths in pixels")
      ->check(one_of(pixel_filter_registry(), "filter"))
      ->type_name("NAME[:XxY]");
  app.add_option("--texture-filter", settings.texture_filter,
                 "how textures are filtered (anisotropic)")
      ->check(one_of(texture_filter_registry(), "texture filter"));
  app.add_option("--reconstruct", settings.reconstruct,
                 "how samples become pixels where lens, motion, lights with extent or bounces "
                 "spread them (wiener where lights or bounces do, otherwise filter)")
      ->check(reconstruction())
      ->type_name("NAME[:COMPONENTS]");
  app.add_option_function<std::string>(
         "--aov", [&settings](const std::string& list) { settings.aovs = split_list(list); },
         "channels to write, separated by commas")
      ->check([](const std::string& list) {
        for (std::string name : split_list(list)) {
          const std::string problem = one_of(aov_registry(), "channel")(name);
          if (!problem.empty()) return problem;
        }
        return std::string();
      })
      ->type_name("LIST");
}

template <class Registry>
std::string list_registry(const char* title, const Registry& registry) {
  std::string text = fmt::format("{}:\n", title);
  for (const auto& entry : registry) text += fmt::format("  {:<14} {}\n", entry.name, entry.help);
  return text;
}

}  // namespace

/// An option in MiB for a number of bytes; `help` has a place for its default.
void add_budget(CLI::App& app, const char* name, size_t& bytes, const char* help) {
  app.add_option_function<size_t>(
         name, [&bytes](const size_t& mib) { bytes = mib << 20; },
         fmt::format(fmt::runtime(help), bytes >> 20))
      ->check(CLI::Range(size_t(1), max_memory_mib))
      ->type_name("MIB");
}

void add_settings_options(CLI::App& app, Settings& settings) {
  add_sample_options(app, settings);
  app.add_option("--extra-samples", settings.extra_samples,
                 "most samples a pixel may have besides, where a filter for distribution effects "
                 "runs and the focal plane is in it (100). Not with --error")
      ->check(CLI::Range(0, max_extra_samples))
      ->type_name("N");
  add_rate_options(app, settings);
  add_raster_options(app, settings);
  add_choice_options(app, settings);
  app.add_option("--heatmap", settings.heatmap,
                 "map what pixels cost: a channel of the image and OUT.NAME.png in false colours")
      ->check(one_of(heatmap_registry(), "heat map"));
  app.add_option("--bucket-size", settings.bucket_size, "side of a bucket in pixels")
      ->check(CLI::Range(1, max_bucket_size))
      ->type_name("N");
  app.add_option("--grid-size", settings.grid_size, "micropolygons along the side of a grid")
      ->check(CLI::Range(1, max_grid_size))
      ->type_name("N");
  app.add_option("--seed", settings.seed, "of the sample patterns (0)")->type_name("N");
  app.add_option("--threads", settings.threads, "0: every core (0)")
      ->check(CLI::Range(0, max_threads))
      ->type_name("N");
  add_budget(
      app, "--memory", settings.memory_bytes,
      "budget for diced grids in MiB ({}); what is shaded on them comes on top, about as much "
      "again");
  add_budget(app, "--filter-memory", settings.filter_memory_bytes,
             "budget for filters of distribution effects in MiB ({}); frames that take more are "
             "rendered in strips, and rows between them twice");
}

std::string list_choices() {
  return "\n" + list_registry("Qualities (--quality)", quality_registry()) +
         list_registry("Hiders", hider_registry()) +
         list_registry("Shading modes", shading_mode_registry()) +
         list_registry("Filters", pixel_filter_registry()) +
         list_registry("Reconstruction", reconstruction_method_registry()) +
         fmt::format("  {:<14} {}\n", "filter", "the pixel filter alone") +
         list_registry("Texture filters", texture_filter_registry()) +
         list_registry("Channels (--aov)", aov_registry()) +
         list_registry("Heat maps (--heatmap)", heatmap_registry());
}

}  // namespace tessera
