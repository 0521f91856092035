#include "shade/fragment_geometry.h"

#include <algorithm>

#include "shade/mathematics.h"

namespace tessera {

KeyBlend::KeyBlend(const Grid& grid, float t) {
  const std::vector<float>& times = grid.key_times;
  const int last = grid.key_count() - 1;
  // The last key at or before t, and the share of the key after it.
  before = std::max(0, int(std::upper_bound(times.begin(), times.end(), t) - times.begin()) - 1);
  after = std::min(before + 1, last);
  const float span = times[size_t(after)] - times[size_t(before)];
  share = span > 0.0f ? std::max(0.0f, (t - times[size_t(before)]) / span) : 0.0f;
}

FragmentGeometry::FragmentGeometry(const ShadeInput& input, size_t fragment) {
  const FragmentList& fragments = *input.fragments;
  grid = input.grids[fragments.grid[fragment]].get();
  corner = grid->triangle_corners(fragments.triangle[fragment]);
  const float b1 = fragments.b1[fragment], b2 = fragments.b2[fragment];
  weight = {1.0f - b1 - b2, b1, b2};
  const AlignedVector<float>& times = input.samples->t;
  time = times.empty() ? 0.0f : times[fragments.sample[fragment]];
}

glm::vec3 FragmentGeometry::P_camera(float t) const {
  const KeyBlend at(*grid, t);
  glm::vec3 P;
  for (int axis = 0; axis < 3; ++axis) {
    const float p0 = interpolate(grid->P(at.before, axis));
    P[axis] = at.share == 0.0f ? p0 : p0 + at.share * (interpolate(grid->P(at.after, axis)) - p0);
  }
  return P;
}

glm::vec3 unit_normal(const FragmentGeometry& seen) {
  const Grid& grid = *seen.grid;
  return unit_or_zero(
      {seen.interpolate(grid.N(0)), seen.interpolate(grid.N(1)), seen.interpolate(grid.N(2))});
}

}  // namespace tessera
