/// Packing the chosen lanes of several vectors with one mask. Included once for each SIMD target.
///
/// Highway's CompressStore would do, but GCC copies its table of permutations to the stack at each
/// call on targets without a compress instruction, which here took most of the time.

#include "hide/compaction_table.h"

#if defined(TESSERA_HIDE_COMPACTION_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_COMPACTION_H_
#undef TESSERA_HIDE_COMPACTION_H_
#else
#define TESSERA_HIDE_COMPACTION_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

class Compaction {
 public:
  using FloatTag = hn::ScalableTag<float>;
  using UintTag = hn::RebindToUnsigned<FloatTag>;

  explicit HWY_INLINE Compaction(hn::Mask<FloatTag> mask)
      : mask_(mask), count_(hn::CountTrue(FloatTag(), mask)) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(FloatTag(), mask, bytes);
    bits_ = bytes[0];
  }
  size_t count() const { return count_; }

  /// Writes the chosen lanes to `to`; what follows them, up to a whole vector, is overwritten.
  HWY_INLINE void store(hn::Vec<FloatTag> v, float* to) const {
    const FloatTag d;
    hn::StoreU(packed(v), d, to);
  }
  HWY_INLINE void store(hn::Vec<UintTag> v, uint32_t* to) const {
    const UintTag du;
    hn::StoreU(hn::BitCast(du, packed(hn::BitCast(FloatTag(), v))), du, to);
  }

 private:
  HWY_INLINE hn::Vec<FloatTag> packed(hn::Vec<FloatTag> v) const {
#if HWY_TARGET <= HWY_AVX3
    return hn::Compress(v, mask_);
#elif HWY_TARGET == HWY_SCALAR
    return v;
#else
    const FloatTag d;
    const auto& lanes = compaction_table<hn::MaxLanes(d)>[bits_];
    return hn::TableLookupLanes(v, hn::SetTableIndices(d, lanes.data()));
#endif
  }

  hn::Mask<FloatTag> mask_;
  size_t count_, bits_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
