#include "reconstruct/sample_moments.h"

#include <algorithm>

namespace tessera {
namespace {

/// A sample's coordinate along an axis; 0 for one that is not a number.
float coordinate(float y) {
  return y == y ? std::clamp(y, -farthest_coordinate, farthest_coordinate) : 0.0f;
}

/// Colour without ray effects, 1, and the parts of each effect.
void carry_values(const MomentLayout& layout, size_t color_group, const SampleValues& values,
                  float* carried) {
  const size_t samples = values.x.size();
  float* base = carried + MomentLayout::base * samples;
  std::copy_n(values.groups[color_group].data(), 3 * samples, base);
  std::fill_n(carried + MomentLayout::one * samples, samples, 1.0f);
  for (size_t e = 0; e < ray_effect_count; ++e) {
    const EffectValues& effect = values.distribution.effects[e];
    if (!layout.has(RayEffect(e)) || effect.empty()) continue;
    for (size_t c = 0; c < 3; ++c) {
      const std::vector<float>&received = effect.received[c], &unblocked = effect.unblocked[c];
      for (size_t s = 0; s < samples; ++s) base[c * samples + s] -= received[s];
      std::copy(received.begin(), received.end(),
                carried + (layout.received(RayEffect(e)) + c) * samples);
      std::copy(unblocked.begin(), unblocked.end(),
                carried + (layout.unblocked(RayEffect(e)) + c) * samples);
      if (RayEffect(e) != RayEffect::shadow) continue;
      const std::vector<float>& drawn = effect.drawn[c].empty() ? unblocked : effect.drawn[c];
      std::copy(drawn.begin(), drawn.end(), carried + (layout.drawn(RayEffect(e)) + c) * samples);
    }
  }
}

/// The two axes' coordinates of a sample; null where the bucket has none (taken as 0).
struct Coordinates {
  const float* axis[2] = {nullptr, nullptr};
  float scale = 1, shift = 0;  ///< y = scale * value + shift
  float at(size_t a, size_t sample) const {
    return axis[a] ? coordinate(scale * axis[a][sample] + shift) : 0.0f;
  }
};

const float* data_or_null(const std::vector<float>& values) {
  return values.empty() ? nullptr : values.data();
}

Coordinates coordinates_of(Blur blur, const DistributionSamples& d, const SampleSpreads& spreads) {
  switch (blur) {
    case Blur::lens:
      return {{data_or_null(d.u), data_or_null(d.v)}, 1.0f / spreads.lens, 0.0f};
    case Blur::motion:
      return {{data_or_null(d.t), nullptr}, 1.0f / spreads.time, -0.5f / spreads.time};
    default: {
      const EffectValues& effect = d.effects[size_t(blur)];
      return {{data_or_null(effect.y[0]), data_or_null(effect.y[1])}};
    }
  }
}

/// Writes the factors of one stack, pixel by pixel.
class FactorWriter {
 public:
  FactorWriter(const MomentStack& stack, const PixelFacts& facts, const SampleSpreads& spreads,
               SampleValues& values)
      : stack_(stack),
        facts_(facts),
        samples_(values.x.size()),
        own_(coordinates_of(stack.blur, values.distribution, spreads)),
        second_(coordinates_of(Blur::lens, values.distribution, spreads)),
        factors_(values.carried.data() + stack.first_factor * samples_) {}

  void write(size_t pixel, size_t first, size_t end) {
    BasisPoint at[2];
    const bool motion = stack_.blur == Blur::motion;
    const size_t axes = motion ? 1 : 2;
    const WedgePlanes& own = facts_.wedges[size_t(stack_.blur)];
    const WedgePlanes& lens = facts_.wedges[size_t(Blur::lens)];
    const bool second = of_rays(stack_.blur) && !lens.empty();
    for (size_t a = 0; a < axes; ++a) {
      at[a].wedge = motion ? blur_line(own, pixel).wedge : own.axis(a, pixel);
      if (second) at[a].second_wedge = lens.axis(a, pixel);
    }
    for (size_t s = first; s < end; ++s) {
      for (size_t a = 0; a < axes; ++a) {
        at[a].y = own_.at(a, s);
        if (second) at[a].second_y = second_.at(a, s);
        stack_.method->basis(at[a], basis_[a]);
      }
      if (motion) basis_[1][0] = 1.0f;
      for (size_t p = 0; p < stack_.pairs.size(); ++p)
        factors_[p * samples_ + s] = basis_[0][stack_.pairs[p].j] * basis_[1][stack_.pairs[p].k];
    }
  }

 private:
  const MomentStack& stack_;
  const PixelFacts& facts_;
  size_t samples_;
  Coordinates own_, second_;
  float* factors_;
  float basis_[2][ReconstructionMethod::max_basis];
};

template <class Visit>
void for_pixels(const SampleValues& values, Visit visit) {
  size_t p = 0;
  for (int y = values.rect.y0; y < values.rect.y1; ++y)
    for (int x = values.rect.x0; x < values.rect.x1; ++x, ++p) {
      const size_t spp = size_t(values.samples_per_pixel);
      const bool regular = values.first_of_pixel.empty();
      visit(x, y, regular ? p * spp : values.first_of_pixel[p],
            regular ? (p + 1) * spp : values.first_of_pixel[p + 1]);
    }
}

}  // namespace

void carry_moments(const MomentLayout& layout, const PixelFacts& facts, size_t color_group,
                   const SampleSpreads& spreads, SampleValues& values) {
  const size_t samples = values.x.size();
  values.carried.assign(layout.carried_count() * samples, 0.0f);
  carry_values(layout, color_group, values, values.carried.data());
  float* ones = values.carried.data() + layout.value_count() * samples;
  std::fill_n(ones, samples, 1.0f);
  float* even = values.carried.data() + layout.even_factor() * samples;
  for_pixels(values, [&](int, int, size_t first, size_t end) {
    for (size_t s = first; s < end; s += 2) even[s] = 1.0f;
  });
  for (const MomentStack& stack : layout.stacks()) {
    FactorWriter writer(stack, facts, spreads, values);
    for_pixels(values, [&](int x, int y, size_t first, size_t end) {
      writer.write(facts.index(x, y), first, end);
    });
  }
}

}  // namespace tessera
