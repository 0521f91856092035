#include "reconstruct/effect_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "reconstruct/guard.h"
#include "reconstruct/outliers.h"

namespace tessera {
namespace {

/// Weights that sum to less than this share of what they should make no average.
constexpr float least_normaliser = 0.02f;

class EffectFilter {
 public:
  explicit EffectFilter(const EffectFilterInput& input)
      : in_(input),
        layout_(*input.layout),
        planes_(*input.planes),
        width_(input.facts->rect().width()),
        height_(input.facts->rect().height()),
        pixels_(size_t(width_) * size_t(height_)) {}

  FilteredColors run() {
    choose_coordinates();
    filter_surfaces();
    FilteredColors out;
    out.base = through_lens(MomentLayout::base);
    for (size_t e = 0; e < ray_effect_count; ++e)
      if (layout_.has(RayEffect(e))) out.received[e] = filter_received(RayEffect(e));
    return out;
  }

 private:
  template <class Visit>
  void for_pixels(Visit visit) const {
    tbb::parallel_for(0, height_, [&](int y) {
      const size_t first = size_t(y) * size_t(width_);
      for (size_t p = first; p < first + size_t(width_); ++p) visit(p);
    });
  }
  const std::vector<float>& mean(size_t value) const { return planes_[layout_.mean_plane(value)]; }
  const std::vector<float>& even(size_t value) const { return planes_[layout_.even_plane(value)]; }
  const WedgePlanes& wedges(Blur blur) const { return in_.facts->wedges[size_t(blur)]; }
  StackFilterInput stack_input(Blur blur, const std::vector<float>* shared) const {
    return {layout_.stack(blur), in_.method, in_.planes, in_.facts, shared, in_.correlation, 1.0f};
  }

  void choose_coordinates();
  void filter_surfaces();
  std::vector<float> shared_surfaces() const;
  Planes through_lens(size_t value) const;
  void describe_plain(size_t value, Component& component) const;
  Planes filter_received(RayEffect effect) const;
  void describe_ratio(RayEffect effect, const StackFilterOutput& filtered, Component& out) const;
  std::vector<float> shared_ratios(RayEffect effect, const Component& ratio) const;
  Planes blend(const Component& component, const std::vector<float>* shared) const;

  const EffectFilterInput& in_;
  const MomentLayout& layout_;
  const Planes& planes_;
  int width_, height_;
  size_t pixels_;
  std::vector<uint8_t> along_motion_;  ///< [pixel] motion blurs more than the lens
  std::vector<float> surface_shift_;   ///< [pixel] least blur by lens or motion, pixels
  std::vector<float> shared_;          ///< of lens and motion
  StackFilterOutput lens_, motion_;    ///< of all values; empty where the frame has no such blur
};

void EffectFilter::choose_coordinates() {
  along_motion_.assign(pixels_, 0);
  surface_shift_.assign(pixels_, 0.0f);
  const bool lens = layout_.stack(Blur::lens), motion = layout_.stack(Blur::motion);
  for_pixels([&](size_t p) {
    const float by_lens = lens ? wedges(Blur::lens).sure_shift(p) : 0.0f;
    const float by_motion = motion ? wedges(Blur::motion).sure_shift(p) : 0.0f;
    along_motion_[p] = motion && (by_motion > by_lens || !lens);
    surface_shift_[p] = std::max(by_lens, by_motion);
  });
}

std::vector<float> EffectFilter::shared_surfaces() const {
  std::vector<float> value(pixels_), even_part(pixels_);
  for_pixels([&](size_t p) {
    const auto add = [&](size_t first) {
      for (size_t v = first; v < first + 3; ++v)
        value[p] += std::abs(mean(v)[p]), even_part[p] += std::abs(even(v)[p]);
    };
    add(MomentLayout::base);
    for (size_t e = 0; e < ray_effect_count; ++e)
      if (layout_.has(RayEffect(e)))
        add(layout_.received(RayEffect(e))), add(layout_.unblocked(RayEffect(e)));
  });
  return shared_pixels(value, even_part, width_, height_, in_.noise_spread);
}

/// What blurs all that is seen: lens and motion.
void EffectFilter::filter_surfaces() {
  const bool lens = layout_.stack(Blur::lens), motion = layout_.stack(Blur::motion);
  if (!lens && !motion) return;
  shared_ = shared_surfaces();
  if (lens) lens_ = filter_stack(stack_input(Blur::lens, &shared_));
  if (motion) motion_ = filter_lines(stack_input(Blur::motion, &shared_), along_motion_);
}

void EffectFilter::describe_plain(size_t value, Component& component) const {
  for_pixels([&](size_t p) {
    for (size_t c = 0; c < 3; ++c) {
      const Quotient q = halves_quotient(mean(value + c)[p], even(value + c)[p],
                                         mean(MomentLayout::one)[p], even(MomentLayout::one)[p]);
      component.plain[c][p] = mean(value + c)[p];
      component.variance[c][p] = q.variance;
    }
  });
}

/// Three values from `value` on, filtered along lens or motion; as they are where there is neither.
Planes EffectFilter::through_lens(size_t value) const {
  if (lens_.values.empty() && motion_.values.empty())
    return {mean(value), mean(value + 1), mean(value + 2)};
  Component component(width_, height_);
  describe_plain(value, component);
  for_pixels([&](size_t p) {
    const StackFilterOutput& from = along_motion_[p] ? motion_ : lens_;
    const float normaliser = from.values[MomentLayout::one][p];
    const bool usable = normaliser > least_normaliser;
    component.own_weight[p] = usable ? from.own_weight[p] / normaliser : 1.0f;
    for (size_t c = 0; c < 3; ++c) {
      const float plain = component.plain[c][p], filtered = from.values[value + c][p] / normaliser;
      const bool good = usable && std::isfinite(filtered);
      // Weights below 0 may overshoot an edge; light does not fall below 0.
      component.filtered[c][p] = !good ? plain : (plain >= 0 ? std::max(filtered, 0.0f) : filtered);
    }
  });
  return blend(component, &shared_);
}

Planes EffectFilter::blend(const Component& component, const std::vector<float>* shared) const {
  std::vector<float> shares;
  if (in_.method->guarded()) shares = filtered_shares(component, in_.correlation, shared);
  Planes out = component.plain;
  for_pixels([&](size_t p) {
    const float unguarded = !shared || (*shared)[p] != 0.0f ? 1.0f : 0.0f;
    const float share = shares.empty() ? unguarded : shares[p];
    if (share == 0.0f) return;
    for (size_t c = 0; c < 3; ++c)
      out[c][p] += share * (component.filtered[c][p] - component.plain[c][p]);
  });
  return out;
}

/// A ratio of shadows is at most 1, and lone lit samples in the dark are what filters are for: only
/// what would arrive unblocked can be an outlier there.
std::vector<float> EffectFilter::shared_ratios(RayEffect effect, const Component& ratio) const {
  std::vector<float> value(pixels_), even_part(pixels_);
  const bool bounded = effect == RayEffect::shadow;
  const size_t first = bounded ? layout_.unblocked(effect) : layout_.received(effect);
  for_pixels([&](size_t p) {
    for (size_t c = 0; c < 3; ++c) {
      const float sum = mean(first + c)[p];
      const float size = std::abs(bounded ? sum : ratio.plain[c][p]);
      value[p] += size;
      if (std::abs(sum) > smallest_divisor)
        even_part[p] += size * std::abs(even(first + c)[p] / sum);
    }
  });
  return shared_pixels(value, even_part, width_, height_, in_.noise_spread);
}

/// What arrived over what would unblocked, before and after filtering.
void EffectFilter::describe_ratio(RayEffect effect, const StackFilterOutput& filtered,
                                  Component& out) const {
  const size_t received = layout_.received(effect), unblocked = layout_.unblocked(effect);
  // No light is brighter than without what is in its way; what bounces may be as bright as it
  // likes.
  const float most = effect == RayEffect::shadow ? 1.0f : std::numeric_limits<float>::max();
  for_pixels([&](size_t p) {
    float own = 0;
    for (size_t c = 0; c < 3; ++c) {
      const float sum = mean(received + c)[p], divisor = mean(unblocked + c)[p];
      const Quotient plain =
          halves_quotient(sum, even(received + c)[p], divisor, even(unblocked + c)[p]);
      out.plain[c][p] = plain.value;
      out.variance[c][p] = plain.variance;
      out.filtered[c][p] = plain.value;
      const float normaliser = filtered.values[3 + c][p];
      const float ratio = filtered.values[c][p] / normaliser;
      if (!std::isfinite(ratio) || !(normaliser / divisor > least_normaliser)) continue;
      out.filtered[c][p] =
          plain.value >= 0 ? std::clamp(ratio, 0.0f, std::max(most, plain.value)) : ratio;
      own = std::max(own, filtered.own_weight[p] * (divisor / normaliser));
    }
    out.own_weight[p] = own;
  });
}

/// A ray effect's light: along its own coordinate or, where lens or motion blur more, along theirs.
Planes EffectFilter::filter_received(RayEffect effect) const {
  const Blur blur = Blur(effect);
  const size_t received = layout_.received(effect), unblocked = layout_.unblocked(effect);
  Component ratio(width_, height_);
  std::vector<float> shared;
  {
    const Planes empty(6, std::vector<float>(pixels_));
    describe_ratio(effect, {empty, std::vector<float>(pixels_)}, ratio);
    shared = shared_ratios(effect, ratio);
    describe_ratio(effect, filter_stack(stack_input(blur, &shared)), ratio);
  }
  const Planes own_ratio = blend(ratio, &shared);
  const Planes light = through_lens(unblocked);
  Planes out = through_lens(received);
  for_pixels([&](size_t p) {
    const float own_shift = wedges(blur).sure_shift(p);
    if (surface_shift_[p] > own_shift) return;
    for (size_t c = 0; c < 3; ++c) {
      if (!(std::abs(mean(unblocked + c)[p]) > smallest_divisor)) continue;
      // As it came where nothing changed it, without the rounding of a division.
      if (own_ratio[c][p] == ratio.plain[c][p] && light[c][p] == mean(unblocked + c)[p])
        out[c][p] = mean(received + c)[p];
      else
        out[c][p] = light[c][p] * own_ratio[c][p];
    }
  });
  return out;
}

}  // namespace

FilteredColors filter_effects(const EffectFilterInput& input) { return EffectFilter(input).run(); }

int effect_filter_margin() { return guard_reach + std::max(outlier_reach, facts_smoothing_reach); }

}  // namespace tessera
