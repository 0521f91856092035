#pragma once
/// The vertices along the edges of grids.
///
/// Every curve between two patches, or between two pieces of a patch, is cut into vertices by a
/// rule that looks at the curve alone, so that both sides of it agree without asking each other: a
/// span longer than a grid is halved; a shorter one (a leaf) is cut evenly into as many segments as
/// its raster length, and the least blur along it, ask for. A grid has at least as many
/// micropolygons along an edge as the part of the leaf that it touches, and moves its own boundary
/// vertices onto the leaf's: several of them may come to lie on one.

#include <memory>
#include <unordered_map>

#include "dice/dice_rate.h"
#include "dice/patch.h"

namespace tessera {

/// Patches of one surface, kept while a group of grids is made. Not thread safe.
class PatchCache {
 public:
  explicit PatchCache(const PatchSet& patches) : patches_(patches) {}
  const PatchSet& patches() const { return patches_; }
  /// Null where there is no surface.
  const Patch* get(uint32_t index);

 private:
  const PatchSet& patches_;
  std::unordered_map<uint32_t, std::unique_ptr<Patch>> cache_;
};

/// Part of a curve along one edge of a piece.
struct EdgeSpan {
  Curve curve;
  double t0 = 0, t1 = 1;
  Location first, last;       ///< the ends of [t0, t1]: they may belong to other curves
  double own0 = 0, own1 = 1;  ///< the piece's own parameter, in its patch, at t0 and t1
  bool reversed = false;      ///< t falls while the own parameter rises
  bool forced = false;        ///< must be halved whatever its length
  bool leaf = true;
  int segments = 1;        ///< of [t0, t1]; at most a grid's size for a leaf
  int begin = 0, end = 1;  ///< the vertices touched, begin <= end; {0, segments} unless a leaf

  int touched() const { return end - begin; }
  double t_of(int vertex) const { return t0 + (t1 - t0) * vertex / segments; }
  double own_of(int vertex) const { return own0 + (own1 - own0) * vertex / segments; }
  Location location_of(int vertex) const;
  /// The vertex at which vertex `i` of `count` along the own parameter comes to lie.
  int vertex_at(int i, int count) const;
  /// The vertices where the own parameter is least and greatest.
  int low() const { return reversed ? end : begin; }
  int high() const { return reversed ? begin : end; }
};

/// Fills in leaf, segments, begin and end.
void measure(EdgeSpan& span, PatchCache& cache, const DiceRate& rate);

/// The whole of side `side` of a patch.
EdgeSpan whole_side(uint32_t patch, int side, PatchCache& cache, const DiceRate& rate);

/// Halves in the order of the own parameter, and where they meet.
struct SplitSpan {
  EdgeSpan low, high;
  Location middle;
  double own_middle = 0;
};
SplitSpan split(const EdgeSpan& span, PatchCache& cache, const DiceRate& rate);

}  // namespace tessera
