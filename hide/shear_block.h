/// Where the vertices of a block may be met in the space of its shear map. Included once for each
/// SIMD target.

#include <algorithm>
#include <cmath>

#include "hide/sheared_grid.h"

#if defined(TESSERA_HIDE_SHEAR_BLOCK_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_SHEAR_BLOCK_H_
#undef TESSERA_HIDE_SHEAR_BLOCK_H_
#else
#define TESSERA_HIDE_SHEAR_BLOCK_H_
#endif

#include "hide/coverage.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Everything the pass over the vertices of a block knows beforehand.
struct ShearPass {
  const ClipSegment* segment;
  const CoverageFrame* frame;
  ShearMap map;
  ShearGain gain;
  float lens, lens_y;     ///< |u|, |v| at most, the latter times the ratio of the CoCs
  float reach[2];         ///< |x|, |y| of a sample relative to the map's middle, at most
  float raster_reach[2];  ///< |x|, |y| of a sample on the raster, at most
};

/// The vertices i, i + 1, ...: their place on the raster at the reference time, relative to the
/// map's middle, and how far from it a sample that sees them may be mapped by the affine fit alone
/// (`coarse`) and, but for what `bend_slack` bounds, with the bend.
struct ShearedVertices {
  FloatVec x, y, x_coarse, y_coarse, x_slack, y_slack, W;
};

/// A bound that the affine fit leaves over, and one that is left over with the bend.
struct LeftOver {
  FloatVec coarse, fine;
};

/// Positions and their products.
struct BendPoint {
  FloatVec x, y, xx, xy, yy;
};

HWY_INLINE FloatVec bend_at(const BendField& b, const BendPoint& p) {
  const FloatTag d;
  const FloatVec sum = hn::MulAdd(hn::Set(d, b.xx), p.xx, hn::Set(d, b.constant));
  return hn::MulAdd(hn::Set(d, b.yy), p.yy, hn::MulAdd(hn::Set(d, b.xy), p.xy, sum));
}

/// What the fits of a field leave over of it, as absolute values.
HWY_INLINE LeftOver left_over(const ShearMap& m, ShearField field, FloatVec f, const BendPoint& p) {
  const FloatTag d;
  const AffineField& fit = m.fit[field];
  const FloatVec at = hn::MulAdd(hn::Set(d, fit.per_y), p.y,
                                 hn::MulAdd(hn::Set(d, fit.per_x), p.x, hn::Set(d, fit.at_middle)));
  const FloatVec rest = hn::Sub(f, at);
  return {hn::Abs(rest), hn::Abs(hn::Sub(rest, bend_at(m.bend[field], p)))};
}

/// a + scale * b, part by part.
HWY_INLINE LeftOver add_scaled(const LeftOver& a, float scale, const LeftOver& b) {
  const FloatVec s = hn::Set(FloatTag(), scale);
  return {hn::MulAdd(s, b.coarse, a.coarse), hn::MulAdd(s, b.fine, a.fine)};
}

template <bool kMotion, bool kLens>
HWY_INLINE ShearedVertices shear_vertices(const ShearPass& p, size_t i) {
  const FloatTag d;
  const ClipSegment& s = *p.segment;
  const ShearMap& m = p.map;
  FloatVec X = hn::LoadU(d, s.X + i), Y = hn::LoadU(d, s.Y + i), W = hn::LoadU(d, s.W + i);
  FloatVec z = hn::LoadU(d, s.z + i), dX, dY, dW, dz;
  // Sizes of what the sample test adds up, at any time of the segment.
  FloatVec X_size = hn::Abs(X), Y_size = hn::Abs(Y), W_size = hn::Abs(W), z_size = hn::Abs(z);
  if constexpr (kMotion) {
    const FloatVec tau = hn::Set(d, m.tau);
    dX = hn::LoadU(d, s.dX + i), dY = hn::LoadU(d, s.dY + i);
    dW = hn::LoadU(d, s.dW + i), dz = hn::LoadU(d, s.dz + i);
    X = hn::MulAdd(tau, dX, X), Y = hn::MulAdd(tau, dY, Y);
    W = hn::MulAdd(tau, dW, W), z = hn::MulAdd(tau, dz, z);
    X_size = hn::Add(X_size, hn::Abs(dX)), Y_size = hn::Add(Y_size, hn::Abs(dY));
    W_size = hn::Add(W_size, hn::Abs(dW)), z_size = hn::Add(z_size, hn::Abs(dz));
  }
  const FloatVec inverse = hn::Div(hn::Set(d, 1.0f), W);
  const FloatVec x_middle = hn::Set(d, m.middle[0]), y_middle = hn::Set(d, m.middle[1]);
  ShearedVertices v;
  v.W = W;
  v.x = hn::Mul(hn::NegMulAdd(x_middle, W, X), inverse);
  v.y = hn::Mul(hn::NegMulAdd(y_middle, W, Y), inverse);

  const BendPoint at{v.x, v.y, hn::Mul(v.x, v.x), hn::Mul(v.x, v.y), hn::Mul(v.y, v.y)};
  const FloatVec zero = hn::Zero(d);
  LeftOver x_left{zero, zero}, y_left{zero, zero};
  if constexpr (kMotion) {
    const FloatVec rx = hn::Mul(hn::NegMulAdd(x_middle, dW, dX), inverse);
    const FloatVec ry = hn::Mul(hn::NegMulAdd(y_middle, dW, dY), inverse);
    const LeftOver q = left_over(m, field_q, hn::Mul(dW, inverse), at);
    x_left = add_scaled(x_left, m.half_duration,
                        add_scaled(left_over(m, field_rx, rx, at), p.reach[0], q));
    y_left = add_scaled(y_left, m.half_duration,
                        add_scaled(left_over(m, field_ry, ry, at), p.reach[1], q));
  }
  if constexpr (kLens) {
    const FloatVec scale = hn::Set(d, p.frame->coc_x.scale);
    const FloatVec offset = hn::Set(d, p.frame->coc_x.offset);
    LeftOver c = left_over(m, field_c, hn::Mul(hn::MulAdd(scale, z, offset), inverse), at);
    if constexpr (kMotion) {
      const FloatVec e = hn::Mul(hn::Mul(scale, dz), inverse);
      c = add_scaled(c, m.half_duration, left_over(m, field_e, e, at));
    }
    x_left = add_scaled(x_left, p.lens, c);
    y_left = add_scaled(y_left, p.lens_y, c);
    const FloatVec coc_size = hn::MulAdd(hn::Abs(scale), z_size, hn::Abs(offset));
    X_size = hn::MulAdd(hn::Set(d, p.lens), coc_size, X_size);
    Y_size = hn::MulAdd(hn::Set(d, p.lens_y), coc_size, Y_size);
  }
  // Rounding of the sample test, of these fields and of the map, all relative to these sizes.
  const FloatVec margin = hn::Mul(hn::Set(d, shear_rounding_margin), hn::Abs(inverse));
  const auto rounding = [&](FloatVec size, float reach) HWY_ATTR {
    return hn::Mul(margin, hn::MulAdd(hn::Set(d, reach), W_size, size));
  };
  const FloatVec x_round = rounding(X_size, p.raster_reach[0]);
  const FloatVec y_round = rounding(Y_size, p.raster_reach[1]);
  const auto gained = [&](float from_x, FloatVec x, float from_y, FloatVec y) HWY_ATTR {
    return hn::MulAdd(hn::Set(d, from_x), hn::Add(x, x_round),
                      hn::Mul(hn::Set(d, from_y), hn::Add(y, y_round)));
  };
  v.x_coarse = gained(p.gain.xx, x_left.coarse, p.gain.xy, y_left.coarse);
  v.y_coarse = gained(p.gain.yx, x_left.coarse, p.gain.yy, y_left.coarse);
  v.x_slack = gained(p.gain.xx, x_left.fine, p.gain.xy, y_left.fine);
  v.y_slack = gained(p.gain.yx, x_left.fine, p.gain.yy, y_left.fine);
  return v;
}

/// Extremes of a pass over the vertices of a block.
struct VertexExtremes {
  RasterBounds places;               ///< of the vertices themselves
  float x_coarse = 0, y_coarse = 0;  ///< largest slack without the bend
  float slack = 0;                   ///< largest with it
  bool usable = false;               ///< all in front of the eye at the reference time, all finite
};

/// Fills the vertex boxes of `out`: place -+ slack.
template <bool kMotion, bool kLens>
VertexExtremes place_vertices(const ShearPass& pass, int u_count, const GridBlock& block,
                              ShearedBlock& out) {
  const FloatTag d;
  const size_t row = size_t(u_count) + 1, count = size_t(block.i1 - block.i0) + 1;
  const FloatVec huge = hn::Set(d, hwy::HighestValue<float>());
  FloatVec x_low = huge, y_low = huge, x_high = hn::Neg(huge), y_high = x_high;
  FloatVec slack = hn::Zero(d), x_coarse = slack, y_coarse = slack, W_low = huge;
  for (int j = block.j0; j <= block.j1; ++j)
    for (size_t k = 0; k < count; k += hn::Lanes(d)) {
      const size_t i = size_t(j) * row + size_t(block.i0) + k;
      const ShearedVertices v = shear_vertices<kMotion, kLens>(pass, i);
      hn::StoreU(hn::Sub(v.x, v.x_slack), d, out.x_low.data() + i);
      hn::StoreU(hn::Add(v.x, v.x_slack), d, out.x_high.data() + i);
      hn::StoreU(hn::Sub(v.y, v.y_slack), d, out.y_low.data() + i);
      hn::StoreU(hn::Add(v.y, v.y_slack), d, out.y_high.data() + i);
      const FloatMask valid = hn::FirstN(d, count - k);
      x_low = hn::Min(x_low, hn::IfThenElse(valid, v.x, huge));
      y_low = hn::Min(y_low, hn::IfThenElse(valid, v.y, huge));
      x_high = hn::Max(x_high, hn::IfThenElse(valid, v.x, hn::Neg(huge)));
      y_high = hn::Max(y_high, hn::IfThenElse(valid, v.y, hn::Neg(huge)));
      // Comparisons that fail for NaN keep the bad one.
      const auto larger = [&](FloatVec most, FloatVec value) HWY_ATTR {
        return hn::IfThenElse(hn::Le(hn::IfThenElseZero(valid, value), most), most, value);
      };
      slack = larger(slack, hn::Max(v.x_slack, v.y_slack));
      x_coarse = larger(x_coarse, v.x_coarse), y_coarse = larger(y_coarse, v.y_coarse);
      W_low = hn::Min(W_low, hn::IfThenElse(valid, v.W, huge));
    }
  VertexExtremes e;
  e.places = {hn::GetLane(hn::MinOfLanes(d, x_low)), hn::GetLane(hn::MinOfLanes(d, y_low)),
              hn::GetLane(hn::MaxOfLanes(d, x_high)), hn::GetLane(hn::MaxOfLanes(d, y_high))};
  e.x_coarse = hn::GetLane(hn::MaxOfLanes(d, x_coarse));
  e.y_coarse = hn::GetLane(hn::MaxOfLanes(d, y_coarse));
  e.slack = hn::GetLane(hn::MaxOfLanes(d, slack));
  e.usable = hn::GetLane(hn::MinOfLanes(d, W_low)) > 0 && hn::AllTrue(d, hn::Le(slack, huge)) &&
             hn::AllTrue(d, hn::Le(hn::Max(x_coarse, y_coarse), huge));
  return e;
}

/// What the step that takes in the bend may be off by: it is taken from where the affine fit leads,
/// at most the coarse slack beside the right place (`moved`), and for the weighted mean of a
/// micropolygon's vertices instead of for each (`gap`, times the squared sides of its box).
struct BendSlack {
  float x_moved = 0, y_moved = 0;
  float x_gap[3] = {0, 0, 0}, y_gap[3] = {0, 0, 0};  ///< of width^2, width height, height^2
};

inline BendSlack bend_slack(const ShearPass& pass, const VertexExtremes& e) {
  const BendBounds b = bend_bounds(pass.map, pass.lens, pass.reach);
  const float x = std::max(std::abs(e.places.x_min), std::abs(e.places.x_max)) + e.x_coarse;
  const float y = std::max(std::abs(e.places.y_min), std::abs(e.places.y_max)) + e.y_coarse;
  float moved[2], gap[2][3];
  for (int axis = 0; axis < 2; ++axis) {
    moved[axis] = (2 * b.xx[axis] * x + b.xy[axis] * y) * e.x_coarse +
                  (2 * b.yy[axis] * y + b.xy[axis] * x) * e.y_coarse;
    // The variance of a value between two ends is at most a quarter of their squared distance.
    gap[axis][0] = 0.25f * b.xx[axis], gap[axis][1] = 0.25f * b.xy[axis];
    gap[axis][2] = 0.25f * b.yy[axis];
  }
  const ShearGain& g = pass.gain;
  BendSlack s;
  s.x_moved = g.xx * moved[0] + g.xy * moved[1], s.y_moved = g.yx * moved[0] + g.yy * moved[1];
  for (int k = 0; k < 3; ++k) {
    s.x_gap[k] = g.xx * gap[0][k] + g.xy * gap[1][k];
    s.y_gap[k] = g.yx * gap[0][k] + g.yy * gap[1][k];
  }
  return s;
}

/// Boxes of the micropolygons from those of their vertices, and the extent of all.
inline void box_micropolygons(int u_count, const GridBlock& block, const BendSlack& bend,
                              ShearedBlock& out) {
  const FloatTag d;
  const size_t row = size_t(u_count) + 1, count = size_t(block.i1 - block.i0);
  const FloatVec huge = hn::Set(d, hwy::HighestValue<float>());
  FloatVec x_low = huge, y_low = huge, x_high = hn::Neg(huge), y_high = x_high;
  for (int j = block.j0; j < block.j1; ++j)
    for (size_t k = 0; k < count; k += hn::Lanes(d)) {
      const size_t i = size_t(j) * row + size_t(block.i0) + k;
      const auto least = [&](float* p) HWY_ATTR {
        return hn::Min(hn::Min(hn::LoadU(d, p), hn::LoadU(d, p + 1)),
                       hn::Min(hn::LoadU(d, p + row), hn::LoadU(d, p + row + 1)));
      };
      const auto most = [&](float* p) HWY_ATTR {
        return hn::Max(hn::Max(hn::LoadU(d, p), hn::LoadU(d, p + 1)),
                       hn::Max(hn::LoadU(d, p + row), hn::LoadU(d, p + row + 1)));
      };
      FloatVec lx = least(out.x_low.data() + i), hx = most(out.x_high.data() + i);
      FloatVec ly = least(out.y_low.data() + i), hy = most(out.y_high.data() + i);
      const FloatVec width = hn::Sub(hx, lx), height = hn::Sub(hy, ly);
      const FloatVec ww = hn::Mul(width, width), wh = hn::Mul(width, height),
                     hh = hn::Mul(height, height);
      const auto slack = [&](float moved, const float(&gap)[3]) HWY_ATTR {
        return hn::MulAdd(hn::Set(d, gap[2]), hh,
                          hn::MulAdd(hn::Set(d, gap[1]), wh,
                                     hn::MulAdd(hn::Set(d, gap[0]), ww, hn::Set(d, moved))));
      };
      const FloatVec x_slack = slack(bend.x_moved, bend.x_gap);
      const FloatVec y_slack = slack(bend.y_moved, bend.y_gap);
      lx = hn::Sub(lx, x_slack), hx = hn::Add(hx, x_slack);
      ly = hn::Sub(ly, y_slack), hy = hn::Add(hy, y_slack);
      const size_t m = size_t(j - block.j0) * out.stride + k;
      hn::StoreU(lx, d, out.boxes[0].data() + m), hn::StoreU(hx, d, out.boxes[1].data() + m);
      hn::StoreU(ly, d, out.boxes[2].data() + m), hn::StoreU(hy, d, out.boxes[3].data() + m);
      const FloatMask valid = hn::FirstN(d, count - k);
      x_low = hn::Min(x_low, hn::IfThenElse(valid, lx, huge));
      y_low = hn::Min(y_low, hn::IfThenElse(valid, ly, huge));
      x_high = hn::Max(x_high, hn::IfThenElse(valid, hx, hn::Neg(huge)));
      y_high = hn::Max(y_high, hn::IfThenElse(valid, hy, hn::Neg(huge)));
    }
  out.extent = {hn::GetLane(hn::MinOfLanes(d, x_low)), hn::GetLane(hn::MinOfLanes(d, y_low)),
                hn::GetLane(hn::MaxOfLanes(d, x_high)), hn::GetLane(hn::MaxOfLanes(d, y_high))};
}

/// Fills `out` for the block; false if a vertex is not in front of the eye at the reference
/// time or some slack is not finite.
template <bool kMotion, bool kLens>
bool shear_block(const ShearPass& pass, int u_count, const GridBlock& block, ShearedBlock& out) {
  out.begin(u_count, block);
  const VertexExtremes e = place_vertices<kMotion, kLens>(pass, u_count, block, out);
  if (!e.usable) return false;
  const BendSlack bend = bend_slack(pass, e);
  box_micropolygons(u_count, block, bend, out);
  out.map = pass.map;
  out.slack = e.slack + std::max(bend.x_moved, bend.y_moved);
  return out.extent.x_max - out.extent.x_min < hwy::HighestValue<float>() &&
         out.extent.y_max - out.extent.y_min < hwy::HighestValue<float>();
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
