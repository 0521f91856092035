#include "shade/light_terms.h"

#include <algorithm>
#include <cmath>

#include "shade/fragment_points.h"
#include "shade/mathematics.h"
#include "shade/sample_places.h"

namespace tessera {
namespace {

using Term = std::array<std::vector<float>, 3>;

bool is_zero(const Term& term, size_t fragment) {
  return term[0][fragment] == 0.0f && term[1][fragment] == 0.0f && term[2][fragment] == 0.0f;
}

/// Which fragments of a bucket share a shadow look-up.
struct LookUps {
  struct User {
    uint32_t look_up, fragment;
    auto operator<=>(const User&) const = default;
  };
  std::vector<uint32_t> at;  ///< [look-up] the fragment it is made at
  std::vector<User> users;   ///< by look-up
};

LookUps each_fragment(const Term& term) {
  LookUps result;
  for (uint32_t f = 0; f < term[0].size(); ++f) {
    if (is_zero(term, f)) continue;
    result.users.push_back({uint32_t(result.at.size()), f});
    result.at.push_back(f);
  }
  return result;
}

/// Squared distance of the fragment's sample from the middle of its pixel.
float off_centre(const SampleBlock& samples, size_t sample) {
  const float x = samples.x[sample], y = samples.y[sample];
  const float dx = x - std::floor(x) - 0.5f, dy = y - std::floor(y) - 0.5f;
  return dx * dx + dy * dy;
}

/// Fragments are ordered by sample, and with that by pixel. Of those of a grid in a pixel the one
/// nearest the middle looks up for all, the first of equals.
LookUps each_grid_of_pixel(const ShadeInput& input, const Term& term) {
  LookUps result;
  const FragmentList& fragments = *input.fragments;
  const auto samples_per_pixel = uint32_t(input.samples->samples_per_pixel);
  uint32_t pixel = 0;
  size_t first_of_pixel = 0;  // among the look-ups
  for (uint32_t f = 0; f < term[0].size(); ++f) {
    if (is_zero(term, f)) continue;
    if (const uint32_t here = fragments.sample[f] / samples_per_pixel; here != pixel) {
      pixel = here, first_of_pixel = result.at.size();
    }
    const auto same_grid = [&](uint32_t other) {
      return fragments.grid[other] == fragments.grid[f];
    };
    const auto known =
        std::find_if(result.at.begin() + long(first_of_pixel), result.at.end(), same_grid);
    result.users.push_back({uint32_t(known - result.at.begin()), f});
    if (known == result.at.end()) {
      result.at.push_back(f);
    } else if (off_centre(*input.samples, fragments.sample[f]) <
               off_centre(*input.samples, fragments.sample[*known])) {
      *known = f;
    }
  }
  std::ranges::sort(result.users);
  return result;
}

/// Points of a bucket that a light is asked about at once: enough to hide what a call costs, and
/// little enough for its arrays to stay in the cache.
constexpr size_t batch_size = 1024;

/// Cuts look-ups into batches. Calls look_up(fragments) with the fragments that some are made at,
/// then use(fragment, k) for each fragment that uses the k-th of them.
template <class LookUp, class Use>
void for_batches(const LookUps& look_ups, const LookUp& look_up, const Use& use) {
  auto user = look_ups.users.begin();
  for (size_t first = 0; first < look_ups.at.size(); first += batch_size) {
    const size_t count = std::min(batch_size, look_ups.at.size() - first);
    look_up(std::span(look_ups.at).subspan(first, count));
    for (; user != look_ups.users.end() && user->look_up < first + count; ++user)
      use(user->fragment, user->look_up - first);
  }
}

/// What the lights of a bucket are applied to.
struct TermTarget {
  const ShadeInput& input;
  const ShaderBindings& bindings;
  ShadedFragments& shaded;
  ShadeCounters& counters;
};

LookUps look_ups_of(const ShadeInput& input, const BoundLight& light, const Term& term) {
  return light.rate == TermRate::pixel ? each_grid_of_pixel(input, term) : each_fragment(term);
}

/// A light of one direction a point: shadow maps were made at shutter open, rays are cast when the
/// sample saw the point.
void apply_transmission(const TermTarget& to, const BoundLight& light, const Term& term) {
  const PointTime when = light.ray_traced ? PointTime::of_sample : PointTime::shutter_open;
  const bool by_pixel = light.rate == TermRate::pixel;
  std::vector<float> share;
  const auto look_up = [&](std::span<const uint32_t> fragments) {
    const FragmentPoints seen(to.input, fragments, when, to.bindings.camera(), by_pixel);
    share.resize(fragments.size());
    light.definition->transmission(light, seen.points(), share);
    (light.ray_traced ? to.counters.rays : to.counters.shadow_lookups) += share.size();
  };
  for_batches(look_ups_of(to.input, light, term), look_up, [&](uint32_t fragment, size_t k) {
    for (size_t c = 0; c < 3; ++c) to.shaded.Ci[c][fragment] += share[k] * term[c][fragment];
  });
}

/// Relative luminance of linear Rec. 709.
float luminance(const Term& term, size_t fragment) {
  return 0.2126f * term[0][fragment] + 0.7152f * term[1][fragment] + 0.0722f * term[2][fragment];
}

/// An effect in a bucket while its lights are added one after the other.
struct EffectSum {
  EffectValues* values;
  std::vector<float> brightest;  ///< [fragment] of the lights so far
  size_t lights = 0;

  void add_drawn(const glm::vec3& open, const Term& term, uint32_t fragment) {
    for (size_t c = 0; c < 3; ++c)
      if (std::isfinite(open[int(c)]))
        values->drawn[c][fragment] += open[int(c)] * term[c][fragment];
  }
  void describe(const ShareSamples& shares, const Term& term, uint32_t fragment, size_t k) {
    const float brightness = luminance(term, fragment);
    if (!(brightness > brightest[fragment])) return;
    brightest[fragment] = brightness;
    for (size_t axis = 0; axis < 2; ++axis) {
      values->y[axis][fragment] = shares.y[axis][k];
      values->extent[axis][fragment] = shares.extent[axis][k];
    }
    values->slope[fragment] = shares.slope[k];
  }
};

/// The share; nothing where that is not finite, which is counted.
glm::vec3 finite_share(const glm::vec3& share, ShadeCounters& counters) {
  if (is_finite(share)) return share;
  ++counters.nonfinite_dropped;
  return glm::vec3(0.0f);
}

void gather(const Term& term, std::span<const uint32_t> fragments, Vec3Array& out) {
  out.reset(int(fragments.size()));
  for (size_t c = 0; c < 3; ++c)
    for (size_t k = 0; k < fragments.size(); ++k) out.component(int(c))[k] = term[c][fragments[k]];
}

/// A light of many directions a point: each sample has a place of its own on it.
void apply_distributed(const TermTarget& to, const BoundLight& light, const Term& term,
                       EffectSum& sum) {
  const LookUps look_ups = look_ups_of(to.input, light, term);
  const size_t number = sum.lights++;
  if (look_ups.at.empty()) return;
  const SamplePlaces places(*to.input.samples, light.definition->effect, number);
  LightServices services = to.bindings.light_services();
  services.counters = &to.counters;
  ShareSamples shares;
  Vec3Array mean;
  if (light.mean_term) services.mean_received = &mean;
  std::vector<glm::vec2> xi;
  const auto look_up = [&](std::span<const uint32_t> fragments) {
    const FragmentPoints seen(to.input, fragments, PointTime::of_sample, to.bindings.camera(),
                              light.rate == TermRate::pixel);
    xi.clear();
    for (const uint32_t f : fragments)
      xi.push_back(places.of_sample(to.input.fragments->sample[f]));
    if (light.mean_term) gather(to.shaded.light_terms[*light.mean_term], fragments, mean);
    shares.reset(int(fragments.size()));
    light.definition->share_from(light, seen.points(), xi, services, shares);
  };
  for_batches(look_ups, look_up, [&](uint32_t f, size_t k) {
    const glm::vec3 share = finite_share(shares.share[int(k)], to.counters);
    if (!sum.values->drawn[0].empty()) sum.add_drawn(shares.open[int(k)], term, f);
    for (size_t c = 0; c < 3; ++c) {
      const float received = share[int(c)] * term[c][f];
      to.shaded.Ci[c][f] += received;
      sum.values->received[c][f] += received;
      sum.values->unblocked[c][f] += term[c][f];
    }
    sum.describe(shares, term, f, k);
  });
}

/// Effects that some light has, sized and zeroed; the others emptied.
std::array<EffectSum, ray_effect_count> start_effects(const TermTarget& to) {
  std::array<EffectSum, ray_effect_count> sums;
  const size_t fragments = to.input.fragments->size();
  for (size_t e = 0; e < ray_effect_count; ++e) {
    sums[e].values = &to.shaded.effects[e];
    const bool wanted = to.bindings.has_effect(RayEffect(e));
    sums[e].values->resize(wanted ? fragments : 0);
    if (wanted && RayEffect(e) == RayEffect::shadow) sums[e].values->add_drawn();
    sums[e].brightest.assign(wanted ? fragments : 0, 0.0f);
  }
  return sums;
}

class LightTermShading : public Shading {
 public:
  LightTermShading(std::unique_ptr<Shading> mode, std::shared_ptr<const ShaderBindings> bindings)
      : mode_(std::move(mode)), bindings_(std::move(bindings)) {}

  void shade(const ShadeInput& input, ShadedFragments& out, ShadeCounters& counters) override {
    mode_->shade(input, out, counters);
    apply_light_terms(input, *bindings_, out, counters);
  }
  void requests(const ShadeInput& input, size_t fragment,
                std::vector<ShadingRequest>& out) override {
    mode_->requests(input, fragment, out);
  }

 private:
  std::unique_ptr<Shading> mode_;
  std::shared_ptr<const ShaderBindings> bindings_;
};

}  // namespace

void apply_light_terms(const ShadeInput& input, const ShaderBindings& bindings,
                       ShadedFragments& shaded, ShadeCounters& counters) {
  const TermTarget to{input, bindings, shaded, counters};
  std::array<EffectSum, ray_effect_count> sums = start_effects(to);
  for (const BoundLight* bound : bindings.term_lights()) {
    const BoundLight& light = *bound;
    const Term& term = shaded.light_terms.at(*light.term);
    if (light.definition->distributed()) {
      apply_distributed(to, light, term, sums[size_t(light.definition->effect)]);
    } else {
      apply_transmission(to, light, term);
    }
  }
}

std::unique_ptr<Shading> with_light_terms(std::unique_ptr<Shading> mode,
                                          std::shared_ptr<const ShaderBindings> bindings) {
  return std::make_unique<LightTermShading>(std::move(mode), std::move(bindings));
}

}  // namespace tessera
