#include "hide/tct_bounds.h"

#include <algorithm>
#include <cmath>

#include "hide/depth_margin.h"

namespace tessera {
namespace {

/// Rounding of dx by the coverage test, relative to |X| + |u coc| + |x W|: docs/visibility.md
/// counts 15 roundings for hide/coverage.h, and edge functions about a reference point take fewer.
constexpr double rounding = 0x1p-18;

struct Point {
  double x, y;
};

/// A side of a box, from its lower to its higher y.
struct Side {
  Point low, high;

  double x_at(double y) const {
    if (y <= low.y) return low.x;
    if (y >= high.y) return high.x;
    const double x = low.x + (y - low.y) / (high.y - low.y) * (high.x - low.x);
    return std::clamp(x, std::min(low.x, high.x), std::max(low.x, high.x));
  }
};

/// Pixels of [0, size) that [min, max] touches.
void clamp_pixels(double min, double max, int size, int& first, int& end) {
  first = int(std::clamp(std::floor(min), 0.0, double(size)));
  end = int(std::clamp(std::floor(max) + 1, 0.0, double(size)));
}

}  // namespace

SweptQuad::SweptQuad(const Quad& q, const CoverageFrame& f, bool moves, const PixelRect& rect)
    : count_(moves ? 8 : 4), rect_(rect) {
  const double x_reach = std::max(std::abs(rect.x0), std::abs(rect.x1));
  const double y_reach = std::max(std::abs(rect.y0), std::abs(rect.y1));
  for (int n = 0; n < count_; ++n) {
    const int k = n % 4;
    const auto at = [&](const float* start, const float* delta) {
      return double(start[k]) + (n >= 4 ? double(delta[k]) : 0.0);
    };
    Corner& c = corners_[n];
    c.X = at(q.X, q.dX), c.Y = at(q.Y, q.dY), c.W = at(q.W, q.dW), c.z = at(q.z, q.dz);
    const auto coc = [&](const AffineInZ& a) { return double(a.scale) * c.z + double(a.offset); };
    const auto coc_size = [&](const AffineInZ& a) {
      return std::abs(double(a.scale) * c.z) + std::abs(double(a.offset));
    };
    c.cx = coc(f.coc_x), c.cy = coc(f.coc_y);
    c.x_error = rounding * (std::abs(c.X) + coc_size(f.coc_x) + x_reach * std::abs(c.W));
    c.y_error = rounding * (std::abs(c.Y) + coc_size(f.coc_y) + y_reach * std::abs(c.W));
    in_front_ &= c.W > 0;
  }
  // At a time in between, the size that the error is relative to is at most that of an end.
  for (int n = 4; n < count_; ++n) {
    Corner &begin = corners_[n - 4], &end = corners_[n];
    begin.x_error = end.x_error = std::max(begin.x_error, end.x_error);
    begin.y_error = end.y_error = std::max(begin.y_error, end.y_error);
  }
}

bool SweptQuad::is_clipped(const CoverageFrame& frame) const {
  bool before = true, behind = true;
  for (const Corner& c : corners()) {
    const double error = double(depth_margin) * std::abs(c.z);
    before &= c.z + error < double(frame.near_clip);
    behind &= c.z - error > double(frame.far_clip);
  }
  return before || behind;
}

/// The sides are planes through the eye, and linear motion between two points beyond one of them
/// stays beyond it.
bool SweptQuad::beyond_a_side(const LensRegion& r) const {
  bool left = true, right = true, above = true, below = true;
  for (const Corner& c : corners()) {
    const double x_slack = (std::abs(r.u) + r.box) * std::abs(c.cx) + c.x_error;
    const double y_slack = (std::abs(r.v) + r.box) * std::abs(c.cy) + c.y_error;
    left &= c.X + x_slack<rect_.x0 * c.W, right &= c.X - x_slack> rect_.x1 * c.W;
    above &= c.Y + y_slack<rect_.y0 * c.W, below &= c.Y - y_slack> rect_.y1 * c.W;
  }
  return left || right || above || below;
}

SweptQuad::Box SweptQuad::box_along(double axis_x, double axis_y, const LensRegion& r) const {
  Box box{axis_x, axis_y, {INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
  const auto add = [](const Corner& c, double nx, double ny, const LensRegion& lens,
                      double(&range)[2]) {
    const double at = (nx * c.X + ny * c.Y) / c.W;
    const double line = std::abs(nx * lens.u * c.cx + ny * lens.v * c.cy);
    const double x_reach = lens.box * std::abs(c.cx) + c.x_error;
    const double y_reach = lens.box * std::abs(c.cy) + c.y_error;
    const double reach = (line + std::abs(nx) * x_reach + std::abs(ny) * y_reach) / c.W;
    range[0] = std::min(range[0], at - reach), range[1] = std::max(range[1], at + reach);
  };
  for (const Corner& c : corners()) {
    add(c, axis_x, axis_y, r, box.along);
    add(c, -axis_y, axis_x, r, box.across);
  }
  // No farther than the bucket: a corner near the eye may be 1e40 pixels away, and what is added to
  // that is lost.
  const auto cut = [&](double nx, double ny, double(&range)[2]) {
    const double middle = 0.5 * (nx * (rect_.x0 + rect_.x1) + ny * (rect_.y0 + rect_.y1));
    const double half = 1 + 0.5 * (std::abs(nx) * rect_.width() + std::abs(ny) * rect_.height());
    range[0] = std::max(range[0], middle - half), range[1] = std::min(range[1], middle + half);
  };
  cut(axis_x, axis_y, box.along), cut(-axis_y, axis_x, box.across);
  return box;
}

SweptQuad::Box SweptQuad::smallest_box(const LensRegion& r) const {
  double motion_x = 0, motion_y = 0, lens_x = 0, lens_y = 0;
  for (int n = 0; n < count_; ++n) {
    const Corner& c = corners_[n];
    const double sign = n < 4 ? -1 : 1;
    motion_x += sign * c.X / c.W, motion_y += sign * c.Y / c.W;
    const double side = c.cx < 0 ? -1 : 1;  // in front of the focus or behind: the same line
    lens_x += side * r.u * c.cx / c.W, lens_y += side * r.v * c.cy / c.W;
  }
  const double lens = std::hypot(lens_x, lens_y);
  Box best = lens > 0 ? box_along(lens_x / lens, lens_y / lens, r) : box_along(1, 0, r);
  const double motion = std::hypot(motion_x, motion_y);
  if (best.empty() || count_ == 4 || !(motion > 0)) return best;
  const Box moving = box_along(motion_x / motion, motion_y / motion, r);
  return moving.empty() || moving.area() < best.area() ? moving : best;
}

void SweptQuad::rasterise(const Box& box, std::vector<PixelSpan>& spans) const {
  if (box.empty()) return;
  const auto corner = [&](double along, double across) {
    return Point{along * box.axis_x - across * box.axis_y - rect_.x0,
                 along * box.axis_y + across * box.axis_x - rect_.y0};
  };
  const Point p[4] = {corner(box.along[0], box.across[0]), corner(box.along[1], box.across[0]),
                      corner(box.along[1], box.across[1]), corner(box.along[0], box.across[1])};
  Side sides[4];
  double y_min = INFINITY, y_max = -INFINITY;
  for (int k = 0; k < 4; ++k) {
    const Point &from = p[k], &to = p[(k + 1) % 4];
    sides[k] = from.y <= to.y ? Side{from, to} : Side{to, from};
    y_min = std::min(y_min, from.y), y_max = std::max(y_max, from.y);
  }
  int row_begin, row_end;
  clamp_pixels(y_min, y_max, rect_.height(), row_begin, row_end);
  for (int row = row_begin; row < row_end; ++row) {
    double x_min = INFINITY, x_max = -INFINITY;
    for (const Side& side : sides) {
      if (side.high.y < row || side.low.y > row + 1) continue;
      const double x0 = side.x_at(row), x1 = side.x_at(row + 1);
      x_min = std::min({x_min, x0, x1}), x_max = std::max({x_max, x0, x1});
    }
    PixelSpan span{row, 0, 0};
    clamp_pixels(x_min, x_max, rect_.width(), span.x0, span.x1);
    if (span.x0 < span.x1) spans.push_back(span);
  }
}

void SweptQuad::find_spans(const LensRegion& region, std::vector<PixelSpan>& spans) const {
  spans.clear();
  if (in_front_) {
    rasterise(smallest_box(region), spans);
  } else if (!beyond_a_side(region)) {
    for (int y = 0; y < rect_.height(); ++y) spans.push_back({y, 0, rect_.width()});
  }
}

}  // namespace tessera
