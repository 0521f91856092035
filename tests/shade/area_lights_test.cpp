#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "shade/emitter.h"
#include "shade/surface_shading.h"
#include "tests/shade/light_fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// An area light on one surface, with the grids that shine. Nothing is in the way.
struct AreaScene {
  TestScene test;
  std::shared_ptr<ShaderBindings> bindings;
  std::vector<std::shared_ptr<const Grid>> grids;
  const Surface* shining = nullptr;
  const Surface* lit = nullptr;

  explicit AreaScene(std::vector<Parameter> parameters, const std::string& name = "arealight") {
    test.add_light(call(name, std::move(parameters)), true);
    Attributes attributes;
    attributes.surface = call("constant");
    attributes.color = glm::vec3(0.0f);
    attributes.area_light = 0;
    shining = &test.add_surface(attributes);
    lit = &test.add_surface("matte");
  }
  void bind() {
    test.camera = std::make_unique<Camera>(test.scene.camera);
    bindings = bind_shaders({&test.scene, test.camera.get(), &test.diagnostics, nullptr});
  }
  void shine() { bindings->use_emitters(grids); }
  const BoundLight& light() const { return *bindings->of(*lit->attributes).lights.at(0); }
};

/// A grid over the rectangle centre + (2 u - 1) a + (2 v - 1) b.
std::shared_ptr<Grid> rectangle_grid(const Surface& surface, int count, const glm::vec3& centre,
                                     const glm::vec3& a, const glm::vec3& b) {
  return make_grid(surface, count, count, [=](float u, float v) {
    return centre + (2.0f * u - 1.0f) * a + (2.0f * v - 1.0f) * b;
  });
}

}  // namespace

TEST_CASE("an area light on a rectangle is a rectanglelight", "[light]") {
  glm::dmat4 from_light = glm::translate(glm::dmat4(1.0), glm::dvec3(0.4, -0.3, 1.0));
  from_light = glm::rotate(from_light, 0.4, glm::dvec3(0.2, 1.0, 0.1));
  const LitScene rectangle(call("rectanglelight",
                                {number("width", 1.2f), number("height", 0.8f),
                                 number("intensity", 2.0f), number("samples", 64)},
                                from_light));
  const LightExtent& extent = rectangle.light().extent;
  // As one parallelogram the places are the same; over a grid they are nearly.
  for (const auto& [count, epsilon] : {std::pair{1, 1e-5}, {16, 6e-3}}) {
    AreaScene area({number("intensity", 2.0f), number("samples", 64)});
    area.grids = {rectangle_grid(*area.shining, count, extent.centre, extent.half_axes[0],
                                 extent.half_axes[1])};
    area.bind();
    area.shine();
    const BoundLight& light = area.light();
    CHECK(glm::distance(light.extent.centre, extent.centre) < 1e-6f);
    CHECK(light.extent.area_root == Approx(extent.area_root));
    double longest = 0.0;
    for (const glm::vec3& axis : light.extent.half_axes)
      longest = std::max(longest, double(glm::length(axis)));
    CHECK(longest == Approx(0.6));
    for (const glm::vec3& P : {glm::vec3(0, 0, 4), {1, 1, 3}, {-3, 0, 8}, {0.4f, -0.3f, -5}}) {
      const glm::vec3 N(0, 0, P.z > 0.0f ? -1 : 1);
      const double expected = quadrature(rectangle.light(), P, N).x;
      CAPTURE(count, P.x, P.y);
      CHECK(quadrature(light, P, N).x == Approx(expected).epsilon(epsilon));
    }
  }
}

TEST_CASE("outward is what the grid says, and both sides shine on request", "[light]") {
  for (const float sign : {1.0f, -1.0f}) {
    for (const float both : {0.0f, 1.0f}) {
      AreaScene area({number("doublesided", both)});
      const auto grid = rectangle_grid(*area.shining, 2, {0, 0, 2}, {1, 0, 0}, {0, 1, 0});
      grid->normal_sign = sign;
      area.grids = {grid};
      area.bind();
      area.shine();
      const bool forward = quadrature(area.light(), {0, 0, 5}, {0, 0, -1}).x > 0.0;
      const bool backward = quadrature(area.light(), {0, 0, -1}, {0, 0, 1}).x > 0.0;
      CHECK(forward == (both != 0.0f || sign > 0.0f));
      CHECK(backward == (both != 0.0f || sign < 0.0f));
    }
  }
}

TEST_CASE("places are drawn evenly over several grids of unequal triangles", "[light]") {
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  // Columns grow wider to the right; together the two grids are [0, 4] x [0, 1].
  const auto grid_over = [&](float from, float to, int columns) {
    return make_grid(surface, columns, 3, [=](float u, float v) {
      return glm::vec3(from + (to - from) * u * u, v, 2.0f);
    });
  };
  const Emitter emitter({grid_over(0, 1, 5), grid_over(1, 4, 7)});
  CHECK(emitter.extent().area_root == Approx(2.0));
  CHECK(glm::distance(emitter.extent().centre, glm::vec3(2.0f, 0.5f, 2.0f)) < 1e-6f);
  const int n = 1 << 16;
  std::vector<int> count(16, 0);
  for (const glm::vec2& xi : spread_places(n)) {
    const LightPlace place = emitter.place(xi, 0.0f);
    CHECK((place.at.x >= 0.0f && place.at.x <= 4.0f));
    CHECK(place.normal == glm::vec3(0, 0, 1));
    const int column = std::min(int(place.at.x * 2.0f), 7), row = place.at.y < 0.5f ? 0 : 1;
    ++count[size_t(2 * column + row)];
  }
  for (const int c : count) CHECK(c == Approx(n / 16).epsilon(0.02));
}

TEST_CASE("places well spread over the unit square are so on a grid", "[light]") {
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  // Columns and rows of unequal widths: at the right place but for the size of a micropolygon.
  const auto column = [](float u) { return 4.0f * u * u; };
  const auto row = [](float v) { return 4.0f * std::sqrt(v); };
  const Emitter emitter({make_grid(
      surface, 32, 32, [&](float u, float v) { return glm::vec3(column(u), row(v), 1.0f); })});
  for (const glm::vec2& xi : spread_places(64)) {
    const glm::vec3 at = emitter.place(xi, 0.0f).at;
    const glm::vec2 wanted = 4.0f * xi;
    const float u = std::sqrt(xi.x), v = xi.y * xi.y, step = 1.0f / 32.0f;
    CAPTURE(xi.x, xi.y);
    CHECK(std::abs(at.x - wanted.x) <= column(u + step) - column(u - step));
    CHECK(std::abs(at.y - wanted.y) <= row(v + step) - row(std::max(v - step, 0.0f)));
  }
}

TEST_CASE("a ball of many pieces is summed over few places to within a hundredth and a half",
          "[light]") {
  // From outside, a ball that shines evenly sends pi (r / d)^2 to what faces it.
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  constexpr double exact_pi = 3.14159265358979323846;
  constexpr float pi = float(exact_pi);
  const auto quarter = [&](float from) {
    return make_grid(surface, 32, 64, [=](float u, float v) {
      const float a = 2.0f * pi * (from + 0.25f * u), h = pi * (0.0005f + 0.999f * v);
      return 0.5f * glm::vec3(std::cos(a) * std::sin(h), std::sin(a) * std::sin(h), std::cos(h));
    });
  };
  const Emitter emitter({quarter(0.0f), quarter(0.25f), quarter(0.5f), quarter(0.75f)});
  const double area = std::pow(double(emitter.extent().area_root), 2);
  for (const glm::vec3& P : {glm::vec3(2, 0, 0), {0, 0, 3}, {1, -1, 1.5f}, {-1.2f, 2, -0.4f}}) {
    double sum = 0;
    for (const glm::vec2& xi : spread_places(64)) {
      const LightPlace place = emitter.place(xi, 0.0f);
      const glm::dvec3 d = glm::dvec3(place.at) - glm::dvec3(P), n(place.normal);
      const double l = glm::length(d), outward = glm::dot(n, glm::dvec3(place.at)) > 0 ? 1 : -1;
      sum += std::max(0.0, -outward * glm::dot(d, n) / l) *
             (-glm::dot(d, glm::normalize(glm::dvec3(P))) / l) / (l * l);
    }
    const double expected = exact_pi * 0.25 / glm::dot(P, P);
    CAPTURE(P.x, P.y, P.z);
    CHECK(sum / 64 * area == Approx(expected).epsilon(0.015));
  }
}

TEST_CASE("a parallelogram is summed over few places like a rectangle light", "[light]") {
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  const glm::vec3 x(1, 0, 0), y(0.3f, 1, 0);
  const Emitter whole({rectangle_grid(surface, 1, {0, 0, 0}, x, y)});
  // What a point below receives from each place, but for a factor.
  const auto received = [](const Emitter& emitter, const glm::vec3& P, int places) {
    double sum = 0;
    for (const glm::vec2& xi : spread_places(places)) {
      const glm::dvec3 d = glm::dvec3(emitter.place(xi, 0.0f).at - P);
      sum += d.z * d.z / std::pow(glm::dot(d, d), 2);
    }
    return sum / places;
  };
  for (const glm::vec3& P : {glm::vec3(0, 0, -2), {1, 1, -2}, {2, 1, -2}, {-2, 2, -2}}) {
    CAPTURE(P.x, P.y);
    CHECK(received(whole, P, 16) == Approx(received(whole, P, 1 << 16)).epsilon(0.01));
  }
  // Bent at the second key, it is two triangles, each with its own plane.
  const auto bent = rectangle_grid(surface, 1, {0, 0, 0}, x, y);
  add_key(*bent, 1.0f, [](const glm::vec3& P) { return P + glm::vec3(0, 0, P.x * P.y); });
  const Emitter folds({bent});
  const auto normal_at = [&](float u) { return folds.place({u, 0.5f}, 1.0f).normal; };
  CHECK(normal_at(0.25f) != normal_at(0.75f));
  CHECK(whole.place({0.25f, 0.5f}, 0.0f).normal == whole.place({0.75f, 0.5f}, 0.0f).normal);
}

TEST_CASE("the box around an area light is the tighter of two", "[light]") {
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  const glm::vec3 x(0.6f, 0, 0.8f), y(0, 1, 0);
  // A square in a plane of the camera's with a small tilted one before it, so that the first
  // triangle lies askew; and a tilted rectangle, whose first triangle has its axes.
  const auto square = rectangle_grid(surface, 2, {0.5f, 0, 3}, {2, 0, 0}, {0, 2, 0});
  const auto chip = rectangle_grid(surface, 1, {0.5f, 0, 3}, 0.01f * x, 0.01f * y);
  const auto tilted = rectangle_grid(surface, 2, {0.5f, 0, 3}, 2.0f * x, 3.0f * y);
  const auto half_lengths = [](const LightExtent& extent) {
    std::array<float, 3> lengths{};
    for (size_t a = 0; a < 3; ++a) lengths[a] = glm::length(extent.half_axes[a]);
    std::ranges::sort(lengths);
    return lengths;
  };
  const LightExtent of_both = Emitter({chip, square}).extent();
  const auto both = half_lengths(of_both);
  CHECK(both[0] == Approx(0.008f).epsilon(1e-3));  // how far the chip sticks out
  CHECK(both[1] == Approx(2.0f));
  CHECK(both[2] == Approx(2.0f));
  for (const glm::vec3& axis : of_both.half_axes)
    CHECK(std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)}) == glm::length(axis));
  const auto one = half_lengths(Emitter({tilted}).extent());
  CHECK(one[0] == Approx(0.0f).margin(1e-5));
  CHECK(one[1] == Approx(2.0f));
  CHECK(one[2] == Approx(3.0f));
}

TEST_CASE("a moving area light shines from where it is at each point's time", "[light]") {
  TestScene test;
  const auto grid = rectangle_grid(test.add_surface("matte"), 1, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  add_key(*grid, 0.5f, [](const glm::vec3& P) { return P + 4.0f; });
  add_key(*grid, 1.0f, [](const glm::vec3& P) { return P + 2.0f; });
  const Emitter emitter({grid});
  CHECK(emitter.moves());
  const glm::vec3 start = emitter.place({0.3f, 0.6f}, 0.0f).at;
  for (const auto& [time, offset] :
       {std::pair{0.25f, 2.0f}, {0.5f, 4.0f}, {0.75f, 3.0f}, {1.0f, 2.0f}}) {
    CHECK(glm::distance(emitter.place({0.3f, 0.6f}, time).at, start + offset) < 1e-5f);
  }
}

TEST_CASE("points of one batch see a moving area light each at its own time", "[light]") {
  AreaScene area({});
  const auto grid = rectangle_grid(*area.shining, 1, {0, 0, 1}, {0.5f, 0, 0}, {0, 0.5f, 0});
  add_key(*grid, 1.0f, [](const glm::vec3& P) { return P + 2.0f; });
  area.grids = {grid};
  area.bind();
  area.shine();
  BarePoints at({{0, 0, 6}, {0, 0, 6}, {0, 0, 6}}, {0, 0, -1});
  const std::vector<float> times{0.0f, 0.5f, 1.0f};
  at.points.time = times.data();
  const auto from_places = [&](const std::vector<glm::vec2>& xi) {
    PlaceSamples from;
    from.reset(3);
    area.light().definition->illuminate_from(area.light(), at.points, xi, from);
    return from;
  };
  const PlaceSamples same = from_places({{0.3f, 0.6f}, {0.3f, 0.6f}, {0.3f, 0.6f}});
  for (int i = 1; i < 3; ++i) {
    CHECK(glm::distance(same.towards[i], same.towards[0] + 2.0f * times[size_t(i)]) < 1e-5f);
  }
  const PlaceSamples other = from_places({{0.3f, 0.6f}, {0.8f, 0.6f}, {0.3f, 0.6f}});
  CHECK(glm::distance(other.towards[1], same.towards[1]) > 0.1f);
  CHECK(other.towards[2] == same.towards[2]);
}

TEST_CASE("triangles without area are left out, and light without any is refused", "[light]") {
  AreaScene area({});
  const auto grid = rectangle_grid(*area.shining, 2, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  grid->P(0, 0)[0] = NAN;
  CHECK(Emitter({grid}).extent().area_root == Approx(std::sqrt(3.0)));  // 6 of 8 triangles
  area.bind();
  const auto refusal = [&](std::shared_ptr<Grid> only) -> std::string {
    area.grids = {std::move(only)};
    try {
      area.shine();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const std::string said =
      refusal(rectangle_grid(*area.shining, 2, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}));
  CHECK_THAT(said, Catch::StartsWith("scene.rib:7: ") && Catch::Contains("no area"));
  for (const float size : {1e-12f, 1e12f}) {
    CHECK(refusal(rectangle_grid(*area.shining, 2, {0, 0, 1}, {size, 0, 0}, {0, size, 0})).empty());
    const double found = quadrature(area.light(), {0, 0, 1.0f + 2.0f * size}, {0, 0, -1}).x;
    CHECK((found >= 0.0 && found <= 1.0));
  }
}

TEST_CASE("an area light that no surface is part of is refused", "[light]") {
  for (const bool area : {true, false}) {
    TestScene test;
    test.add_light(call("arealight"), area);
    test.add_surface("matte");
    CHECK_THROWS_WITH(test.bind(),
                      Catch::StartsWith("scene.rib:7: light \"arealight\" can never shine") &&
                          Catch::Contains("no surface is part of it"));
  }
}

TEST_CASE("rays are asked for by the shadows of area lights only", "[light]") {
  for (const char* shadow : {"", "off"}) {
    AreaScene area({});
    area.test.scene.lights.back().shadow = shadow;
    area.bind();
    CHECK(wants_emitters(*area.bindings));
    CHECK(wants_rays(*area.bindings) == (shadow != std::string("off")));
  }
  CHECK_FALSE(wants_emitters(*LitScene(call("rectanglelight")).bindings));
}

TEST_CASE("area light shaders by other names are area lights, said once", "[light]") {
  AreaScene area({}, "finite");
  area.bind();
  CHECK(area.light().definition->name == "arealight");
  CHECK(area.test.warned("\"finite\" is taken as an arealight"));
  // Until they are handed over it is not known where its surfaces are.
  CHECK(quadrature(area.light(), {0, 0, 5}, {0, 0, -1}).x == 0.0);
}

TEST_CASE("surfaces of an area light show its radiance on the sides that shine", "[light]") {
  for (const float both : {0.0f, 1.0f}) {
    AreaScene area({number("intensity", 3.0f), number("doublesided", both),
                    triple("lightcolor", ValueType::color, {1, 0.5f, 0})});
    area.bind();
    const auto shown = [&](const Surface& surface, float normal_z) {
      const auto grid = make_square(surface, 1, 3.0f);
      for (size_t k = 0; k < 4; ++k) grid->N_camera[2 * grid->stride() + k] = normal_z;
      const GridPoints batch(*grid, area.bindings->camera(), Footprints::none);
      SurfaceColors colors;
      ShadeCounters counters;
      shade_surface(*area.bindings, area.bindings->of(*surface.attributes), batch.points(),
                    FailedPoint::black, colors, counters);
      for (const Vec3Array& term : colors.light_terms) CHECK(term[0] == glm::vec3(0.0f));
      return colors.Ci[0];
    };
    CHECK(shown(*area.shining, -1.0f) == glm::vec3(3.0f, 1.5f, 0.0f));
    CHECK(shown(*area.shining, 1.0f) == both * glm::vec3(3.0f, 1.5f, 0.0f));
    CHECK(shown(*area.lit, -1.0f) == glm::vec3(0.0f));
  }
}
