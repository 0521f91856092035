#include "shade/space_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera {
namespace {

struct Corner {
  float x, y, w;  // x, y relative to the point looked for
};

struct Corners {
  Corner A, B, C;
};

Corners corners_about(const SpaceVertices& s, uint32_t triangle, float x, float y) {
  const int m = int(triangle / 2), row = s.u_count + 1;
  const int a = m / s.u_count * row + m % s.u_count;
  const auto corner = [&](int i) {
    return Corner{s.x[size_t(i)] - x, s.y[size_t(i)] - y, s.w[size_t(i)]};
  };
  const Corner A = corner(a), D = corner(a + row + 1);
  return triangle % 2 == 0 ? Corners{A, corner(a + 1), D} : Corners{A, D, corner(a + row)};
}

float cross(const Corner& p, const Corner& q) { return p.x * q.y - p.y * q.x; }

/// From weights in the plane to weights on the surface: those of Vertex / W, which the plane
/// interpolates, back to those of the vertices.
SurfacePoint on_surface(uint32_t triangle, const Corners& c, float a, float b, float d) {
  const float wa = a / c.A.w, wb = b / c.B.w, wc = d / c.C.w;
  const float sum = wa + wb + wc;
  return {triangle, wb / sum, wc / sum};
}

/// The place on the segment from p to q nearest to the origin.
struct OnSegment {
  float share, distance2;
};

OnSegment nearest_on_segment(const Corner& p, const Corner& q) {
  const float dx = q.x - p.x, dy = q.y - p.y, length2 = dx * dx + dy * dy;
  const float share =
      length2 > 0.0f ? std::clamp(-(p.x * dx + p.y * dy) / length2, 0.0f, 1.0f) : 0.0f;
  const float x = p.x + share * dx, y = p.y + share * dy;
  return {share, x * x + y * y};
}

}  // namespace

struct SpaceIndex::Best {
  SurfacePoint point;
  float distance2 = std::numeric_limits<float>::infinity();
};

SpaceIndex::SpaceIndex(const SpaceVertices& vertices, const SpaceCharts& charts)
    : vertices_(vertices), charts_(charts) {
  const size_t count = size_t((vertices.u_count + 1) * (vertices.v_count + 1));
  const auto [x0, x1] = std::minmax_element(vertices.x.begin(), vertices.x.begin() + long(count));
  const auto [y0, y1] = std::minmax_element(vertices.y.begin(), vertices.y.begin() + long(count));
  x0_ = *x0, x1_ = *x1, y0_ = *y0, y1_ = *y1;
  choose_bins();
  while (!fill_bins()) columns_ = (columns_ + 1) / 2, rows_ = (rows_ + 1) / 2;
}

/// About one bin a micropolygon, as square as can be.
void SpaceIndex::choose_bins() {
  const float width = x1_ - x0_, height = y1_ - y0_;
  const float count = float(vertices_.u_count) * float(vertices_.v_count);
  const float columns = height > 0.0f ? std::sqrt(count * width / height) : count;
  columns_ = int(std::clamp(columns, 1.0f, std::max(1.0f, 2.0f * float(vertices_.u_count))));
  rows_ = std::max(1, int(std::min(count / float(columns_), 2.0f * float(vertices_.v_count))));
}

int SpaceIndex::column_of(float x) const {
  return int(std::clamp((x - x0_) * columns_per_x_, 0.0f, float(columns_ - 1)));
}
int SpaceIndex::row_of(float y) const {
  return int(std::clamp((y - y0_) * rows_per_y_, 0.0f, float(rows_ - 1)));
}

std::span<const uint32_t> SpaceIndex::bin(int column, int row) const {
  const size_t b = size_t(row) * size_t(columns_) + size_t(column);
  return {micropolygons_.data() + first_[b], first_[b + 1] - first_[b]};
}

/// False, with nothing done, if micropolygons would lie in too many bins each.
bool SpaceIndex::fill_bins() {
  columns_per_x_ = x1_ > x0_ ? float(columns_) / (x1_ - x0_) : 0.0f;
  rows_per_y_ = y1_ > y0_ ? float(rows_) / (y1_ - y0_) : 0.0f;
  const SpaceVertices& s = vertices_;
  const auto for_bins = [&](const auto& visit) {
    uint32_t m = 0;
    for (int j = 0; j < s.v_count; ++j) {
      for (int i = 0; i < s.u_count; ++i, ++m) {
        const size_t a = size_t(j * (s.u_count + 1) + i), c = a + size_t(s.u_count) + 1;
        const auto [low_x, high_x] = std::minmax({s.x[a], s.x[a + 1], s.x[c], s.x[c + 1]});
        const auto [low_y, high_y] = std::minmax({s.y[a], s.y[a + 1], s.y[c], s.y[c + 1]});
        const int column0 = column_of(low_x), column1 = column_of(high_x);
        const int row0 = row_of(low_y), row1 = row_of(high_y);
        for (int row = row0; row <= row1; ++row)
          for (int column = column0; column <= column1; ++column)
            visit(size_t(row) * size_t(columns_) + size_t(column), m);
      }
    }
  };
  first_.assign(size_t(columns_) * size_t(rows_) + 1, 0);
  size_t entries = 0;
  for_bins([&](size_t b, uint32_t) { ++first_[b + 1], ++entries; });
  const size_t most = 16 * (size_t(s.u_count) * size_t(s.v_count) + 1);
  if (entries > most && columns_ * rows_ > 1) return false;
  for (size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  micropolygons_.resize(entries);
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for_bins([&](size_t b, uint32_t m) { micropolygons_[next[b]++] = m; });
  return true;
}

/// Whether the triangle lies over (x, y), and where.
bool SpaceIndex::covers(uint32_t triangle, float x, float y, SurfacePoint& point) const {
  const Corners c = corners_about(vertices_, triangle, x, y);
  const float bc = cross(c.B, c.C), ca = cross(c.C, c.A), ab = cross(c.A, c.B);
  const float area = bc + ca + ab;
  const bool inside =
      area > 0.0f ? std::min({bc, ca, ab}) >= 0.0f : area < 0.0f && std::max({bc, ca, ab}) <= 0.0f;
  if (inside) point = on_surface(triangle, c, bc / area, ca / area, ab / area);
  return inside;
}

void SpaceIndex::consider_edges(uint32_t triangle, float x, float y, Best& best) const {
  const Corners c = corners_about(vertices_, triangle, x, y);
  const OnSegment on_ab = nearest_on_segment(c.A, c.B), on_bc = nearest_on_segment(c.B, c.C),
                  on_ca = nearest_on_segment(c.C, c.A);
  const float least = std::min({on_ab.distance2, on_bc.distance2, on_ca.distance2});
  if (!(least < best.distance2)) return;
  best.distance2 = least;
  if (least == on_ab.distance2) {
    best.point = on_surface(triangle, c, 1 - on_ab.share, on_ab.share, 0);
  } else if (least == on_bc.distance2) {
    best.point = on_surface(triangle, c, 0, 1 - on_bc.share, on_bc.share);
  } else {
    best.point = on_surface(triangle, c, on_ca.share, 0, 1 - on_ca.share);
  }
}

SurfacePoint SpaceIndex::nearest(uint32_t chart, float x, float y, float reach) const {
  SurfacePoint point;
  for (const uint32_t m : bin(column_of(x), row_of(y)))
    for (const uint32_t triangle : {2 * m, 2 * m + 1})
      if (charts_.of(triangle) == chart && covers(triangle, x, y, point)) return point;
  Best best;
  const auto consider = [&](uint32_t m) {
    for (const uint32_t triangle : {2 * m, 2 * m + 1})
      if (charts_.of(triangle) == chart) consider_edges(triangle, x, y, best);
  };
  for (int row = row_of(y - reach); row <= row_of(y + reach); ++row)
    for (int column = column_of(x - reach); column <= column_of(x + reach); ++column)
      for (const uint32_t m : bin(column, row)) consider(m);
  if (best.distance2 < std::numeric_limits<float>::infinity()) return best.point;
  // Rounding put a sample into a cell that its sheet only just misses.
  for (int m = 0; m < vertices_.u_count * vertices_.v_count; ++m) consider(uint32_t(m));
  return best.point;
}

}  // namespace tessera
