#include "dice/edge_span.h"

#include <algorithm>
#include <array>

#include "dice/passage.h"
#include "dice/shape_rate.h"

namespace tessera {

const Patch* PatchCache::get(uint32_t index) {
  auto [entry, is_new] = cache_.try_emplace(index);
  if (is_new) entry->second = patches_.patch(index);
  return entry->second.get();
}

Location EdgeSpan::location_of(int vertex) const {
  if (vertex == 0) return first;
  if (vertex == segments) return last;
  return {curve, t_of(vertex)};
}

int EdgeSpan::vertex_at(int i, int count) const {
  // Rounded: onto as long as count >= touched().
  const int offset = int((2L * i * touched() + count) / (2L * count));
  return reversed ? end - offset : begin + offset;
}

namespace {

constexpr int most_pieces = 8;

/// Samples of [t0, t1] of a curve, evenly in t.
class SpanSamples {
 public:
  SpanSamples(const EdgeSpan& span, const Patch& patch)
      : span_(span), patch_(patch), pieces_(std::min(patch.sample_segments(), most_pieces)) {
    for (size_t i = 0; i <= size_t(pieces_); ++i) {
      const double at = span.t0 + (span.t1 - span.t0) * double(i) / pieces_;
      const glm::dvec2 uv = span.curve.parameters(at);
      t_[i] = float(at), u_[i] = float(uv.x), v_[i] = float(uv.y);
    }
  }
  int pieces() const { return pieces_; }

  std::span<const glm::vec3> at_key(int key) {
    alignas(64) float x[16], y[16], z[16];
    const PatchOutput out{{x, y, z}, {}};
    const size_t count = size_t(pieces_) + 1;
    if (span_.curve.is_side()) {
      patch_.side(key, int(span_.curve.line), span_.curve.flip, {t_, count}, out);
    } else {
      patch_.points(key, {u_, count}, {v_, count}, out);
    }
    for (size_t i = 0; i < count; ++i) P_camera_[i] = {x[i], y[i], z[i]};
    return {P_camera_.data(), count};
  }

 private:
  const EdgeSpan& span_;
  const Patch& patch_;
  int pieces_;
  alignas(64) float t_[16] = {}, u_[16] = {}, v_[16] = {};
  std::array<glm::vec3, most_pieces + 1> P_camera_;
};

RowSegments segments_by_shape(const EdgeSpan& span, const Patch& patch, const DiceRate& rate) {
  SpanSamples samples(span, patch);
  ShapeTurn turn;
  for (int key = 0; key < rate.key_count(); ++key) turn.add_row(samples.at_key(key));
  return turn.segments(*rate.shape);
}

RowSegments segments_on_raster(const EdgeSpan& span, const Patch& patch, const DiceRate& rate) {
  SpanSamples samples(span, patch);
  RowSize size;
  size.pieces = samples.pieces();
  const size_t count = size_t(size.pieces) + 1;
  const auto add_row = [&](const auto& length_of) {
    RowLength row;
    for (size_t i = 1; i < count; ++i) row.add(length_of(i - 1, i));
    size.add(row);
  };
  const RasterProjection& projection = *rate.projection;
  LeastBlur blur;
  Passage passage(projection);
  for (int key = 0; key < rate.key_count(); ++key) {
    const std::span<const glm::vec3> P = samples.at_key(key);
    add_row([&](size_t a, size_t b) { return projection.segment_length(P[a], P[b]); });
    if (rate.key_count() > 1) passage.add_key(P);
    if (passage.matters()) add_row([&](size_t a, size_t b) { return passage.length(a, b); });
    if (!rate.follows_blur()) continue;
    blur.add_key(projection, rate.key_times[size_t(key)], P);
    for (size_t i = 2; i < count; ++i) size.add_bend(projection, P[i - 2], P[i - 1], P[i]);
  }
  return segments_of(size, rate.step_under(blur));
}

/// Segments of [t0, t1] of a curve, from its own samples at every key and nothing else.
RowSegments segments_of(const EdgeSpan& span, const Patch& patch, const DiceRate& rate) {
  return rate.shape ? segments_by_shape(span, patch, rate) : segments_on_raster(span, patch, rate);
}

}  // namespace

void measure(EdgeSpan& span, PatchCache& cache, const DiceRate& rate) {
  const Patch* patch = cache.get(span.curve.patch);
  const RowSegments segments = patch ? segments_of(span, *patch, rate) : RowSegments{};
  const bool too_narrow = span.t1 - span.t0 <= DiceRate::min_width;
  span.leaf = !span.forced && (segments.most <= rate.max_grid_size || too_narrow);
  span.segments = std::min(segments.count, rate.max_grid_size);
  span.begin = 0;
  span.end = span.segments;
}

EdgeSpan whole_side(uint32_t patch, int side, PatchCache& cache, const DiceRate& rate) {
  const SharedSide shared = cache.patches().shared_side(patch, side);
  EdgeSpan span;
  span.curve = shared.curve;
  span.t0 = shared.t0;
  span.t1 = shared.t1;
  span.reversed = shared.reversed;
  span.forced = shared.forced_split;
  const Patch* owner = cache.get(span.curve.patch);
  if (owner && span.curve.is_side() && owner->side_is_flipped(int(span.curve.line))) {
    span.curve.flip = true;
    span.t0 = 1.0 - shared.t1;
    span.t1 = 1.0 - shared.t0;
    span.reversed = !span.reversed;
  }
  constexpr int corners[4][2] = {{0, 1}, {1, 3}, {2, 3}, {0, 2}};
  span.first = cache.patches().shared_corner(patch, corners[side][span.reversed ? 1 : 0]);
  span.last = cache.patches().shared_corner(patch, corners[side][span.reversed ? 0 : 1]);
  span.own0 = span.reversed ? 1 : 0;
  span.own1 = span.reversed ? 0 : 1;
  measure(span, cache, rate);
  return span;
}

SplitSpan split(const EdgeSpan& span, PatchCache& cache, const DiceRate& rate) {
  EdgeSpan a = span, b = span;
  SplitSpan halves;
  if (span.leaf) {
    const int middle = (span.begin + span.end) / 2;
    a.end = b.begin = middle;
    halves.middle = span.location_of(middle);
    halves.own_middle = span.own_of(middle);
  } else {
    const double t = 0.5 * (span.t0 + span.t1);
    halves.middle = {span.curve, t};
    halves.own_middle = 0.5 * (span.own0 + span.own1);
    a.forced = b.forced = false;
    a.t1 = b.t0 = t;
    a.own1 = b.own0 = halves.own_middle;
    a.last = b.first = halves.middle;
    measure(a, cache, rate);
    measure(b, cache, rate);
  }
  halves.low = span.reversed ? b : a;
  halves.high = span.reversed ? a : b;
  return halves;
}

}  // namespace tessera
