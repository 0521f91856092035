#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/owen_points.cpp"
#include <cmath>
#include <limits>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/owen_points.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using UintTag = hn::RebindToUnsigned<FloatTag>;

/// owen_scramble_reversed() of sobol.h, then the digits the right way round as a fraction.
HWY_INLINE hn::Vec<FloatTag> scrambled(const uint32_t* sobol, uint32_t seed) {
  const FloatTag d;
  const UintTag du;
  auto x = hn::LoadU(du, sobol);
  x = hn::Xor(x, hn::Mul(x, hn::Set(du, 0x3d20adeau)));
  x = hn::Add(x, hn::Set(du, seed));
  x = hn::Mul(x, hn::Set(du, (seed >> 16) | 1u));
  x = hn::Xor(x, hn::Mul(x, hn::Set(du, 0x05526c56u)));
  x = hn::Xor(x, hn::Mul(x, hn::Set(du, 0x53a22864u)));
  // Bit reversal by swapping ever larger halves.
  const auto swap = [&](auto v, uint32_t low, auto shift) HWY_ATTR {
    constexpr int kBits = decltype(shift)::value;
    const auto mask = hn::Set(du, low);
    return hn::Or(hn::ShiftLeft<kBits>(hn::And(v, mask)), hn::And(hn::ShiftRight<kBits>(v), mask));
  };
  x = swap(x, 0x55555555u, std::integral_constant<int, 1>());
  x = swap(x, 0x33333333u, std::integral_constant<int, 2>());
  x = swap(x, 0x0f0f0f0fu, std::integral_constant<int, 4>());
  x = swap(x, 0x00ff00ffu, std::integral_constant<int, 8>());
  x = hn::Or(hn::ShiftLeft<16>(x), hn::ShiftRight<16>(x));
  const hn::RebindToSigned<FloatTag> di;
  return hn::Mul(hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<8>(x))),
                 hn::Set(d, 1.0f / 16777216.0f));
}

void scramble(const uint32_t* sobol, size_t count, uint32_t seed, float* out) {
  const FloatTag d;
  for (size_t i = 0; i < count; i += hn::Lanes(d))
    hn::StoreU(scrambled(sobol + i, seed), d, out + i);
}

void scramble_in_pixel(const uint32_t* sobol, size_t count, uint32_t seed, float pixel, float last,
                       float* out) {
  const FloatTag d;
  const auto origin = hn::Set(d, pixel), limit = hn::Set(d, last);
  for (size_t i = 0; i < count; i += hn::Lanes(d))
    hn::StoreU(hn::Min(hn::Add(origin, scrambled(sobol + i, seed)), limit), d, out + i);
}

/// Octants of the square go to octants of the disc: with r the larger of |x|, |y| and q the signed
/// ratio of the smaller to the larger, the angle from the nearer axis is q pi / 4. Taylor series to
/// the tenth power of the angle are good to 2^-24 there.
void square_to_disc(float* u, float* v, size_t count) {
  const FloatTag d;
  const auto one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f), zero = hn::Zero(d);
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto x = hn::MulSub(hn::LoadU(d, u + i), two, one);
    const auto y = hn::MulSub(hn::LoadU(d, v + i), two, one);
    const auto along_x = hn::Gt(hn::Abs(x), hn::Abs(y));
    const auto major = hn::IfThenElse(along_x, x, y), minor = hn::IfThenElse(along_x, y, x);
    const auto centre = hn::Eq(major, zero);
    const auto ratio = hn::Div(minor, hn::IfThenElse(centre, one, major));
    const auto a = hn::Mul(ratio, hn::Set(d, 0.78539816339744831f)), a2 = hn::Mul(a, a);
    auto s = hn::MulAdd(a2, hn::Set(d, 1.0f / 362880), hn::Set(d, -1.0f / 5040));
    s = hn::MulAdd(a2, s, hn::Set(d, 1.0f / 120));
    s = hn::MulAdd(a2, s, hn::Set(d, -1.0f / 6));
    s = hn::MulAdd(hn::Mul(a2, s), a, a);
    auto c = hn::MulAdd(a2, hn::Set(d, -1.0f / 3628800), hn::Set(d, 1.0f / 40320));
    c = hn::MulAdd(a2, c, hn::Set(d, -1.0f / 720));
    c = hn::MulAdd(a2, c, hn::Set(d, 1.0f / 24));
    c = hn::MulAdd(a2, c, hn::Set(d, -0.5f));
    c = hn::MulAdd(a2, c, one);
    const auto near_axis = hn::Mul(major, c), off_axis = hn::Mul(major, s);
    hn::StoreU(hn::IfThenElse(along_x, near_axis, off_axis), d, u + i);
    hn::StoreU(hn::IfThenElse(along_x, off_axis, near_axis), d, v + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(scramble);
HWY_EXPORT(scramble_in_pixel);
HWY_EXPORT(square_to_disc);

void scramble_points(const uint32_t* sobol, size_t count, uint32_t seed, float* out) {
  HWY_DYNAMIC_DISPATCH(scramble)(sobol, count, seed, out);
}

void scramble_positions(const uint32_t* sobol, size_t count, uint32_t seed, float pixel,
                        float* out) {
  const float last = std::nextafter(pixel + 1.0f, -std::numeric_limits<float>::infinity());
  HWY_DYNAMIC_DISPATCH(scramble_in_pixel)(sobol, count, seed, pixel, last, out);
}

void warp_to_disc(float* u, float* v, size_t count) {
  HWY_DYNAMIC_DISPATCH(square_to_disc)(u, v, count);
}

}  // namespace tessera
#endif
