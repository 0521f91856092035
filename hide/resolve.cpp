#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/resolve.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/compaction.h"
#include "hide/fragment_buffer.h"
#include "hide/resolve.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Copies the hits that exist into the arrays of `out`, which have room for all samples and a
/// vector more. Whole vectors of hits, the common case, are copied as such; the gaps in
/// the others are closed. Returns the number of fragments.
size_t compact_hits(const OpaqueHits& hits, const TriangleIds& ids, size_t samples, float weight,
                    FragmentList& out) {
  const hn::ScalableTag<float> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const size_t lanes = hn::Lanes(d);
  const auto infinity = hn::Inf(d);
  const int bits = ids.bits();
  const auto triangle_bits = hn::Set(du, uint32_t((uint64_t(1) << bits) - 1));
  size_t count = 0;
  for (size_t i = 0; i < samples; i += lanes) {
    const auto z = hn::LoadU(d, hits.z + i);
    const auto seen = hn::And(hn::Lt(z, infinity), hn::FirstN(d, samples - i));
    const auto sample = hn::Iota(du, uint32_t(i));
    const auto id = hn::LoadU(du, hits.id + i);
    const auto grid = bits < 32 ? hn::ShiftRightSame(id, bits) : hn::Zero(du);
    const auto triangle = hn::And(id, triangle_bits);
    const auto b1 = hn::LoadU(d, hits.b1 + i), b2 = hn::LoadU(d, hits.b2 + i);
    // first_of_sample[i + k]: fragments before it, counting the seen lanes below k.
    if (hn::AllTrue(d, seen)) {
      hn::StoreU(hn::Iota(du, uint32_t(count)), du, out.first_of_sample.data() + i);
      hn::StoreU(sample, du, out.sample.data() + count);
      hn::StoreU(grid, du, out.grid.data() + count);
      hn::StoreU(triangle, du, out.triangle.data() + count);
      hn::StoreU(b1, d, out.b1.data() + count);
      hn::StoreU(b2, d, out.b2.data() + count);
      hn::StoreU(z, d, out.z.data() + count);
      hn::StoreU(hn::Set(d, weight), d, out.weight.data() + count);
      count += lanes;
      continue;
    }
    size_t first = count;
    for (size_t k = 0; k < lanes && i + k < samples; ++k) {
      out.first_of_sample[i + k] = uint32_t(first);
      first += hits.z[i + k] < hwy::HighestValue<float>();
    }
    if (first == count) continue;
    const Compaction kept(seen);
    kept.store(sample, out.sample.data() + count);
    kept.store(grid, out.grid.data() + count);
    kept.store(triangle, out.triangle.data() + count);
    kept.store(b1, out.b1.data() + count);
    kept.store(b2, out.b2.data() + count);
    kept.store(z, out.z.data() + count);
    kept.store(hn::Set(d, weight), out.weight.data() + count);
    count = first;
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(compact_hits);

namespace {

/// Resizing to the number of samples and back, not clearing, so that arrays which stay about as
/// long from bucket to bucket are not zeroed each time.
void resize_fragments(FragmentList& list, size_t count) {
  for (auto* a : {&list.sample, &list.grid, &list.triangle}) a->resize(count);
  for (auto* a : {&list.b1, &list.b2, &list.z, &list.weight}) a->resize(count);
}

}  // namespace

void resolve_opaque(const OpaqueHits& hits, const TriangleIds& ids, const HideInput& input,
                    FragmentList& out) {
  const size_t samples = input.samples->size();
  resize_fragments(out, samples + simd_padding);
  out.first_of_sample.resize(samples + simd_padding);
  const float weight = 1.0f / float(input.samples->samples_per_pixel);
  const size_t count = HWY_DYNAMIC_DISPATCH(compact_hits)(hits, ids, samples, weight, out);
  resize_fragments(out, count);
  out.first_of_sample.resize(samples + 1);
  out.first_of_sample[samples] = uint32_t(count);
}

}  // namespace tessera
#endif
