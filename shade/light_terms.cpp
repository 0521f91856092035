#include "shade/light_terms.h"

#include <algorithm>
#include <cmath>

#include "shade/fragment_geometry.h"
#include "shade/mathematics.h"

namespace tessera {
namespace {

using Term = std::array<std::vector<float>, 3>;

bool is_zero(const Term& term, size_t fragment) {
  return term[0][fragment] == 0.0f && term[1][fragment] == 0.0f && term[2][fragment] == 0.0f;
}

/// Which fragments of a bucket share a shadow look-up.
struct LookUps {
  std::vector<size_t> at;                              ///< [look-up] the fragment it is made at
  std::vector<std::pair<size_t, size_t>> of_fragment;  ///< (fragment, its look-up)
};

LookUps each_fragment(const Term& term) {
  LookUps result;
  for (size_t f = 0; f < term[0].size(); ++f) {
    if (is_zero(term, f)) continue;
    result.of_fragment.emplace_back(f, result.at.size());
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
  for (size_t f = 0; f < term[0].size(); ++f) {
    if (is_zero(term, f)) continue;
    if (const uint32_t here = fragments.sample[f] / samples_per_pixel; here != pixel) {
      pixel = here, first_of_pixel = result.at.size();
    }
    const auto same_grid = [&](size_t other) { return fragments.grid[other] == fragments.grid[f]; };
    const auto known =
        std::find_if(result.at.begin() + long(first_of_pixel), result.at.end(), same_grid);
    result.of_fragment.emplace_back(f, size_t(known - result.at.begin()));
    if (known == result.at.end()) {
      result.at.push_back(f);
    } else if (off_centre(*input.samples, fragments.sample[f]) <
               off_centre(*input.samples, fragments.sample[*known])) {
      *known = f;
    }
  }
  return result;
}

/// A pixel on a surface seen at a smaller angle than this is taken as seen at this one: its
/// footprint stays bounded.
constexpr float least_cosine = 0.05f;

/// A fragment's point at shutter open, lifted from its flat triangle to the curved surface that the
/// normals of its corners tell of: with coarse micropolygons a map made from fine ones would shadow
/// the triangles. Halfway to the mean of its projections onto the corners' tangent planes, which is
/// exact for a parabola (compare T. Boubekeur, M. Alexa, "Phong tessellation", SIGGRAPH Asia 2008).
glm::vec3 lifted_point(const FragmentGeometry& seen) {
  const Grid& grid = *seen.grid;
  const glm::vec3 P = seen.P_camera(0.0f);
  glm::vec3 lift(0.0f);
  for (size_t k = 0; k < 3; ++k) {
    const int corner = seen.corner[k];
    const glm::vec3 Q(grid.P(0, 0)[corner], grid.P(0, 1)[corner], grid.P(0, 2)[corner]);
    const glm::vec3 N(grid.N(0)[corner], grid.N(1)[corner], grid.N(2)[corner]);
    lift += seen.weight[k] * glm::dot(Q - P, N) * N;
  }
  return P + 0.5f * lift;
}

/// The surface points of fragments at shutter open.
class FragmentPoints {
 public:
  /// `pixel_of` null: no footprints.
  FragmentPoints(const ShadeInput& input, const std::vector<size_t>& fragments,
                 const Camera* pixel_of)
      : P_(int(fragments.size())), N_(P_.count()) {
    for (int i = 0; i < P_.count(); ++i) {
      const FragmentGeometry seen(input, fragments[size_t(i)]);
      const Grid& grid = *seen.grid;
      P_.set(i, lifted_point(seen));
      N_.set(i, unit_or_zero({seen.interpolate(grid.N(0)), seen.interpolate(grid.N(1)),
                              seen.interpolate(grid.N(2))}));
    }
    points_.count = P_.count();
    points_.P = P_;
    points_.N = N_;
    if (pixel_of) fill_footprints(*pixel_of);
  }
  FragmentPoints(const FragmentPoints&) = delete;
  FragmentPoints& operator=(const FragmentPoints&) = delete;

  const ShadingPoints& points() const { return points_; }

 private:
  void fill_footprints(const Camera& camera) {
    dPdx_.reset(P_.count()), dPdy_.reset(P_.count());
    for (int i = 0; i < P_.count(); ++i) {
      const glm::vec3 P = P_[i], N = N_[i];
      const glm::vec3 forward(0.0f, 0.0f, 1.0f);
      const glm::vec3 I = camera.perspective() ? unit_or_zero(P) : forward;
      const float w = camera.raster_clip_from_camera(P).z;
      const float cosine = glm::dot(N, I);
      const float bounded = std::copysign(std::max(std::abs(cosine), least_cosine), cosine);
      // One pixel sideways at the point's depth, then along the view back to the tangent plane.
      const auto onto_plane = [&](const glm::vec3& step) {
        return step - I * (glm::dot(N, step) / bounded);
      };
      dPdx_.set(i, onto_plane({w / camera.raster_clip().x_scale, 0.0f, 0.0f}));
      dPdy_.set(i, onto_plane({0.0f, w / camera.raster_clip().y_scale, 0.0f}));
    }
    points_.dPdx = dPdx_;
    points_.dPdy = dPdy_;
  }

  Vec3Array P_, N_, dPdx_, dPdy_;
  ShadingPoints points_;
};

void apply_term(const ShadeInput& input, const BoundLight& light, const Camera& camera,
                const Term& term, std::array<std::vector<float>, 3>& Ci, ShadeCounters& counters) {
  const bool by_pixel = light.rate == TermRate::pixel;
  const LookUps look_ups = by_pixel ? each_grid_of_pixel(input, term) : each_fragment(term);
  const FragmentPoints seen(input, look_ups.at, by_pixel ? &camera : nullptr);
  std::vector<float> share(look_ups.at.size());
  light.definition->transmission(light, seen.points(), share);
  counters.shadow_lookups += share.size();
  for (const auto& [fragment, look_up] : look_ups.of_fragment) {
    for (size_t c = 0; c < 3; ++c) Ci[c][fragment] += share[look_up] * term[c][fragment];
  }
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
  for (size_t k = 0; k < bindings.light_term_count(); ++k) {
    apply_term(input, *bindings.term_lights()[k], bindings.camera(), shaded.light_terms.at(k),
               shaded.Ci, counters);
  }
}

std::unique_ptr<Shading> with_light_terms(std::unique_ptr<Shading> mode,
                                          std::shared_ptr<const ShaderBindings> bindings) {
  return std::make_unique<LightTermShading>(std::move(mode), std::move(bindings));
}

}  // namespace tessera
