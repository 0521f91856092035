#include "hide/fragment_buffer.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/error.h"
#include "hide/resolve.h"

namespace tessera {
namespace {

constexpr float unseen = std::numeric_limits<float>::infinity();

}  // namespace

void TriangleIds::set(std::span<const HideGrid> grids) {
  uint64_t triangles = 2;
  for (const HideGrid& g : grids)
    triangles = std::max(triangles, uint64_t(2) * uint64_t(g.grid->micropolygon_count()));
  bits_ = std::bit_width(triangles - 1);
  if (grids.size() > (uint64_t(1) << 32) >> bits_)
    throw Error(fmt::format("a bucket holds {} grids of up to {} triangles; expected at most {}",
                            grids.size(), triangles, (uint64_t(1) << 32) >> bits_));
}

void FragmentBuffer::begin(const HideInput& input) {
  ids_.set(input.grids);
  const size_t count = padded(input.samples->size()) + simd_padding;
  z_.assign(count, unseen);
  id_.resize(count), b1_.resize(count), b2_.resize(count);
  nodes_.clear();
  head_.clear();
  if (input.features.transparency) head_.assign(count, 0);
}

void FragmentBuffer::resolve(const HideInput& input, FragmentList& out) {
  if (nodes_.empty()) {
    resolve_opaque({z_.data(), b1_.data(), b2_.data(), id_.data()}, ids_, input, out);
    return;
  }
  resolve_lists(input, out);
}

void FragmentBuffer::resolve_lists(const HideInput& input, FragmentList& out) {
  out.clear();
  const size_t count = input.samples->size();
  const float weight = 1.0f / float(input.samples->samples_per_pixel);
  const auto emit = [&](size_t sample, float z, float b1, float b2, uint32_t id) {
    out.sample.push_back(uint32_t(sample));
    out.grid.push_back(ids_.grid(id)), out.triangle.push_back(ids_.triangle(id));
    out.b1.push_back(b1), out.b2.push_back(b2), out.z.push_back(z);
    out.weight.push_back(weight);
  };
  const auto before = [](const Node& a, const Node& b) {
    return a.z < b.z || (a.z == b.z && a.id < b.id);
  };
  out.first_of_sample.resize(count + 1);
  for (size_t s = 0; s < count; ++s) {
    out.first_of_sample[s] = uint32_t(out.size());
    const Node opaque{z_[s], b1_[s], b2_[s], id_[s], 0};
    sorted_.clear();
    for (uint32_t n = head_[s]; n != 0; n = nodes_[n - 1].next)
      if (opaque.z == unseen || before(nodes_[n - 1], opaque)) sorted_.push_back(nodes_[n - 1]);
    std::sort(sorted_.begin(), sorted_.end(), before);
    for (const Node& n : sorted_) emit(s, n.z, n.b1, n.b2, n.id);
    if (opaque.z != unseen) emit(s, opaque.z, opaque.b1, opaque.b2, opaque.id);
  }
  out.first_of_sample[count] = uint32_t(out.size());
}

}  // namespace tessera
