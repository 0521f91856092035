#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "shade/mathematics.h"
#include "shade/noise.h"
#include "shade/pattern_points.h"
#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// A cell of that length and width, its longer axis at `angle` to x.
struct TurnedCell {
  glm::vec2 x, y;
  TurnedCell(float length, float width, float angle)
      : x(length * std::cos(angle), length * std::sin(angle)),
        y(-width * std::sin(angle), width * std::cos(angle)) {}
};

double brute_force_checker(glm::dvec2 st, glm::dvec2 x, glm::dvec2 y) {
  const int steps = 300;
  int white = 0;
  for (int j = 0; j < steps; ++j) {
    for (int i = 0; i < steps; ++i) {
      const glm::dvec2 p = st + ((i + 0.5) / steps - 0.5) * x + ((j + 0.5) / steps - 0.5) * y;
      white += (long(std::floor(p.x)) + long(std::floor(p.y))) % 2 == 0 ? 1 : 0;
    }
  }
  return double(white) / (steps * steps);
}

/// A sphere of radius 1 around (0.3, 0.2, 4), turned so that its grid meets the pole of the map.
glm::vec3 sphere_normal(float u, float v) {
  const float a = 0.6f * (u - 0.5f), b = 0.4f * (v - 0.5f) + 0.2f * u;
  return {std::sin(a) * std::cos(b), std::sin(b), -std::cos(a) * std::cos(b)};
}

/// Keeps the footprints of the last look-up.
struct RecordingSampler : TextureSampler {
  std::vector<float> s, t, dsdx, dtdx, dsdy, dtdy;
  TextureResult sample(const TextureRequest&, const TexturePoints& points,
                       std::span<float>) override {
    const auto copy = [](std::span<const float> v) { return std::vector(v.begin(), v.end()); };
    s = copy(points.s), t = copy(points.t);
    dsdx = copy(points.dsdx), dtdx = copy(points.dtdx);
    dsdy = copy(points.dsdy), dtdy = copy(points.dtdy);
    return {};
  }
};

}  // namespace

TEST_CASE("principal axes are at right angles and have the parallelogram's covariance") {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> side(-1.0f, 1.0f);
  for (int k = 0; k < 1000; ++k) {
    const glm::vec3 a(side(random), side(random), side(random));
    const glm::vec3 b = k % 4 == 0 ? side(random) * a  // also parallel ones
                                   : glm::vec3(side(random), side(random), side(random));
    const CellAxes<glm::vec3> axes = principal_axes(a, b);
    CHECK(glm::dot(axes.major, axes.minor) == Approx(0.0).margin(1e-6));
    CHECK(glm::length(axes.major) >= glm::length(axes.minor));
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        CHECK(axes.major[i] * axes.major[j] + axes.minor[i] * axes.minor[j] ==
              Approx(a[i] * a[j] + b[i] * b[j]).margin(2e-6));
      }
    }
  }
  const glm::vec2 zero(0.0f), x(2.0f, 0.0f);
  CHECK(principal_axes(zero, zero).major == zero);
  CHECK(principal_axes(zero, x).major == x);
  CHECK(taps_along(0.0f, 0.0f) == 1);
  CHECK(taps_along(1.0f, 0.0f) == most_taps);
  CHECK(taps_along(1.4f, 1.0f) == 1);
  CHECK(taps_along(8.0f, 1.0f) == 8);
  CHECK(taps_along(1e30f, 1.0f) == most_taps);
}

TEST_CASE("a compact cell costs one evaluation, a long one at most sixteen that fill it") {
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  const auto bindings = test.bind();
  const auto evaluations = [&](float du, float dv) {
    const auto grid = make_grid(surface, 4, 4, [&](float u, float v) {
      return glm::vec3(4.0f * du * (u - 0.5f), 4.0f * dv * (v - 0.5f), 5.0f);
    });
    const GridPoints batch(*grid, bindings->camera(), Footprints::over_micropolygons);
    ShadeCounters counters;
    const ShaderContext context(bindings->of(grid->attributes()).surface, batch.points(),
                                {{}, nullptr, &counters});
    const PatternPoints pattern = context.pattern_points();
    std::vector<float> along, footprints;
    const float mean = pattern.average_over_cell(12, [&](const glm::vec3& P, float footprint) {
      along.push_back(du > dv ? P.x : P.y);
      footprints.push_back(footprint);
      return du > dv ? P.x : P.y;
    });
    CHECK(mean == Approx(0.0).margin(1e-5));  // the cell is around the point
    const float length = std::max(du, dv), part = length / float(along.size());
    for (float footprint : footprints) {
      CHECK(footprint == Approx(std::max(part, along.size() == 1 ? 0.0f : std::min(du, dv))));
    }
    for (size_t k = 1; k < along.size(); ++k) {
      CHECK(std::abs(along[k] - along[k - 1]) == Approx(part).epsilon(1e-4));
    }
    return along.size();
  };
  CHECK(evaluations(0.1f, 0.1f) == 1);
  CHECK(evaluations(0.1f, 0.08f) == 1);
  CHECK(evaluations(0.1f, 0.4f) == 4);
  CHECK(evaluations(1.6f, 0.1f) == 16);
  CHECK(evaluations(6.4f, 0.1f) == 16);
}

TEST_CASE("marble over a long cell is the mean of sharp marble over it") {
  TestScene test;
  test.add_light(call("ambientlight"));
  const Surface& surface = test.add_surface("marble", {number("frequency", 0.5f)});
  const auto bindings = test.bind();
  const float length = 1.6f, width = 0.1f;
  for (float angle : {0.0f, 0.9f, 2.2f}) {
    const glm::vec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
    /// Marble on a grid of 8 x 8 cells of that size around the middle vertex, 40.
    const auto middle = [&](glm::vec2 centre, float du, float dv) {
      const auto grid = make_grid(surface, 8, 8, [&](float u, float v) {
        const glm::vec2 p = centre + 8.0f * (du * (u - 0.5f) * along + dv * (v - 0.5f) * across);
        return glm::vec3(p, 5.0f);
      });
      return run_surface(*bindings, *grid);
    };
    double squared = 0.0, squared_isotropic = 0.0;
    const int places = 12;
    for (int k = 0; k < places; ++k) {
      const glm::vec2 centre(3.7f * float(k), -1.3f * float(k));
      // 64 x 8 sharp points over the cell, in eight grids along it.
      double mean = 0.0;
      for (int part = 0; part < 8; ++part) {
        const glm::vec2 at = centre + ((float(part) + 0.5f) / 8.0f - 0.5f) * length * along;
        const SurfaceColors fine = middle(at, length / 72.0f, width / 9.0f);
        for (int i = 0; i < 81; ++i) mean += fine.Ci[i].x / (8.0 * 81.0);
      }
      squared += std::pow(middle(centre, length, width).Ci[40].x - mean, 2);
      squared_isotropic += std::pow(middle(centre, length, length).Ci[40].x - mean, 2);
    }
    INFO("angle " << angle);
    CHECK(std::sqrt(squared / places) < 0.02);
    CHECK(std::sqrt(squared_isotropic / places) > 3.0 * std::sqrt(squared / places));
  }
}

TEST_CASE("a checkerboard over a long oblique cell is close to its mean") {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> place(-3.0f, 3.0f), turn(0.0f, 3.14f);
  double squared = 0.0, squared_box = 0.0;
  const int count = 60;
  for (int k = 0; k < count; ++k) {
    const TurnedCell cell(4.8f, 0.3f, turn(random));
    const glm::vec2 st(place(random), place(random));
    const double mean = brute_force_checker(st, cell.x, cell.y);
    squared += std::pow(checker_over_cell(st, cell.x, cell.y) - mean, 2);
    const glm::vec2 box = glm::abs(cell.x) + glm::abs(cell.y);
    squared_box += std::pow(filtered_checker(st, box) - mean, 2);
  }
  CHECK(std::sqrt(squared / count) < 0.03);
  CHECK(std::sqrt(squared_box / count) > 4.0 * std::sqrt(squared / count));
}

TEST_CASE("a checkerboard over a cell along s and t, or a compact one, is one box") {
  for (float angle : {0.0f, pi / 4.0f, pi / 2.0f}) {
    const TurnedCell cell(angle == pi / 4.0f ? 0.4f : 6.4f, 0.4f, angle);
    for (float s = -1.0f; s < 2.0f; s += 0.37f) {
      const glm::vec2 st(s, 0.3f * s + 0.1f);
      if (angle != 0.0f) {
        CHECK(checker_over_cell(st, cell.x, cell.y) ==
              Approx(filtered_checker(st, glm::abs(cell.x) + glm::abs(cell.y))).margin(1e-5));
      } else {
        CHECK(checker_over_cell(st, cell.x, cell.y) == filtered_checker(st, {6.4f, 0.4f}));
      }
    }
  }
  CHECK(checker_over_cell({0.5f, 0.5f}, {0, 0}, {0, 0}) == 1.0f);
}

TEST_CASE("an environment is filtered over the spread of mirror directions") {
  TestScene test;
  const auto sampler = std::make_shared<RecordingSampler>();
  test.texture_sampler = [&] { return sampler; };
  const float blur = 0.005f;
  const Surface& surface =
      test.add_surface("shinymetal", {text("texturename", "any.tex"), number("roughness", blur)});
  const int n = 96, row = n + 1;
  const auto grid = make_grid(surface, n, n, [](float u, float v) {
    return glm::vec3(0.3f, 0.2f, 4.0f) + sphere_normal(u, v);
  });
  for (size_t k = 0; k < size_t(grid->vertex_count()); ++k) {
    const glm::vec3 N = sphere_normal(grid->uv[k], grid->uv[grid->stride() + k]);
    for (size_t c = 0; c < 3; ++c) grid->N_camera[c * grid->stride() + k] = N[int(c)];
  }
  run_surface(*test.bind(), *grid);
  const RecordingSampler& found = *sampler;
  REQUIRE(found.s.size() == size_t(grid->vertex_count()));
  int checked = 0;
  for (int j = 1; j < n; ++j) {
    for (int i = 1; i < n; ++i) {
      // The sampler saw where the neighbours look: half their difference is the change over a cell.
      const size_t k = size_t(j * row + i);
      const auto change = [&](const std::vector<float>& f, size_t step) {
        const double difference = double(f[k + step]) - f[k - step];
        return 0.5 * (difference - std::round(difference));  // s may wrap around
      };
      const size_t up = size_t(row);
      const double t = found.t[k], sine = std::sin(pi * t);
      if (sine < 0.2) continue;  // nearer the pole st is not linear over a cell
      const double sx = change(found.s, 1), sy = change(found.s, up);
      const double tx = change(found.t, 1), ty = change(found.t, up);
      const double s_blur = blur / (2.0 * pi * sine), t_blur = blur / double(pi);
      const auto covariance = [](double a, double b, double c, double d) { return a * b + c * d; };
      const double dsdx = found.dsdx[k], dsdy = found.dsdy[k];
      const double dtdx = found.dtdx[k], dtdy = found.dtdy[k];
      const double ss = covariance(sx, sx, sy, sy) + s_blur * s_blur;
      const double tt = covariance(tx, tx, ty, ty) + t_blur * t_blur;
      const double st = covariance(sx, tx, sy, ty);
      INFO("vertex " << i << " " << j << " sine " << sine);
      CHECK(covariance(dsdx, dsdx, dsdy, dsdy) == Approx(ss).epsilon(0.03));
      CHECK(covariance(dtdx, dtdx, dtdy, dtdy) == Approx(tt).epsilon(0.03));
      CHECK(covariance(dsdx, dtdx, dsdy, dtdy) == Approx(st).margin(0.03 * std::sqrt(ss * tt)));
      ++checked;
    }
  }
  CHECK(checked > 5000);
}

TEST_CASE("the cost of expensive enters its colour and does not run away") {
  TestScene test;
  test.add_light(call("ambientlight"));
  const auto color = [&](float cost, float scale) {
    const Surface& surface = test.add_surface("expensive", {number("cost", cost)});
    const auto grid = make_grid(surface, 1, 1, [&](float u, float v) {
      return glm::vec3(0.37f, 0.21f, 2.0f) + scale * glm::vec3(u, v, 0.0f);
    });
    return run_surface(*test.bind(), *grid).Ci[0].x;
  };
  CHECK(color(0.0f, 0.01f) == 1.0f);
  CHECK(color(-5.0f, 0.01f) == 1.0f);
  CHECK(color(std::nanf(""), 0.01f) == 1.0f);
  for (float cost : {1.0f, 2.0f, 10.0f, 100.0f}) {
    // The sum of the fields without its normalisation: one more changes it.
    const auto sum = [&](float n) { return (color(n, 0.01f) - 1.0f) * std::sqrt(n); };
    CHECK(std::abs(sum(cost) - sum(cost + 1.0f)) > 1e-3f);
    CHECK(color(cost, 0.01f) == Approx(1.0).margin(1.0));
  }
  CHECK(color(100.0f, 100.0f) == 1.0f);  // a cell too large to hold any of it
  CHECK(color(2e6f, 0.01f) == color(1e6f, 0.01f));
}
