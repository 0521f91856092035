#include "hide/tct_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace tessera {
namespace {

/// A linear function of s.
struct Linear {
  double middle = 0, slope = 0;
  double size() const { return std::abs(middle) + 0.5 * std::abs(slope); }
};

Linear operator*(double factor, const Linear& f) { return {factor * f.middle, factor * f.slope}; }
Linear operator-(const Linear& f, const Linear& g) {
  return {f.middle - g.middle, f.slope - g.slope};
}

struct Corners {
  Linear X[4], Y[4], W[4], z[4], cx[4], cy[4];
};

Corners load_corners(const Quad& q, const CoverageFrame& f, bool moves, bool lens) {
  Corners c;
  const auto linear = [&](const float* start, const float* delta, int k) {
    const double slope = moves ? double(delta[k]) : 0.0;
    return Linear{double(start[k]) + 0.5 * slope, slope};
  };
  for (int k = 0; k < 4; ++k) {
    c.X[k] = linear(q.X, q.dX, k), c.Y[k] = linear(q.Y, q.dY, k);
    c.W[k] = linear(q.W, q.dW, k), c.z[k] = linear(q.z, q.dz, k);
    if (!lens) continue;
    const auto coc = [&](const AffineInZ& a) {
      return Linear{double(a.scale) * c.z[k].middle + double(a.offset),
                    double(a.scale) * c.z[k].slope};
    };
    c.cx[k] = coc(f.coc_x), c.cy[k] = coc(f.coc_y);
  }
  return c;
}

/// The whole pixel of [begin, end] nearest to where the corners are on average at s = 0; the middle
/// if one of them is not in front of the eye.
double reference(const Linear (&position)[4], const Linear (&W)[4], int begin, int end) {
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    if (!(W[k].middle > 0)) return std::floor(0.5 * (double(begin) + double(end)));
    sum += position[k].middle / W[k].middle;
  }
  return std::clamp(std::round(0.25 * sum), double(begin), double(end));
}

/// Largest |dx| (or |dy|) there can be, to within a small factor.
double row_size(const Linear (&position)[4], const Linear (&W)[4], const Linear (&coc)[4]) {
  double size = 0;
  for (int k = 0; k < 4; ++k)
    size = std::max({size, position[k].size(), W[k].size(), coc[k].size()});
  return size;
}

/// scale * (f_i g_j - f_j g_i).
void cross(const Linear (&f)[4], const Linear (&g)[4], int i, int j, double scale,
           float (&result)[3]) {
  result[0] = float(scale * (f[i].middle * g[j].middle - f[j].middle * g[i].middle));
  result[1] = float(scale * (f[i].middle * g[j].slope + f[i].slope * g[j].middle -
                             f[j].middle * g[i].slope - f[j].slope * g[i].middle));
  result[2] = float(scale * (f[i].slope * g[j].slope - f[j].slope * g[i].slope));
}

/// An order of corners by their own coordinates, so that two micropolygons agree on it.
float tie_of(const Quad& q, bool moves, int i, int j) {
  const auto key = [&](int k) {
    return moves ? std::tuple(q.X[k], q.Y[k], q.W[k], q.dX[k], q.dY[k], q.dW[k])
                 : std::tuple(q.X[k], q.Y[k], q.W[k], 0.0f, 0.0f, 0.0f);
  };
  const float tiny = std::numeric_limits<float>::min();
  return key(i) < key(j) ? tiny : key(j) < key(i) ? -tiny : 0.0f;
}

}  // namespace

TimeEdges set_up_time_edges(const Quad& quad, const CoverageFrame& frame, bool moves, bool lens,
                            const PixelRect& rect) {
  Corners c = load_corners(quad, frame, moves, lens);
  const double x = reference(c.X, c.W, rect.x0, rect.x1);
  const double y = reference(c.Y, c.W, rect.y0, rect.y1);
  for (int k = 0; k < 4; ++k) c.X[k] = c.X[k] - x * c.W[k], c.Y[k] = c.Y[k] - y * c.W[k];
  const double size = row_size(c.X, c.W, c.cx) * row_size(c.Y, c.W, c.cy);
  const double scale = size > 0 ? 1 / size : 0;

  TimeEdges edges;
  edges.x_reference = float(x), edges.y_reference = float(y);
  for (int k = 0; k < 4; ++k) edges.z[k] = float(c.z[k].middle), edges.dz[k] = float(c.z[k].slope);
  constexpr int a = 0, b = 1, cc = 2, d = 3;
  constexpr int ends[TimeEdges::edge_count][2] = {{a, b}, {b, d}, {d, a}, {d, cc}, {cc, a}};
  for (int e = 0; e < TimeEdges::edge_count; ++e) {
    const auto [i, j] = ends[e];
    auto& to = edges.coefficient[e];
    cross(c.X, c.Y, i, j, scale, to[TimeEdges::K]);
    cross(c.X, c.W, i, j, scale, to[TimeEdges::S]);
    cross(c.W, c.Y, i, j, scale, to[TimeEdges::U]);
    edges.tie[e] = tie_of(quad, moves, i, j);
    if (!lens) continue;
    cross(c.X, c.cy, i, j, scale, to[TimeEdges::P]);
    cross(c.cx, c.Y, i, j, scale, to[TimeEdges::Q]);
    cross(c.cx, c.W, i, j, scale, to[TimeEdges::T]);
    cross(c.W, c.cy, i, j, scale, to[TimeEdges::V]);
  }
  return edges;
}

}  // namespace tessera
