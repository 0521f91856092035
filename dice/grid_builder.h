#pragma once
/// Dices one piece of a patch into a Grid.

#include <memory>
#include <vector>

#include "base/diagnostics.h"
#include "dice/grid.h"
#include "dice/piece.h"
#include "dice/surface_context.h"

namespace tessera {

/// Makes grids of one surface, one after the other. Not thread safe; the grids are the same
/// whatever builder makes them.
class GridBuilder {
 public:
  GridBuilder(const SurfaceContext& context, PatchCache& cache, Diagnostics& diagnostics)
      : context_(context), cache_(cache), diagnostics_(diagnostics) {}

  /// Null when a vertex is not finite.
  std::unique_ptr<Grid> build(const Piece& piece);

 private:
  /// A vertex on the boundary and the place that all grids that touch it agree on.
  struct BoundaryVertex {
    int vertex;
    Location location;
  };

  /// Unit normals at one place of a patch; zero where it has no two directions.
  struct StencilNormals {
    glm::dvec3 surface{0};    ///< before displacement, of the patch's own geometry; no sign applied
    glm::dvec3 displaced{0};  ///< outward
  };

  void lay_out(const Piece& piece, Grid& grid);
  void evaluate_interior(const Piece& piece, Grid& grid);
  /// Moves the vertices along one side onto the vertices of its edge.
  void evaluate_side(const Piece& piece, int side, Grid& grid);
  /// Own parameters of the edge's vertices [begin, end].
  void gather_edge_parameters(const Piece& piece, int side);
  void evaluate_location(const Location& location, int key, float* const P[3], size_t at);
  /// Texture coordinates and primitive variables at the points (u, v) of a patch, one a vertex.
  void fill_attributes(uint32_t patch, std::span<const float> u, std::span<const float> v,
                       Grid& grid);
  /// Surface parameters, and texture coordinates, of the points (u, v) of a patch.
  void fill_uv(uint32_t patch, std::span<const float> u, std::span<const float> v, float* uv,
               size_t stride);
  void fill_st(uint32_t patch, std::span<const float> u, std::span<const float> v, const float* uv,
               float* st, size_t stride);
  void apply_vertex_normals(uint32_t patch, Grid& grid);
  bool set_bounds(Grid& grid) const;

  void displace(uint32_t patch, Grid& grid);
  /// What the displacer says, within the bound. One a vertex, grid.stride() long.
  AlignedVector<float> distances(const Grid& grid);
  void share_boundary_attributes(Grid& grid);
  void boundary_normals(Grid& grid, std::vector<AlignedVector<float>>& normals);
  /// Replaces the normals of a displaced grid's boundary by those that its neighbours find too.
  void displaced_boundary_normals(uint32_t own_patch, Grid& grid);
  std::vector<StencilNormals> stencil_normals(uint32_t patch, std::span<const glm::dvec2> places,
                                              float normal_sign);
  /// Parameters, five a place, to take derivatives from. Returns StencilNormals::surface.
  std::vector<glm::dvec3> place_stencils(const Patch& patch, std::span<const glm::dvec2> places,
                                         AlignedVector<float>& u, AlignedVector<float>& v) const;

  const SurfaceContext& context_;
  PatchCache& cache_;
  Diagnostics& diagnostics_;

  AlignedVector<float> u_, v_;                // tensor parameters
  AlignedVector<float> vertex_u_, vertex_v_;  // own parameters of each vertex
  AlignedVector<float> scratch_;              // tensor output in padded rows
  AlignedVector<float> edge_u_, edge_v_, edge_t_;
  AlignedVector<float> edge_P_, edge_N_, edge_own_P_;
  std::vector<AlignedVector<float>> key_normals_;  // [key] of a displaced grid, [xyz][vertex]
  std::vector<BoundaryVertex> boundary_;           // of a displaced grid
};

}  // namespace tessera
