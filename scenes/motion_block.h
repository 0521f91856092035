#pragma once
/// The calls between MotionBegin and MotionEnd, gathered into keys.

#include <optional>

#include "scenes/keyed_shape.h"

namespace tessera {

/// One motion block. Each transform or shape call inside it is a key; the block holds calls of one
/// kind only, one for each of its times. Other calls take their first value.
class MotionBlock {
 public:
  /// Throws Error at `where` unless `times` ascend strictly and there is at least one.
  /// `current` is the transform in force.
  MotionBlock(std::vector<double> times, const KeyedTransform& current,
              const SourceLocation& where);

  /// A call that replaces the current transform by `matrix`, or applies it before that.
  void set_transform(const glm::dmat4& matrix, const SourceLocation& where);
  void concat_transform(const glm::dmat4& matrix, const SourceLocation& where);
  void add_shape(KeyedShape shape, const SourceLocation& where);

  /// Checks that every time got its call (or that nothing was called at all).
  void close(const SourceLocation& where) const;
  /// The transform in force after the block.
  KeyedTransform transform() const;
  /// The shape the block made, if it holds shapes.
  std::optional<KeyedShape>& shape() { return shape_; }

 private:
  enum class Holds { nothing, transforms, shapes };
  double next_time(Holds kind, const SourceLocation& where);

  std::vector<double> times_;
  KeyedTransform before_;
  SourceLocation where_;
  Holds holds_ = Holds::nothing;
  size_t calls_ = 0;
  bool sets_ = false;
  std::vector<glm::dmat4> matrices_;
  std::optional<KeyedShape> shape_;
};

}  // namespace tessera
