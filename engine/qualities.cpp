#include "engine/qualities.h"

#include <string>

#include <fmt/format.h>

#include "base/find_named.h"

namespace tessera {
namespace {

// Why these: docs/trade.md, Qualities.
// clang-format off
constexpr QualityDefinition definitions[] = {
    {.name = "draft", .help = "4 samples a pixel, large micropolygons",
     .samples_per_pixel = 4, .error = {}, .max_samples = {},
     .shading_rate = {}, .dicing_rate = 4.0f, .extra_samples = 0},
    {.name = "preview", .help = "16 samples a pixel",
     .samples_per_pixel = 16, .error = {}, .max_samples = {},
     .shading_rate = {}, .dicing_rate = {}, .extra_samples = {}},
    {.name = "final", .help = "an error of 0.01, shading cells of a quarter of a pixel",
     .samples_per_pixel = {}, .error = 0.01, .max_samples = 1024,
     .shading_rate = 0.25f, .dicing_rate = {}, .extra_samples = {}},
};
// clang-format on

template <class T>
void complete(std::optional<T>& setting, const std::optional<T>& value) {
  if (!setting) setting = value;
}

}  // namespace

std::span<const QualityDefinition> quality_registry() { return definitions; }

const QualityDefinition& find_quality(std::string_view name) {
  return find_named(definitions, "quality", name);
}

Settings with_quality(const Settings& settings) {
  if (!settings.quality) return settings;
  const QualityDefinition& quality = find_quality(*settings.quality);
  Settings result = settings;
  const bool counted = settings.samples_per_pixel || settings.error || settings.time_s ||
                       !settings.rounds.empty() || !settings.passes.empty();
  if (!counted) {
    result.samples_per_pixel = quality.samples_per_pixel;
    result.error = quality.error;
    complete(result.max_samples, quality.max_samples);
  }
  complete(result.shading_rate, quality.shading_rate);
  complete(result.dicing_rate, quality.dicing_rate);
  complete(result.extra_samples, quality.extra_samples);
  return result;
}

}  // namespace tessera
