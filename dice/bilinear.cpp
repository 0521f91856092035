#include "dice/bilinear.h"

#include "dice/bicubic.h"

namespace tessera {

namespace {

constexpr int side_corners[4][2] = {{0, 1}, {1, 3}, {2, 3}, {0, 2}};

// Double precision: ground planes are large, and seen from close by.
float bilinear(const BilinearPatch::Corners& p, int axis, double u, double v) {
  const double low = (1.0 - u) * double(p[0][axis]) + u * double(p[1][axis]);
  const double high = (1.0 - u) * double(p[2][axis]) + u * double(p[3][axis]);
  return float((1.0 - v) * low + v * high);
}

}  // namespace

bool BilinearPatch::is_triangle(int key) const {
  return keys_[size_t(key)][2] == keys_[size_t(key)][3];
}

void BilinearPatch::points(int key, std::span<const float> u, std::span<const float> v,
                           const PatchOutput& out) const {
  const Corners& p = keys_[size_t(key)];
  for (int axis = 0; axis < 3; ++axis) {
    for (size_t i = 0; i < u.size(); ++i) out.P[axis][i] = bilinear(p, axis, u[i], v[i]);
  }
  if (!out.wants_normals()) return;
  const bool triangle = is_triangle(key);
  const glm::dvec3 p0 = p[0], p1 = p[1], p2 = p[2], p3 = p[3];
  for (size_t i = 0; i < u.size(); ++i) {
    const double a = u[i], b = v[i];
    glm::vec3 normal;
    if (!normals_.empty()) {
      for (int axis = 0; axis < 3; ++axis) {
        normal[axis] = bilinear(normals_[size_t(key)], axis, a, b);
      }
    } else if (triangle) {
      normal = glm::vec3(glm::cross(p1 - p0, p2 - p0));
    } else {
      normal = glm::vec3(
          glm::cross((p1 - p0) * (1.0 - b) + (p3 - p2) * b, (p2 - p0) * (1.0 - a) + (p3 - p1) * a));
    }
    for (int axis = 0; axis < 3; ++axis) out.N[axis][i] = normal[axis];
  }
}

void BilinearPatch::tensor(int key, std::span<const float> u, std::span<const float> v,
                           size_t row_stride, const PatchOutput& out) const {
  std::vector<float> row_v(u.size());
  for (size_t j = 0; j < v.size(); ++j) {
    row_v.assign(u.size(), v[j]);
    points(key, u, row_v, out.from(j * row_stride));
  }
}

void BilinearPatch::side(int key, int side, bool flip, std::span<const float> t,
                         const PatchOutput& out) const {
  const int a = side_corners[side][flip ? 1 : 0], b = side_corners[side][flip ? 0 : 1];
  const auto interpolate = [&](const Corners& p, float* const to[3]) {
    for (int axis = 0; axis < 3; ++axis) {
      const double pa = p[size_t(a)][axis], pb = p[size_t(b)][axis];
      for (size_t i = 0; i < t.size(); ++i) {
        to[axis][i] = float((1.0 - double(t[i])) * pa + double(t[i]) * pb);
      }
    }
  };
  if (out.wants_normals()) Patch::side(key, side, flip, t, out);
  interpolate(keys_[size_t(key)], out.P);
  if (out.wants_normals() && !normals_.empty()) interpolate(normals_[size_t(key)], out.N);
}

bool BilinearPatch::side_is_flipped(int side) const {
  for (const Corners& p : keys_) {
    const glm::vec3 ends[2] = {p[size_t(side_corners[side][0])], p[size_t(side_corners[side][1])]};
    if (ends[0] != ends[1]) return curve_is_flipped(ends);
  }
  return false;
}

void BilinearPatch::append_hull(int key, const ParameterRect& rect,
                                std::vector<glm::vec3>& hull) const {
  const Corners& p = keys_[size_t(key)];
  for (int corner = 0; corner < 4; ++corner) {
    const double u = corner & 1 ? rect.u1 : rect.u0, v = corner & 2 ? rect.v1 : rect.v0;
    hull.emplace_back(bilinear(p, 0, u, v), bilinear(p, 1, u, v), bilinear(p, 2, u, v));
  }
}

}  // namespace tessera
