#pragma once
/// Scene time and shutter time. Readers give motion keys in scene time; a Scene holds them in
/// shutter time t = (time - open) / (close - open), cut to [0, 1].

#include <vector>

#include <glm/glm.hpp>

#include "base/transform.h"

namespace tessera {

struct ShutterInterval {
  double open = 0.0, close = 0.0;
};

/// One key in shutter time, as a blend of two keys in scene time:
/// value = (1 - weight) * values[before] + weight * values[after].
struct ShutterKey {
  float t;
  size_t before, after;
  double weight;
};

/// The keys in shutter time of something keyed at `times` (scene time, ascending, not empty) that
/// is linear between its keys and held outside them. Several keys always start at t = 0 and end at
/// t = 1; a shutter that never opens, or a single key, gives one key at t = 0.
std::vector<ShutterKey> shutter_keys(const std::vector<double>& times, ShutterInterval shutter);

template <class T>
T blend(const std::vector<T>& values, const ShutterKey& key) {
  if (key.weight == 0.0) return values[key.before];
  using Scalar = typename T::value_type;
  return values[key.before] * Scalar(1.0 - key.weight) + values[key.after] * Scalar(key.weight);
}

/// A transform keyed in scene time; elements are linear between keys and held outside.
class KeyedTransform {
 public:
  KeyedTransform() : KeyedTransform(glm::dmat4(1.0)) {}
  explicit KeyedTransform(const glm::dmat4& matrix) : times_{0.0}, matrices_{matrix} {}
  /// `times` strictly ascending, as many as `matrices`, at least one.
  KeyedTransform(std::vector<double> times, std::vector<glm::dmat4> matrices);

  bool moves() const { return matrices_.size() > 1; }
  const std::vector<double>& times() const { return times_; }
  const std::vector<glm::dmat4>& matrices() const { return matrices_; }
  glm::dmat4 at(double time) const;

  /// a * b, exact at the union of both key times.
  friend KeyedTransform operator*(const KeyedTransform& a, const KeyedTransform& b);
  /// Exact at the key times. The matrices must not be singular.
  KeyedTransform inverse() const;
  MovingTransform in_shutter(ShutterInterval shutter) const;
  /// Sign of the determinant of the 3 x 3 part at the first key: -1 for a reflection, else 1.
  int handedness() const;

  bool operator==(const KeyedTransform&) const = default;

 private:
  std::vector<double> times_;
  std::vector<glm::dmat4> matrices_;
};

/// The largest factor by which the matrix stretches a vector: its largest singular value.
double largest_stretch(const glm::dmat4& matrix);

}  // namespace tessera
