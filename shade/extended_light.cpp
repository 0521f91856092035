#include "shade/extended_light.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "shade/camera_motion.h"
#include "shade/mathematics.h"
#include "shade/ray_shadows.h"
#include "shade/receiver_frame.h"
#include "shade/shade.h"
#include "shade/view.h"

namespace tessera {
namespace {

constexpr float steepest_slope = 1e6f;
/// Most that a place's cosine counts for against the mean cosine over the light.
constexpr float largest_cosine_ratio = 16.0f;

/// Normals turned towards the eye, as surface shaders turn them.
Vec3Array facing_normals(const ShadingPoints& points, const Camera* camera) {
  Vec3Array facing(points.count);
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 P = points.P[i];
    facing.set(i, turned_against(points.N[i], camera ? along_view(*camera, P) : P));
  }
  return facing;
}

/// Cl cos of entry i.
glm::vec3 received(const LightSamples& samples, const Vec3Input& N, int i) {
  return samples.Cl[i] * std::max(0.0f, glm::dot(N[i], samples.L[i]));
}

/// The mean over the light's places of Cl cos at each point.
Vec3Array mean_received(const BoundLight& light, const ShadingPoints& points,
                        ShadeCounters* counters) {
  Vec3Array mean(points.count);
  PlaceSamples from;
  std::vector<glm::vec2> xi(size_t(points.count));
  const float weight = 1.0f / float(light.open_places.size());
  for (const glm::vec2& place : light.open_places) {
    std::ranges::fill(xi, place);
    illuminate_from(light, points, xi, counters, from);
    for (int i = 0; i < points.count; ++i)
      mean.add(i, weight * received(from.arriving, points.N, i));
  }
  return mean;
}

/// The mean over the light's places of Cl at point i.
glm::vec3 mean_sent(const BoundLight& light, const ShadingPoints& points, int i,
                    ShadeCounters* counters) {
  const std::vector<glm::vec2>& places = light.open_places;
  const glm::vec3 P = points.P[i], N = points.N[i];
  const std::vector<float> time(places.size(), points.time ? points.time[i] : 0.0f);
  ShadingPoints same;  // the point, once for each place
  same.count = int(places.size());
  same.P = Vec3Input::uniform(&P.x);
  same.N = Vec3Input::uniform(&N.x);
  same.time = points.time ? time.data() : nullptr;
  PlaceSamples from;
  illuminate_from(light, same, places, counters, from);
  glm::vec3 sum(0.0f);
  for (int k = 0; k < same.count; ++k) sum += from.arriving.Cl[k];
  return sum / float(same.count);
}

/// `part` / `whole`, and 0 where the whole is 0.
glm::vec3 ratio(const glm::vec3& part, const glm::vec3& whole) {
  glm::vec3 result(0.0f);
  for (int c = 0; c < 3; ++c) {
    const float quotient = part[c] / whole[c];
    if (std::isfinite(quotient)) result[c] = quotient;
  }
  return result;
}

/// Where nearly all of the light is below the surface the mean of Cl cos is next to nothing, and a
/// place that still shows counts for hundreds of it. What the share multiplies may be more than
/// that mean: highlights at grazing angles, or a cell whose other points see more. The product
/// would be a bright dot. So a share above 16 counts for no more than 16 times what the place sends
/// against what all send, whatever their cosines; of an even light that takes away at most 1 / (4 *
/// 16^2) of what arrives where all of it shows.
void bound_shares(const BoundLight& light, const ShadingPoints& points, const LightSamples& from,
                  ShadeCounters* counters, Vec3Array& share) {
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 s = share[i];
    if (!(std::max({s.x, s.y, s.z}) > largest_cosine_ratio)) continue;
    const glm::vec3 sent =
        glm::max(glm::vec3(1.0f), ratio(from.Cl[i], mean_sent(light, points, i, counters)));
    share.set(i, glm::min(s, largest_cosine_ratio * sent));
  }
}

float slope_of(float blocker, bool infinite) {
  if (!std::isfinite(blocker)) return std::numeric_limits<float>::quiet_NaN();
  if (infinite) return std::max(blocker, 0.0f);
  // With distances in units of d1: d1 / d2 - 1 = 1 / (1 - blocker) - 1.
  const float beyond = 1.0f - blocker;
  return beyond > 0.0f ? std::clamp(blocker / beyond, 0.0f, steepest_slope) : steepest_slope;
}

void fill_coordinates(const BoundLight& light, const ShadingPoints& points,
                      const PlaceSamples& from, const Camera& camera, ShareSamples& out) {
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 P = points.P[i], N = points.N[i];
    ReceiverFrame frame = ReceiverFrame::at(camera, P, N);
    if (!light.extent.infinite) {
      frame = frame.projected_along(unit_or_zero(light.extent.centre - P), N);
    }
    const glm::vec2 pixels = frame.pixels(from.offset[i]);
    set_coordinate(size_t(i), effect_coordinate(pixels, reach_of(light.extent, frame)), out);
  }
}

/// Points as the light sees them: where they would be in camera space had the camera stood still
/// since shutter open, as the light is given. Surfaces that shine move with their grids instead.
class StillPoints {
 public:
  StillPoints(const BoundLight& light, const ShadingPoints& points, const Camera* camera)
      : now_(points), camera_(camera), carried_(camera_.concerns(points) && !light.emitter) {
    if (!carried_) return;
    P_.reset(points.count), N_.reset(points.count);
    for (int i = 0; i < points.count; ++i) {
      const glm::dmat4 now_from_open = camera_.now_from_open(points.time[i]);
      P_.set(i, glm::inverse(now_from_open) * glm::dvec4(points.P[i], 1.0));
      N_.set(i, unit_or_zero(glm::transpose(glm::dmat3(now_from_open)) * glm::dvec3(points.N[i])));
    }
  }

  ShadingPoints points() const {
    ShadingPoints still = now_;
    if (carried_) still.P = P_, still.N = N_;
    return still;
  }
  /// Directions from these points become those from where the points are.
  void carry(Vec3Array& towards) const {
    for (int i = 0; carried_ && i < now_.count; ++i) {
      const glm::dmat3 now_from_open(camera_.now_from_open(now_.time[i]));
      towards.set(i, now_from_open * glm::dvec3(towards[i]));
    }
  }

 private:
  const ShadingPoints& now_;
  CameraMotion camera_;
  bool carried_;
  Vec3Array P_{0}, N_{0};
};

}  // namespace

std::vector<ParameterDeclaration> with_extent_parameters(std::vector<ParameterDeclaration> own) {
  const ParameterDeclaration common[] = {
      scalar_parameter("intensity", 1.0f, "multiplies the colour to give radiance"),
      color_parameter("lightcolor", glm::vec3(1.0f), "colour"),
      scalar_parameter("samples", 16.0f,
                       "places of the light that it is summed over, and shadow rays at rate cell"),
      string_parameter("shadowrate", "sample", "shadows once a cell, pixel or sample")};
  own.insert(own.end(), std::begin(common), std::end(common));
  return own;
}

glm::vec3 radiance_of(const BoundParameters& parameters) {
  return parameters.scalar("intensity") * parameters.vec3("lightcolor");
}

std::vector<glm::vec2> spread_places(int count) {
  constexpr uint32_t every_other_bit = 0x55555555u;
  const auto n = uint32_t(std::max(count, 1));
  const int bits = std::bit_width(n - 1);  // 2^bits >= n
  std::vector<glm::vec2> places;
  for (uint32_t k = 0; k < n; ++k) {
    uint32_t reversed = 0;
    for (int b = 0; b < bits; ++b) reversed |= (k >> b & 1u) << (bits - 1 - b);
    reversed ^= every_other_bit & ((1u << bits) - 1u);
    places.emplace_back((float(k) + 0.5f) / float(n),
                        (float(reversed) + 0.5f) / float(uint32_t(1) << bits));
  }
  return places;
}

int place_count(const BoundParameters& parameters) {
  constexpr float most = 4096.0f;
  const float asked = parameters.scalar("samples"), count = std::round(asked);
  if (!(count >= 1.0f && count <= most))
    throw Error(fmt::format("samples must lie between 1 and {}, found {}", most, asked));
  return int(count);
}

void set_place(const BoundLight& light, const glm::vec3& P, const LightPlace& place,
               const glm::vec3& radiance, bool double_sided, int i, PlaceSamples& out) {
  const glm::vec3 towards = place.at - P;
  const float distance = glm::length(towards);
  out.offset.set(i, place.at - light.extent.centre);
  if (!(distance > 0.0f) || !std::isfinite(distance)) return;  // on the light, or out of all range
  const glm::vec3 L = towards / distance;
  const float cosine = -glm::dot(L, place.normal);
  const float seen = double_sided ? std::abs(cosine) : cosine;
  if (!(seen > 0.0f)) return;
  const float size = light.extent.area_root / distance;
  const float most = 2.0f * float(light.places.size());
  out.arriving.L.set(i, L);
  out.arriving.Cl.set(i, radiance * std::min(size * seen / pi * size, most));
  out.towards.set(i, towards);
}

void share_from_extent(const BoundLight& light, const ShadingPoints& given,
                       std::span<const glm::vec2> xi, const LightServices& services,
                       ShareSamples& out) {
  const Vec3Array N = facing_normals(given, services.camera);
  ShadingPoints now = given;
  now.N = N;
  const StillPoints still(light, now, services.camera);
  const ShadingPoints points = still.points();
  out.reset(points.count);
  PlaceSamples from;
  illuminate_from(light, points, xi, services.counters, from);
  const Vec3Array mean = services.mean_received ? *services.mean_received
                                                : mean_received(light, points, services.counters);
  if (services.camera) fill_coordinates(light, points, from, *services.camera, out);
  for (int i = 0; i < points.count; ++i) {
    out.open.set(i, ratio(received(from.arriving, points.N, i), mean[i]));
    if (out.open[i] == glm::vec3(0.0f)) from.towards.set(i, glm::vec3(0.0f));  // casts no ray
  }
  bound_shares(light, points, from.arriving, services.counters, out.open);
  out.share = out.open;
  if (!light.ray_traced) return;
  PlaceShadows shadows;
  still.carry(from.towards);
  trace_shadows(services.rays, now, from.towards, light.extent.infinite, shadows);
  if (services.counters) services.counters->rays += shadows.rays;
  for (int i = 0; i < points.count; ++i) {
    const size_t k = size_t(i);
    out.share.set(i, shadows.share[k] * out.share[i]);
    out.slope[k] = slope_of(shadows.distance[k], light.extent.infinite);
  }
}

}  // namespace tessera
