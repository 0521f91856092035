#include "dice/bicubic.h"

#include "dice/bezier.h"

namespace tessera {

namespace {

// Control points of side s: first index and step.
constexpr int side_first[4] = {0, 3, 12, 0};
constexpr int side_step[4] = {1, 4, 1, 4};

int compare(const glm::vec3& a, const glm::vec3& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a[axis] != b[axis]) return a[axis] < b[axis] ? -1 : 1;
  }
  return 0;
}

}  // namespace

bool curve_is_flipped(std::span<const glm::vec3> points) {
  for (size_t i = 0, j = points.size() - 1; i < j; ++i, --j) {
    const int order = compare(points[i], points[j]);
    if (order != 0) return order > 0;
  }
  return false;
}

BicubicControl bicubic_control(const glm::vec3 (&points)[16],
                               const std::array<double, 16>& u_matrix,
                               const std::array<double, 16>& v_matrix) {
  BicubicControl control;
  for (int axis = 0; axis < 3; ++axis) {
    double rows[16];
    for (int b = 0; b < 4; ++b) {
      for (int i = 0; i < 4; ++i) {
        double sum = 0;
        for (int a = 0; a < 4; ++a) {
          sum += u_matrix[size_t(4 * i + a)] * double(points[4 * b + a][axis]);
        }
        rows[4 * b + i] = sum;
      }
    }
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        double sum = 0;
        for (int b = 0; b < 4; ++b) sum += v_matrix[size_t(4 * j + b)] * rows[4 * b + i];
        control.c[axis][4 * j + i] = float(sum);
      }
    }
  }
  return control;
}

glm::vec3 BicubicPatch::control(int key, int index) const {
  const BicubicControl& k = keys_[size_t(key)];
  return {k.c[0][index], k.c[1][index], k.c[2][index]};
}

void BicubicPatch::tensor(int key, std::span<const float> u, std::span<const float> v,
                          size_t row_stride, const PatchOutput& out) const {
  bicubic_tensor(keys_[size_t(key)], u.data(), u.size(), v.data(), v.size(), row_stride, out.P,
                 out.N);
}

void BicubicPatch::points(int key, std::span<const float> u, std::span<const float> v,
                          const PatchOutput& out) const {
  bicubic_points(keys_[size_t(key)], u.data(), v.data(), u.size(), out.P, out.N);
}

void BicubicPatch::side(int key, int side, bool flip, std::span<const float> t,
                        const PatchOutput& out) const {
  if (out.wants_normals()) Patch::side(key, side, flip, t, out);
  const BicubicControl& k = keys_[size_t(key)];
  const int first = side_first[side], step = side_step[side];
  for (int axis = 0; axis < 3; ++axis) {
    float p[4];
    for (int i = 0; i < 4; ++i) p[i] = k.c[axis][first + step * (flip ? 3 - i : i)];
    for (size_t i = 0; i < t.size(); ++i) {
      const float b = t[i], a = 1.0f - b, ab3 = 3.0f * a * b;
      out.P[axis][i] = a * a * a * p[0] + ab3 * a * p[1] + ab3 * b * p[2] + b * b * b * p[3];
    }
  }
}

bool BicubicPatch::side_is_flipped(int side) const {
  // Keys are compared in turn: a curve may be symmetric at one and not at another.
  for (size_t key = 0; key < keys_.size(); ++key) {
    glm::vec3 points[4], reversed[4];
    for (int i = 0; i < 4; ++i) {
      points[i] = control(int(key), side_first[side] + side_step[side] * i);
      reversed[3 - i] = points[i];
    }
    if (curve_is_flipped(points)) return true;
    if (curve_is_flipped(reversed)) return false;
  }
  return false;
}

void BicubicPatch::append_hull(int key, const ParameterRect& rect,
                               std::vector<glm::vec3>& hull) const {
  glm::vec3 points[16];
  for (int i = 0; i < 16; ++i) points[i] = control(key, i);
  for (int j = 0; j < 4; ++j) restrict_bezier(points + 4 * j, 3, 1, rect.u0, rect.u1);
  for (int i = 0; i < 4; ++i) restrict_bezier(points + i, 3, 4, rect.v0, rect.v1);
  hull.insert(hull.end(), points, points + 16);
}

}  // namespace tessera
