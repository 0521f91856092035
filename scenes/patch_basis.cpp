#include "scenes/patch_basis.h"

namespace tessera {

std::optional<NamedBasis> named_basis(std::string_view name) {
  // Row i of each matrix holds the weights of t^(3 - i).
  if (name == "bezier") return NamedBasis{{-1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0}, 3};
  if (name == "b-spline") {
    constexpr double s = 1.0 / 6.0;
    return NamedBasis{
        {-s, 3 * s, -3 * s, s, 3 * s, -6 * s, 3 * s, 0, -3 * s, 0, 3 * s, 0, s, 4 * s, s, 0}, 1};
  }
  if (name == "catmull-rom")
    return NamedBasis{{-0.5, 1.5, -1.5, 0.5, 1, -2.5, 2, -0.5, -0.5, 0, 0.5, 0, 0, 1, 0, 0}, 1};
  if (name == "hermite")  // control points: point, tangent, point, tangent
    return NamedBasis{{2, 1, -2, 1, -3, -2, 3, -1, 0, 1, 0, 0, 1, 0, 0, 0}, 2};
  if (name == "power") return NamedBasis{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, 4};
  return std::nullopt;
}

}  // namespace tessera
