#pragma once
/// What the samples of a bucket have seen so far: the nearest opaque hit of each, and, where there
/// is transparency, a list of the non-opaque hits in front of it.

#include <cstdint>
#include <vector>

#include "base/aligned.h"
#include "hide/hide.h"

namespace tessera {

/// Names a triangle within a bucket: (index of its grid, triangle) packed so that ids order as the
/// pairs do.
class TriangleIds {
 public:
  /// Room for the triangles of the largest grid. Throws Error if 32 bits cannot name them all.
  void set(std::span<const HideGrid> grids);
  uint32_t id(size_t grid, uint32_t triangle) const { return uint32_t(grid << bits_) | triangle; }
  int bits() const { return bits_; }  ///< of the triangle number
  uint32_t grid(uint32_t id) const { return uint32_t(uint64_t(id) >> bits_); }
  uint32_t triangle(uint32_t id) const { return id & uint32_t((uint64_t(1) << bits_) - 1); }

 private:
  int bits_ = 1;
};

class FragmentBuffer {
 public:
  struct Node {
    float z, b1, b2;
    uint32_t id, next;
  };

  /// Empties the buffer for the samples and grids of `input`.
  void begin(const HideInput& input);

  const TriangleIds& ids() const { return ids_; }

  /// Nearest opaque hit, [sample] and padding to a whole vector past any of them: depth (infinity:
  /// none), then triangle id and barycentrics, which mean nothing where the depth is infinite.
  float* z() { return z_.data(); }
  const float* z() const { return z_.data(); }
  uint32_t* id() { return id_.data(); }
  float* b1() { return b1_.data(); }
  float* b2() { return b2_.data(); }

  /// Records an opaque hit, if it is nearer than what is there or, at the same depth, earlier.
  void put(size_t sample, float z, float b1, float b2, uint32_t id) {
    if (z > z_[sample] || (z == z_[sample] && id > id_[sample])) return;
    z_[sample] = z, b1_[sample] = b1, b2_[sample] = b2, id_[sample] = id;
  }
  /// Records a non-opaque hit, unless something opaque is known to be in front of it.
  void add(size_t sample, float z, float b1, float b2, uint32_t id) {
    if (z > z_[sample]) return;
    nodes_.push_back({z, b1, b2, id, head_[sample]});
    head_[sample] = uint32_t(nodes_.size());
  }

  /// Writes the visible fragments, front to back within a sample.
  void resolve(const HideInput& input, FragmentList& out);

 private:
  void resolve_lists(const HideInput& input, FragmentList& out);

  TriangleIds ids_;
  AlignedVector<float> z_, b1_, b2_;
  AlignedVector<uint32_t> id_;
  std::vector<uint32_t> head_;  // [sample]: 1 + index of its last node; empty without transparency
  std::vector<Node> nodes_;
  std::vector<Node> sorted_;
};

}  // namespace tessera
