#pragma once
/// Bicubic Bezier patches: RIB patches in any basis, regular faces of Catmull-Clark meshes,
/// polynomial bicubic spans of NuPatches.

#include <array>
#include <vector>

#include "dice/bicubic_kernel.h"
#include "dice/patch.h"

namespace tessera {

class BicubicPatch final : public Patch {
 public:
  /// One set of control points a motion key.
  explicit BicubicPatch(std::vector<BicubicControl> keys) : keys_(std::move(keys)) {}

  void tensor(int key, std::span<const float> u, std::span<const float> v, size_t row_stride,
              const PatchOutput& out) const override;
  void points(int key, std::span<const float> u, std::span<const float> v,
              const PatchOutput& out) const override;
  void side(int key, int side, bool flip, std::span<const float> t,
            const PatchOutput& out) const override;
  bool side_is_flipped(int side) const override;
  void append_hull(int key, const ParameterRect& rect, std::vector<glm::vec3>& hull) const override;

 private:
  glm::vec3 control(int key, int index) const;
  std::vector<BicubicControl> keys_;
};

/// Control points of one key: sum over (a, b) of v_matrix[j][b] u_matrix[i][a] point[4 b + a], with
/// 4 x 4 row-major matrices from bezier_from_basis.
BicubicControl bicubic_control(const glm::vec3 (&points)[16],
                               const std::array<double, 16>& u_matrix,
                               const std::array<double, 16>& v_matrix);

/// The direction in which a curve given by control points is evaluated, whoever owns it: from the
/// lexicographically smaller end. True when that is against the given order.
bool curve_is_flipped(std::span<const glm::vec3> points);

}  // namespace tessera
