#include "shade/normal_spread.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shade/mathematics.h"

namespace tessera {
namespace {

/// A box narrower than this many standard deviations of the lobe counts as a Gaussian of the same
/// variance: their means differ by less than 1e-5 there, and the Gaussian is far cheaper.
constexpr float narrow_box = 0.3f;
/// Parts a sheared cell is cut into, at most; each counts as a rectangle.
constexpr int most_slabs = 4;

struct Gaussian {
  double exponent = 1.0, amplitude = 1.0;
  double at(double x) const { return amplitude * std::exp(-0.5 * exponent * x * x); }
  /// Convolved along one axis with a distribution of that variance.
  Gaussian widened(double variance) const {
    const double growth = 1.0 + exponent * variance;
    return {exponent / growth, amplitude / std::sqrt(growth)};
  }
};

/// The mean of `lobe` over [x - width / 2, x + width / 2].
double mean_over_box(const Gaussian& lobe, double x, double width) {
  const double scale = std::sqrt(0.5 * lobe.exponent);
  if (width * std::sqrt(lobe.exponent) < narrow_box) {
    return lobe.widened(width * width / 12.0).at(x);
  }
  const double high = std::erf(scale * (x + 0.5 * width));
  const double low = std::erf(scale * (x - 0.5 * width));
  return lobe.amplitude * std::sqrt(double(pi)) / (2.0 * scale * width) * (high - low);
}

/// The mean of exp(-exponent / 2 |x - y|^2) over the y in the parallelogram of the spread.
double mean_over_parallelogram(const glm::vec3& x, double exponent, const NormalSpread& spread) {
  const float width = glm::length(spread.along);
  const glm::vec3 along = unit_or_zero(spread.along);
  const float shear = glm::dot(spread.across, along);
  glm::vec3 perpendicular = spread.across - along * shear;
  // What rounding leaves of parallel axes has no direction.
  if (glm::length(perpendicular) < 1e-4f * width) perpendicular = glm::vec3(0.0f);
  const float height = glm::length(perpendicular);
  const float x_along = glm::dot(x, along);
  const float x_across = glm::dot(x, unit_or_zero(perpendicular));
  const double rest =  // of x, in directions in which the normals do not vary
      std::max(0.0, double(glm::dot(x, x) - x_along * x_along - x_across * x_across));
  const double wanted = std::ceil(3.0 * std::abs(shear) * std::sqrt(exponent));  // in deviations
  const int slabs = wanted < most_slabs ? std::max(1, int(wanted)) : most_slabs;
  const Gaussian lobe{exponent, 1.0};
  const Gaussian sheared_lobe = lobe.widened(std::pow(shear / slabs, 2) / 12.0);
  double sum = 0.0;
  for (int k = 0; k < slabs; ++k) {
    const double b = (k + 0.5) / slabs - 0.5;
    sum += mean_over_box(sheared_lobe, x_along - b * shear, width) *
           mean_over_box(lobe, x_across - b * height, height / slabs);
  }
  return sum / slabs * std::exp(-0.5 * exponent * rest);
}

/// The same for normals that spread less than narrow_box: the spread's covariance adds to the
/// lobe's. x is given by its squared length and any vector `tangent` along it.
float mean_over_narrow_spread(const glm::vec3& tangent, float x_squared, float exponent,
                              const NormalSpread& spread) {
  // With A = (along, across): x^T (1 + k A A^T)^-1 x = x^2 - k (A^T x)^T (1 + k A^T A)^-1 A^T x.
  const float k = exponent / 12.0f;
  const float m00 = 1.0f + k * glm::dot(spread.along, spread.along);
  const float m11 = 1.0f + k * glm::dot(spread.across, spread.across);
  const float m01 = k * glm::dot(spread.along, spread.across);
  const float determinant = m00 * m11 - m01 * m01;
  const float p = glm::dot(spread.along, tangent), q = glm::dot(spread.across, tangent);
  const float quadratic = (m11 * p * p - 2.0f * m01 * p * q + m00 * q * q) / determinant;
  const float squared = glm::dot(tangent, tangent);
  const float reduction = squared > 0.0f ? k * quadratic / squared : 0.0f;
  return std::exp(-0.5f * exponent * x_squared * (1.0f - reduction)) / std::sqrt(determinant);
}

/// The spread of N + a dx + b dy.
NormalSpread spread_along(const glm::vec3& N, const glm::vec3& dx, const glm::vec3& dy,
                          float scatter) {
  // A neighbour whose normal is not finite leaves the change unknown; this point's own may be good.
  const float squared = glm::dot(dx, dx) + glm::dot(dy, dy);
  if (!(squared > 0.0f) || !std::isfinite(squared)) return {.scatter = scatter};
  NormalSpread spread{dx - N * glm::dot(N, dx), dy - N * glm::dot(N, dy), scatter};
  if (glm::dot(spread.along, spread.along) < glm::dot(spread.across, spread.across)) {
    std::swap(spread.along, spread.across);
  }
  return spread;
}

/// Half of the mean squared deviation goes to each of the two tangential directions.
float scatter_of(const ShadingPoints& points, int i) {
  return points.normal_variance ? 0.5f * points.normal_variance[i] : 0.0f;
}

double positive_cubed(double x) { return x > 0.0 ? x * x * x : 0.0; }
double positive_squared(double x) { return x > 0.0 ? x * x : 0.0; }

}  // namespace

glm::vec3 view_change(const ShadingPoints& points, int i, const glm::vec3& dP) {
  const glm::vec3 I = points.I[i], P = points.P[i];
  const float distance = glm::length(P);
  const bool off_axis = P.x != 0.0f || P.y != 0.0f;
  const bool parallel = off_axis && I == glm::vec3(0.0f, 0.0f, 1.0f);
  if (parallel || distance == 0.0f) return glm::vec3(0.0f);
  return (dP - I * glm::dot(I, dP)) / distance;
}

NormalSpread normal_spread(const ShadingPoints& points, int i, const glm::vec3& N) {
  const float scatter = scatter_of(points, i);
  if (!points.dNdx.x) return {.scatter = scatter};
  return spread_along(N, points.dNdx[i], points.dNdy[i], scatter);
}

NormalSpread half_vector_spread(const ShadingPoints& points, int i, const glm::vec3& N,
                                const glm::vec3& H) {
  const float scatter = scatter_of(points, i), length = glm::length(H);
  if (!points.dNdx.x || !points.dPdx.x || length == 0.0f) return {.scatter = scatter};
  const float side = glm::dot(N, points.N[i]) < 0.0f ? -1.0f : 1.0f;
  const auto against_half_vector = [&](const glm::vec3& dN, const glm::vec3& dP) {
    const glm::vec3 dI = view_change(points, i, dP), h = H / length;
    return side * dN + (dI - h * glm::dot(h, dI)) / length;
  };
  return spread_along(N, against_half_vector(points.dNdx[i], points.dPdx[i]),
                      against_half_vector(points.dNdy[i], points.dPdy[i]), scatter);
}

float mean_specular_lobe(const glm::vec3& N, const glm::vec3& H, float exponent,
                         const NormalSpread& spread) {
  const float n_dot_h = glm::dot(N, H);
  if (n_dot_h <= 0.0f) return 0.0f;
  if (spread.none()) return std::pow(n_dot_h / glm::length(H), exponent);
  const glm::vec3 tangent = H - N * n_dot_h;
  // -2 ln cos = ln(1 + tan^2), which loses nothing where the angle is small.
  const float squared = glm::dot(tangent, tangent);
  const float x_squared = std::log1p(std::min(squared / (n_dot_h * n_dot_h), 1e30f));
  const float dimmed = 1.0f / (1.0f + exponent * spread.scatter), widened = exponent * dimmed;
  const float widest = glm::dot(spread.along, spread.along);
  if (widest * widened < narrow_box * narrow_box) {
    return dimmed * mean_over_narrow_spread(tangent, x_squared, widened, spread);
  }
  const float scale = squared > 0.0f ? std::sqrt(x_squared / squared) : 0.0f;
  return dimmed * float(mean_over_parallelogram(tangent * scale, widened, spread));
}

float mean_positive_part(float x, float p, float q) {
  if (p < q) std::swap(p, q);
  const double a = 0.5 * p, b = 0.5 * q, c = x;
  if (b < 1e-4 * a) return float((positive_squared(c + a) - positive_squared(c - a)) / (4.0 * a));
  const double corners = positive_cubed(c + a + b) - positive_cubed(c + a - b) -
                         positive_cubed(c - a + b) + positive_cubed(c - a - b);
  return float(corners / (24.0 * a * b));
}

}  // namespace tessera
