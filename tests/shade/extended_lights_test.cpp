#include <catch2/catch.hpp>

#include <atomic>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "shade/surface_shading.h"
#include "tests/shade/light_fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

using LongVec = glm::vec<3, long double>;

/// What a surface of albedo 1 sends back under a polygon of radiance 1 all above its horizon
/// (J. H. Lambert's formula), counter-clockwise from below or not.
long double under_polygon(const std::vector<glm::dvec3>& corners, const glm::dvec3& P,
                          const glm::dvec3& N) {
  LongVec sum(0.0L);
  for (size_t k = 0; k < corners.size(); ++k) {
    const LongVec a = glm::normalize(LongVec(corners[k]) - LongVec(P));
    const LongVec b = glm::normalize(LongVec(corners[(k + 1) % corners.size()]) - LongVec(P));
    const LongVec across = glm::cross(a, b);
    const long double sine = glm::length(across);
    sum += across / sine * std::atan2(sine, glm::dot(a, b));
  }
  return std::abs(glm::dot(sum, LongVec(N))) / (2.0L * std::acos(-1.0L));
}

/// A space with its z axis along `z` and its origin at `at`.
glm::dmat4 space(const glm::dvec3& at, const glm::dvec3& z, const glm::dvec3& scale) {
  const glm::dvec3 w = glm::normalize(z);
  const glm::dvec3 u = glm::normalize(glm::cross(glm::dvec3(0.3, 1.0, 0.2), w));
  glm::dmat4 m(1.0);
  m[0] = glm::dvec4(u * scale.x, 0.0);
  m[1] = glm::dvec4(glm::cross(w, u) * scale.y, 0.0);
  m[2] = glm::dvec4(w * scale.z, 0.0);
  m[3] = glm::dvec4(at, 1.0);
  return m;
}

std::vector<glm::dvec3> rectangle_corners(const glm::dmat4& from_light, double w, double h) {
  std::vector<glm::dvec3> corners;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    corners.emplace_back(from_light * glm::dvec4(0.5 * w * x, 0.5 * h * y, 0.0, 1.0));
  }
  return corners;
}

const glm::dmat4 identity(1.0);

/// (z of the direction + 1, whether x > 0, 1) as a latitude-longitude picture, for "sky.tex".
struct SkySampler : TextureSampler {
  std::atomic<uint64_t>* asked;
  explicit SkySampler(std::atomic<uint64_t>* points_asked) : asked(points_asked) {}

  TextureResult sample(const TextureRequest& request, const TexturePoints& points,
                       std::span<float> out) override {
    if (request.file != "sky.tex") return {false, "no such file"};
    const size_t n = points.s.size();
    *asked += n;
    for (size_t i = 0; i < n; ++i) {
      const bool ahead = points.s[i] > 0.25f && points.s[i] < 0.75f;
      out[i] = std::cos(float(M_PI) * points.t[i]) + 1.0f, out[n + i] = ahead, out[2 * n + i] = 1;
    }
    return {};
  }
};

/// A surface under a dome with that map.
struct SkyScene : LitScene {
  mutable std::atomic<uint64_t> asked = 0;  ///< points that the map was looked up at

  explicit SkyScene(std::vector<Parameter> parameters,
                    const glm::dmat4& from_light = glm::dmat4(1.0))
      : LitScene(call("domelight", with_map(std::move(parameters)), from_light)) {
    bindings = bind_shaders({&test.scene, test.camera.get(), &test.diagnostics,
                             [this] { return std::make_shared<SkySampler>(&asked); }});
  }
  static std::vector<Parameter> with_map(std::vector<Parameter> parameters) {
    parameters.push_back(text("texturename", "sky.tex"));
    return parameters;
  }
};

}  // namespace

TEST_CASE("sums over few places are as good on either diagonal of a light", "[light]") {
  // What the square [-1, 1]^2 sends to a point two below its plane that faces it, but for a factor.
  const auto received = [](const glm::dvec2& P, const std::vector<glm::vec2>& places) {
    double sum = 0;
    for (const glm::vec2& xi : places) {
      const glm::dvec2 d = 2.0 * glm::dvec2(xi) - 1.0 - P;
      sum += 1.0 / std::pow(glm::dot(d, d) + 4.0, 2);
    }
    return sum / double(places.size());
  };
  constexpr int n = 200;
  std::vector<glm::vec2> all;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      all.emplace_back((float(i) + 0.5f) / float(n), (float(j) + 0.5f) / float(n));
  for (const glm::dvec2& P : {glm::dvec2(0, 0), {1, 1}, {-2, 2}, {2, 1}, {3, -3}}) {
    const double exact = received(P, all);
    CAPTURE(P.x, P.y);
    CHECK(received(P, spread_places(16)) == Approx(exact).epsilon(0.004));
    CHECK(received(P, spread_places(64)) == Approx(exact).epsilon(0.001));
    CHECK(received(P, spread_places(1024)) == Approx(exact).epsilon(1e-4));
  }
}

TEST_CASE("a rectangle light adds what Lambert's formula says", "[light]") {
  const glm::dmat4 tilted = space({1.0, -0.5, 2.0}, {-0.2, 0.3, 1.0}, {1.5, 1.0, 0.7});
  const auto corners = rectangle_corners(tilted, 0.8, 1.2);
  const glm::vec3 N = glm::normalize(glm::vec3(0.1f, -0.2f, -1.0f));
  for (const auto& [samples, tolerance] : {std::pair{1024.0f, 6e-4}, {16.0f, 0.02}}) {
    const LitScene scene(call(
        "rectanglelight",
        {number("width", 0.8f), number("height", 1.2f), number("intensity", 3.0f),
         number("samples", samples), triple("lightcolor", ValueType::color, {1.0f, 0.5f, 0.25f})},
        tilted));
    CHECK(scene.light().places.size() == size_t(samples));
    for (const glm::vec3& P : {glm::vec3(0, 0, 5), {1, -0.5f, 3}, {-4, 3, 6}, {0, 0, 40}}) {
      const double expected = 3.0 * double(under_polygon(corners, P, N));
      const glm::dvec3 found = quadrature(scene.light(), P, N);
      CAPTURE(samples, P.x, P.z);
      CHECK(found.x == Approx(expected).epsilon(tolerance));
      CHECK(found.z == Approx(0.25 * expected).epsilon(tolerance));
    }
  }
}

TEST_CASE("a rectangle light shines along its +z only, mirrored spaces or not", "[light]") {
  for (const double mirror : {1.0, -1.0}) {
    const glm::dmat4 from_light = space({0, 0, 2}, {0, 0, 1}, {mirror, 1.0, 1.0});
    const LitScene scene(call("rectanglelight", {}, from_light));
    CHECK(quadrature(scene.light(), {0, 0, 4}, {0, 0, -1}).x > 0.05);
    CHECK(quadrature(scene.light(), {0, 0, 1}, {0, 0, 1}).x == 0.0);
  }
}

TEST_CASE("a disc light on its axis follows r^2 / (r^2 + d^2)", "[light]") {
  const LitScene scene(call("disclight", {number("radius", 0.75f), number("samples", 1024)}));
  for (const double d : {0.3, 1.0, 5.0, 100.0}) {
    const double expected = 0.5625 / (0.5625 + d * d);
    CHECK(quadrature(scene.light(), {0, 0, d}, {0, 0, -1}).x == Approx(expected).epsilon(5e-3));
  }
}

TEST_CASE("a sphere light above the horizon follows (r / d)^2 cos", "[light]") {
  const glm::vec3 centre(1.0f, 2.0f, 3.0f);
  const LitScene scene(call("spherelight", {number("radius", 0.5f), number("samples", 256)},
                            glm::translate(identity, glm::dvec3(centre))));
  const glm::vec3 N = glm::normalize(glm::vec3(0.2f, 0.1f, -1.0f));
  for (const glm::vec3& P : {glm::vec3(1, 2, 4), {0, 1, 5}, {-30, 0, 100}, {1e4f, 0, 3e4f}}) {
    const double d = glm::distance(glm::dvec3(centre), glm::dvec3(P));
    const double cosine = glm::dot(glm::dvec3(N), glm::dvec3(centre) - glm::dvec3(P)) / d;
    const double expected = 0.25 / (d * d) * cosine;
    CHECK(quadrature(scene.light(), P, N).x == Approx(expected).epsilon(1e-3));
  }
  CHECK(quadrature(scene.light(), centre + glm::vec3(0.1f, 0, 0), N).x == 0.0);  // inside
}

TEST_CASE("an ellipsoid's light agrees with a sum over its surface", "[light]") {
  const glm::dmat4 from_light = space({0.5, 0.0, 1.0}, {0.4, 0.2, 1.0}, {0.5, 0.25, 1.0});
  const LitScene scene(call("spherelight", {number("samples", 4096)}, from_light));
  const glm::dvec3 P(0.2, -0.3, 5.0), N(0.0, 0.0, -1.0);
  double sum = 0.0;
  const int n = 600;
  const glm::dmat3 linear(from_light);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      // Even in the ball's z and longitude; a patch's area is |M du x M dv|.
      const double z = 2.0 * (j + 0.5) / n - 1.0, r = std::sqrt(1.0 - z * z);
      const double angle = 2.0 * M_PI * (i + 0.5) / n;
      const glm::dvec3 unit(r * std::cos(angle), r * std::sin(angle), z);
      const glm::dvec3 du = linear * glm::dvec3(-unit.y, unit.x, 0.0);
      const glm::dvec3 dv = linear * glm::dvec3(-z / (r * r) * unit.x, -z / (r * r) * unit.y, 1.0);
      const glm::dvec3 area = glm::cross(du, dv),
                       to = glm::dvec3(from_light[3]) + linear * unit - P;
      const double d2 = glm::dot(to, to), facing = -glm::dot(area, to), cosine = glm::dot(N, to);
      if (facing > 0.0 && cosine > 0.0) sum += facing * cosine / (d2 * d2);
    }
  }
  const double expected = sum * (2.0 / n) * (2.0 * M_PI / n) / M_PI;
  CHECK(quadrature(scene.light(), P, N).x == Approx(expected).epsilon(1e-3));
}

TEST_CASE("under a dome of radiance 1 a matte surface shows 1, whichever way it faces", "[light]") {
  for (const float samples : {1.0f, 5.0f, 16.0f}) {
    const LitScene scene(call("domelight", {number("samples", samples)}));
    for (const glm::vec3& n : {glm::vec3(0, 0, -1), {0, 0, 1}, {1, 2, 3}, {-1, 1e-4f, 0}}) {
      CHECK(quadrature(scene.light(), {1, 2, 3}, glm::normalize(n)).y == Approx(1.0).epsilon(1e-5));
    }
  }
}

TEST_CASE("a dome's map is looked up in the light's space and multiplies it", "[light]") {
  // The map's z points along camera -z, its x along camera y.
  const glm::dmat4 from_light({0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, -1, 0}, {5, 6, 7, 1});
  const SkyScene scene({number("samples", 4096), number("intensity", 2)}, from_light);
  // The mean of 1 + cos with the cosine's density is 1 + 2/3; half lies ahead.
  const glm::dvec3 up = quadrature(scene.light(), {1, 2, 3}, {0, 0, -1});
  CHECK(up.x == Approx(2.0 * (5.0 / 3.0)).epsilon(2e-3));
  CHECK(up.y == Approx(1.0).epsilon(5e-3));
  CHECK(up.z == Approx(2.0).epsilon(1e-4));
  CHECK(quadrature(scene.light(), {1, 2, 3}, {0, 1, 0}).y == Approx(2.0).epsilon(5e-3));
  CHECK(quadrature(scene.light(), {1, 2, 3}, {0, -1, 0}).y == Approx(0.0).margin(5e-3));
}

TEST_CASE("look-ups in a dome's map are counted, whoever asks", "[light]") {
  // At rate cell 9 places at each of 25 vertices; apart from them 36, and one for each share.
  for (const char* rate : {"cell", "sample"}) {
    const SkyScene scene({number("samples", 9), text("shadowrate", rate)});
    const auto grid = make_square(scene.test.scene.surfaces.front(), 4, 3.0f);
    const GridPoints batch(*grid, scene.bindings->camera(), Footprints::over_micropolygons);
    const SurfaceBinding& surface = scene.bindings->of(grid->attributes());
    SurfaceColors colors;
    ShadeCounters counters;
    shade_surface(*scene.bindings, surface, batch.points(), FailedPoint::black, colors, counters);
    CHECK(counters.texture_lookups == (std::string(rate) == "cell" ? 9u : 36u) * 25);
    CHECK(counters.texture_lookups == scene.asked);
  }
  const SkyScene scene({number("samples", 9)});
  (void)shares(scene, {1, 2, 3}, {0, 0, -1}, {{0.1f, 0.2f}, {0.6f, 0.7f}});
  CHECK(scene.counters.texture_lookups == 2 + 2 * 36);  // the shares, and the means for them
  CHECK(scene.counters.texture_lookups == scene.asked);
}

TEST_CASE("surface shaders gather the light of places", "[light]") {
  const glm::dmat4 from_light = space({0.5, 0.2, 1.0}, {0, 0, 1}, {1, 1, 1});
  for (const char* rate : {"cell", "sample"}) {
    LitScene scene(
        call("rectanglelight", {number("samples", 256), text("shadowrate", rate)}, from_light));
    const auto grid = make_square(scene.test.scene.surfaces.front(), 4, 3.0f);
    const SurfaceColors colors = run_surface(*scene.bindings, *grid);
    const bool apart = std::string(rate) == "sample";
    REQUIRE(colors.light_terms.size() == (apart ? 2u : 0u));  // and the mean over its places
    for (int i = 0; i < grid->vertex_count(); ++i) {
      const glm::dvec3 P(grid->P(0, 0)[i], grid->P(0, 1)[i], 3.0);
      const double expected =
          double(under_polygon(rectangle_corners(from_light, 1, 1), P, {0, 0, -1}));
      const glm::vec3 found = apart ? colors.light_terms[0][i] : colors.Ci[i];
      CHECK(found.x == Approx(expected).epsilon(4e-3));
      if (apart) CHECK(colors.Ci[i].x == 0.0f);
      if (apart) CHECK(colors.light_terms[1][i].x == found.x);  // of a white surface the same
    }
  }
}

TEST_CASE("light that is shadowed apart is summed over sixteen times the places", "[light]") {
  for (const char* name : {"rectanglelight", "disclight", "spherelight", "domelight"}) {
    for (const char* rate : {"cell", "pixel", "sample"}) {
      CAPTURE(name, rate);
      const LitScene scene(call(name, {number("samples", 9), text("shadowrate", rate)}));
      const bool apart = std::string(rate) != "cell";
      CHECK(scene.light().places.size() == 9);
      CHECK(scene.light().open_places.size() == (apart ? 36u : 9u));
      CHECK(scene.light().term.has_value() == apart);
      CHECK(scene.light().mean_term.has_value() == apart);
      CHECK(scene.bindings->light_term_count() == (apart ? 2u : 0u));
    }
  }
  const LitScene bounce(call("occlusionlight"));  // is the same from everywhere
  CHECK(bounce.light().open_places.size() == bounce.light().places.size());
  CHECK(bounce.bindings->light_term_count() == 1);
}

TEST_CASE("highlights of a small light with extent are those of a point light", "[light]") {
  const auto highlight = [](ShaderCall light) {
    LitScene scene(std::move(light));
    Attributes attributes;
    attributes.surface = call("plastic", {number("Kd", 0), number("roughness", 0.2f)});
    TestScene& test = scene.test;
    const Surface& surface = test.add_surface(attributes);
    scene.bindings = bind_shaders({&test.scene, test.camera.get(), &test.diagnostics, nullptr});
    return run_surface(*scene.bindings, *make_square(surface, 4, 3.0f), Footprints::none);
  };
  // Area 1e-4 at right angles to +z; intensity makes Cl = 1 / d^2 on the axis.
  const SurfaceColors extended = highlight(call(
      "rectanglelight", {number("width", 0.01f), number("height", 0.01f), number("samples", 4),
                         number("intensity", 1e4f * float(M_PI)), text("shadowrate", "cell")}));
  const SurfaceColors point = highlight(call("pointlight"));
  CHECK(point.Ci[12].x > 0.05f);
  CHECK(extended.Ci[12].x == Approx(point.Ci[12].x).epsilon(1e-3));
}

TEST_CASE("lights of very large and very small size stay what they are", "[light]") {
  SECTION("a rectangle of 1e6 is a furnace lid") {
    const LitScene scene(call(
        "rectanglelight", {number("width", 1e6f), number("height", 1e6f), number("samples", 64)}));
    // Right under it the places are too few for the formula, but what arrives has a bound.
    const double found = quadrature(scene.light(), {0, 0, 1}, {0, 0, -1}).x;
    CHECK(found >= 0.0);
    CHECK(found <= 128.0);
    CHECK(quadrature(scene.light(), {0, 0, 1e6f}, {0, 0, -1}).x == Approx(0.239).epsilon(0.02));
  }
  SECTION("a ball of 1e6 and one of 1e-6") {
    for (const double r : {1e6, 1e-6}) {
      const LitScene scene(call("spherelight", {number("radius", float(r))}));
      const double found = quadrature(scene.light(), {0, 0, 2 * r}, {0, 0, -1}).x;
      CHECK(found == Approx(0.25).epsilon(0.01));
    }
  }
  SECTION("far from everything") {
    const LitScene scene(call("rectanglelight", {number("width", 1e-6f), number("height", 1e-6f)}));
    CHECK(quadrature(scene.light(), {0, 0, 1e-3f}, {0, 0, -1}).x ==
          Approx(1e-6 / M_PI).epsilon(1e-4));
    for (const glm::vec3& P : {glm::vec3(0, 0, 1e7f), {0, 0, 1e30f}, {1e30f, 1e30f, 1e30f}}) {
      CHECK(std::isfinite(quadrature(scene.light(), P, {0, 0, -1}).x));
    }
  }
  SECTION("so near one of the places that the rest of the light is nothing to it") {
    const LitScene scene(call("rectanglelight"));
    const glm::vec2 place = scene.light().places[8] - 0.5f;
    for (const float height : {1e-3f, 1e-6f, 1e-12f}) {
      const double found = quadrature(scene.light(), {place, height}, {0, 0, -1}).x;
      CHECK((found > 1.9 && found < 2.1));  // at most 2 n / n of it
    }
  }
  SECTION("on the light itself") {
    for (const char* name : {"rectanglelight", "disclight", "spherelight"}) {
      const LitScene scene(call(name));
      for (const glm::vec3& P :
           {glm::vec3(0), {0.03125f, 0.03125f, 0}, {0, 0, 1}, {0, 0, 1e-20f}}) {
        const double found = quadrature(scene.light(), P, {0, 0, -1}).x;
        CAPTURE(name, P.z);
        CHECK(found >= 0.0);
        CHECK(found <= 32.0);
      }
    }
  }
}

TEST_CASE("lights that can never shine are refused with their place and what is wrong", "[light]") {
  const auto refusal = [](ShaderCall light) -> std::string {
    try {
      LitScene scene(std::move(light));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  using Catch::Contains;
  using Catch::StartsWith;
  CHECK_THAT(refusal(call("rectanglelight", {number("width", 0)})),
             StartsWith("scene.rib:7: ") && Contains("rectanglelight") &&
                 Contains("\"width\" is 0, expected a positive number"));
  CHECK_THAT(refusal(call("rectanglelight", {number("height", -2)})), Contains("\"height\" is -2"));
  CHECK_THAT(refusal(call("disclight", {number("radius", NAN)})), Contains("nan"));
  CHECK_THAT(refusal(call("spherelight", {number("radius", INFINITY)})), Contains("inf"));
  const glm::dmat4 flat = glm::scale(identity, glm::dvec3(1, 0, 1));
  CHECK_THAT(refusal(call("disclight", {}, flat)), StartsWith("scene.rib:7: ") && Contains("area"));
  CHECK_THAT(refusal(call("spherelight", {}, flat)), Contains("cross section"));
  // What is flat anyway may be flattened along its normal.
  CHECK(refusal(call("disclight", {}, glm::scale(identity, glm::dvec3(1, 1, 0)))).empty());
  CHECK(refusal(call("domelight", {}, flat)).empty());
  for (const float samples : {0.0f, -1.0f, 0.4f, 4097.0f, 1e30f, INFINITY, NAN}) {
    CAPTURE(samples);
    for (const char* name : {"rectanglelight", "domelight", "occlusionlight", "indirectlight"})
      CHECK_THAT(refusal(call(name, {number("samples", samples)})),
                 StartsWith("scene.rib:7: ") && Contains(name) && Contains("between 1 and 4096"));
    CHECK_THAT(
        refusal(call("spotlight", {number("samples", samples), text("shadowname", "map.z")})),
        StartsWith("scene.rib:7: ") && Contains("between 1 and 4096"));
    CHECK(refusal(call("spotlight", {number("samples", samples)})).empty());  // not asked for
  }
  for (const float samples : {1.0f, 0.6f, 4096.0f})
    CHECK(refusal(call("rectanglelight", {number("samples", samples)})).empty());
  CHECK_THAT(refusal(call("domelight", {text("texturename", "sky.tex")}, flat)),
             StartsWith("scene.rib:7: ") && Contains("inverse"));
}

TEST_CASE("the places that lights are summed over are stratified", "[light]") {
  for (const int n : {1, 2, 3, 7, 16, 64, 100}) {
    const auto places = spread_places(n);
    REQUIRE(places.size() == size_t(n));
    std::vector<int> along_x(size_t(n), 0);
    double mean = 0.0;
    for (const glm::vec2& p : places) {
      CHECK((p.x > 0.0f && p.x < 1.0f && p.y > 0.0f && p.y < 1.0f));
      ++along_x[size_t(p.x * float(n))];
      mean += p.x / n;
    }
    for (const int count : along_x) CHECK(count == 1);
    CHECK(mean == Approx(0.5));
  }
  std::vector<int> in_square(16, 0);
  for (const glm::vec2& p : spread_places(16)) ++in_square[size_t(int(p.x * 4) * 4 + int(p.y * 4))];
  for (const int count : in_square) CHECK(count == 1);
}
