#include "reconstruct/pixel_filter.h"

#include <string>

#include <fmt/format.h>

#include "base/error.h"

namespace tessera {

const PixelFilterDefinition& find_pixel_filter(std::string_view name) {
  std::string choices;
  for (const PixelFilterDefinition& filter : pixel_filter_registry()) {
    if (name == filter.name) return filter;
    choices += fmt::format("{}{}", choices.empty() ? "" : ", ", filter.name);
  }
  throw Error(fmt::format("unknown pixel filter '{}': expected one of {}", name, choices));
}

}  // namespace tessera
