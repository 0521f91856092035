#pragma once
/// Settings with a name: `--quality NAME`.

#include <optional>
#include <span>
#include <string_view>

#include "engine/settings.h"

namespace tessera {

/// A quality: a row of the table in qualities.cpp. What is empty is left to the scene, or to the
/// default of its option.
struct QualityDefinition {
  const char* name;
  const char* help;
  std::optional<int> samples_per_pixel;  ///< or the next two
  std::optional<double> error;
  std::optional<int> max_samples;
  std::optional<float> shading_rate;  ///< pixels^2
  std::optional<float> dicing_rate;   ///< pixels^2
  std::optional<int> extra_samples;
};

std::span<const QualityDefinition> quality_registry();
/// Throws Error that lists the choices when unknown.
const QualityDefinition& find_quality(std::string_view name);

/// The settings with what Settings::quality stands for wherever they say nothing themselves. A
/// number of samples, an error, a time or rounds of their own replace all that a quality says of
/// how many samples there are, but for a limit.
Settings with_quality(const Settings& settings);

}  // namespace tessera
