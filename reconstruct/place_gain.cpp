#include "reconstruct/place_gain.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "reconstruct/guard.h"

namespace tessera {
namespace {

/// Keeps quotients finite: very near a light its fixed places may miss nearly all of it.
constexpr float largest_gain = 1e4f;

float bounded_quotient(float sum, float divisor) {
  const float quotient = sum / divisor;
  return std::isfinite(quotient) ? std::clamp(quotient, 0.0f, largest_gain) : 1.0f;
}

class PlaceGain {
 public:
  PlaceGain(const std::array<std::array<const float*, 3>, 2>& sums, const PixelFacts& facts)
      : sums_(sums), facts_(facts) {}

  /// The quotient of the sums over the pixels near that show the same surface.
  Candidate near() const {
    const PixelRect& rect = facts_.rect();
    const size_t pixels = size_t(rect.pixel_count());
    Candidate out{Planes(3, std::vector<float>(pixels)), std::vector<float>(pixels)};
    tbb::parallel_for(rect.y0, rect.y1, [&](int y) {
      for (int x = rect.x0; x < rect.x1; ++x) sum_near(x, y, out);
    });
    return out;
  }

 private:
  void sum_near(int x, int y, Candidate& out) const {
    const PixelRect window =
        PixelRect{x, y, x + 1, y + 1}.grown(place_gain_reach).intersect(facts_.rect());
    const size_t at = facts_.index(x, y);
    std::array<float, 3> drawn{}, unblocked{};
    int count = 0;
    for (int qy = window.y0; qy < window.y1; ++qy) {
      for (int qx = window.x0; qx < window.x1; ++qx) {
        const size_t q = facts_.index(qx, qy);
        if (facts_.surface[q] != facts_.surface[at]) continue;
        ++count;
        for (size_t c = 0; c < 3; ++c) drawn[c] += sums_[0][c][q], unblocked[c] += sums_[1][c][q];
      }
    }
    for (size_t c = 0; c < 3; ++c) out.filtered[c][at] = bounded_quotient(drawn[c], unblocked[c]);
    out.own_weight[at] = 1.0f / float(std::max(count, 1));
  }

  const std::array<std::array<const float*, 3>, 2>& sums_;
  const PixelFacts& facts_;
};

}  // namespace

Planes place_gain(const std::array<std::array<const float*, 3>, 2>& sums,
                  const std::array<std::array<const float*, 3>, 2>& even_sums,
                  const PixelFacts& facts, const NoiseCorrelation& correlation) {
  Component gain(facts.rect().width(), facts.rect().height());
  for (size_t c = 0; c < 3; ++c) {
    for (size_t p = 0; p < gain.pixels(); ++p) {
      const Quotient q =
          halves_quotient(sums[0][c][p], even_sums[0][c][p], sums[1][c][p], even_sums[1][c][p]);
      gain.plain[c][p] = bounded_quotient(sums[0][c][p], sums[1][c][p]);
      gain.deviation[c][p] = q.deviation;
    }
  }
  const size_t pixels = gain.pixels();
  gain.candidates.push_back(
      {Planes(3, std::vector<float>(pixels, 1.0f)), std::vector<float>(pixels, 0.0f)});
  gain.candidates.push_back(PlaceGain(sums, facts).near());
  const auto shares = filtered_shares(gain, correlation, nullptr);
  Planes out = gain.plain;
  for (size_t k = 0; k < shares.size(); ++k)
    for (size_t c = 0; c < 3; ++c)
      for (size_t p = 0; p < pixels; ++p)
        out[c][p] += shares[k][p] * (gain.candidates[k].filtered[c][p] - gain.plain[c][p]);
  return out;
}

}  // namespace tessera
