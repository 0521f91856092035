#pragma once
/// How a texture is filtered over a footprint: `--texture-filter NAME`.

#include <span>
#include <string_view>

namespace tessera {

enum class TextureFilter { point, bilinear, trilinear, anisotropic };

/// A way to filter: a row of the table in texture_filters.cpp.
struct TextureFilterDefinition {
  const char* name;
  const char* help;
  TextureFilter filter;
};

std::span<const TextureFilterDefinition> texture_filter_registry();
/// Throws Error that lists the choices when unknown.
const TextureFilterDefinition& find_texture_filter(std::string_view name);

}  // namespace tessera
