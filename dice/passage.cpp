#include "dice/passage.h"

#include <algorithm>
#include <limits>

namespace tessera {

namespace {

constexpr size_t side_count = RasterProjection::side_count;

/// What enters or leaves the frame is measured in one so many times as large: otherwise only the
/// end that has entered would count. This shows all of a segment as long as the frame, and more
/// than a frame of those that are longer.
constexpr float frames_at_border = 3;

/// From the first to the last share of the way between two keys.
struct Shares {
  double first = 0, last = 1;
  bool empty() const { return !(first < last); }
};

/// Where the linear function from f0 to f1 is negative.
Shares negative_shares(double f0, double f1) {
  if (f0 < 0) return {0, f1 < 0 ? 1 : f0 / (f0 - f1)};
  return {f1 < 0 ? f0 / (f0 - f1) : 1, 1};
}

/// The shares but for those before and after which all of the segment is beyond some side of the
/// frame; what turns may be beyond one for a while in between, too.
Shares shares_in_frame(const RasterProjection& projection, const MovingSegment& s) {
  const auto a0 = projection.inside(s.a0), b0 = projection.inside(s.b0);
  const auto a1 = projection.inside(s.a1), b1 = projection.inside(s.b1);
  std::array<Shares, side_count> beyond;
  for (size_t side = 0; side < side_count; ++side) {
    const Shares a = negative_shares(a0[side], a1[side]);
    const Shares b = negative_shares(b0[side], b1[side]);
    beyond[side] = {std::max(a.first, b.first), std::min(a.last, b.last)};
  }
  Shares seen;
  for (const Shares& out : beyond) {
    if (out.empty()) continue;
    if (out.first == 0) seen.first = std::max(seen.first, out.last);
    if (out.last == 1) seen.last = std::min(seen.last, out.first);
  }
  return seen;
}

/// The share of the way from p0 to p1 that is nearest to the eye; 0 if it is a key, or all alike.
double nearest_share(const glm::vec3& p0, const glm::vec3& p1) {
  const glm::dvec3 step = glm::dvec3(p1) - glm::dvec3(p0);
  const double share = -glm::dot(glm::dvec3(p0), step) / glm::dot(step, step);
  return share > 0 && share < 1 ? share : 0;
}

glm::vec3 point_at(double share, const glm::vec3& p0, const glm::vec3& p1) {
  return glm::vec3((1 - share) * glm::dvec3(p0) + share * glm::dvec3(p1));
}

}  // namespace

float longest_length(const RasterProjection& projection, const MovingSegment& s) {
  float longest = std::max(projection.segment_length(s.a0, s.b0),  //
                           projection.segment_length(s.a1, s.b1));
  if (s.a0 == s.a1 && s.b0 == s.b1) return longest;
  const auto see = [&](double share, float frames) {
    if (!(share > 0 && share < 1)) return;  // a key
    const glm::vec3 a = point_at(share, s.a0, s.a1), b = point_at(share, s.b0, s.b1);
    longest = std::max(longest, projection.segment_length(a, b, frames));
  };
  const Shares seen = shares_in_frame(projection, s);
  if (!seen.empty()) {
    see(seen.first, frames_at_border);
    see(0.5 * (seen.first + seen.last), 1);
    see(seen.last, frames_at_border);
  }
  if (projection.turned_to_eye()) {
    see(nearest_share(s.a0, s.a1), 1);
    see(nearest_share(s.b0, s.b1), 1);
    see(nearest_share(0.5f * (s.a0 + s.b0), 0.5f * (s.a1 + s.b1)), 1);
  }
  return longest;
}

void Passage::add_key(std::span<const glm::vec3> P_camera) {
  const size_t count = std::min(P_camera.size(), LeastBlur::most_samples);
  if (keys_ > 0) std::copy_n(to_.begin(), count, from_.begin());
  from_sides_ = to_sides_;
  std::copy_n(P_camera.begin(), count, to_.begin());
  to_sides_ = {0, std::numeric_limits<uint32_t>::max()};
  for (const glm::vec3& P : P_camera.first(count)) {
    const auto inside = projection_.inside(P);
    uint32_t beyond = 0;
    for (size_t side = 0; side < side_count; ++side) beyond |= uint32_t(inside[side] < 0) << side;
    to_sides_.any |= beyond, to_sides_.all &= beyond;
  }
  ++keys_;
}

bool Passage::matters() const {
  // Orthographic lengths of what moves linearly are convex in time: keys are enough.
  if (keys_ < 2 || !projection_.perspective()) return false;
  if (projection_.turned_to_eye()) return true;
  return (from_sides_.any | to_sides_.any) != 0 && (from_sides_.all & to_sides_.all) == 0;
}

}  // namespace tessera
