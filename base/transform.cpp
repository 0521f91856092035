#include "base/transform.h"

#include <algorithm>

#include "base/error.h"

namespace tessera {

MovingTransform::MovingTransform(std::vector<float> times, std::vector<glm::dmat4> matrices)
    : times_(std::move(times)), matrices_(std::move(matrices)) {
  if (times_.empty() || times_.size() != matrices_.size())
    throw Error("a moving transform needs one matrix for each of its key times");
  if (!std::is_sorted(times_.begin(), times_.end()))
    throw Error("the key times of a moving transform must ascend");
  const bool still = std::all_of(matrices_.begin(), matrices_.end(),
                                 [&](const glm::dmat4& m) { return m == matrices_.front(); });
  if (still) {
    times_.resize(1);
    matrices_.resize(1);
  }
}

glm::dmat4 MovingTransform::at(float t) const {
  if (t <= times_.front()) return matrices_.front();
  if (t >= times_.back()) return matrices_.back();
  const size_t next = std::upper_bound(times_.begin(), times_.end(), t) - times_.begin();
  const double span = double(times_[next]) - double(times_[next - 1]);
  const double s = (double(t) - double(times_[next - 1])) / span;
  return matrices_[next - 1] * (1.0 - s) + matrices_[next] * s;
}

MovingTransform MovingTransform::product(const MovingTransform& a, const MovingTransform& b) {
  if (!a.moves() && !b.moves()) return MovingTransform(a.matrices_[0] * b.matrices_[0]);
  std::vector<float> times = merged_key_times(a.times_, b.times_);
  std::vector<glm::dmat4> matrices;
  for (float t : times) matrices.push_back(a.at(t) * b.at(t));
  return MovingTransform(std::move(times), std::move(matrices));
}

std::vector<float> merged_key_times(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.size() <= 1 && b.size() <= 1) return {0.0f};
  std::vector<float> times{0.0f, 1.0f};
  for (const auto* list : {&a, &b})
    if (list->size() > 1)
      for (float t : *list)
        if (t > 0.0f && t < 1.0f) times.push_back(t);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace tessera
