#include "scenes/motion_block.h"

namespace tessera {

MotionBlock::MotionBlock(std::vector<double> times, const KeyedTransform& current,
                         const SourceLocation& where)
    : times_(std::move(times)), before_(current), where_(where) {
  if (times_.empty()) throw Error(where, "expected at least one motion time, found none");
  for (size_t i = 1; i < times_.size(); ++i)
    if (!(times_[i - 1] < times_[i]))
      throw Error(where, fmt::format("expected ascending motion times, found {} after {}",
                                     times_[i], times_[i - 1]));
}

double MotionBlock::next_time(Holds kind, const SourceLocation& where) {
  if (holds_ != Holds::nothing && holds_ != kind)
    throw Error(where, fmt::format("the motion block begun at {} mixes transforms and shapes",
                                   where_.text()));
  holds_ = kind;
  if (calls_ == times_.size())
    throw Error(where, fmt::format("the motion block begun at {} has {} times, found more calls",
                                   where_.text(), times_.size()));
  return times_[calls_++];
}

void MotionBlock::set_transform(const glm::dmat4& matrix, const SourceLocation& where) {
  if (calls_ > 0 && !sets_)
    throw Error(where, "a motion block cannot both set and concatenate transforms");
  next_time(Holds::transforms, where);
  sets_ = true;
  matrices_.push_back(matrix);
}

void MotionBlock::concat_transform(const glm::dmat4& matrix, const SourceLocation& where) {
  if (calls_ > 0 && sets_)
    throw Error(where, "a motion block cannot both set and concatenate transforms");
  next_time(Holds::transforms, where);
  matrices_.push_back(matrix);
}

void MotionBlock::add_shape(KeyedShape shape, const SourceLocation& where) {
  const double time = next_time(Holds::shapes, where);
  if (shape_) return append_key(*shape_, std::move(shape), time);
  shape_ = std::move(shape);
  shape_->scene_times = {time};
}

void MotionBlock::close(const SourceLocation& where) const {
  // A block whose only calls were of kinds that are skipped is empty, and harmless.
  if (holds_ != Holds::nothing && calls_ != times_.size())
    throw Error(where, fmt::format("the motion block begun at {} has {} times, found {} calls",
                                   where_.text(), times_.size(), calls_));
}

KeyedTransform MotionBlock::transform() const {
  if (holds_ != Holds::transforms) return before_;
  const KeyedTransform keys(times_, matrices_);
  return sets_ ? keys : before_ * keys;
}

}  // namespace tessera
