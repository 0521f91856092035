#include "dice/patch.h"

#include "base/aligned.h"

namespace tessera {

PatchOutput PatchOutput::from(size_t offset) const {
  PatchOutput out = *this;
  for (int axis = 0; axis < 3; ++axis) {
    out.P[axis] += offset;
    if (out.N[axis]) out.N[axis] += offset;
  }
  return out;
}

glm::dvec2 point_on_side(int side, double t) {
  switch (side) {
    case 0:
      return {t, 0.0};
    case 1:
      return {1.0, t};
    case 2:
      return {t, 1.0};
    default:
      return {0.0, t};
  }
}

void Patch::side(int key, int side, bool flip, std::span<const float> t,
                 const PatchOutput& out) const {
  AlignedVector<float> u(padded(t.size())), v(padded(t.size()));
  for (size_t i = 0; i < t.size(); ++i) {
    const glm::dvec2 uv = point_on_side(side, flip ? 1.0 - double(t[i]) : double(t[i]));
    u[i] = float(uv.x);
    v[i] = float(uv.y);
  }
  points(key, {u.data(), t.size()}, {v.data(), t.size()}, out);
}

bool Patch::side_is_flipped(int) const { return false; }

glm::dvec2 Curve::parameters(double t) const {
  if (line == Line::constant_u) return {constant, t};
  if (line == Line::constant_v) return {t, constant};
  return point_on_side(int(line), flip ? 1.0 - t : t);
}

Location own_corner(uint32_t patch, int corner) {
  Location location;
  location.curve.patch = patch;
  location.curve.line = corner < 2 ? Curve::Line::side0 : Curve::Line::side2;
  location.t = corner & 1;
  return location;
}

SharedSide PatchSet::shared_side(uint32_t patch, int side) const {
  SharedSide shared;
  shared.curve.patch = patch;
  shared.curve.line = Curve::Line(side);
  return shared;
}

Location PatchSet::shared_corner(uint32_t patch, int corner) const {
  return own_corner(patch, corner);
}

ParameterRect PatchSet::surface_parameters(uint32_t) const { return {}; }

SharedSide PatchArray::shared_side(uint32_t patch, int side) const {
  int i = int(patch) % u_patches, j = int(patch) / u_patches;
  if (side == 0 && (j > 0 || v_wraps)) {
    j = (j + v_patches - 1) % v_patches;
    side = 2;
  } else if (side == 3 && (i > 0 || u_wraps)) {
    i = (i + u_patches - 1) % u_patches;
    side = 1;
  }
  SharedSide shared;
  shared.curve.patch = index(i, j);
  shared.curve.line = Curve::Line(side);
  return shared;
}

Location PatchArray::shared_corner(uint32_t patch, int corner) const {
  int i = int(patch) % u_patches + (corner & 1), j = int(patch) / u_patches + (corner >> 1);
  if (u_wraps) i %= u_patches;
  if (v_wraps) j %= v_patches;
  const int pi = std::min(i, u_patches - 1), pj = std::min(j, v_patches - 1);
  return own_corner(index(pi, pj), (i - pi) + 2 * (j - pj));
}

ParameterRect PatchArray::surface_parameters(uint32_t patch) const {
  const int i = int(patch) % u_patches, j = int(patch) / u_patches;
  return {double(i) / u_patches, double(i + 1) / u_patches, double(j) / v_patches,
          double(j + 1) / v_patches};
}

}  // namespace tessera
