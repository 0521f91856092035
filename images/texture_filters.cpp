#include "images/texture_filters.h"

#include <string>

#include <fmt/format.h>

#include "base/find_named.h"

namespace tessera {
namespace {

constexpr TextureFilterDefinition definitions[] = {
    {"point", "the texel that a point falls into; aliases", TextureFilter::point},
    {"bilinear", "between the four texels around a point; aliases", TextureFilter::bilinear},
    {"trilinear", "over a square as wide as the footprint is long, from two MIP levels",
     TextureFilter::trilinear},
    {"anisotropic", "over the footprint itself, up to 16 times as long as wide",
     TextureFilter::anisotropic},
};

}  // namespace

std::span<const TextureFilterDefinition> texture_filter_registry() { return definitions; }

const TextureFilterDefinition& find_texture_filter(std::string_view name) {
  return find_named(definitions, "texture filter", name);
}

}  // namespace tessera
