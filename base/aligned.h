#pragma once
/// Storage for structure-of-arrays data that SIMD kernels read in whole vectors.

#include <cstddef>
#include <new>
#include <vector>

namespace tessera {

/// Every structure-of-arrays run is padded to a multiple of this many floats (one AVX-512 vector),
/// so that kernels need no scalar tail whatever the target.
inline constexpr size_t simd_padding = 16;

constexpr size_t padded(size_t count) {
  return (count + simd_padding - 1) / simd_padding * simd_padding;
}

/// Allocator with cache-line alignment.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, size_t) { ::operator delete(p, alignment); }
  bool operator==(const AlignedAllocator&) const { return true; }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace tessera
