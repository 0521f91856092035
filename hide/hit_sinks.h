/// Where the hits of the sample test go. Included once for each SIMD target, after coverage.h.

#include "hide/fragment_buffer.h"

#if defined(TESSERA_HIDE_HIT_SINKS_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_HIT_SINKS_H_
#undef TESSERA_HIDE_HIT_SINKS_H_
#else
#define TESSERA_HIDE_HIT_SINKS_H_
#endif

#include "hide/coverage.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// Opaque hits on the samples i, i + 1, ... Micropolygons come in order of their ids, so on equal
/// depth what is there stays. A blend and a whole store are faster than a masked store, and nobody
/// else writes to the bucket.
HWY_INLINE void store_opaque(const Hit& hit, size_t i, uint32_t id0, FragmentBuffer& buffer) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  const FloatVec z = hn::LoadU(d, buffer.z() + i);
  const FloatMask nearer = hn::And(hit.mask, hn::Lt(hit.z, z));
  if (hn::AllFalse(d, nearer)) return;
  const auto blend = [&](FloatVec value, float* to) HWY_ATTR {
    hn::StoreU(hn::IfThenElse(nearer, value, hn::LoadU(d, to)), d, to);
  };
  hn::StoreU(hn::IfThenElse(nearer, hit.z, z), d, buffer.z() + i);
  blend(hit.b1, buffer.b1() + i);
  blend(hit.b2, buffer.b2() + i);
  const auto one = hn::IfThenElseZero(hn::RebindMask(du, hit.triangle1), hn::Set(du, 1u));
  const auto id = hn::Add(hn::Set(du, id0), one);
  uint32_t* ids = buffer.id() + i;
  hn::StoreU(hn::IfThenElse(hn::RebindMask(du, nearer), id, hn::LoadU(du, ids)), du, ids);
}

/// Calls put(lane, z, b1, b2, triangle) for each lane that is hit.
template <class Put>
HWY_INLINE void for_each_hit(const Hit& hit, const Put& put) {
  const FloatTag d;
  if (hn::AllFalse(d, hit.mask)) return;
  constexpr size_t kMax = 16;
  HWY_ALIGN float z[kMax], b1[kMax], b2[kMax];
  uint8_t hits[8] = {}, second[8] = {};
  hn::StoreMaskBits(d, hit.mask, hits);
  hn::StoreMaskBits(d, hit.triangle1, second);
  hn::Store(hit.z, d, z), hn::Store(hit.b1, d, b1), hn::Store(hit.b2, d, b2);
  uint32_t pending = uint32_t(hits[0] | hits[1] << 8);
  const uint32_t triangle = uint32_t(second[0] | second[1] << 8);
  for (; pending != 0; pending &= pending - 1) {
    const auto lane = size_t(__builtin_ctz(pending));
    put(lane, z[lane], b1[lane], b2[lane], triangle >> lane & 1u);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
