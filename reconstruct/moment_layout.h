#pragma once
/// Which sums of samples a frame keeps, and where they lie.

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/method.h"
#include "reconstruct/reconstruct.h"

namespace tessera {

/// Coordinates that samples are spread over. The first two are those of RayEffect.
enum class Blur : uint8_t { shadow, bounce, lens, motion };
inline constexpr size_t blur_count = 4;
constexpr bool of_rays(Blur blur) { return size_t(blur) < ray_effect_count; }

/// A product B_j(y along x) * B_k(y along y).
struct BasisPair {
  int j = 0, k = 0;
};

/// The sums of one coordinate: each pair of basis functions times each value.
struct MomentStack {
  Blur blur = Blur::shadow;
  std::vector<BasisPair> pairs;
  const ReconstructionMethod* method = nullptr;
  size_t first_factor = 0;  ///< among the carried channels, one factor a pair
  size_t first_value = 0, value_count = 0;
  size_t first_plane = 0;  ///< among Film::take_products()

  size_t plane(size_t pair, size_t value) const { return first_plane + pair * value_count + value; }
};

/// Values are carried channels: the colour without ray effects, 1, and for each effect what was
/// received (3 channels) and what would be without anything in the way (3 channels). Factors follow
/// them: 1, whether the sample's index is even, and the pairs of every coordinate.
///
/// Ray effects' own coordinates are summed for the values of the effect alone; lens and time for
/// all values, as they blur everything.
class MomentLayout {
 public:
  /// The method must outlive the layout.
  MomentLayout(const DistributionFeatures& features, const ReconstructionMethod& method);

  static constexpr size_t base = 0, one = 3;
  bool has(RayEffect effect) const { return effects_[size_t(effect)] > 0; }
  /// First of three values; the effect must be there.
  size_t received(RayEffect effect) const { return effects_[size_t(effect)]; }
  /// EffectValues::drawn; for bounces `unblocked` itself.
  size_t drawn(RayEffect effect) const { return effects_[size_t(effect)] + 3; }
  size_t unblocked(RayEffect effect) const {
    return effects_[size_t(effect)] + (effect == RayEffect::shadow ? 6 : 3);
  }

  size_t value_count() const { return value_count_; }
  size_t even_factor() const { return value_count_ + 1; }
  size_t carried_count() const { return carried_count_; }
  size_t plane_count() const { return plane_count_; }
  /// The plane of a value's mean, and of its mean over even samples times their share.
  size_t mean_plane(size_t value) const { return value; }
  size_t even_plane(size_t value) const { return value_count_ + value; }

  const std::vector<MomentStack>& stacks() const { return stacks_; }
  /// The stack of a coordinate, or null where the frame has none.
  const MomentStack* stack(Blur blur) const;
  std::vector<SampleProducts> products() const;

 private:
  void add_stack(Blur blur, size_t first_value, size_t values, const ReconstructionMethod& method);

  std::array<size_t, ray_effect_count> effects_{};  ///< place of the first value; 0: no effect
  size_t value_count_ = 4, carried_count_ = 0, plane_count_ = 0;
  std::vector<MomentStack> stacks_;
};

}  // namespace tessera
