#pragma once
/// A grid: a diced piece of one surface, at most 32 x 32 micropolygons by default.
///
/// Vertex (i, j) has index j * (u_count + 1) + i. Micropolygon m = j * u_count + i is the quad
///
///     c=(i,j+1) --- d=(i+1,j+1)
///        |        /   |
///        |   1  /  0  |            triangle 0 = (a, b, d), triangle 1 = (a, d, c);
///        |    /       |            the diagonal a-d is fixed, so that every ray caster and every
///     a=(i,j) ----- b=(i+1,j)      hider sees the same geometry.
///
/// Neighbouring grids of one surface share the vertices of their common edge bit for bit; a
/// micropolygon at such an edge may be degenerate (two vertices equal), see docs/dicing.md.

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/aligned.h"
#include "base/raster.h"
#include "scenes/scene.h"

namespace tessera {

/// Stable name of a grid: the same whatever bucket or thread asks for it, ordered by scene order.
struct GridId {
  uint32_t surface = 0;  ///< Scene::surfaces index
  uint32_t face = 0;     ///< face, patch or quadric part of the surface
  uint64_t path = 1;     ///< splits taken below the face: a leading 1, then one bit a split
  auto operator<=>(const GridId&) const = default;
};

/// One primitive variable at the vertices of a grid.
struct GridPrimvar {
  const Parameter* source = nullptr;  ///< name, type; owned by the scene
  int components = 1;
  AlignedVector<float> values;  ///< [component][vertex], stride Grid::stride()
  const float* component(int c, size_t stride) const { return values.data() + size_t(c) * stride; }
};

/// One lazily built object that a later stage hangs on a grid and that dies with it (the shaded
/// colours of its vertices, say). dice/ does not know what it is.
class GridAttachment {
 public:
  virtual ~GridAttachment() = default;
};

struct Grid {
  GridId id;
  const Surface* surface = nullptr;
  int u_count = 0, v_count = 0;  ///< micropolygons along u and v, at least 1 each

  /// Shutter times of the keys, ascending from 0 to 1; {0} when static.
  std::vector<float> key_times{0.0f};
  AlignedVector<float> P_camera;  ///< [key][x, y, z][vertex]
  AlignedVector<float> N_camera;  ///< [x, y, z][vertex], unit, outward, at shutter open
  AlignedVector<float> uv;        ///< [u, v][vertex], surface parameters in [0, 1]
  AlignedVector<float> st;        ///< [s, t][vertex], texture coordinates
  std::vector<GridPrimvar> primvars;

  /// Raster bounds over the whole shutter and lens, conservative; everything() where the grid
  /// meets the camera plane and no better bound is known.
  RasterBounds raster_bounds;
  float z_min = 0, z_max = 0;  ///< camera depth over all keys
  /// The outward normal of a micropolygon is this sign times cross(b - a, d - a) in camera space.
  float normal_sign = 1.0f;
  bool one_sided = false;  ///< Sides 1: micropolygons facing away are not seen

  mutable std::unique_ptr<GridAttachment> attachment;  ///< guarded by its owner's own lock

  int vertex_count() const { return (u_count + 1) * (v_count + 1); }
  int micropolygon_count() const { return u_count * v_count; }
  int key_count() const { return int(key_times.size()); }
  /// The vertices of triangle 2 * micropolygon + (0 or 1), in the order of the picture above.
  std::array<int, 3> triangle_corners(uint32_t triangle) const {
    const int m = int(triangle / 2), row = u_count + 1;
    const int a = m / u_count * row + m % u_count;
    const int b = a + 1, c = a + row, d = c + 1;
    return triangle % 2 == 0 ? std::array{a, b, d} : std::array{a, d, c};
  }
  size_t stride() const { return padded(size_t(vertex_count())); }
  const float* P(int key, int axis) const {
    return P_camera.data() + (size_t(key) * 3 + size_t(axis)) * stride();
  }
  float* P(int key, int axis) {
    return P_camera.data() + (size_t(key) * 3 + size_t(axis)) * stride();
  }
  const float* N(int axis) const { return N_camera.data() + size_t(axis) * stride(); }
  const Attributes& attributes() const { return *surface->attributes; }
  size_t memory_bytes() const;
};

}  // namespace tessera
