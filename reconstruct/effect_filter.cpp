#include "reconstruct/effect_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "reconstruct/guard.h"
#include "reconstruct/outliers.h"
#include "reconstruct/place_gain.h"

namespace tessera {
namespace {

/// Weights that sum to less than this share of what they should make no average.
constexpr float least_normaliser = 0.02f;
/// The same where weights of samples cancel: light that was drawn, as a share of what would arrive.
constexpr float least_steady = 0.25f;

/// Wedges that guarded methods try, as shares of the way from the least shift to the largest:
/// slopes that were met are no sign of how often they were.
constexpr float candidate_widths[] = {1.0f, 0.25f};

/// What lens or motion blur, filtered: of all values.
struct SurfaceFilter {
  StackFilterOutput lens, motion;  ///< empty where the frame has no such blur
  const StackFilterOutput& at(bool along_motion) const { return along_motion ? motion : lens; }
};

/// Filtered sums of what arrived of an effect: three values from `first` on, then three of what
/// would have unblocked.
struct RatioSource {
  const StackFilterOutput* output;
  size_t first;
};

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
  StackFilterInput stack_input(Blur blur, const std::vector<float>* shared, float width) const {
    return {layout_.stack(blur), in_.planes, in_.facts, shared, in_.correlation, width};
  }

  void choose_coordinates();
  void filter_surfaces();
  std::vector<float> shared_surfaces() const;
  Planes through_lens(size_t value) const;
  void describe_plain(size_t value, Component& component) const;
  Planes filter_received(RayEffect effect) const;
  void describe_ratio(RayEffect effect, Component& out) const;
  template <class Source>
  void add_ratio(RayEffect effect, const Source& source, Component& component) const;
  Planes gain_of(RayEffect effect) const;
  bool divides(float drawn, float wanted) const;
  void fill_unknown(RayEffect effect, Component& ratio) const;
  bool steady(RayEffect effect, size_t p) const;
  float least_weight() const { return in_.cancels ? least_steady : least_normaliser; }
  std::vector<float> shared_ratios(RayEffect effect, const Component& ratio) const;
  Planes blend(const Component& component, const std::vector<float>* shared) const;

  const EffectFilterInput& in_;
  const MomentLayout& layout_;
  const Planes& planes_;
  int width_, height_;
  size_t pixels_;
  std::vector<uint8_t> along_motion_;    ///< [pixel] motion blurs more than the lens
  std::vector<float> surface_shift_;     ///< [pixel] least blur by lens or motion, pixels
  std::vector<float> shared_;            ///< of lens and motion
  std::vector<SurfaceFilter> surfaces_;  ///< one a candidate; none without lens and motion
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
  const size_t count = in_.method->guarded() ? std::size(candidate_widths) : 1;
  for (size_t k = 0; k < count; ++k) {
    SurfaceFilter& filter = surfaces_.emplace_back();
    const float width = candidate_widths[k];
    if (lens) filter.lens = filter_stack(stack_input(Blur::lens, &shared_, width));
    if (motion)
      filter.motion = filter_lines(stack_input(Blur::motion, &shared_, width), along_motion_);
  }
}

void EffectFilter::describe_plain(size_t value, Component& component) const {
  for_pixels([&](size_t p) {
    for (size_t c = 0; c < 3; ++c) {
      const Quotient q = halves_quotient(mean(value + c)[p], even(value + c)[p],
                                         mean(MomentLayout::one)[p], even(MomentLayout::one)[p]);
      component.plain[c][p] = mean(value + c)[p];
      component.deviation[c][p] = q.deviation;
    }
  });
}

/// Three values from `value` on, filtered along lens or motion; as they are where there is neither.
Planes EffectFilter::through_lens(size_t value) const {
  if (surfaces_.empty()) return {mean(value), mean(value + 1), mean(value + 2)};
  Component component(width_, height_);
  describe_plain(value, component);
  for (const SurfaceFilter& filter : surfaces_) {
    Candidate& candidate = component.candidates.emplace_back(Candidate{component.plain, {}});
    candidate.own_weight.resize(pixels_);
    for_pixels([&](size_t p) {
      const StackFilterOutput& from = filter.at(along_motion_[p]);
      const float normaliser = from.values[MomentLayout::one][p];
      const bool usable = normaliser > least_weight();
      candidate.own_weight[p] = usable ? from.own_weight[p] / normaliser : 1.0f;
      for (size_t c = 0; c < 3 && usable; ++c) {
        const float filtered = from.values[value + c][p] / normaliser;
        // Weights below 0 may overshoot an edge; light does not fall below 0.
        if (std::isfinite(filtered))
          candidate.filtered[c][p] =
              component.plain[c][p] >= 0 ? std::max(filtered, 0.0f) : filtered;
      }
    });
  }
  return blend(component, &shared_);
}

Planes EffectFilter::blend(const Component& component, const std::vector<float>* shared) const {
  std::vector<std::vector<float>> shares;
  if (in_.method->guarded()) {
    shares = filtered_shares(component, in_.correlation, shared);
  } else {
    shares.emplace_back(shared ? *shared : std::vector<float>(pixels_, 1.0f));
  }
  Planes out = component.plain;
  for_pixels([&](size_t p) {
    for (size_t k = 0; k < shares.size(); ++k) {
      const float share = shares[k][p];
      if (share == 0.0f) continue;
      for (size_t c = 0; c < 3; ++c)
        out[c][p] += share * (component.candidates[k].filtered[c][p] - component.plain[c][p]);
    }
  });
  return out;
}

/// Whether what samples drew of the light that is wanted is enough to divide by.
bool EffectFilter::divides(float drawn, float wanted) const {
  if (!(std::abs(wanted) > smallest_divisor)) return false;
  return !in_.cancels || drawn / wanted > least_steady;
}

/// The same of all channels of a pixel, where there is light.
bool EffectFilter::steady(RayEffect effect, size_t p) const {
  if (!in_.cancels) return true;
  const size_t drawn = layout_.drawn(effect), unblocked = layout_.unblocked(effect);
  for (size_t c = 0; c < 3; ++c) {
    const float wanted = mean(unblocked + c)[p];
    if (std::abs(wanted) > smallest_divisor && !divides(mean(drawn + c)[p], wanted)) return false;
  }
  return true;
}

/// Where no sample of a pixel drew a place that lights it, nothing is known of its own ratio, and
/// it is that of the others.
void EffectFilter::fill_unknown(RayEffect effect, Component& ratio) const {
  const size_t drawn = layout_.drawn(effect);
  for_pixels([&](size_t p) {
    for (size_t c = 0; c < 3; ++c) {
      if (std::abs(mean(drawn + c)[p]) > smallest_divisor) continue;
      ratio.plain[c][p] = ratio.candidates.front().filtered[c][p];
      ratio.deviation[c][p] = -1.0f;
    }
  });
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
  std::vector<float> shared = shared_pixels(value, even_part, width_, height_, in_.noise_spread);
  for_pixels([&](size_t p) {
    if (!steady(effect, p)) shared[p] = 0.0f;
  });
  return shared;
}

/// What arrived over what would from the same places, unfiltered.
void EffectFilter::describe_ratio(RayEffect effect, Component& out) const {
  const size_t received = layout_.received(effect), drawn = layout_.drawn(effect);
  for_pixels([&](size_t p) {
    for (size_t c = 0; c < 3; ++c) {
      const Quotient plain = halves_quotient(mean(received + c)[p], even(received + c)[p],
                                             mean(drawn + c)[p], even(drawn + c)[p]);
      out.plain[c][p] = plain.value;
      out.deviation[c][p] = plain.deviation;
    }
  });
}

/// The ratio of filtered sums that `source(p)` names for each pixel.
template <class Source>
void EffectFilter::add_ratio(RayEffect effect, const Source& source, Component& component) const {
  const size_t drawn = layout_.drawn(effect);
  // No light is brighter than without what is in its way; what bounces may be as bright as it
  // likes.
  const float most = effect == RayEffect::shadow ? 1.0f : std::numeric_limits<float>::max();
  Candidate& candidate = component.candidates.emplace_back(Candidate{component.plain, {}});
  candidate.own_weight.assign(pixels_, 1.0f);
  for_pixels([&](size_t p) {
    const auto [filtered, first] = source(p);
    float own = 0;
    for (size_t c = 0; c < 3; ++c) {
      const float plain = component.plain[c][p], divisor = mean(drawn + c)[p];
      const float normaliser = filtered->values[first + 3 + c][p];
      const float ratio = filtered->values[first + c][p] / normaliser;
      if (!std::isfinite(ratio) || !(normaliser / divisor > least_weight())) continue;
      candidate.filtered[c][p] =
          plain >= 0 ? std::clamp(ratio, 0.0f, std::max(most, plain)) : ratio;
      own = std::max(own, filtered->own_weight[p] * (divisor / normaliser));
    }
    candidate.own_weight[p] = own;
  });
}

Planes EffectFilter::gain_of(RayEffect effect) const {
  std::array<std::array<const float*, 3>, 2> sums, even_sums;
  const size_t first[2] = {layout_.drawn(effect), layout_.unblocked(effect)};
  for (size_t k = 0; k < 2; ++k)
    for (size_t c = 0; c < 3; ++c)
      sums[k][c] = mean(first[k] + c).data(), even_sums[k][c] = even(first[k] + c).data();
  return place_gain(sums, even_sums, *in_.facts, in_.correlation);
}

/// A ray effect's light: what would arrive, through lens and motion, times the ratio that does.
/// Guarded methods choose between its own coordinate and those of lens and motion; others take the
/// one that blurs more for sure.
Planes EffectFilter::filter_received(RayEffect effect) const {
  const Blur blur = Blur(effect);
  const size_t received = layout_.received(effect), drawn = layout_.drawn(effect);
  Component ratio(width_, height_);
  describe_ratio(effect, ratio);
  const std::vector<float> shared = shared_ratios(effect, ratio);
  const auto surface = [&](const SurfaceFilter& filter, size_t p) {
    return RatioSource{&filter.at(along_motion_[p]), received};
  };
  if (in_.method->guarded()) {
    for (const float width : candidate_widths) {
      const StackFilterOutput own = filter_stack(stack_input(blur, &shared, width));
      add_ratio(
          effect,
          [&](size_t) {
            return RatioSource{&own, 0};
          },
          ratio);
    }
    for (const SurfaceFilter& filter : surfaces_)
      add_ratio(
          effect, [&](size_t p) { return surface(filter, p); }, ratio);
  } else {
    const StackFilterOutput own = filter_stack(stack_input(blur, &shared, 1.0f));
    const auto strongest = [&](size_t p) {
      return surface_shift_[p] > wedges(blur).sure_shift(p) ? surface(surfaces_.front(), p)
                                                            : RatioSource{&own, 0};
    };
    add_ratio(effect, strongest, ratio);
  }
  fill_unknown(effect, ratio);
  const Planes own_ratio = blend(ratio, &shared);
  const Planes light = through_lens(layout_.unblocked(effect));
  const Planes gain = effect == RayEffect::shadow ? gain_of(effect) : Planes();
  Planes out{mean(received), mean(received + 1), mean(received + 2)};
  for_pixels([&](size_t p) {
    for (size_t c = 0; c < 3 && steady(effect, p); ++c)
      if (divides(mean(drawn + c)[p], light[c][p]))
        out[c][p] = light[c][p] * own_ratio[c][p] * (gain.empty() ? 1.0f : gain[c][p]);
  });
  return out;
}

}  // namespace

FilteredColors filter_effects(const EffectFilterInput& input) { return EffectFilter(input).run(); }

size_t effect_filter_planes(const MomentLayout& layout, const ReconstructionMethod& method) {
  const size_t widths = method.guarded() ? std::size(candidate_widths) : 1;
  const auto outputs = [&](Blur blur) {
    const MomentStack* stack = layout.stack(blur);
    return stack ? stack->value_count + 1 : 0;
  };
  const size_t of_surfaces = outputs(Blur::lens) + outputs(Blur::motion);
  const size_t of_rays = std::max(outputs(Blur::shadow), outputs(Blur::bounce));
  // A ratio, the light that it is of and their gain, each with its noise and its candidates.
  const size_t candidates = 2 * widths, component = 6 + 4 * candidates + 2 * candidates;
  return widths * of_surfaces + of_rays + 2 * component + 16;
}

int effect_filter_margin() { return guard_reach + std::max(outlier_reach, facts_smoothing_reach); }

}  // namespace tessera
