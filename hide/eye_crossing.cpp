#include "hide/eye_crossing.h"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

/// A corner at one end of the segment, along one axis.
struct Point {
  double P, W, coc;
  double error;  ///< by which P may be off
};

struct Points {
  Point at[8];
  int count = 0;
  double w_error = 0;  ///< by which the W of a hit may be off
};

/// A hit is a convex combination of the corners at the sample's time, each off sideways by no more
/// than the rounding of its dx, whose W is not below -w_error: its depth passed the near plane.
Points points_along(const Quad& q, const EyeView& view, int axis) {
  const float *P = axis ? q.Y : q.X, *dP = axis ? q.dY : q.dX;
  const double reach = 1 + std::max(std::abs(axis ? view.rect.y0 : view.rect.x0),
                                    std::abs(axis ? view.rect.y1 : view.rect.x1));
  Points points;
  double w_max = 0, size[4] = {};
  for (int end = 0; end <= int(view.moves); ++end)
    for (int k = 0; k < 4; ++k) {
      const auto at = [&](const float* start, const float* delta) {
        return double(start[k]) + (end ? double(delta[k]) : 0.0);
      };
      const double z = at(q.z, q.dz), scale = double(view.coc[axis].scale),
                   offset = double(view.coc[axis].offset);
      Point& p = points.at[points.count++];
      p = {at(P, dP), at(q.W, q.dW), scale * z + offset, 0};
      const double blur = double(view.lens) * (std::abs(scale * z) + std::abs(offset));
      size[k] = std::max(size[k], std::abs(p.P) + blur + reach * std::abs(p.W));
      w_max = std::max(w_max, std::abs(p.W));
    }
  points.w_error = 0x1p-18 * w_max;
  for (int i = 0; i < points.count; ++i)
    points.at[i].error = double(view.size_margin) * size[i % 4] + 2 * reach * points.w_error;
  return points;
}

/// Whether the hull of the points, spread sideways by lens and error, may meet the eye plane on
/// side +1 or -1, that is, the half-line from the eye to infinity. It does not if a line through
/// the eye separates them; such a line has the points in front of the eye on its one side, P / W
/// below its slope, and those behind above it. Points are taken w_error up and down, so that a hull
/// that just touches the eye counts as crossing on both sides.
bool crosses(const Points& points, double lens, int side) {
  double front = -INFINITY, behind = INFINITY;
  for (int i = 0; i < points.count; ++i) {
    const Point& p = points.at[i];
    const double reach = side * p.P + lens * std::abs(p.coc) + p.error;
    for (const double W : {p.W - points.w_error, p.W + points.w_error}) {
      if (W > 0) front = std::max(front, reach / W);
      if (W < 0) behind = std::min(behind, reach / W);
      if (W == 0 && reach >= 0) return true;
    }
  }
  return front >= behind;
}

/// Extremes, on side +1 or -1, of the points in front of the eye at the two lens corners.
void bound_side(const Points& points, const EyeView& view, int axis, int side, float (&bound)[2]) {
  const double origin = axis ? view.rect.y0 : view.rect.x0;
  const bool open = crosses(points, double(view.lens), side);
  for (int corner = 0; corner < 2; ++corner) {
    double most = open ? double(beyond_screen) : -double(beyond_screen);
    for (int i = 0; i < points.count && !open; ++i) {
      const Point& p = points.at[i];
      const double lens = (corner ? 1 : -1) * double(view.lens);
      if (p.W > 0)
        most = std::max(most, (side * (p.P + lens * p.coc) + p.error) / p.W - side * origin);
    }
    bound[corner] = float(side * std::min(most, double(beyond_screen)));
  }
}

/// Cuts [tau[0], tau[1]] to where the line from a (at 0) to b (at 1) is not negative.
void clip_to_positive(double a, double b, float (&tau)[2]) {
  if (a >= 0 && b >= 0) return;
  if (a < 0 && b < 0) {
    tau[0] = 2;
    return;
  }
  const auto root = float(a / (a - b));
  constexpr float slack = 0x1p-20f;
  if (a < 0)
    tau[0] = std::max(tau[0], root - slack);
  else
    tau[1] = std::min(tau[1], root + slack);
}

/// The bucket's sides are planes through the eye. A hit is on their inner sides, so some corner is.
void clip_to_sides(const Points& points, const EyeView& view, int axis, float (&tau)[2]) {
  const double edges[2] = {double(axis ? view.rect.y0 : view.rect.x0),
                           double(axis ? view.rect.y1 : view.rect.x1)};
  for (int edge = 0; edge < 2; ++edge) {
    const int inward = edge ? -1 : 1;
    double most[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < points.count; ++i) {
      const Point& p = points.at[i];
      const double inside =
          inward * (p.P - edges[edge] * p.W) + double(view.lens) * std::abs(p.coc) + p.error;
      most[i / 4] = std::max(most[i / 4], inside);
    }
    clip_to_positive(most[0], view.moves ? most[1] : most[0], tau);
  }
}

}  // namespace

EyeBox box_across_eye_plane(const Quad& quad, const EyeView& view) {
  EyeBox box;
  for (int axis = 0; axis < 2; ++axis) {
    const Points points = points_along(quad, view, axis);
    bound_side(points, view, axis, -1, box.low[axis]);
    bound_side(points, view, axis, 1, box.high[axis]);
    clip_to_sides(points, view, axis, box.tau);
  }
  return box;
}

}  // namespace tessera
