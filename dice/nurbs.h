#pragma once
/// NuPatch: rational tensor-product B-splines of any order, cut into Bezier patches at their knots.

#include "dice/moving_points.h"
#include "dice/patch.h"

namespace tessera {

/// `surface` must hold a NurbsPatch; it and `points` must outlive the set. Throws Error when the
/// knots leave no span between the parameter limits.
std::unique_ptr<PatchSet> make_nurbs_patches(const Surface& surface, const MovingPoints& points);

/// One polynomial span of a B-spline.
struct KnotSpan {
  int first = 0;          ///< index of the first control point that matters
  double t0 = 0, t1 = 1;  ///< the span's knot values, cut to the limits
  /// bezier_i = sum_j matrix[i * order + j] p_(first + j).
  std::vector<double> matrix;
};

/// The non-empty spans of a B-spline within [t_min, t_max], by polar forms (Ramshaw 1987,
/// "Blossoming"): Bezier point i of [a, b] is the blossom at (order - 1 - i) times a and i times b.
std::vector<KnotSpan> knot_spans(std::span<const double> knots, int vertices, int order,
                                 double t_min, double t_max);

}  // namespace tessera
