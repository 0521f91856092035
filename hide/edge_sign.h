#pragma once
/// The exact tie rule of the coverage test.
///
/// A vertex seen from a sample is the triple (dx, dy, W) with dx = X - x W, dy = Y - y W: its
/// projection relative to the sample, times W. Edge i-j has the sample on one side or the other by
/// the sign of e = dx_i dy_j - dx_j dy_i. If e is zero the sample lies on the line of the edge, and
/// it is moved by (eps, eps^2), eps -> 0+, the same way for every edge. That replaces dx by
/// dx - eps W and dy by dy - eps^2 W:
///
///   e(eps) = e + eps (-W_i dy_j + W_j dy_i) + eps^2 (-dx_i W_j + dx_j W_i),
///
/// and the cubic terms cancel. The first term that is not zero decides. Moving the sample is moving
/// one point over an unchanged mesh, so a sample on a shared edge or vertex of a closed mesh is
/// covered exactly as often as the points beside it are: once per layer.

namespace tessera {

struct SeenVertex {
  float dx, dy, W;
};

/// Sign of a * b - c * d, exact: the product of two floats fits a double, and the rounded
/// difference of two doubles has the sign of the difference.
inline int exact_sign(float a, float b, float c, float d) {
  const double difference = double(a) * double(b) - double(c) * double(d);
  return (difference > 0) - (difference < 0);
}

/// Side of edge i-j on which the sample lies: -1 or 1, and edge_sign(i, j) == -edge_sign(j, i).
/// 0 only if i and j lie on one ray from the eye; such an edge bounds nothing.
inline int edge_sign(const SeenVertex& i, const SeenVertex& j) {
  if (const int sign = exact_sign(i.dx, j.dy, j.dx, i.dy)) return sign;
  if (const int sign = exact_sign(j.W, i.dy, i.W, j.dy)) return sign;
  return exact_sign(j.dx, i.W, i.dx, j.W);
}

}  // namespace tessera
