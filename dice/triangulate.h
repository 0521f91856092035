#pragma once
/// Triangles of a polygon: concave, with holes, collinear and repeated vertices.

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace tessera {

/// Ear clipping in the plane of the outer loop's area vector (Newell), after every hole has been
/// joined to the outer loop by a bridge. `loops` are index lists into `points`; the first is the
/// outer one. Triangles keep the outer loop's orientation, whatever the holes'; they are index
/// triples into `points`. Every boundary edge appears in exactly one triangle and every other edge
/// in two, opposite ways, so triangles of no area are kept.
std::vector<std::array<int, 3>> triangulate(std::span<const glm::dvec3> points,
                                            const std::vector<std::vector<int>>& loops);

/// Newell's area vector of a loop, twice the area long.
glm::dvec3 area_vector(std::span<const glm::dvec3> points, std::span<const int> loop);

/// Whether a loop of four is strictly convex seen along its area vector.
bool is_convex_quad(std::span<const glm::dvec3> points, std::span<const int> loop);

}  // namespace tessera
