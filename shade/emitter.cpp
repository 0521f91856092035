#include "shade/emitter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "shade/fragment_geometry.h"
#include "shade/mathematics.h"

namespace tessera {
namespace {

using Corners = std::array<glm::vec3, 3>;
using Frame = std::array<glm::dvec3, 3>;

/// A triangle's corners at a shutter time, straight between the keys.
Corners corners_at(const Grid& grid, uint32_t triangle, float time) {
  const KeyBlend at(grid, time);
  const std::array<int, 3> vertices = grid.triangle_corners(triangle);
  Corners corners;
  for (size_t c = 0; c < 3; ++c) corners[c] = vertex_camera(grid, vertices[c], at);
  return corners;
}

/// Twice the area, in double: sides of 1e-20 and 1e20 do not under- or overflow.
glm::dvec3 doubled_area(const Corners& p) {
  return glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[2]) - glm::dvec3(p[0]));
}

/// Along the Hilbert curve over a square of `side` x `side` cells, side a power of two. The curve
/// of the whole is four of half the size, of which the first and last are turned.
uint32_t place_on_hilbert_curve(uint32_t side, uint32_t x, uint32_t y) {
  uint32_t place = 0;
  for (uint32_t s = side / 2; s > 0; s /= 2) {
    const bool right = (x & s) != 0, upper = (y & s) != 0;
    place += s * s * (right ? (upper ? 2u : 3u) : (upper ? 1u : 0u));
    if (upper) continue;
    if (right) x = ~x, y = ~y;
    std::swap(x, y);
  }
  return place;
}

std::vector<uint32_t> micropolygons_along_curve(const Grid& grid) {
  const auto columns = uint32_t(grid.u_count), rows = uint32_t(grid.v_count);
  const uint32_t side = std::bit_ceil(std::max(columns, rows));
  std::vector<std::pair<uint32_t, uint32_t>> order;  // (place, micropolygon)
  for (uint32_t m = 0; m < columns * rows; ++m) {
    order.emplace_back(place_on_hilbert_curve(side, m % columns, m / columns), m);
  }
  std::ranges::sort(order);
  std::vector<uint32_t> result;
  for (const auto& [place, m] : order) result.push_back(m);
  return result;
}

/// The square onto the triangle with corners 0, x and y, area kept and less bent than by a square
/// root (E. Heitz, "A low-distortion map between triangle and square", 2019).
glm::vec2 triangle_from_square(glm::vec2 xi) {
  if (xi.y > xi.x) {
    xi.x *= 0.5f, xi.y -= xi.x;
  } else {
    xi.y *= 0.5f, xi.x -= xi.y;
  }
  return xi;
}

/// An edge, what is across it in the triangle, and the normal: natural axes of most flat shapes.
Frame frame_of(const Corners& p) {
  const glm::dvec3 normal = glm::normalize(doubled_area(p));
  const glm::dvec3 edge = glm::normalize(glm::dvec3(p[1]) - glm::dvec3(p[0]));
  return {edge, glm::cross(normal, edge), normal};
}

}  // namespace

Emitter::Emitter(std::vector<std::shared_ptr<const Grid>> grids) : grids_(std::move(grids)) {
  for (uint32_t g = 0; g < grids_.size(); ++g) {
    for (const uint32_t m : micropolygons_along_curve(*grids_[g])) {
      add_triangle(g, 2 * m), add_triangle(g, 2 * m + 1);
    }
  }
  if (!empty()) measure();
}

bool Emitter::moves() const {
  return std::ranges::any_of(grids_, [](const auto& grid) { return grid->key_count() > 1; });
}

void Emitter::add_triangle(uint32_t grid, uint32_t triangle) {
  const double area = 0.5 * glm::length(doubled_area(corners_at(*grids_[grid], triangle, 0.0f)));
  if (!(area > 0.0) || !std::isfinite(area)) return;
  triangles_.push_back({grid, triangle});
  area_up_to_.push_back(area + (area_up_to_.empty() ? 0.0 : area_up_to_.back()));
}

Corners Emitter::corners(size_t triangle, float time) const {
  const Triangle& of = triangles_[triangle];
  return corners_at(*grids_[of.grid], of.triangle, time);
}

glm::dvec3 Emitter::centroid() const {
  glm::dvec3 moment(0.0);
  double before = 0.0;
  for (size_t k = 0; k < triangles_.size(); ++k) {
    const Corners p = corners(k, 0.0f);
    moment +=
        (area_up_to_[k] - before) / 3.0 * (glm::dvec3(p[0]) + glm::dvec3(p[1]) + glm::dvec3(p[2]));
    before = area_up_to_[k];
  }
  return moment / before;
}

glm::dvec3 Emitter::reach(const glm::dvec3& centre, const Frame& frame) const {
  glm::dvec3 reach(0.0);
  for (size_t k = 0; k < triangles_.size(); ++k) {
    for (const glm::vec3& p : corners(k, 0.0f)) {
      const glm::dvec3 offset = glm::dvec3(p) - centre;
      for (int a = 0; a < 3; ++a) {
        reach[a] = std::max(reach[a], std::abs(glm::dot(offset, frame[size_t(a)])));
      }
    }
  }
  return reach;
}

void Emitter::measure() {
  const glm::dvec3 centre = centroid();
  extent_.centre = glm::vec3(centre);
  extent_.area_root = float(std::sqrt(area_up_to_.back()));
  double least = std::numeric_limits<double>::infinity();
  const Frame of_camera{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
  for (const Frame& frame : {frame_of(corners(0, 0.0f)), of_camera}) {
    const glm::dvec3 r = reach(centre, frame);
    const double surface = r.x * r.y + r.y * r.z + r.z * r.x;
    if (!(surface < least)) continue;
    least = surface;
    for (int a = 0; a < 3; ++a) extent_.half_axes[size_t(a)] = glm::vec3(r[a] * frame[size_t(a)]);
  }
}

LightPlace Emitter::place(glm::vec2 xi, float time) const {
  const double wanted = double(xi.x) * area_up_to_.back();
  const auto found = std::ranges::upper_bound(area_up_to_, wanted);
  const size_t k = std::min(size_t(found - area_up_to_.begin()), triangles_.size() - 1);
  const double before = k > 0 ? area_up_to_[k - 1] : 0.0;
  const double within = (wanted - before) / (area_up_to_[k] - before);
  const Corners p = corners(k, time);
  const glm::vec2 at = triangle_from_square({std::clamp(float(within), 0.0f, 1.0f), xi.y});
  const glm::dvec3 normal = double(grids_[triangles_[k].grid]->normal_sign) * doubled_area(p);
  const double length = glm::length(normal);
  return {p[0] + at.x * (p[1] - p[0]) + at.y * (p[2] - p[0]),
          length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f)};
}

void make_emitter(std::span<const std::shared_ptr<const Grid>> grids, int index,
                  BoundLight& light) {
  std::vector<std::shared_ptr<const Grid>> own;
  for (const std::shared_ptr<const Grid>& grid : grids) {
    if (grid->attributes().area_light == index) own.push_back(grid);
  }
  const auto emitter = std::make_shared<Emitter>(std::move(own));
  if (emitter->empty()) {
    throw Error(light.where, fmt::format("light \"{}\" can never shine: its surfaces have no area",
                                         light.definition->name));
  }
  light.extent = emitter->extent();
  light.emitter = emitter;
}

}  // namespace tessera
