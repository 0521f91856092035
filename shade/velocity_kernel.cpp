#include "shade/velocity_kernel.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/velocity_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, velocity_padding>;
using V = hn::Vec<D>;

HWY_INLINE V load(const float* from) {
  const D tag;
  return hn::PromoteTo(tag, hn::LoadU(hn::Rebind<float, D>(), from));
}

void write_slowest(const RasterClipMap& map, const KeyPositions& begin, const KeyPositions& end,
                   double duration, size_t count, double* HWY_RESTRICT out_x,
                   double* HWY_RESTRICT out_y) {
  const D tag;
  const V x_rate = hn::Set(tag, double(map.x_scale) / duration);
  const V y_rate = hn::Set(tag, double(map.y_scale) / duration);
  const V from_z = hn::Set(tag, double(map.w_from_z)), constant = hn::Set(tag, map.w_constant);
  const auto depth = [&](V z) HWY_ATTR { return hn::Add(hn::Mul(from_z, z), constant); };
  for (size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const V w0 = depth(load(begin.z + i)), w1 = depth(load(end.z + i));
    const V slow = hn::Max(w0, w1), square = hn::Mul(slow, slow);
    const auto velocity = [&](const float* p0, const float* p1, V rate) HWY_ATTR {
      const V turned = hn::Sub(hn::Mul(load(p1 + i), w0), hn::Mul(load(p0 + i), w1));
      return hn::Mul(rate, hn::Div(turned, square));
    };
    hn::StoreU(velocity(begin.x, end.x, x_rate), tag, out_x + i);
    hn::StoreU(velocity(begin.y, end.y, y_rate), tag, out_y + i);
  }
}

void find_box(const Velocities& velocities, VelocityBox& box) {
  const D tag;
  const V infinity = hn::Set(tag, std::numeric_limits<double>::infinity());
  V x_low = infinity, y_low = infinity, x_high = hn::Neg(infinity), y_high = x_high;
  auto finite = hn::Eq(infinity, infinity);
  for (size_t i = 0; i < velocities.count; i += hn::Lanes(tag)) {
    const auto counted = hn::FirstN(tag, velocities.count - i);
    const V x = hn::LoadU(tag, velocities.x + i), y = hn::LoadU(tag, velocities.y + i);
    x_low = hn::IfThenElse(counted, hn::Min(x_low, x), x_low);
    x_high = hn::IfThenElse(counted, hn::Max(x_high, x), x_high);
    y_low = hn::IfThenElse(counted, hn::Min(y_low, y), y_low);
    y_high = hn::IfThenElse(counted, hn::Max(y_high, y), y_high);
    // Infinities and NaNs both make the sum of absolute values fail this comparison.
    const auto good = hn::Lt(hn::Add(hn::Abs(x), hn::Abs(y)), infinity);
    finite = hn::And(finite, hn::Or(hn::Not(counted), good));
  }
  box.low = {hn::GetLane(hn::MinOfLanes(tag, x_low)), hn::GetLane(hn::MinOfLanes(tag, y_low))};
  box.high = {hn::GetLane(hn::MaxOfLanes(tag, x_high)), hn::GetLane(hn::MaxOfLanes(tag, y_high))};
  box.finite = hn::AllTrue(tag, finite);
}

// The first index of the least of some values, lane by lane.
struct Least {
  V value, index;

  HWY_INLINE void add(V candidate, V at, hn::Mask<D> counted) {
    const auto less = hn::And(counted, hn::Lt(candidate, value));
    value = hn::IfThenElse(less, candidate, value);
    index = hn::IfThenElse(less, at, index);
  }
  HWY_INLINE size_t first() const {
    const D tag;
    const auto least = hn::Eq(value, hn::MinOfLanes(tag, value));
    const V beyond = hn::Set(tag, std::numeric_limits<double>::max());
    return size_t(hn::GetLane(hn::MinOfLanes(tag, hn::IfThenElse(least, index, beyond))));
  }
};

// No value yet. (A default constructor would be compiled for the baseline target.)
HWY_INLINE Least none_yet() {
  const D tag;
  return {hn::Set(tag, std::numeric_limits<double>::infinity()), hn::Zero(tag)};
}

size_t find_least(const Velocities& velocities, double along_x, double along_y) {
  const D tag;
  const V ax = hn::Set(tag, along_x), ay = hn::Set(tag, along_y);
  Least least = none_yet();
  for (size_t i = 0; i < velocities.count; i += hn::Lanes(tag)) {
    const V x = hn::LoadU(tag, velocities.x + i), y = hn::LoadU(tag, velocities.y + i);
    least.add(hn::Add(hn::Mul(ax, x), hn::Mul(ay, y)), hn::Iota(tag, double(i)),
              hn::FirstN(tag, velocities.count - i));
  }
  return least.first();
}

void find_arc_ends(const Velocities& velocities, double axis_x, double axis_y, ArcEnds& ends) {
  const D tag;
  const V ax = hn::Set(tag, axis_x), ay = hn::Set(tag, axis_y);
  Least least = none_yet(), greatest = none_yet();
  for (size_t i = 0; i < velocities.count; i += hn::Lanes(tag)) {
    const V x = hn::LoadU(tag, velocities.x + i), y = hn::LoadU(tag, velocities.y + i);
    const V across = hn::Sub(hn::Mul(ax, y), hn::Mul(ay, x));
    const V slope = hn::Div(across, hn::Add(hn::Mul(ax, x), hn::Mul(ay, y)));
    const V index = hn::Iota(tag, double(i));
    const auto counted = hn::FirstN(tag, velocities.count - i);
    least.add(slope, index, counted);
    greatest.add(hn::Neg(slope), index, counted);
  }
  ends = {least.first(), greatest.first()};
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(write_slowest);
HWY_EXPORT(find_box);
HWY_EXPORT(find_least);
HWY_EXPORT(find_arc_ends);

void slowest_velocities(const RasterClipMap& map, const KeyPositions& begin,
                        const KeyPositions& end, double duration, size_t count, double* x,
                        double* y) {
  HWY_DYNAMIC_DISPATCH(write_slowest)(map, begin, end, duration, count, x, y);
}

VelocityBox velocity_box(const Velocities& velocities) {
  VelocityBox box;
  HWY_DYNAMIC_DISPATCH(find_box)(velocities, box);
  return box;
}

size_t least_along(const Velocities& velocities, glm::dvec2 along) {
  return HWY_DYNAMIC_DISPATCH(find_least)(velocities, along.x, along.y);
}

ArcEnds arc_ends(const Velocities& velocities, glm::dvec2 axis) {
  ArcEnds ends;
  HWY_DYNAMIC_DISPATCH(find_arc_ends)(velocities, axis.x, axis.y, ends);
  return ends;
}

}  // namespace tessera
#endif
