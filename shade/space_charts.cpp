#include "shade/space_charts.h"

#include <algorithm>
#include <array>

namespace tessera {
namespace {

constexpr int block_size = 8;  // micropolygons
constexpr uint32_t no_chart = ~0u;

/// Twice the signed areas of the triangles of micropolygon (i, j).
std::array<float, 2> areas(const SpaceVertices& s, int i, int j) {
  const int row = s.u_count + 1, a = j * row + i;
  const size_t A = size_t(a), B = size_t(a + 1), C = size_t(a + row), D = size_t(a + row + 1);
  const float dx = s.x[D] - s.x[A], dy = s.y[D] - s.y[A];
  return {(s.x[B] - s.x[A]) * dy - (s.y[B] - s.y[A]) * dx,
          dx * (s.y[C] - s.y[A]) - dy * (s.x[C] - s.x[A])};
}

/// [triangle] 1 or -1: which way it turns; those without area turn like most.
std::vector<int8_t> orientations(const SpaceVertices& s) {
  std::vector<int8_t> turn(size_t(s.triangle_count()));
  int sum = 0;
  size_t triangle = 0;
  for (int j = 0; j < s.v_count; ++j) {
    for (int i = 0; i < s.u_count; ++i) {
      for (const float area : areas(s, i, j)) {
        const int sign = (area > 0.0f) - (area < 0.0f);
        turn[triangle++] = int8_t(sign);
        sum += sign;
      }
    }
  }
  std::ranges::replace(turn, int8_t(0), int8_t(sum >= 0 ? 1 : -1));
  return turn;
}

/// Whether edges along one parameter point more than 90 degrees away from their mean somewhere.
bool winds(const SpaceVertices& s, int step, int columns, int rows) {
  const int row = s.u_count + 1;
  const auto for_edges = [&](const auto& visit) {
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        const size_t p = size_t(j * row + i), q = p + size_t(step);
        visit(s.x[q] - s.x[p], s.y[q] - s.y[p]);
      }
    }
  };
  float x = 0, y = 0;
  for_edges([&](float dx, float dy) { x += dx, y += dy; });
  float least = 0;
  for_edges([&](float dx, float dy) { least = std::min(least, dx * x + dy * y); });
  return least < 0;
}

/// Up to three triangles that share an edge with `triangle`.
std::array<int, 3> neighbours(const SpaceVertices& s, int triangle) {
  const int m = triangle / 2, i = m % s.u_count, j = m / s.u_count;
  if (triangle % 2 == 0) {
    return {triangle + 1, j > 0 ? 2 * (m - s.u_count) + 1 : -1,
            i + 1 < s.u_count ? 2 * (m + 1) + 1 : -1};
  }
  return {triangle - 1, j + 1 < s.v_count ? 2 * (m + s.u_count) : -1, i > 0 ? 2 * (m - 1) : -1};
}

int block_of(const SpaceVertices& s, int triangle) {
  const int m = triangle / 2, columns = (s.u_count + block_size - 1) / block_size;
  return m / s.u_count / block_size * columns + m % s.u_count / block_size;
}

}  // namespace

SpaceCharts::SpaceCharts(const SpaceVertices& s) {
  const std::vector<int8_t> turn = orientations(s);
  const bool folded = std::ranges::any_of(turn, [&](int8_t t) { return t != turn[0]; });
  const bool in_blocks =
      winds(s, 1, s.u_count, s.v_count + 1) || winds(s, s.u_count + 1, s.u_count + 1, s.v_count);
  if (!folded && !in_blocks) return;

  uint32_t count = 0;
  chart_.assign(turn.size(), no_chart);
  std::vector<int> open;
  for (int first = 0; first < s.triangle_count(); ++first) {
    if (chart_[size_t(first)] != no_chart) continue;
    const uint32_t chart = count++;
    chart_[size_t(first)] = chart;
    open.push_back(first);
    while (!open.empty()) {
      const int triangle = open.back();
      open.pop_back();
      for (const int next : neighbours(s, triangle)) {
        if (next < 0 || chart_[size_t(next)] != no_chart) continue;
        if (turn[size_t(next)] != turn[size_t(triangle)]) continue;
        if (in_blocks && block_of(s, next) != block_of(s, triangle)) continue;
        chart_[size_t(next)] = chart;
        open.push_back(next);
      }
    }
  }
}

}  // namespace tessera
