#include "scenes/scene_time.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/gtc/constants.hpp>

namespace tessera {

namespace {

/// The place of `time` between the keys; .t is left for the caller.
ShutterKey locate(const std::vector<double>& times, double time) {
  if (time <= times.front()) return {0.0f, 0, 0, 0.0};
  if (time >= times.back()) return {0.0f, times.size() - 1, times.size() - 1, 0.0};
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  const size_t after = size_t(next - times.begin());
  const double weight = (time - times[after - 1]) / (times[after] - times[after - 1]);
  return {0.0f, after - 1, after, weight};
}

}  // namespace

std::vector<ShutterKey> shutter_keys(const std::vector<double>& times, ShutterInterval shutter) {
  if (times.size() == 1 || !(shutter.close > shutter.open)) return {locate(times, shutter.open)};
  std::vector<ShutterKey> keys{locate(times, shutter.open)};
  for (size_t i = 0; i < times.size(); ++i) {
    const float t = float((times[i] - shutter.open) / (shutter.close - shutter.open));
    // Keys closer than float can tell apart would make a segment of no length.
    if (t > keys.back().t && t < 1.0f) keys.push_back({t, i, i, 0.0});
  }
  keys.push_back(locate(times, shutter.close));
  keys.back().t = 1.0f;
  return keys;
}

KeyedTransform::KeyedTransform(std::vector<double> times, std::vector<glm::dmat4> matrices)
    : times_(std::move(times)), matrices_(std::move(matrices)) {
  const bool still = std::all_of(matrices_.begin(), matrices_.end(),
                                 [&](const glm::dmat4& m) { return m == matrices_.front(); });
  if (!still) return;
  times_ = {0.0};
  matrices_.erase(matrices_.begin() + 1, matrices_.end());
}

glm::dmat4 KeyedTransform::at(double time) const { return blend(matrices_, locate(times_, time)); }

KeyedTransform operator*(const KeyedTransform& a, const KeyedTransform& b) {
  if (!a.moves() && !b.moves()) return KeyedTransform(a.matrices_[0] * b.matrices_[0]);
  std::vector<double> times;
  if (a.moves() && b.moves())
    std::set_union(a.times_.begin(), a.times_.end(), b.times_.begin(), b.times_.end(),
                   std::back_inserter(times));
  else
    times = a.moves() ? a.times_ : b.times_;
  std::vector<glm::dmat4> matrices;
  for (double time : times) matrices.push_back(a.at(time) * b.at(time));
  return KeyedTransform(std::move(times), std::move(matrices));
}

KeyedTransform KeyedTransform::inverse() const {
  KeyedTransform result = *this;
  for (glm::dmat4& matrix : result.matrices_) matrix = glm::inverse(matrix);
  return result;
}

MovingTransform KeyedTransform::in_shutter(ShutterInterval shutter) const {
  std::vector<float> times;
  std::vector<glm::dmat4> matrices;
  for (const ShutterKey& key : shutter_keys(times_, shutter)) {
    times.push_back(key.t);
    matrices.push_back(blend(matrices_, key));
  }
  return MovingTransform(std::move(times), std::move(matrices));
}

int KeyedTransform::handedness() const {
  return glm::determinant(glm::dmat3(matrices_.front())) < 0.0 ? -1 : 1;
}

double largest_stretch(const glm::dmat4& matrix) {
  // The largest eigenvalue of the symmetric A = M^T M, in closed form: with q = tr(A) / 3 and
  // p^2 = tr((A - qI)^2) / 6, it is q + 2 p cos(acos(det((A - qI) / p) / 2) / 3).
  const glm::dmat3 m(matrix);
  const glm::dmat3 a = glm::transpose(m) * m;
  const double q = (a[0][0] + a[1][1] + a[2][2]) / 3.0;
  const glm::dmat3 shifted = a - glm::dmat3(q);
  double square = 0.0;
  for (int i = 0; i < 3; ++i) square += glm::dot(shifted[i], shifted[i]);
  const double p = std::sqrt(square / 6.0);
  if (p <= 1e-12 * q) return std::sqrt(q);
  const double r = std::clamp(glm::determinant(shifted / p) / 2.0, -1.0, 1.0);
  return std::sqrt(q + 2.0 * p * std::cos(std::acos(r) / 3.0));
}

}  // namespace tessera
