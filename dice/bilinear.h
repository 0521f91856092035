#pragma once
/// Bilinear patches, and triangles as patches whose side 2 is one point.

#include <array>
#include <vector>

#include "dice/patch.h"

namespace tessera {

/// Corner points at each key, in corner order (dice/patch.h). A triangle (a, b, c) is the patch
/// with corners a, b, c, c: its barycentrics are ((1 - u)(1 - v), u (1 - v), v), so everything
/// bilinear over the patch is linear over the triangle.
class BilinearPatch final : public Patch {
 public:
  using Corners = std::array<glm::vec3, 4>;

  explicit BilinearPatch(std::vector<Corners> keys) : keys_(std::move(keys)) {}
  /// Normals at the corners, one set a key, to use instead of cross(dP/du, dP/dv).
  void set_corner_normals(std::vector<Corners> normals) { normals_ = std::move(normals); }

  void tensor(int key, std::span<const float> u, std::span<const float> v, size_t row_stride,
              const PatchOutput& out) const override;
  void points(int key, std::span<const float> u, std::span<const float> v,
              const PatchOutput& out) const override;
  void side(int key, int side, bool flip, std::span<const float> t,
            const PatchOutput& out) const override;
  bool side_is_flipped(int side) const override;
  void append_hull(int key, const ParameterRect& rect, std::vector<glm::vec3>& hull) const override;
  int sample_segments() const override { return 4; }

 private:
  bool is_triangle(int key) const;
  std::vector<Corners> keys_;
  std::vector<Corners> normals_;
};

}  // namespace tessera
