/// The textures, environments and pattern points of a ShaderContext: what is looked up over the
/// footprint of a shading cell.

#include <algorithm>
#include <cmath>

#include "shade/bindings.h"
#include "shade/latitude_longitude.h"
#include "shade/mathematics.h"
#include "shade/normal_spread.h"
#include "shade/shader.h"
#include "shade/textures.h"

namespace tessera {
namespace {

/// What reflect(I, N) = I - 2 (N . I) N changes by.
glm::vec3 mirror_change(const glm::vec3& I, const glm::vec3& N, const glm::vec3& dI,
                        const glm::vec3& dN) {
  return dI - 2.0f * ((glm::dot(dN, I) + glm::dot(N, dI)) * N + glm::dot(N, I) * dN);
}

/// The box filter of a look-up in a latitude-longitude map.
struct MapFootprint {
  float dsdx, dtdx, dsdy, dtdy;
};

/// A unit direction of the world with the unit tangents of growing s and t.
struct MapPlace {
  glm::vec3 direction, east, south;
  float sine;  ///< of the angle to the pole, kept from 0

  explicit MapPlace(const glm::vec3& d)
      : direction(d), sine(std::max(1e-3f, std::sqrt(std::max(0.0f, 1.0f - d.z * d.z)))) {
    const float longitude = std::atan2(d.y, d.x);
    const float cosine_east = std::cos(longitude), sine_east = std::sin(longitude);
    east = {sine_east, -cosine_east, 0.0f};  // s falls with the longitude
    south = {d.z * cosine_east, d.z * sine_east, -sine};
  }
};

/// Covers `blur_radians` around and a change of direction by dx and dy over the cell: variances
/// add, so squares of widths do.
MapFootprint map_footprint(const MapPlace& place, const glm::vec3& dx, const glm::vec3& dy,
                           float blur_radians) {
  const glm::vec2 x(glm::dot(dx, place.east), glm::dot(dx, place.south));
  const glm::vec2 y(glm::dot(dy, place.east), glm::dot(dy, place.south));
  // A circle of directions spans more longitude near the poles.
  const float s_of_east = 1.0f / (2.0f * pi) / place.sine, t_of_south = 1.0f / pi;
  const auto limited = [](float ds) { return std::clamp(ds, -1.0f, 1.0f); };
  if (x == glm::vec2(0.0f) && y == glm::vec2(0.0f)) {
    return {limited(blur_radians * s_of_east), 0.0f, 0.0f, blur_radians * t_of_south};
  }
  const float b = blur_radians * blur_radians;
  const float ee = x.x * x.x + y.x * y.x + b, es = x.x * x.y + y.x * y.y;
  const float ss = x.y * x.y + y.y * y.y + b;
  // Columns of the Cholesky factor of that covariance: edges of a cell that has it.
  const float east = std::sqrt(ee), skew = east > 0.0f ? es / east : 0.0f;
  const float south = std::sqrt(std::max(0.0f, ss - skew * skew));
  return {limited(east * s_of_east), std::clamp(skew * t_of_south, -1.0f, 1.0f), 0.0f,
          std::min(1.0f, south * t_of_south)};
}

}  // namespace

Vec3Array ShaderContext::texture(const std::string& file) const {
  services_.counters->texture_lookups += uint64_t(count());
  const size_t n = size_t(count());
  const StFootprint& d = points_.st_footprint;
  const std::vector<float> zeros(n, 0.0f);
  const auto change = [&](const float* given) {
    return given ? std::span(given, n) : std::span<const float>(zeros);
  };
  const TexturePoints points{{points_.s, n}, {points_.t, n}, change(d.dsdx),
                             change(d.dtdx), change(d.dsdy), change(d.dtdy)};
  return services_.textures->color({.file = file}, points, shader_.where);
}

CellDirections ShaderContext::mirror_directions(const Vec3Array& N) const {
  const int n = count();
  CellDirections mirrored{Vec3Array(n), Vec3Array(n), Vec3Array(n), {}};
  mirrored.scatter.assign(padded(size_t(n)), 0.0f);
  for (int i = 0; i < n; ++i) {
    const glm::vec3 I = points_.I[i], normal = N[i];
    mirrored.direction.set(i, glm::reflect(I, normal));
    const NormalSpread spread = normal_spread(points_, i, normal);
    mirrored.scatter[size_t(i)] = 4.0f * spread.scatter;  // the angle to the normal counts twice
    if (!points_.dPdx.x) continue;
    const float side = glm::dot(normal, points_.N[i]) < 0.0f ? -1.0f : 1.0f;
    const bool bent = points_.dNdx.x != nullptr;
    const auto change = [&](const glm::vec3& dP, const glm::vec3& dN) {
      return mirror_change(I, normal, view_change(points_, i, dP), side * dN);
    };
    mirrored.dx.set(i, change(points_.dPdx[i], bent ? points_.dNdx[i] : glm::vec3(0.0f)));
    mirrored.dy.set(i, change(points_.dPdy[i], bent ? points_.dNdy[i] : glm::vec3(0.0f)));
  }
  return mirrored;
}

Vec3Array ShaderContext::environment(const std::string& file, const CellDirections& directions,
                                     const ScalarInput& blur) const {
  if (services_.diffuse_only) return Vec3Array(count());
  services_.counters->texture_lookups += uint64_t(count());
  const size_t n = size_t(count());
  std::vector<float> s(n), t(n), dsdx(n), dtdx(n), dsdy(n), dtdy(n);
  const glm::dmat3 world_from_camera(shader_.world_from_camera);
  const float length_scale = float(glm::length(world_from_camera[0]));
  for (size_t i = 0; i < n; ++i) {
    const auto in_world = [&](const Vec3Array& v) {
      return glm::vec3(world_from_camera * glm::dvec3(v[int(i)]));
    };
    const glm::vec3 d = unit_or_zero(in_world(directions.direction));
    const glm::vec2 st = st_of_direction(d);
    s[i] = st.x, t[i] = st.y;
    // A box as wide as sqrt(12) standard deviations has the variance of the scatter.
    const float scatter = directions.scatter[i];
    const float width =
        scatter > 0.0f ? std::hypot(blur[int(i)], std::sqrt(12.0f * scatter)) : blur[int(i)];
    const MapFootprint f = map_footprint(MapPlace(d), in_world(directions.dx) / length_scale,
                                         in_world(directions.dy) / length_scale, width);
    dsdx[i] = f.dsdx, dtdx[i] = f.dtdx, dsdy[i] = f.dsdy, dtdy[i] = f.dtdy;
  }
  const TextureRequest request{.file = file, .t_wrap = TextureWrap::clamp};
  return services_.textures->color(request, {s, t, dsdx, dtdx, dsdy, dtdy}, shader_.where);
}

PatternPoints ShaderContext::pattern_points() const {
  const size_t size = padded(size_t(count()));
  PatternPoints pattern{Vec3Array(count()), AlignedVector<float>(size), Vec3Array(count()),
                        AlignedVector<int>(size, 1), AlignedVector<float>(size)};
  const PrimvarView* reference = points_.find_primvar("Pref");
  const bool use_reference = reference && reference->components == 3;
  const Vec3Input source =
      use_reference ? Vec3Input::varying(reference->values, reference->stride) : points_.P;
  const glm::dmat4& shader_from_camera = shader_.spaces.shader_from_camera;
  const glm::dmat4 shader_from_source =
      use_reference ? shader_from_camera * points_.camera_from_object : shader_from_camera;
  for (int i = 0; i < count(); ++i) {
    pattern.P.set(i, transformed(shader_from_source, ValueType::point, source[i]));
  }
  if (!points_.dPdx.x) return pattern;
  for (int i = 0; i < count(); ++i) {
    const size_t k = size_t(i);
    const glm::vec3 x = shader_vector(points_.dPdx[i]), y = shader_vector(points_.dPdy[i]);
    pattern.footprint[k] = std::max(glm::length(x), glm::length(y));
    if (use_reference) continue;  // how Pref changes along the cell is not known
    const CellAxes<glm::vec3> axes = principal_axes(x, y);
    const float length = glm::length(axes.major), width = glm::length(axes.minor);
    pattern.taps[k] = taps_along(length, width);
    pattern.along.set(i, axes.major);
    pattern.tap_footprint[k] = std::max(width, length / float(pattern.taps[k]));
  }
  return pattern;
}

}  // namespace tessera
