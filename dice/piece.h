#pragma once
/// A piece of a patch and the decision to split or dice it, apart from doing so: it is taken once
/// for all motion keys.

#include <array>
#include <optional>

#include "dice/edge_span.h"

namespace tessera {

struct Piece {
  uint32_t patch = 0;
  uint64_t path = 1;  ///< GridId::path
  ParameterRect rect;
  std::array<EdgeSpan, 4> edges;  ///< by side
  /// Own parameters of the four corners: off the rectangle's where an edge's vertices are sparse.
  std::array<glm::dvec2, 4> corners;
  int u_count = 1, v_count = 1;  ///< micropolygons to dice into
  int u_most = 1, v_most = 1;    ///< where the parameters run fastest

  /// Contains the own parameters of every vertex of the piece.
  ParameterRect vertex_rect() const;
};

/// Sizes up a piece whose rect and edges are set: u_count, v_count, u_most, v_most.
void measure(Piece& piece, PatchCache& cache, const DiceRate& rate);

/// The whole patch, measured. Nothing where there is no surface.
std::optional<Piece> whole_patch(uint32_t patch, PatchCache& cache, const DiceRate& rate);

enum class SplitDecision { dice, split_u, split_v };
SplitDecision decide(const Piece& piece, const DiceRate& rate);

/// The two halves, measured, lower parameters first.
std::array<Piece, 2> split(const Piece& piece, SplitDecision direction, PatchCache& cache,
                           const DiceRate& rate);

}  // namespace tessera
