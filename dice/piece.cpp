#include "dice/piece.h"

#include <algorithm>

#include "dice/passage.h"
#include "dice/shape_rate.h"

namespace tessera {

ParameterRect Piece::vertex_rect() const {
  ParameterRect r = rect;
  for (const glm::dvec2& c : corners) {
    r.u0 = std::min(r.u0, c.x), r.u1 = std::max(r.u1, c.x);
    r.v0 = std::min(r.v0, c.y), r.v1 = std::max(r.v1, c.y);
  }
  return r;
}

namespace {

constexpr int most_sample_pieces = 8;

/// Samples of a piece, evenly over its rectangle: element j * count + i is at u = i, v = j.
struct PieceSamples {
  int pieces = 1;  ///< samples along u or v less one
  std::array<glm::vec3, LeastBlur::most_samples> P_camera;

  size_t side() const { return size_t(pieces) + 1; }
  size_t index(int i, int j) const { return size_t(j) * side() + size_t(i); }
  const glm::vec3& at(int i, int j) const { return P_camera[index(i, j)]; }
  std::span<const glm::vec3> row(int j) const { return {&at(0, j), side()}; }
  std::span<const glm::vec3> all() const { return {P_camera.data(), side() * side()}; }

  /// With u and v exchanged.
  PieceSamples transposed() const {
    PieceSamples result;
    result.pieces = pieces;
    for (int j = 0; j <= pieces; ++j) {
      for (int i = 0; i <= pieces; ++i) result.P_camera[index(j, i)] = at(i, j);
    }
    return result;
  }

  void take(const Patch& patch, const ParameterRect& r, int key) {
    constexpr int stride = 16;
    alignas(64) float u[stride] = {}, v[stride] = {};
    alignas(64) float x[3][(most_sample_pieces + 1) * stride];
    for (int i = 0; i <= pieces; ++i) {
      u[i] = float(r.u0 + (r.u1 - r.u0) * i / pieces);
      v[i] = float(r.v0 + (r.v1 - r.v0) * i / pieces);
    }
    patch.tensor(key, {u, side()}, {v, side()}, stride, PatchOutput{{x[0], x[1], x[2]}, {}});
    for (int j = 0; j <= pieces; ++j) {
      for (int i = 0; i <= pieces; ++i) {
        const int k = j * stride + i;
        P_camera[index(i, j)] = {x[0][k], x[1][k], x[2][k]};
      }
    }
  }
};

/// The rows and columns of a piece.
struct PieceSize {
  RowSize along_u, along_v;

  /// `length_of(a, b)`: pixels between two samples, by index.
  template <class LengthOf>
  void add_rows(const PieceSamples& samples, const LengthOf& length_of) {
    for (int row = 0; row <= samples.pieces; ++row) {
      RowLength length_u, length_v;
      for (int k = 0; k < samples.pieces; ++k) {
        length_u.add(length_of(samples.index(k, row), samples.index(k + 1, row)));
        length_v.add(length_of(samples.index(row, k), samples.index(row, k + 1)));
      }
      along_u.add(length_u);
      along_v.add(length_v);
    }
  }

  void add_bends(const RasterProjection& projection, const PieceSamples& s) {
    for (int row = 0; row <= s.pieces; ++row) {
      for (int k = 2; k <= s.pieces; ++k) {
        along_u.add_bend(projection, s.at(k - 2, row), s.at(k - 1, row), s.at(k, row));
        along_v.add_bend(projection, s.at(row, k - 2), s.at(row, k - 1), s.at(row, k));
      }
    }
  }
};

struct PieceSegments {
  RowSegments in_u, in_v;
};

/// The largest turn of the rows, and of the normals along them.
void add_turns(const PieceSamples& samples, ShapeTurn& along) {
  for (int row = 0; row <= samples.pieces; ++row) {
    along.add_row(samples.row(row));
    along.add_strip(samples.row(row), samples.row(row < samples.pieces ? row + 1 : row - 1));
  }
}

PieceSegments segments_by_shape(const Patch& patch, const ParameterRect& rect,
                                const DiceRate& rate) {
  PieceSamples samples;
  samples.pieces = std::min(patch.sample_segments(), most_sample_pieces);
  ShapeTurn along_u, along_v;
  for (int key = 0; key < rate.key_count(); ++key) {
    samples.take(patch, rect, key);
    add_turns(samples, along_u);
    add_turns(samples.transposed(), along_v);
  }
  return {along_u.segments(*rate.shape), along_v.segments(*rate.shape)};
}

PieceSegments segments_on_raster(const Patch& patch, const ParameterRect& rect,
                                 const DiceRate& rate) {
  const RasterProjection& projection = *rate.projection;
  PieceSamples samples;
  PieceSize size;
  size.along_u.pieces = size.along_v.pieces = samples.pieces =
      std::min(patch.sample_segments(), most_sample_pieces);
  LeastBlur blur;
  Passage passage(projection);
  for (int key = 0; key < rate.key_count(); ++key) {
    samples.take(patch, rect, key);
    size.add_rows(samples, [&](size_t a, size_t b) {
      return projection.segment_length(samples.P_camera[a], samples.P_camera[b]);
    });
    if (rate.key_count() > 1) passage.add_key(samples.all());
    if (passage.matters()) {
      size.add_rows(samples, [&](size_t a, size_t b) { return passage.length(a, b); });
    }
    if (!rate.follows_blur()) continue;
    size.add_bends(projection, samples);
    blur.add_key(projection, rate.key_times[size_t(key)], samples.all());
  }
  const DiceStep step = rate.step_under(blur);
  return {segments_of(size.along_u, step), segments_of(size.along_v, step)};
}

}  // namespace

void measure(Piece& piece, PatchCache& cache, const DiceRate& rate) {
  const Patch& patch = *cache.get(piece.patch);
  const auto [in_u, in_v] = rate.shape ? segments_by_shape(patch, piece.rect, rate)
                                       : segments_on_raster(patch, piece.rect, rate);
  piece.u_count = in_u.count, piece.u_most = in_u.most;
  piece.v_count = in_v.count, piece.v_most = in_v.most;
  // Never fewer than the vertices of an edge, or the grid could not touch all of them.
  for (int side = 0; side < 4; ++side) {
    int& n = side % 2 ? piece.v_count : piece.u_count;
    n = std::max(n, piece.edges[size_t(side)].touched());
  }
}

std::optional<Piece> whole_patch(uint32_t patch, PatchCache& cache, const DiceRate& rate) {
  if (!cache.get(patch)) return std::nullopt;
  Piece piece;
  piece.patch = patch;
  for (int side = 0; side < 4; ++side) {
    piece.edges[size_t(side)] = whole_side(patch, side, cache, rate);
  }
  piece.corners = {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)};
  measure(piece, cache, rate);
  return piece;
}

SplitDecision decide(const Piece& piece, const DiceRate& rate) {
  const auto wish = [&](int count, int most, const EdgeSpan& a, const EdgeSpan& b, double width) {
    // A piece must follow its edges; by its own size it stops at the least width.
    if (!a.leaf || !b.leaf) return std::max(most, rate.max_grid_size + 1);
    const bool too_big = std::max(count, most) > rate.max_grid_size;
    return too_big && width > DiceRate::min_width ? most : 0;
  };
  const ParameterRect& r = piece.rect;
  const int u = wish(piece.u_count, piece.u_most, piece.edges[0], piece.edges[2], r.u1 - r.u0);
  const int v = wish(piece.v_count, piece.v_most, piece.edges[1], piece.edges[3], r.v1 - r.v0);
  if (u == 0 && v == 0) return SplitDecision::dice;
  return u >= v ? SplitDecision::split_u : SplitDecision::split_v;
}

std::array<Piece, 2> split(const Piece& piece, SplitDecision direction, PatchCache& cache,
                           const DiceRate& rate) {
  const bool in_u = direction == SplitDecision::split_u;
  // Sides cut in two: from low to high, the one at the least of the other parameter first.
  const size_t near = in_u ? 0 : 3, far = in_u ? 2 : 1;
  const SplitSpan near_halves = split(piece.edges[near], cache, rate);
  const SplitSpan far_halves = split(piece.edges[far], cache, rate);

  const ParameterRect& r = piece.rect;
  const double middle = in_u ? 0.5 * (r.u0 + r.u1) : 0.5 * (r.v0 + r.v1);
  EdgeSpan cut;
  cut.curve.patch = piece.patch;
  cut.curve.line = in_u ? Curve::Line::constant_u : Curve::Line::constant_v;
  cut.curve.constant = float(middle);
  cut.t0 = cut.own0 = in_u ? r.v0 : r.u0;
  cut.t1 = cut.own1 = in_u ? r.v1 : r.u1;
  cut.first = near_halves.middle;
  cut.last = far_halves.middle;
  measure(cut, cache, rate);

  const glm::dvec2 near_point =
      in_u ? glm::dvec2(near_halves.own_middle, r.v0) : glm::dvec2(r.u0, near_halves.own_middle);
  const glm::dvec2 far_point =
      in_u ? glm::dvec2(far_halves.own_middle, r.v1) : glm::dvec2(r.u1, far_halves.own_middle);
  std::array<Piece, 2> halves{piece, piece};
  Piece &low = halves[0], &high = halves[1];
  low.path = piece.path << 1;
  high.path = low.path | 1;
  low.edges[near] = near_halves.low, low.edges[far] = far_halves.low;
  high.edges[near] = near_halves.high, high.edges[far] = far_halves.high;
  if (in_u) {
    low.rect.u1 = high.rect.u0 = middle;
    low.edges[1] = high.edges[3] = cut;
    low.corners[1] = high.corners[0] = near_point;
    low.corners[3] = high.corners[2] = far_point;
  } else {
    low.rect.v1 = high.rect.v0 = middle;
    low.edges[2] = high.edges[0] = cut;
    low.corners[2] = high.corners[0] = near_point;
    low.corners[3] = high.corners[1] = far_point;
  }
  measure(low, cache, rate);
  measure(high, cache, rate);
  return halves;
}

}  // namespace tessera
