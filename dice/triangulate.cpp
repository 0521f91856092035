#include "dice/triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera {

namespace {

using Point = glm::dvec2;

double cross(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Coordinates in a plane such that `normal` looks at the viewer: drops the largest axis.
std::vector<Point> projected(std::span<const glm::dvec3> points, const glm::dvec3& normal) {
  int axis = 0;
  for (int a = 1; a < 3; ++a) {
    if (std::abs(normal[a]) > std::abs(normal[axis])) axis = a;
  }
  int x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(x, y);
  std::vector<Point> flat;
  for (const glm::dvec3& p : points) flat.emplace_back(p[x], p[y]);
  return flat;
}

double signed_area(std::span<const Point> flat, std::span<const int> loop) {
  double sum = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Point &a = flat[size_t(loop[i])], &b = flat[size_t(loop[(i + 1) % loop.size()])];
    sum += a.x * b.y - b.x * a.y;
  }
  return sum;
}

// Whether segments p-q and a-b cross at a point inside both.
bool properly_cross(Point p, Point q, Point a, Point b) {
  return cross(p, q, a) * cross(p, q, b) < 0 && cross(a, b, p) * cross(a, b, q) < 0;
}

// Whether a diagonal from the vertex between `before` and `after` to `target` starts inside.
bool within_corner(Point before, Point corner, Point after, Point target) {
  const bool left_in = cross(before, corner, target) > 0,
             left_out = cross(corner, after, target) > 0;
  return cross(before, corner, after) >= 0 ? left_in && left_out : left_in || left_out;
}

// Splices `hole` into `outer` by the shortest bridge that crosses nothing; by the shortest of all
// if every bridge crosses something (loops that intersect).
void bridge(std::span<const Point> flat, std::vector<int>& outer, const std::vector<int>& hole,
            std::span<const std::vector<int>> obstacles) {
  const auto at = [&](int index) { return flat[size_t(index)]; };
  const auto crosses = [&](Point p, Point q, const std::vector<int>& loop) {
    for (size_t i = 0; i < loop.size(); ++i) {
      if (properly_cross(p, q, at(loop[i]), at(loop[(i + 1) % loop.size()]))) return true;
    }
    return false;
  };
  // The hole's rightmost vertex always sees the outer loop.
  size_t from = 0;
  for (size_t i = 1; i < hole.size(); ++i) {
    if (at(hole[i]).x > at(hole[from]).x) from = i;
  }
  const Point p = at(hole[from]);
  size_t best = 0;
  double best_cost = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < outer.size(); ++i) {
    const Point q = at(outer[i]);
    const Point before = at(outer[(i + outer.size() - 1) % outer.size()]);
    const Point after = at(outer[(i + 1) % outer.size()]);
    double cost = glm::dot(q - p, q - p);
    const bool dearer = cost >= best_cost;
    if (dearer) continue;
    bool blocked =
        !within_corner(before, q, after, p) || crosses(p, q, outer) || crosses(p, q, hole);
    for (const std::vector<int>& other : obstacles) blocked = blocked || crosses(p, q, other);
    if (blocked) cost += 1e200;
    if (cost < best_cost) best_cost = cost, best = i;
  }
  std::vector<int> joined(outer.begin(), outer.begin() + long(best) + 1);
  for (size_t i = 0; i <= hole.size(); ++i) joined.push_back(hole[(from + i) % hole.size()]);
  joined.insert(joined.end(), outer.begin() + long(best), outer.end());
  outer = std::move(joined);
}

// Whether cutting off corner i of the loop leaves every other vertex outside the triangle.
bool is_ear(std::span<const Point> flat, const std::vector<int>& loop, size_t i) {
  const size_t n = loop.size();
  const Point a = flat[size_t(loop[(i + n - 1) % n])], b = flat[size_t(loop[i])];
  const Point c = flat[size_t(loop[(i + 1) % n])];
  if (!(cross(a, b, c) > 0)) return false;
  for (size_t k = 0; k < n; ++k) {
    const Point p = flat[size_t(loop[k])];
    if (p == a || p == b || p == c) continue;
    if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
  }
  return true;
}

// The next corner to cut: an ear; failing that one of no area; failing that (a loop that crosses
// itself) the convex corner of least area, so that clipping always ends.
size_t next_corner(std::span<const Point> flat, const std::vector<int>& loop, size_t start) {
  const size_t n = loop.size();
  for (size_t k = 0; k < n; ++k) {
    if (is_ear(flat, loop, (start + k) % n)) return (start + k) % n;
  }
  size_t best = start % n;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < n; ++i) {
    const double area = cross(flat[size_t(loop[(i + n - 1) % n])], flat[size_t(loop[i])],
                              flat[size_t(loop[(i + 1) % n])]);
    const double cost = area >= 0 ? area : -area * 1e6;
    if (cost < least) least = cost, best = i;
  }
  return best;
}

}  // namespace

glm::dvec3 area_vector(std::span<const glm::dvec3> points, std::span<const int> loop) {
  glm::dvec3 sum(0);
  // Relative to the first vertex: polygons are small and may be far from the origin.
  const glm::dvec3 origin = loop.empty() ? glm::dvec3(0) : points[size_t(loop[0])];
  for (size_t i = 0; i < loop.size(); ++i) {
    sum += glm::cross(points[size_t(loop[i])] - origin,
                      points[size_t(loop[(i + 1) % loop.size()])] - origin);
  }
  return sum;
}

bool is_convex_quad(std::span<const glm::dvec3> points, std::span<const int> loop) {
  if (loop.size() != 4) return false;
  const glm::dvec3 normal = area_vector(points, loop);
  for (size_t i = 0; i < 4; ++i) {
    const glm::dvec3 a = points[size_t(loop[i])], b = points[size_t(loop[(i + 1) % 4])];
    const glm::dvec3 c = points[size_t(loop[(i + 2) % 4])];
    if (!(glm::dot(glm::cross(b - a, c - b), normal) > 0)) return false;
  }
  return true;
}

std::vector<std::array<int, 3>> triangulate(std::span<const glm::dvec3> points,
                                            const std::vector<std::vector<int>>& loops) {
  std::vector<std::array<int, 3>> triangles;
  if (loops.empty() || loops[0].size() < 3) return triangles;
  const std::vector<Point> flat = projected(points, area_vector(points, loops[0]));
  std::vector<int> loop = loops[0];

  std::vector<std::vector<int>> holes(loops.begin() + 1, loops.end());
  std::erase_if(holes, [](const std::vector<int>& hole) { return hole.size() < 3; });
  const auto rightmost = [&](const std::vector<int>& hole) {
    double x = -std::numeric_limits<double>::infinity();
    for (int i : hole) x = std::max(x, flat[size_t(i)].x);
    return x;
  };
  std::stable_sort(holes.begin(), holes.end(),
                   [&](const auto& a, const auto& b) { return rightmost(a) > rightmost(b); });
  for (size_t h = 0; h < holes.size(); ++h) {
    if (signed_area(flat, holes[h]) > 0) std::reverse(holes[h].begin(), holes[h].end());
    bridge(flat, loop, holes[h], std::span(holes).subspan(h + 1));
  }

  size_t at = 0;
  while (loop.size() > 3) {
    const size_t n = loop.size(), i = next_corner(flat, loop, at);
    triangles.push_back({loop[(i + n - 1) % n], loop[i], loop[(i + 1) % n]});
    loop.erase(loop.begin() + long(i));
    // Going on two corners further makes better shapes than a fan.
    at = (i + 1) % loop.size();
  }
  triangles.push_back({loop[0], loop[1], loop[2]});
  return triangles;
}

}  // namespace tessera
