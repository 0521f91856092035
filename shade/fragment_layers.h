#pragma once
/// The fragments of a sample front to back, as compositing meets them.

#include <limits>

#include "shade/shade.h"

namespace tessera {

inline constexpr size_t no_fragment = std::numeric_limits<size_t>::max();

struct FragmentRange {
  size_t begin, end;
};

inline FragmentRange fragments_of(const FragmentList& fragments, size_t sample) {
  return {fragments.first_of_sample[sample], fragments.first_of_sample[sample + 1]};
}

inline glm::vec3 color_at(const std::array<std::vector<float>, 3>& values, size_t fragment) {
  return {values[0][fragment], values[1][fragment], values[2][fragment]};
}

/// Matte surfaces hold out what is behind them and add nothing.
inline bool is_matte(const ShadeInput& input, size_t fragment) {
  return input.grids[input.fragments->grid[fragment]]->attributes().matte;
}

/// The "over" operator front to back (T. Porter, T. Duff, "Compositing digital images", SIGGRAPH
/// 1984), a channel at a time because opacity has three. Calls see(fragment, through) for every
/// fragment of the range that is seen and not matte, where `through` is the share of its light that
/// passes what lies in front of it.
template <class See>
void for_layers(const ShadeInput& input, const ShadedFragments& shaded, FragmentRange range,
                const See& see) {
  glm::vec3 through(1.0f);
  for (size_t f = range.begin; f < range.end; ++f) {
    if (!is_matte(input, f)) see(f, through);
    through *= 1.0f - color_at(shaded.Oi, f);
    if (through == glm::vec3(0.0f)) break;  // a failed fragment that nobody sees spoils nothing
  }
}

/// The nearest fragment that is not wholly transparent, unless it is matte: no_fragment then, or if
/// there is none.
inline size_t nearest_surface(const ShadeInput& input, const ShadedFragments& shaded,
                              FragmentRange range) {
  for (size_t f = range.begin; f < range.end; ++f) {
    if (color_at(shaded.Oi, f) == glm::vec3(0.0f)) continue;
    return is_matte(input, f) ? no_fragment : f;
  }
  return no_fragment;
}

}  // namespace tessera
