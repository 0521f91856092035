#include "reconstruct/moment_layout.h"

#include <fmt/format.h>

#include "base/error.h"

namespace tessera {
namespace {

/// Time is one axis: its second function is always the first one, which is left out by factor 1.
std::vector<BasisPair> basis_pairs(Blur blur, const ReconstructionMethod& method) {
  std::vector<BasisPair> pairs;
  const int count = method.basis_count();
  for (int j = 0; j < count; ++j)
    for (int k = 0; k < (blur == Blur::motion ? 1 : count); ++k)
      if (blur == Blur::motion || method.degree(j) + method.degree(k) <= method.max_degree())
        pairs.push_back({j, k});
  return pairs;
}

}  // namespace

MomentLayout::MomentLayout(const DistributionFeatures& features,
                           const ReconstructionMethod& method) {
  for (size_t e = 0; e < ray_effect_count; ++e) {
    if (!(RayEffect(e) == RayEffect::shadow ? features.shadow : features.bounce)) continue;
    effects_[e] = value_count_;
    value_count_ += RayEffect(e) == RayEffect::shadow ? 9 : 6;
  }
  carried_count_ = value_count_ + 2;
  plane_count_ = 2 * value_count_;
  for (size_t e = 0; e < ray_effect_count; ++e)
    if (has(RayEffect(e)))
      add_stack(Blur(e), effects_[e], 6,
                RayEffect(e) == RayEffect::bounce ? method.for_bounces() : method);
  if (features.lens) add_stack(Blur::lens, 0, value_count_, method);
  if (features.motion) add_stack(Blur::motion, 0, value_count_, method);
}

void MomentLayout::add_stack(Blur blur, size_t first_value, size_t values,
                             const ReconstructionMethod& method) {
  MomentStack& stack = stacks_.emplace_back();
  stack.blur = blur;
  stack.pairs = basis_pairs(blur, method);
  stack.method = &method;
  stack.first_factor = carried_count_;
  stack.first_value = first_value, stack.value_count = values;
  stack.first_plane = plane_count_;
  carried_count_ += stack.pairs.size();
  plane_count_ += stack.pairs.size() * values;
}

const MomentStack* MomentLayout::stack(Blur blur) const {
  for (const MomentStack& stack : stacks_)
    if (stack.blur == blur) return &stack;
  return nullptr;
}

std::vector<SampleProducts> MomentLayout::products() const {
  std::vector<SampleProducts> products{{value_count_, 2, 0, value_count_}};
  for (const MomentStack& stack : stacks_)
    products.push_back(
        {stack.first_factor, stack.pairs.size(), stack.first_value, stack.value_count});
  return products;
}

}  // namespace tessera
