#pragma once
/// SIMD evaluation of bicubic Bezier patches.

#include <cstddef>

namespace tessera {

/// Sixteen control points of a bicubic Bezier patch: element [axis][4 j + i] is point i along u, j
/// along v.
struct BicubicControl {
  alignas(64) float c[3][16];
};

/// Evaluates all (u[i], v[j]) into element j * row_stride + i of P[axis] and, unless N[0] is null,
/// cross(dP/du, dP/dv) into N[axis]. `u` is read and rows are written up to padded(u_count).
void bicubic_tensor(const BicubicControl& control, const float* u, size_t u_count, const float* v,
                    size_t v_count, size_t row_stride, float* const P[3], float* const N[3]);

/// Evaluates the points (u[i], v[i]), i < count; arrays are padded as above.
void bicubic_points(const BicubicControl& control, const float* u, const float* v, size_t count,
                    float* const P[3], float* const N[3]);

/// Writes sign * N / |N| over N, `count` rounded up to simd_padding. Returns false when some
/// length leaves the range of float arithmetic; those are only multiplied by sign.
bool normalize_normals(float* const N[3], size_t count, float sign);

}  // namespace tessera
