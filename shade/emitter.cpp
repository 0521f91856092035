#include "shade/emitter.h"

#include <algorithm>
#include <cmath>

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

/// The part that holds a share in [0, 1) of the area of parts [first, end), and the share of its
/// own area that is up to there. area_before(k): of all parts before k.
struct Found {
  size_t part;
  double share;
};
template <class Area>
Found find_share(size_t first, size_t end, double share, const Area& area_before) {
  const double from = area_before(first), wanted = from + share * (area_before(end) - from);
  size_t part = first;
  for (size_t count = end - first; count > 1;) {
    const size_t half = count / 2;
    const bool later = area_before(part + half) <= wanted;
    part += later ? half : 0, count = later ? count - half : half;
  }
  const double before = area_before(part), own = area_before(part + 1) - before;
  return {part, std::clamp((wanted - before) / own, 0.0, 1.0)};
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

/// An edge, what is across it in the plane, and the normal: natural axes of most flat shapes.
Frame frame_of(const Corners& p) {
  const glm::dvec3 normal = glm::normalize(doubled_area(p));
  const glm::dvec3 edge = glm::normalize(glm::dvec3(p[1]) - glm::dvec3(p[0]));
  return {edge, glm::cross(normal, edge), normal};
}

/// Whether a grid of one micropolygon, which is how flat surfaces are diced, is a parallelogram at
/// every key, but for rounding. Straight ways between keys keep it one. Pieces of curved surfaces
/// are none: far from the eye rounding hides how their sides differ.
bool is_parallelogram(const Grid& grid) {
  if (grid.micropolygon_count() != 1) return false;
  constexpr float rounding = 1e-6f;
  for (const float time : grid.key_times) {
    const Corners abd = corners_at(grid, 0, time);
    const glm::vec3 c = corners_at(grid, 1, time)[2];
    const glm::vec3 a = abd[0], b = abd[1], d = abd[2];
    const float size = glm::length(b - a) + glm::length(d - b) + glm::length(a);
    if (!(glm::length((a - b) + (d - c)) <= rounding * size)) return false;
  }
  return true;
}

}  // namespace

Emitter::Emitter(std::vector<std::shared_ptr<const Grid>> grids) : grids_(std::move(grids)) {
  for (uint32_t g = 0; g < grids_.size(); ++g) add_grid(g);
  if (!empty()) measure();
}

void Emitter::add_grid(uint32_t grid) {
  const auto columns = uint32_t(grids_[grid]->u_count), rows = uint32_t(grids_[grid]->v_count);
  const size_t first_row = row_ends_.size();
  for (uint32_t row = 0; row < rows; ++row) {
    const size_t first_piece = pieces_.size();
    for (uint32_t k = 0; k < columns; ++k) add_micropolygon(grid, row * columns + k);
    if (pieces_.size() > first_piece) row_ends_.push_back(pieces_.size());
  }
  if (row_ends_.size() > first_row) grid_ends_.push_back(row_ends_.size());
}

bool Emitter::moves() const {
  return std::ranges::any_of(grids_, [](const auto& grid) { return grid->key_count() > 1; });
}

void Emitter::add_micropolygon(uint32_t grid, uint32_t micropolygon) {
  const bool whole = is_parallelogram(*grids_[grid]);
  add({grid, 2 * micropolygon, whole});
  if (!whole) add({grid, 2 * micropolygon + 1, false});
}

void Emitter::add(const Piece& piece) {
  const double share = piece.parallelogram ? 1.0 : 0.5;
  const double area = share * glm::length(doubled_area(corners(piece, 0.0f)));
  if (!(area > 0.0) || !std::isfinite(area)) return;
  pieces_.push_back(piece);
  area_up_to_.push_back(area + (area_up_to_.empty() ? 0.0 : area_up_to_.back()));
}

Corners Emitter::corners(const Piece& piece, float time) const {
  const Corners p = corners_at(*grids_[piece.grid], piece.triangle, time);
  if (!piece.parallelogram) return p;
  return {p[0], p[1], p[0] + (p[2] - p[1])};
}

glm::dvec3 Emitter::centroid() const {
  glm::dvec3 moment(0.0);
  double before = 0.0;
  for (size_t k = 0; k < pieces_.size(); ++k) {
    const Corners p = corners(pieces_[k], 0.0f);
    const glm::dvec3 a(p[0]), b(p[1]), c(p[2]);
    const glm::dvec3 centre = pieces_[k].parallelogram ? 0.5 * (b + c) : (a + b + c) / 3.0;
    moment += (area_up_to_[k] - before) * centre;
    before = area_up_to_[k];
  }
  return moment / before;
}

glm::dvec3 Emitter::reach(const glm::dvec3& centre, const Frame& frame) const {
  glm::dvec3 reach(0.0);
  const auto include = [&](const glm::vec3& p) {
    const glm::dvec3 offset = glm::dvec3(p) - centre;
    for (int a = 0; a < 3; ++a)
      reach[a] = std::max(reach[a], std::abs(glm::dot(offset, frame[size_t(a)])));
  };
  for (const Piece& piece : pieces_) {
    const Corners p = corners(piece, 0.0f);
    for (const glm::vec3& corner : p) include(corner);
    if (piece.parallelogram) include(p[1] + (p[2] - p[0]));
  }
  return reach;
}

void Emitter::measure() {
  const glm::dvec3 centre = centroid();
  extent_.centre = glm::vec3(centre);
  extent_.area_root = float(std::sqrt(area_up_to_.back()));
  double least = std::numeric_limits<double>::infinity();
  const Frame of_camera{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
  for (const Frame& frame : {frame_of(corners(pieces_.front(), 0.0f)), of_camera}) {
    const glm::dvec3 r = reach(centre, frame);
    const double surface = r.x * r.y + r.y * r.z + r.z * r.x;
    if (!(surface < least)) continue;
    least = surface;
    for (int a = 0; a < 3; ++a) extent_.half_axes[size_t(a)] = glm::vec3(r[a] * frame[size_t(a)]);
  }
}

LightPlace Emitter::place(glm::vec2 xi, float time) const {
  const auto first_of = [](const std::vector<size_t>& ends, size_t k) {
    return k > 0 ? ends[k - 1] : 0;
  };
  const Found grid =
      find_share(0, grid_ends_.size(), double(xi.x), [&](size_t k) { return area_before_grid(k); });
  const Found row = find_share(first_of(grid_ends_, grid.part), grid_ends_[grid.part], double(xi.y),
                               [&](size_t k) { return area_before_row(k); });
  const Found in_row = find_share(first_of(row_ends_, row.part), row_ends_[row.part], grid.share,
                                  [&](size_t k) { return area_before(k); });
  const Piece& piece = pieces_[in_row.part];
  const Corners p = corners(piece, time);
  const glm::vec2 on_square(float(in_row.share), float(row.share));
  const glm::vec2 at = piece.parallelogram ? on_square : triangle_from_square(on_square);
  const glm::dvec3 normal = double(grids_[piece.grid]->normal_sign) * doubled_area(p);
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
