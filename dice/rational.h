#pragma once
/// Rational tensor-product Bezier patches of any degree: spans of NuPatches.

#include <vector>

#include "dice/patch.h"

namespace tessera {

class RationalPatch final : public Patch {
 public:
  /// `keys` holds homogeneous camera-space points (w P, w), [key][j * (u_degree + 1) + i].
  RationalPatch(int u_degree, int v_degree, std::vector<std::vector<glm::dvec4>> keys);

  void tensor(int key, std::span<const float> u, std::span<const float> v, size_t row_stride,
              const PatchOutput& out) const override;
  void points(int key, std::span<const float> u, std::span<const float> v,
              const PatchOutput& out) const override;
  void side(int key, int side, bool flip, std::span<const float> t,
            const PatchOutput& out) const override;
  bool side_is_flipped(int side) const override;
  void append_hull(int key, const ParameterRect& rect, std::vector<glm::vec3>& hull) const override;

 private:
  /// The control points of a side in the order of its parameter.
  std::vector<glm::dvec4> side_points(int key, int side) const;

  int u_degree_, v_degree_;
  std::vector<std::vector<glm::dvec4>> keys_;
};

/// Bernstein polynomials of `degree` at t, and (unless null) their derivatives, each degree + 1
/// long. Exactly 0 and 1 at the ends.
void bernstein(int degree, double t, double* values, double* slopes);

}  // namespace tessera
