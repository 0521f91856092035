#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "shade/normal_spread.h"
#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// The mean of value(n) over 80 x 80 normals of a cell, each normalised.
double brute_force_mean(const NormalSpread& spread, const glm::dvec3& N,
                        const std::function<double(const glm::dvec3& n)>& value) {
  const int steps = 80;
  double sum = 0.0;
  for (int j = 0; j < steps; ++j) {
    for (int i = 0; i < steps; ++i) {
      const double a = (i + 0.5) / steps - 0.5, b = (j + 0.5) / steps - 0.5;
      sum +=
          value(glm::normalize(N + a * glm::dvec3(spread.along) + b * glm::dvec3(spread.across)));
    }
  }
  return sum / (steps * steps);
}

double lobe(const glm::dvec3& n, const glm::dvec3& h, double exponent) {
  return std::pow(std::max(0.0, glm::dot(n, h)), exponent);
}

NormalSpread spread_of(double width, int shape) {
  const float w = float(width);
  switch (shape) {
    case 0:
      return {{w, 0, 0}, {0, w, 0}, 0};
    case 1:
      return {{w, 0, 0}, {0, w / 16, 0}, 0};
    case 2:
      return {{w, 0, 0}, {0.7071f * w, 0.7071f * w, 0}, 0};
    default:
      return {{w, 0, 0}, {0.9f * w, 0, 0}, 0};  // a cylinder across the cell's diagonal
  }
}

/// A half vector at `angle` from z.
glm::dvec3 half_vector(double angle, double azimuth) {
  return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
          std::cos(angle)};
}

/// A cylinder of radius 1 about the y axis at z = 4, `u_count` columns over 1.2 radians.
std::shared_ptr<Grid> make_cylinder(const Surface& surface, int u_count) {
  const auto angle = [](float u) { return 1.2f * (u - 0.5f); };
  const auto grid = make_grid(surface, u_count, 2, [&](float u, float v) {
    return glm::vec3(std::sin(angle(u)), 1e-3f * (v - 0.5f), 4.0f - std::cos(angle(u)));
  });
  for (size_t k = 0; k < size_t(grid->vertex_count()); ++k) {
    grid->N_camera[k] = std::sin(angle(grid->uv[k]));
    grid->N_camera[2 * grid->stride() + k] = -std::cos(angle(grid->uv[k]));
  }
  return grid;
}

}  // namespace

TEST_CASE("a highlight over a cell is the mean of the sharp one over the cell's normals") {
  const glm::vec3 N(0, 0, 1);
  for (double roughness : {0.5, 0.1, 0.05, 0.01, 0.001}) {
    for (double width : {0.02, 0.1, 0.2, 0.3, 0.5}) {
      for (int shape = 0; shape < 4; ++shape) {
        INFO("roughness " << roughness << " spread " << width << " shape " << shape);
        const NormalSpread spread = spread_of(width, shape);
        double worst = 0.0, worst_unwidened = 0.0;
        for (int k = 0; k < 24; ++k) {
          const double reach = std::min(1.3, 0.75 * width + 3.0 * std::sqrt(roughness));
          const glm::dvec3 h = half_vector(reach * (k % 8) / 7.0, 0.1 + 1.05 * (k / 8));
          const double exponent = 1.0 / roughness;
          const double mean = brute_force_mean(
              spread, N, [&](const glm::dvec3& n) { return lobe(n, h, exponent); });
          // Of any length.
          const float widened = mean_specular_lobe(N, 1.7f * glm::vec3(h), float(exponent), spread);
          worst = std::max(worst, std::abs(widened - mean));
          worst_unwidened = std::max(worst_unwidened, std::abs(lobe(N, h, exponent) - mean));
        }
        // Of a peak of 1. The lobe is a Gaussian in a coordinate that stretches with the angle, so
        // the error grows with the square of the spread: broad lobes seen far from their centre
        // are the worst, 0.024 at a spread of 0.5. Sheared cells are cut into four rectangles.
        CHECK(worst < 0.1 * width * width + 0.004);
        CHECK(worst <= worst_unwidened + 1e-4);
        if (width >= 0.2 && roughness <= 0.01) CHECK(worst < 0.05 * worst_unwidened);
      }
    }
  }
}

TEST_CASE("without spread a highlight is the power of the cosine, bit for bit") {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> side(-1.0f, 1.0f), place(1.0f, 500.0f);
  for (int k = 0; k < 1000; ++k) {
    const glm::vec3 N = glm::normalize(glm::vec3(side(random), side(random), 1.1f));
    const glm::vec3 H(side(random), side(random), side(random));
    const float exponent = place(random), cosine = glm::dot(N, H) / glm::length(H);
    const float expected = glm::dot(N, H) <= 0.0f ? 0.0f : std::pow(cosine, exponent);
    REQUIRE(mean_specular_lobe(N, H, exponent, {}) == expected);
    REQUIRE(mean_clamped_cosine(N, H, {}) == std::max(0.0f, glm::dot(N, H)));
  }
}

TEST_CASE("scattered normals widen a highlight and dim it") {
  std::mt19937 random(4);
  std::normal_distribution<double> bump(0.0, 1.0);
  for (double variance : {1e-4, 1e-3, 1e-2}) {
    for (double exponent : {10.0, 100.0, 1000.0}) {
      for (double angle : {0.0, 0.1, 0.2}) {
        const NormalSpread spread{{0.1f, 0, 0}, {0, 0.05f, 0}, float(variance)};
        const glm::dvec3 h = half_vector(angle, 0.4);
        double sum = 0.0;
        const int count = 40000;
        std::uniform_real_distribution<double> place(-0.5, 0.5);
        for (int k = 0; k < count; ++k) {
          const double x = 0.1 * place(random) + std::sqrt(variance) * bump(random);
          const double y = 0.05 * place(random) + std::sqrt(variance) * bump(random);
          sum += lobe(glm::normalize(glm::dvec3(x, y, 1.0)), h, exponent);
        }
        INFO(variance << " " << exponent << " " << angle);
        // Three standard deviations of the random sum (at most 0.5 / sqrt(count)) are 0.0075.
        CHECK(mean_specular_lobe({0, 0, 1}, glm::vec3(h), float(exponent), spread) ==
              Approx(sum / count).margin(0.01));
      }
    }
  }
}

TEST_CASE("a widened highlight keeps its integral over half vectors") {
  for (float exponent : {50.0f, 1000.0f}) {
    for (int shape = 0; shape < 4; ++shape) {
      NormalSpread spread = spread_of(0.2, shape);
      spread.scatter = 1e-3f;
      double sharp = 0.0, widened = 0.0;
      const int steps = 300;
      for (int j = 0; j < steps; ++j) {
        for (int i = 0; i < steps; ++i) {
          // Of the projected disc: a solid angle of 1 / cos.
          const double x = 1.6 * ((i + 0.5) / steps - 0.5), y = 1.6 * ((j + 0.5) / steps - 0.5);
          if (x * x + y * y > 0.64) continue;
          const glm::vec3 h(x, y, std::sqrt(1.0 - x * x - y * y));
          sharp += mean_specular_lobe({0, 0, 1}, h, exponent, {}) / h.z;
          widened += mean_specular_lobe({0, 0, 1}, h, exponent, spread) / h.z;
        }
      }
      INFO(exponent << " " << shape);
      CHECK(widened == Approx(sharp).epsilon(0.02));  // what the curved coordinate costs
    }
  }
}

TEST_CASE("diffuse light over a cell is the mean of the clamped cosine") {
  for (double width : {0.05, 0.1, 0.2, 0.3, 0.5}) {
    for (int shape = 0; shape < 4; ++shape) {
      const NormalSpread spread = spread_of(width, shape);
      double worst = 0.0, worst_sharp = 0.0;
      for (int k = 0; k <= 120; ++k) {
        // Also along x, across which the shorter edge of an upright cell changes nothing.
        const glm::dvec3 l = half_vector((k / 2) * 3.14159 / 60, k % 2 == 0 ? 0.5 : 0.0);
        const double mean = brute_force_mean(
            spread, {0, 0, 1}, [&](const glm::dvec3& n) { return std::max(0.0, glm::dot(n, l)); });
        const float found = mean_clamped_cosine({0, 0, 1}, glm::vec3(l), spread);
        worst = std::max(worst, std::abs(found - mean));
        worst_sharp = std::max(worst_sharp, std::abs(std::max(0.0, l.z) - mean));
      }
      INFO("spread " << width << " shape " << shape);
      // Left out is that the mean normal is shorter than 1: (|x|^2 + |y|^2) / 24.
      CHECK(worst < 2.0 * width * width / 24.0 * 1.05 + 1e-3);
      CHECK(worst_sharp > 2.0 * worst);
    }
  }
}

TEST_CASE("the view turns with a step on the surface, and not at all where it is parallel") {
  const glm::vec3 steps[] = {{0.01f, 0, 0}, {0, -0.02f, 0.01f}, {0.003f, 0.004f, -0.005f}};
  for (const glm::vec3 P : {glm::vec3(0, 0, 4), {1, -2, 3}, {1e-3f, 0, 1}, {30, 20, 10}}) {
    const BarePoints at({P}, {0, 0, -1});
    ShadingPoints perspective = at.points, parallel = at.points;
    const glm::vec3 from_eye = glm::normalize(P), forward(0, 0, 1);
    perspective.I = Vec3Input::uniform(&from_eye.x);
    parallel.I = Vec3Input::uniform(&forward.x);
    for (const glm::vec3& dP : steps) {
      const auto view = [&](double t) {
        return glm::normalize(glm::dvec3(P) + t * glm::dvec3(dP));
      };
      const glm::dvec3 expected = (view(1e-4) - view(-1e-4)) / 2e-4;
      CHECK(glm::length(glm::dvec3(view_change(perspective, 0, dP)) - expected) <
            1e-5 * glm::length(expected) + 1e-9);
      if (P.x != 0.0f) CHECK(view_change(parallel, 0, dP) == glm::vec3(0.0f));
    }
  }
  const BarePoints in_eye({{0, 0, 0}}, {0, 0, -1});
  ShadingPoints lost = in_eye.points;
  const glm::vec3 forward(0, 0, 1);
  lost.I = Vec3Input::uniform(&forward.x);
  CHECK(view_change(lost, 0, {1, 2, 3}) == glm::vec3(0.0f));
}

TEST_CASE("normals that cannot be told spread nothing; bad ones are not hidden") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float zero = 0.0f, one = 1.0f;
  ShadingPoints points;
  points.count = 1;
  CHECK(normal_spread(points, 0, {0, 0, 1}).none());
  points.dNdx = points.dNdy = {&nan, &zero, &zero, 0};
  CHECK(normal_spread(points, 0, {0, 0, 1}).none());
  points.dNdx = {&zero, &zero, &one, 0}, points.dNdy = {&zero, &zero, &zero, 0};
  CHECK(normal_spread(points, 0, {0, 0, 1}).none());  // along N there is nothing to change
  points.normal_variance = &one;
  CHECK(normal_spread(points, 0, {0, 0, 1}).scatter == 0.5f);
  const NormalSpread spread = spread_of(0.3, 2);
  CHECK(std::isnan(mean_specular_lobe({nan, 0, 1}, {0, 0, 1}, 10.0f, spread)));
  CHECK(std::isnan(mean_specular_lobe({nan, 0, 1}, {0, 0, 1}, 10.0f, spread_of(0.01, 0))));
  CHECK(std::isnan(mean_clamped_cosine({nan, 0, 1}, {0, 0, 1}, spread)));
  // Extremes stay finite and within [0, 1].
  for (float exponent : {1e-3f, 1.0f, 1e4f}) {
    for (double width : {1e-20, 1e-6, 1.0, 100.0}) {
      for (double angle : {0.0, 1e-6, 1.5, 1.5707963}) {
        NormalSpread wide = spread_of(width, 2);
        wide.scatter = 1.0f;
        const float value =
            mean_specular_lobe({0, 0, 1}, glm::vec3(half_vector(angle, 1.0)), exponent, wide);
        CHECK(value >= 0.0f);
        CHECK(value <= 1.0f);
      }
    }
  }
}

TEST_CASE("the vertices of a grid know how the normal changes over a micropolygon") {
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  const auto cylinder = make_cylinder(surface, 60);
  const auto bindings = test.bind();
  const GridPoints batch(*cylinder, bindings->camera(), Footprints::over_micropolygons);
  const ShadingPoints& points = batch.points();
  for (int i = 0; i < points.count; ++i) {
    // On a unit cylinder N and P turn by the same angle, here 0.02 radians.
    CHECK(glm::length(points.dNdx[i] - points.dPdx[i]) < 1e-6f);
    CHECK(glm::length(points.dNdx[i]) == Approx(0.02).epsilon(1e-3));
    CHECK(glm::length(points.dNdy[i]) == 0.0f);
  }
  const GridPoints bare(*cylinder, bindings->camera(), Footprints::none);
  CHECK(bare.points().dNdx.x == nullptr);
}

TEST_CASE("a highlight narrower than the cells keeps its light in a shader") {
  TestScene test;
  test.add_light(call("distantlight", {triple("from", ValueType::point, {0, 0, 0}),
                                       triple("to", ValueType::point, {0.1f, 0, 1})}));
  const Surface& surface = test.add_surface("metal", {number("roughness", 0.001f)});
  const auto bindings = test.bind();
  const auto mean_light = [&](int u_count) {
    const auto grid = make_cylinder(surface, u_count);
    const SurfaceColors colors = run_surface(*bindings, *grid);
    double sum = 0.0;
    for (int i = 1; i < u_count; ++i) sum += colors.Ci[i + u_count + 1].x;
    return sum / u_count;
  };
  const double fine = mean_light(3000);
  CHECK(fine > 0.01);
  // Cells of 0.1 to 0.3 radians under a lobe of 0.03: wherever the grid falls, the sum is the same.
  // The view turns by a sixth of that.
  for (int u_count : {4, 5, 7, 8, 12}) CHECK(mean_light(u_count) == Approx(fine).epsilon(0.05));
}
