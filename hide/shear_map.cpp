#include "hide/shear_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace tessera {
namespace {

/// Vertices looked at along each side of a block; the fit only has to be good, whatever it leaves
/// over is bounded at every vertex afterwards.
constexpr int fit_side = 5;

struct FitPoint {
  double x, y, fields[shear_fields];
};

struct ShearVertex {
  double X, Y, W, dX = 0, dY = 0, dW = 0, coc, dcoc = 0;
};

ShearVertex shear_vertex(const ClipSegment& s, const CoverageFrame& frame, bool lens, size_t i,
                         double tau) {
  ShearVertex v{};
  double z = s.z[i];
  v.X = s.X[i], v.Y = s.Y[i], v.W = s.W[i];
  if (s.dX) {
    v.dX = s.dX[i], v.dY = s.dY[i], v.dW = s.dW[i];
    v.X += tau * v.dX, v.Y += tau * v.dY, v.W += tau * v.dW;
    z += tau * s.dz[i];
    v.dcoc = lens ? double(frame.coc_x.scale) * s.dz[i] : 0.0;
  }
  v.coc = lens ? frame.coc_x.scale * z + frame.coc_x.offset : 0.0;
  return v;
}

/// Least squares over the basis 1, x, y, x^2 - m, x y - m, y^2 - m, with x and y scaled to about 1
/// and the means m taken off so that the affine part is good on its own. A tiny ridge settles what
/// the points do not determine: few of them, or all on a line.
class FieldFit {
 public:
  explicit FieldFit(std::span<const FitPoint> points) : points_(points) {
    for (const FitPoint& p : points) scale_ = std::max({scale_, std::abs(p.x), std::abs(p.y)});
    for (const FitPoint& p : points) {
      const double x = p.x / scale_, y = p.y / scale_, n = double(points.size());
      mean_[0] += x * x / n, mean_[1] += x * y / n, mean_[2] += y * y / n;
    }
    for (const FitPoint& p : points) {
      const Basis b = basis(p);
      for (int i = 0; i < size; ++i)
        for (int j = 0; j <= i; ++j) matrix_[i][j] += b[size_t(i)] * b[size_t(j)];
    }
    factorise();
  }

  void solve(int field, ShearMap& map) const {
    Basis r{};
    for (const FitPoint& p : points_) {
      const Basis b = basis(p);
      for (int i = 0; i < size; ++i) r[size_t(i)] += b[size_t(i)] * p.fields[field];
    }
    substitute(r);
    const double s = 1 / scale_, s2 = s * s;
    map.fit[field] = {float(r[0]), float(r[1] * s), float(r[2] * s)};
    map.bend[field] = {float(-(r[3] * mean_[0] + r[4] * mean_[1] + r[5] * mean_[2])),
                       float(r[3] * s2), float(r[4] * s2), float(r[5] * s2)};
  }

 private:
  static constexpr int size = 6;
  using Basis = std::array<double, size>;

  Basis basis(const FitPoint& p) const {
    const double x = p.x / scale_, y = p.y / scale_;
    return {1, x, y, x * x - mean_[0], x * y - mean_[1], y * y - mean_[2]};
  }
  /// Cholesky, in place in the lower triangle.
  void factorise() {
    double trace = 0;
    for (int i = 0; i < size; ++i) trace += matrix_[i][i];
    for (int i = 0; i < size; ++i) matrix_[i][i] += 1e-10 * trace + 1e-30;
    for (int i = 0; i < size; ++i)
      for (int j = 0; j <= i; ++j) {
        double sum = matrix_[i][j];
        for (int k = 0; k < j; ++k) sum -= matrix_[i][k] * matrix_[j][k];
        matrix_[i][j] = i == j ? std::sqrt(std::max(sum, 1e-30)) : sum / matrix_[j][j];
      }
  }
  void substitute(Basis& r) const {
    for (size_t i = 0; i < size; ++i) {
      for (size_t k = 0; k < i; ++k) r[i] -= matrix_[i][k] * r[k];
      r[i] /= matrix_[i][i];
    }
    for (size_t i = size; i-- > 0;) {
      for (size_t k = i + 1; k < size; ++k) r[i] -= matrix_[k][i] * r[k];
      r[i] /= matrix_[i][i];
    }
  }

  std::span<const FitPoint> points_;
  double scale_ = 1e-30, mean_[3] = {0, 0, 0};
  double matrix_[size][size] = {};
};

}  // namespace

bool fit_shear(const ClipSegment& s, int u_count, const CoverageFrame& frame, const SampleBox& box,
               const GridBlock& block, const TimePiece& piece, ShearMap& map) {
  const bool lens = box.lens > 0;
  map = {};
  map.tau = s.dX ? 0.5f * (piece.begin + piece.end) : 0.0f;
  map.half_duration = s.dX ? 0.5f * (piece.end - piece.begin) : 0.0f;
  if (lens) map.coc_ratio = frame.coc_y.offset / frame.coc_x.offset;

  const int i_steps = std::min(block.i1 - block.i0, fit_side - 1);
  const int j_steps = std::min(block.j1 - block.j0, fit_side - 1);
  const auto vertex = [&](int i, int j) {
    const int column = block.i0 + (block.i1 - block.i0) * i / i_steps;
    const int row = block.j0 + (block.j1 - block.j0) * j / j_steps;
    return shear_vertex(s, frame, lens, size_t(row * (u_count + 1) + column), map.tau);
  };
  double x = 0, y = 0;
  for (int j = 0; j <= j_steps; ++j)
    for (int i = 0; i <= i_steps; ++i) {
      const ShearVertex v = vertex(i, j);
      if (!(v.W > 0)) return false;
      x += v.X / v.W, y += v.Y / v.W;
    }
  const int count = (i_steps + 1) * (j_steps + 1);
  map.middle[0] = float(x / count), map.middle[1] = float(y / count);
  FitPoint points[fit_side * fit_side];
  size_t found = 0;
  for (int j = 0; j <= j_steps; ++j)
    for (int i = 0; i <= i_steps; ++i) {
      const ShearVertex v = vertex(i, j);
      points[found++] = {v.X / v.W - map.middle[0],
                         v.Y / v.W - map.middle[1],
                         {(v.dX - map.middle[0] * v.dW) / v.W, (v.dY - map.middle[1] * v.dW) / v.W,
                          v.dW / v.W, v.coc / v.W, v.dcoc / v.W}};
    }
  const FieldFit fit({points, found});
  if (s.dX)
    for (const int field : {field_rx, field_ry, field_q}) fit.solve(field, map);
  if (lens) fit.solve(field_c, map);
  if (lens && s.dX) fit.solve(field_e, map);
  return true;
}

ShearGain shear_gain(const ShearMap& m, float lens, const float (&reach)[2]) {
  const float h = m.half_duration;
  // Largest departure of the matrix from the identity.
  const auto departure = [&](const AffineField& r, float AffineField::*slope, float x, float l) {
    return h * (std::abs(r.*slope) + x * std::abs(m.fit[field_q].*slope)) +
           l * (std::abs(m.fit[field_c].*slope) + h * std::abs(m.fit[field_e].*slope));
  };
  const float lens_y = lens * std::abs(m.coc_ratio);
  const float xx = departure(m.fit[field_rx], &AffineField::per_x, reach[0], lens);
  const float xy = departure(m.fit[field_rx], &AffineField::per_y, reach[0], lens);
  const float yx = departure(m.fit[field_ry], &AffineField::per_x, reach[1], lens_y);
  const float yy = departure(m.fit[field_ry], &AffineField::per_y, reach[1], lens_y);
  // The inverse of I + D is at most the sum of the powers of |D|, which is (I - |D|)^-1.
  const float determinant = (1 - xx) * (1 - yy) - xy * yx;
  ShearGain gain;
  gain.usable = xx < 0.9f && yy < 0.9f && determinant > 0.05f;
  if (!gain.usable) return gain;
  const float inverse = (1 + 0x1p-18f) / determinant;
  gain.xx = (1 - yy) * inverse, gain.xy = xy * inverse;
  gain.yx = yx * inverse, gain.yy = (1 - xx) * inverse;
  return gain;
}

BendBounds bend_bounds(const ShearMap& m, float lens, const float (&reach)[2]) {
  BendBounds b;
  const float h = m.half_duration;
  for (int axis = 0; axis < 2; ++axis) {
    const BendField& r = m.bend[axis == 0 ? field_rx : field_ry];
    const float l = axis == 0 ? lens : lens * std::abs(m.coc_ratio);
    const auto bound = [&](float BendField::*part) {
      return h * (std::abs(r.*part) + reach[axis] * std::abs(m.bend[field_q].*part)) +
             l * (std::abs(m.bend[field_c].*part) + h * std::abs(m.bend[field_e].*part));
    };
    b.xx[axis] = bound(&BendField::xx), b.xy[axis] = bound(&BendField::xy);
    b.yy[axis] = bound(&BendField::yy);
  }
  return b;
}

}  // namespace tessera
