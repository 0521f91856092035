#include "dice/bicubic_kernel.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "dice/bicubic_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

// Bernstein polynomials of degree 3, and 3 times those of degree 2, which weigh the differences of
// neighbouring control points in the derivative. At t = 0 and t = 1 the weights are exactly 0 and
// 1, so that a patch interpolates its corners exactly.
struct Basis {
  V b[4], d[3];
};

HWY_INLINE Basis basis_at(V t) {
  const D tag;
  const V one = hn::Set(tag, 1.0f), three = hn::Set(tag, 3.0f);
  const V s = hn::Sub(one, t);
  const V ss = hn::Mul(s, s), tt = hn::Mul(t, t), st = hn::Mul(s, t);
  const V st3 = hn::Mul(three, st);
  return {{hn::Mul(ss, s), hn::Mul(st3, s), hn::Mul(st3, t), hn::Mul(tt, t)},
          {hn::Mul(three, ss), hn::Add(st3, st3), hn::Mul(three, tt)}};
}

HWY_INLINE V cubic(const Basis& w, V p0, V p1, V p2, V p3) {
  return hn::MulAdd(w.b[3], p3,
                    hn::MulAdd(w.b[2], p2, hn::MulAdd(w.b[1], p1, hn::Mul(w.b[0], p0))));
}

HWY_INLINE V cubic_slope(const Basis& w, V p0, V p1, V p2, V p3) {
  return hn::MulAdd(w.d[2], hn::Sub(p3, p2),
                    hn::MulAdd(w.d[1], hn::Sub(p2, p1), hn::Mul(w.d[0], hn::Sub(p1, p0))));
}

HWY_INLINE void store_cross(const V a[3], const V b[3], float* const N[3], size_t at) {
  const D tag;
  for (int axis = 0; axis < 3; ++axis) {
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    hn::StoreU(hn::NegMulAdd(a[z], b[y], hn::Mul(a[y], b[z])), tag, N[axis] + at);
  }
}

// For a row of constant v the patch is a cubic in u whose control points q (and those of dP/dv,
// r) are found once; lanes are then values of u.
template <bool with_normals>
void tensor_of(const BicubicControl& control, const float* HWY_RESTRICT u, size_t u_count,
               const float* HWY_RESTRICT v, size_t v_count, size_t row_stride, float* const P[3],
               float* const N[3]) {
  const D tag;
  const size_t lanes = hn::Lanes(tag);
  alignas(64) float rows[24][16];
  for (size_t block = 0; block < v_count; block += lanes) {
    // The control points of `lanes` rows at once.
    const size_t in_block = std::min(lanes, v_count - block);
    alignas(64) float v_block[16];
    for (size_t k = 0; k < lanes; ++k) v_block[k] = v[block + std::min(k, in_block - 1)];
    const Basis w = basis_at(hn::Load(tag, v_block));
    for (int axis = 0; axis < 3; ++axis) {
      const float* c = control.c[axis];
      for (int i = 0; i < 4; ++i) {
        const V p0 = hn::Set(tag, c[i]), p1 = hn::Set(tag, c[4 + i]);
        const V p2 = hn::Set(tag, c[8 + i]), p3 = hn::Set(tag, c[12 + i]);
        hn::Store(cubic(w, p0, p1, p2, p3), tag, rows[axis * 8 + i]);
        if (with_normals) hn::Store(cubic_slope(w, p0, p1, p2, p3), tag, rows[axis * 8 + 4 + i]);
      }
    }
    for (size_t at = 0; at < u_count; at += lanes) {
      const Basis wu = basis_at(hn::LoadU(tag, u + at));
      for (size_t k = 0; k < in_block; ++k) {
        const size_t out = (block + k) * row_stride + at;
        V dPdu[3], dPdv[3];
        for (int axis = 0; axis < 3; ++axis) {
          const float(*q)[16] = rows + axis * 8;
          const V q0 = hn::Set(tag, q[0][k]), q1 = hn::Set(tag, q[1][k]);
          const V q2 = hn::Set(tag, q[2][k]), q3 = hn::Set(tag, q[3][k]);
          hn::StoreU(cubic(wu, q0, q1, q2, q3), tag, P[axis] + out);
          if constexpr (with_normals) {
            dPdu[axis] = cubic_slope(wu, q0, q1, q2, q3);
            dPdv[axis] = cubic(wu, hn::Set(tag, q[4][k]), hn::Set(tag, q[5][k]),
                               hn::Set(tag, q[6][k]), hn::Set(tag, q[7][k]));
          }
        }
        if constexpr (with_normals) store_cross(dPdu, dPdv, N, out);
      }
    }
  }
}

void tensor(const BicubicControl& control, const float* u, size_t u_count, const float* v,
            size_t v_count, size_t row_stride, float* const P[3], float* const N[3]) {
  if (N[0]) {
    tensor_of<true>(control, u, u_count, v, v_count, row_stride, P, N);
  } else {
    tensor_of<false>(control, u, u_count, v, v_count, row_stride, P, N);
  }
}

void points(const BicubicControl& control, const float* HWY_RESTRICT u, const float* HWY_RESTRICT v,
            size_t count, float* const P[3], float* const N[3]) {
  const D tag;
  const size_t lanes = hn::Lanes(tag);
  for (size_t at = 0; at < count; at += lanes) {
    const Basis wu = basis_at(hn::LoadU(tag, u + at)), wv = basis_at(hn::LoadU(tag, v + at));
    V dPdu[3], dPdv[3];
    for (int axis = 0; axis < 3; ++axis) {
      const float* c = control.c[axis];
      V q[4], r[4];
      for (int i = 0; i < 4; ++i) {
        const V p0 = hn::Set(tag, c[i]), p1 = hn::Set(tag, c[4 + i]);
        const V p2 = hn::Set(tag, c[8 + i]), p3 = hn::Set(tag, c[12 + i]);
        q[i] = cubic(wv, p0, p1, p2, p3);
        r[i] = cubic_slope(wv, p0, p1, p2, p3);
      }
      hn::StoreU(cubic(wu, q[0], q[1], q[2], q[3]), tag, P[axis] + at);
      dPdu[axis] = cubic_slope(wu, q[0], q[1], q[2], q[3]);
      dPdv[axis] = cubic(wu, r[0], r[1], r[2], r[3]);
    }
    if (N[0]) store_cross(dPdu, dPdv, N, at);
  }
}

bool normalize(float* const N[3], size_t count, float sign) {
  const D tag;
  const size_t lanes = hn::Lanes(tag);
  // Squared lengths outside this range lose too many bits to be trusted.
  const V tiny = hn::Set(tag, 1e-36f), huge = hn::Set(tag, 1e36f);
  const V unit = hn::Set(tag, sign);
  bool all_good = true;
  for (size_t at = 0; at < count; at += lanes) {
    const V x = hn::LoadU(tag, N[0] + at), y = hn::LoadU(tag, N[1] + at);
    const V z = hn::LoadU(tag, N[2] + at);
    const V squared = hn::MulAdd(z, z, hn::MulAdd(y, y, hn::Mul(x, x)));
    const auto good = hn::And(hn::Gt(squared, tiny), hn::Lt(squared, huge));
    const V one = hn::Set(tag, 1.0f);
    const V scale =
        hn::IfThenElse(good, hn::Div(unit, hn::Sqrt(hn::IfThenElse(good, squared, one))), unit);
    hn::StoreU(hn::Mul(x, scale), tag, N[0] + at);
    hn::StoreU(hn::Mul(y, scale), tag, N[1] + at);
    hn::StoreU(hn::Mul(z, scale), tag, N[2] + at);
    // Lanes past the end do not count.
    const auto counted = hn::FirstN(tag, count - at);
    all_good &= hn::AllTrue(tag, hn::Or(good, hn::Not(counted)));
  }
  return all_good;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(tensor);
HWY_EXPORT(points);
HWY_EXPORT(normalize);

void bicubic_tensor(const BicubicControl& control, const float* u, size_t u_count, const float* v,
                    size_t v_count, size_t row_stride, float* const P[3], float* const N[3]) {
  HWY_DYNAMIC_DISPATCH(tensor)(control, u, u_count, v, v_count, row_stride, P, N);
}

void bicubic_points(const BicubicControl& control, const float* u, const float* v, size_t count,
                    float* const P[3], float* const N[3]) {
  HWY_DYNAMIC_DISPATCH(points)(control, u, v, count, P, N);
}

bool normalize_normals(float* const N[3], size_t count, float sign) {
  return HWY_DYNAMIC_DISPATCH(normalize)(N, count, sign);
}

}  // namespace tessera
#endif
