#include "dice/bounds_kernel.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "dice/bounds_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

// Widens [low, high] by (p - blur) / w ... (p + blur) / w where `counted`.
HWY_INLINE void widen(V p, V blur, V w, hn::Mask<D> counted, V& low, V& high) {
  low = hn::IfThenElse(counted, hn::Min(low, hn::Div(hn::Sub(p, blur), w)), low);
  high = hn::IfThenElse(counted, hn::Max(high, hn::Div(hn::Add(p, blur), w)), high);
}

void add_bounds(const RasterClipMap& map, float lens_extent, const float* HWY_RESTRICT x,
                const float* HWY_RESTRICT y, const float* HWY_RESTRICT z, size_t count,
                VertexBounds& bounds) {
  const D tag;
  const size_t lanes = hn::Lanes(tag);
  const V infinity = hn::Set(tag, std::numeric_limits<float>::infinity());
  const V zero = hn::Zero(tag), extent = hn::Set(tag, lens_extent);
  V x_min = infinity, y_min = infinity, z_min = infinity;
  V x_max = hn::Neg(infinity), y_max = x_max, z_max = x_max;
  auto in_front = hn::Eq(zero, zero), finite = in_front;
  for (size_t at = 0; at < count; at += lanes) {
    const auto counted = hn::FirstN(tag, count - at);
    const auto spare = hn::Not(counted);
    const V px = hn::LoadU(tag, x + at), py = hn::LoadU(tag, y + at), pz = hn::LoadU(tag, z + at);
    const V w = hn::MulAdd(hn::Set(tag, map.w_from_z), pz, hn::Set(tag, map.w_constant));
    const V X = hn::MulAdd(hn::Set(tag, map.x_from_w), w, hn::Mul(hn::Set(tag, map.x_scale), px));
    const V Y = hn::MulAdd(hn::Set(tag, map.y_from_w), w, hn::Mul(hn::Set(tag, map.y_scale), py));
    const auto blur = [&](const AffineInZ& coc) HWY_ATTR {
      const V radius = hn::MulAdd(hn::Set(tag, coc.scale), pz, hn::Set(tag, coc.offset));
      return hn::Mul(extent, hn::Abs(radius));
    };
    widen(X, blur(map.coc_x), w, counted, x_min, x_max);
    widen(Y, blur(map.coc_y), w, counted, y_min, y_max);
    z_min = hn::IfThenElse(counted, hn::Min(z_min, pz), z_min);
    z_max = hn::IfThenElse(counted, hn::Max(z_max, pz), z_max);
    in_front = hn::And(in_front, hn::Or(spare, hn::Gt(w, zero)));
    // Infinities and NaNs both make the sum of absolute values fail this comparison.
    const V sum = hn::Add(hn::Add(hn::Abs(px), hn::Abs(py)), hn::Abs(pz));
    finite = hn::And(finite, hn::Or(spare, hn::Lt(sum, infinity)));
  }
  const auto least = [&](V v) HWY_ATTR { return hn::GetLane(hn::MinOfLanes(tag, v)); };
  const auto most = [&](V v) HWY_ATTR { return hn::GetLane(hn::MaxOfLanes(tag, v)); };
  bounds.raster.add(RasterBounds{least(x_min), least(y_min), most(x_max), most(y_max)});
  bounds.z_min = std::min(bounds.z_min, least(z_min));
  bounds.z_max = std::max(bounds.z_max, most(z_max));
  bounds.in_front = bounds.in_front && hn::AllTrue(tag, in_front);
  bounds.finite = bounds.finite && hn::AllTrue(tag, finite);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(add_bounds);

void add_vertex_bounds(const RasterClipMap& map, float lens_extent, const float* x, const float* y,
                       const float* z, size_t count, VertexBounds& bounds) {
  HWY_DYNAMIC_DISPATCH(add_bounds)(map, lens_extent, x, y, z, count, bounds);
}

}  // namespace tessera
#endif
