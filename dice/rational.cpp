#include "dice/rational.h"

#include <algorithm>

#include "dice/bezier.h"

namespace tessera {

void bernstein(int degree, double t, double* values, double* slopes) {
  values[0] = 1;
  for (int d = 1; d <= degree; ++d) {
    if (d == degree && slopes) {
      for (int k = 0; k <= degree; ++k) {
        const double before = k > 0 ? values[k - 1] : 0, here = k < degree ? values[k] : 0;
        slopes[k] = degree * (before - here);
      }
    }
    values[d] = t * values[d - 1];
    for (int k = d - 1; k > 0; --k) values[k] = (1 - t) * values[k] + t * values[k - 1];
    values[0] = (1 - t) * values[0];
  }
  if (degree == 0 && slopes) slopes[0] = 0;
}

RationalPatch::RationalPatch(int u_degree, int v_degree, std::vector<std::vector<glm::dvec4>> keys)
    : u_degree_(u_degree), v_degree_(v_degree), keys_(std::move(keys)) {}

void RationalPatch::points(int key, std::span<const float> u, std::span<const float> v,
                           const PatchOutput& out) const {
  const std::vector<glm::dvec4>& control = keys_[size_t(key)];
  std::vector<double> bu(size_t(u_degree_) + 1), du(bu), bv(size_t(v_degree_) + 1), dv(bv);
  for (size_t n = 0; n < u.size(); ++n) {
    bernstein(u_degree_, u[n], bu.data(), du.data());
    bernstein(v_degree_, v[n], bv.data(), dv.data());
    glm::dvec4 H(0), Hu(0), Hv(0);
    for (size_t j = 0; j < bv.size(); ++j) {
      glm::dvec4 row(0), row_u(0);
      for (size_t i = 0; i < bu.size(); ++i) {
        row += bu[i] * control[j * bu.size() + i];
        row_u += du[i] * control[j * bu.size() + i];
      }
      H += bv[j] * row;
      Hu += bv[j] * row_u;
      Hv += dv[j] * row;
    }
    // P = H / w, and (H / w)' = (H' - P w') / w; the positive factor 1 / w^2 of the cross product
    // is left out.
    const glm::dvec3 P = glm::dvec3(H) / H.w;
    for (int axis = 0; axis < 3; ++axis) out.P[axis][n] = float(P[axis]);
    if (!out.wants_normals()) continue;
    const glm::dvec3 N = glm::cross(glm::dvec3(Hu) - P * Hu.w, glm::dvec3(Hv) - P * Hv.w);
    for (int axis = 0; axis < 3; ++axis) out.N[axis][n] = float(N[axis]);
  }
}

void RationalPatch::tensor(int key, std::span<const float> u, std::span<const float> v,
                           size_t row_stride, const PatchOutput& out) const {
  std::vector<float> row_v(u.size());
  for (size_t j = 0; j < v.size(); ++j) {
    row_v.assign(u.size(), v[j]);
    points(key, u, row_v, out.from(j * row_stride));
  }
}

std::vector<glm::dvec4> RationalPatch::side_points(int key, int side) const {
  const std::vector<glm::dvec4>& control = keys_[size_t(key)];
  const int width = u_degree_ + 1, count = side % 2 ? v_degree_ + 1 : width;
  const int first = side == 1 ? u_degree_ : side == 2 ? v_degree_ * width : 0;
  std::vector<glm::dvec4> points;
  for (int k = 0; k < count; ++k)
    points.push_back(control[size_t(first + k * (side % 2 ? width : 1))]);
  return points;
}

void RationalPatch::side(int key, int side, bool flip, std::span<const float> t,
                         const PatchOutput& out) const {
  if (out.wants_normals()) Patch::side(key, side, flip, t, out);
  std::vector<glm::dvec4> curve = side_points(key, side);
  if (flip) std::reverse(curve.begin(), curve.end());
  std::vector<double> basis(curve.size());
  for (size_t n = 0; n < t.size(); ++n) {
    bernstein(int(curve.size()) - 1, t[n], basis.data(), nullptr);
    glm::dvec4 H(0);
    for (size_t i = 0; i < curve.size(); ++i) H += basis[i] * curve[i];
    for (int axis = 0; axis < 3; ++axis) out.P[axis][n] = float(H[axis] / H.w);
  }
}

bool RationalPatch::side_is_flipped(int side) const {
  for (size_t key = 0; key < keys_.size(); ++key) {
    const std::vector<glm::dvec4> curve = side_points(int(key), side);
    for (size_t i = 0, j = curve.size() - 1; i < j; ++i, --j) {
      for (int axis = 0; axis < 4; ++axis) {
        if (curve[i][axis] != curve[j][axis]) return curve[i][axis] > curve[j][axis];
      }
    }
  }
  return false;
}

void RationalPatch::append_hull(int key, const ParameterRect& rect,
                                std::vector<glm::vec3>& hull) const {
  std::vector<glm::dvec4> points = keys_[size_t(key)];
  const int width = u_degree_ + 1;
  for (int j = 0; j <= v_degree_; ++j) {
    restrict_bezier(points.data() + j * width, u_degree_, 1, rect.u0, rect.u1);
  }
  for (int i = 0; i < width; ++i) {
    restrict_bezier(points.data() + i, v_degree_, width, rect.v0, rect.v1);
  }
  const bool positive =
      std::all_of(points.begin(), points.end(), [](const glm::dvec4& p) { return p.w > 0; });
  if (positive) {
    for (const glm::dvec4& p : points) hull.emplace_back(glm::dvec3(p) / p.w);
    return;
  }
  // With a weight of zero or less the hull property is lost: no bound is known.
  for (int corner = 0; corner < 8; ++corner) {
    constexpr float far = 1e18f;
    hull.emplace_back(corner & 1 ? far : -far, corner & 2 ? far : -far, corner & 4 ? far : -far);
  }
}

}  // namespace tessera
