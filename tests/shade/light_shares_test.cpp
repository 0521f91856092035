#include <catch2/catch.hpp>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "shade/receiver_frame.h"
#include "tests/shade/light_fixtures.h"
#include "tests/shade/ray_fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

const glm::dmat4 identity(1.0);

glm::dvec2 raster(const Camera& camera, const glm::vec3& P) {
  const glm::dvec3 clip(camera.raster_clip_from_camera(P));
  return {clip.x / clip.z, clip.y / clip.z};
}

/// x + 2 y < 0.3 of the plane z = 3 blocks.
bool half_plane(double x, double y) { return x + 2.0 * y < 0.3; }

/// What arrives at P on a surface that faces -z from the square [-1, 1]^2 at z = 1, or from the
/// disc in it, that shines along +z, shadowed by half_plane(): a sum over the light in double.
double shadowed_sum(const glm::dvec3& P, bool disc, bool blocked) {
  const int n = 800;
  double sum = 0.0;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const glm::dvec3 Y(2.0 * (i + 0.5) / n - 1.0, 2.0 * (j + 0.5) / n - 1.0, 1.0);
      if (disc && Y.x * Y.x + Y.y * Y.y > 1.0) continue;
      const double t = (3.0 - P.z) / (Y.z - P.z);
      const glm::dvec3 at = P + t * (Y - P);
      if (blocked && half_plane(at.x, at.y)) continue;
      const double d2 = glm::dot(Y - P, Y - P), cosine = (P.z - Y.z) / std::sqrt(d2);
      sum += cosine * cosine / d2;
    }
  }
  return sum * 4.0 / (double(n) * n) / M_PI;
}

}  // namespace

TEST_CASE("receiver frames are the derivative of the camera along the surface", "[light]") {
  for (const bool perspective : {true, false}) {
    CameraSettings settings;
    settings.projection = perspective ? Projection::perspective : Projection::orthographic;
    settings.x_resolution = 200, settings.y_resolution = 100;
    const Camera camera(settings);
    const glm::vec3 P(0.3f, -0.4f, 3.0f), N = glm::normalize(glm::vec3(0.5f, 0.3f, -1.0f));
    const ReceiverFrame frame = ReceiverFrame::at(camera, P, N);
    const glm::vec3 tangent = glm::normalize(glm::cross(N, glm::vec3(0.2f, 1.0f, 0.4f)));
    for (const glm::vec3& step : {tangent, glm::cross(N, tangent)}) {
      const float h = 1e-2f;
      const glm::dvec2 expected =
          (raster(camera, P + h * step) - raster(camera, P - h * step)) / (2.0 * double(h));
      const glm::vec2 found = frame.pixels(step);
      CHECK(found.x == Approx(expected.x).epsilon(1e-3).margin(1e-2));
      CHECK(found.y == Approx(expected.y).epsilon(1e-3).margin(1e-2));
    }
    CHECK(glm::length(frame.pixels(N)) < 1e-3f);
  }
  CameraSettings settings;
  settings.projection = Projection::perspective;
  const Camera eye(settings);
  for (const glm::vec3& P : {glm::vec3(0), {0, 0, -1}, {1, 0, 1e-30f}, {NAN, 0, 1}}) {
    CHECK(ReceiverFrame::at(eye, P, {0, 0, -1}).reach_of_unit_disc() == glm::vec2(0.0f));
  }
}

TEST_CASE("the mean share times the unblocked light is the shadowed light", "[light]") {
  for (const bool disc : {false, true}) {
    const glm::dmat4 at = glm::translate(identity, glm::dvec3(0, 0, 1));
    LitScene scene(disc ? call("disclight", {number("samples", 16)}, at)
                        : call("rectanglelight",
                               {number("width", 2), number("height", 2), number("samples", 16)},
                               at));
    scene.bindings->use_rays(std::make_shared<AnalyticBlocker>(plane_blocker(3.0, half_plane)));
    for (const glm::vec3& P : {glm::vec3(0.2f, 0.1f, 5), {0.9f, -0.4f, 4}, {-0.3f, 0.3f, 7}}) {
      const ShareSamples found = shares(scene, P, {0, 0, -1}, spread_places(16384));
      const double received = mean_share(found) * open_quadrature(scene.light(), P, {0, 0, -1}).x;
      CAPTURE(disc, P.x);
      CHECK(received == Approx(shadowed_sum(glm::dvec3(P), disc, true)).epsilon(4e-3));
      CHECK(received < 0.95 * shadowed_sum(glm::dvec3(P), disc, false));
    }
  }
}

TEST_CASE("a light that only just shows makes no bright dots and loses next to nothing",
          "[light]") {
  // Before a point at depth 5 the light spans x from 2 to 4 at depth 1; the surface turns until
  // only the share `shown` of that is above it.
  const glm::vec3 P(0, 0, 5);
  const glm::dmat4 place = glm::translate(identity, glm::dvec3(3, 0, 1));
  const auto normal = [](double shown) {
    return glm::normalize(glm::dvec3(-1.0, 0.0, -0.5 * (1.0 + shown)));
  };
  const auto exact = [&](double shown) {
    const int n = 200;
    double sum = 0.0;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const glm::dvec3 to(2.0 + 2.0 * (i + 0.5) / n, 2.0 * (j + 0.5) / n - 1.0, -4.0);
        const double d2 = glm::dot(to, to);
        sum += 4.0 * std::max(0.0, glm::dot(normal(shown), to)) / (d2 * d2);
      }
    }
    return sum * 4.0 / (double(n) * n) / M_PI;
  };
  for (const int samples : {16, 64}) {
    const LitScene scene(
        call("rectanglelight",
             {number("width", 2), number("height", 2), number("samples", float(samples))}, place));
    for (const double shown : {0.001, 0.008, 0.0313, 0.05, 0.1, 0.2, 0.5, 1.0}) {
      CAPTURE(samples, shown);
      const glm::vec3 N(normal(shown));
      const ShareSamples found = shares(scene, P, N, spread_places(4096));
      float most = 0.0f;
      for (int i = 0; i < found.share.count(); ++i) most = std::max(most, found.share[i].x);
      CHECK(most < 16.0f * 1.6f);  // the nearest part of the light sends 1.6 times the mean
      const double received = mean_share(found) * open_quadrature(scene.light(), P, N).x;
      CHECK(received < 1.01 * exact(shown) + 1e-6);
      CHECK(received > 0.99 * exact(shown) - exact(1.0) / (samples == 16 ? 256 : 1024));
    }
  }
}

TEST_CASE("the share of a ball under a half-space is the lit part of its disc", "[light]") {
  // Far away the ball is a disc; a blocker edge through its centre leaves one half.
  LitScene scene(call("spherelight", {number("radius", 0.1f)}));
  scene.bindings->use_rays(std::make_shared<AnalyticBlocker>(
      plane_blocker(5.0, [](double x, double) { return x < 0.0; })));
  const ShareSamples found = shares(scene, {0, 0, 10}, {0, 0, -1}, spread_places(4096));
  CHECK(mean_share(found) == Approx(0.5).epsilon(0.01));
}

TEST_CASE("under a dome a wall at right angles leaves half, and slopes are distances", "[light]") {
  LitScene scene(call("domelight"));
  const auto wall = [](const glm::dvec3& o, const glm::dvec3& d) {
    const double t = (2.0 - o.x) / d.x;  // the plane x = 2
    return t > 0.0 ? t : std::numeric_limits<double>::infinity();
  };
  scene.bindings->use_rays(std::make_shared<AnalyticBlocker>(wall, 0.25f));
  const auto xi = spread_places(4096);
  const glm::vec3 P(0, 0, 4), N(0, 0, -1);
  const ShareSamples found = shares(scene, P, N, xi);
  CHECK(mean_share(found) == Approx(0.5 + 0.5 * 0.25).epsilon(2e-3));
  for (int i = 0; i < found.share.count(); ++i) {
    const size_t k = size_t(i);
    // Facing the eye squarely, 50 pixels a unit at depth 1, so 12.5 at depth 4.
    // Coordinates of a unit disc are spread by sqrt(3) / 2.
    const float sine[] = {0.8660254f * found.y[0][k], 0.8660254f * found.y[1][k]};
    CHECK(found.extent[0][k] == Approx(12.5f * 0.8660254f));
    CHECK(found.extent[1][k] == Approx(12.5f * 0.8660254f));
    CHECK(std::hypot(sine[0], sine[1]) <= 1.0001f);
    if (sine[0] < 1e-3f) continue;
    // The wall is 2 units away.
    CHECK(found.slope[k] == Approx(2.0f / sine[0]).epsilon(1e-3));
  }
  int misses = 0;
  for (int i = 0; i < found.share.count(); ++i) misses += std::isnan(found.slope[size_t(i)]);
  CHECK(misses == 2048);
}

TEST_CASE("shadow edges move over the raster by minus slope * extent * y", "[light]") {
  // f(x, y) = g(x + slope * extent * y): the edge x*, where g changes, has x* + slope extent y
  // fixed.
  for (const char* name : {"rectanglelight", "disclight"}) {
    for (const size_t axis : {0u, 1u}) {
      LitScene scene(call(name, {}, glm::translate(identity, glm::dvec3(0.5, 0.3, 1))));
      scene.bindings->use_rays(std::make_shared<AnalyticBlocker>(
          plane_blocker(3.0, [axis](double x, double y) { return (axis == 0 ? x : y) < 0.02; })));
      // A plane at depth 5 that faces the eye, 10 pixels a unit.
      const auto at_pixel = [axis](double along) {
        const glm::dvec2 P = axis == 0 ? glm::dvec2(along, 50.0) : glm::dvec2(50.0, along);
        return glm::vec3(0.1 * (P.x - 50.0), -0.1 * (P.y - 50.0), 5.0);
      };
      double low = 1e30, high = -1e30, least = 1e30, most = -1e30;
      for (const glm::vec2& xi : spread_places(16)) {
        const auto is_lit = [&](double along) {
          return shares(scene, at_pixel(along), {0, 0, -1}, {xi}).share[0].x > 0.0f;
        };
        double dark = 5.0, lit = 95.0;
        if (is_lit(dark)) std::swap(dark, lit);
        REQUIRE((!is_lit(dark) && is_lit(lit)));
        for (int step = 0; step < 22; ++step) {
          const double middle = 0.5 * (dark + lit);
          (is_lit(middle) ? lit : dark) = middle;
        }
        const ShareSamples there = shares(scene, at_pixel(dark), {0, 0, -1}, {xi});
        const double shift =
            double(there.slope[0]) * double(there.extent[axis][0]) * double(there.y[axis][0]);
        low = std::min(low, dark + shift), high = std::max(high, dark + shift);
        least = std::min(least, shift), most = std::max(most, shift);
      }
      CAPTURE(name, axis, low, high, least, most);
      CHECK(most - least > 5.0);  // pixels
      CHECK(high - low < 1e-3);   // both planes face the light: exact but for rounding
    }
  }
}

TEST_CASE("the shadow of a point moves so in two dimensions on tilted surfaces", "[light]") {
  struct Setup {
    const char* light;
    glm::vec3 N;           // of the receiving plane through (0, 0, 5)
    glm::dvec3 at, along;  // of the light
  };
  const Setup setups[] = {{"rectanglelight", {0.5f, 0.2f, -0.8f}, {1.0, -0.6, 1.5}, {-0.3, 0.2, 1}},
                          {"disclight", {-0.1f, 0.9f, -0.5f}, {0.4, 1.6, 1.5}, {0.1, -0.2, 1}},
                          {"spherelight", {0.4f, -0.2f, -0.8f}, {-1.2, 0.4, 1.5}, {0, 0, 1}}};
  const glm::dvec3 blocker(0.05, 0.1, 3.5);
  for (const Setup& setup : setups) {
    const glm::vec3 N = glm::normalize(setup.N);
    const glm::dmat4 turn = glm::inverse(glm::lookAt(glm::dvec3(0), -setup.along, {0, 1, 0}));
    const float size = 0.02f;  // to first order in the light's size
    LitScene scene(call(setup.light,
                        {number("width", size), number("height", size), number("radius", size)},
                        glm::translate(identity, setup.at) * turn));
    scene.bindings->use_rays(
        std::make_shared<AnalyticBlocker>([&](const glm::dvec3& o, const glm::dvec3& d) {
          return glm::dot(blocker - o, d) / glm::dot(d, d);  // in its way, by construction
        }));
    glm::dvec2 low(1e30), high(-1e30), least(1e30), most(-1e30);
    for (const glm::vec2& xi : spread_places(16)) {
      glm::dvec3 P(0.0, 0.0, 5.0);
      for (int round = 0; round < 4; ++round) {  // what is seen of a ball depends on P
        const BarePoints at({glm::vec3(P)}, N);
        PlaceSamples from;
        from.reset(1);
        scene.light().definition->illuminate_from(scene.light(), at.points, std::vector{xi}, from);
        const glm::dvec3 Y = glm::dvec3(scene.light().extent.centre) + glm::dvec3(from.offset[0]);
        const glm::dvec3 d = blocker - Y, n(N);
        P = Y + d * (glm::dot(n, glm::dvec3(0, 0, 5) - Y) / glm::dot(n, d));
      }
      const ShareSamples there = shares(scene, glm::vec3(P), N, {xi});
      glm::dvec2 shift;
      for (size_t axis = 0; axis < 2; ++axis) {
        shift[int(axis)] =
            double(there.slope[0]) * double(there.extent[axis][0]) * double(there.y[axis][0]);
      }
      const glm::dvec2 fixed = glm::dvec2(50.0 + 50.0 * P.x / P.z, 50.0 - 50.0 * P.y / P.z) + shift;
      low = glm::min(low, fixed), high = glm::max(high, fixed);
      least = glm::min(least, shift), most = glm::max(most, shift);
    }
    CAPTURE(setup.light, least.x, most.x, least.y, most.y, high.x - low.x, high.y - low.y);
    for (const int axis : {0, 1}) {
      CHECK(most[axis] - least[axis] > 0.05);  // pixels
      CHECK(high[axis] - low[axis] < 0.01 * (most[axis] - least[axis]));
    }
  }
}

TEST_CASE("coordinates have the mean square of a uniform distribution, whatever the light",
          "[light]") {
  for (const char* name : {"rectanglelight", "disclight", "spherelight", "domelight"}) {
    // Of a ball the middle is nearer than the rim, which draws places together by its size over
    // the distance.
    const LitScene scene(
        call(name, {number("width", 0.5f), number("height", 0.3f), number("radius", 0.02f)}));
    for (const glm::vec3& normal :
         {glm::vec3(0, 0, -1), {0.3f, 0.1f, -1}, {-0.8f, 0.7f, -1}, {0.1f, 1, -0.6f}}) {
      const ShareSamples found =
          shares(scene, {0.5f, 0.2f, 4}, glm::normalize(normal), spread_over_square(64));
      for (size_t axis = 0; axis < 2; ++axis) {
        double squares = 0, sum = 0, most = 0;
        for (int i = 0; i < found.share.count(); ++i) {
          REQUIRE(found.extent[axis][size_t(i)] == found.extent[axis][0]);
          const double y = found.y[axis][size_t(i)];
          squares += y * y / found.share.count(), sum += y / found.share.count();
          most = std::max(most, std::abs(y));
        }
        CAPTURE(name, axis, normal.x, normal.y);
        CHECK(found.extent[axis][0] > 0.0f);
        CHECK(squares == Approx(1.0 / 3.0).epsilon(0.02));
        CHECK(sum == Approx(0.0).margin(0.02));
        // Of a box the farthest corner may lie at sqrt(2), of a disc the rim at 1 / 0.866.
        const bool box = std::string(name) == "rectanglelight";
        CHECK(most <= (box ? 1.4143 : 1.1548) * 1.001);
        CHECK(most > 0.98);
      }
    }
  }
}

TEST_CASE("blockers that touch the receiver or the light have the slopes of the ends", "[light]") {
  LitScene scene(call("rectanglelight"));
  const auto slope_with = [&](double distance) {
    scene.bindings->use_rays(std::make_shared<AnalyticBlocker>(
        [=](const glm::dvec3&, const glm::dvec3&) { return distance; }));
    return shares(scene, {0, 0, 4}, {0, 0, -1}, {{0.5f, 0.5f}}).slope[0];
  };
  CHECK(slope_with(0.0) == 0.0f);
  CHECK(slope_with(0.5) == Approx(1.0f));
  CHECK(slope_with(0.75) == Approx(3.0f));
  CHECK((slope_with(0.9999 * 0.99999) > 9e3f && slope_with(0.9999 * 0.99999) <= 1e6f));
  CHECK(std::isnan(slope_with(1.0)));  // the light itself
  CHECK(std::isnan(slope_with(std::numeric_limits<double>::infinity())));
}

TEST_CASE("shares are finite on the light, behind it and where it does not reach", "[light]") {
  for (const char* name : {"rectanglelight", "disclight", "spherelight", "domelight"}) {
    LitScene scene(call(name));
    scene.bindings->use_rays(
        std::make_shared<AnalyticBlocker>(plane_blocker(0.5, [](double, double) { return true; })));
    for (const glm::vec3& P : {glm::vec3(0),
                               {0, 0, -1},
                               {0, 0, 1},
                               {1e30f, 0, 1e30f},
                               {0.01f, 0.02f, 1e-20f},
                               {0, 0, 1e7f}}) {
      for (const glm::vec3& N : {glm::vec3(0, 0, -1), {1, 0, 0}, {0, 0, 0}}) {
        const ShareSamples found = shares(scene, P, N, spread_places(16));
        for (int i = 0; i < 16; ++i) {
          CAPTURE(name, P.x, P.z, N.x, N.z);
          CHECK(std::isfinite(found.share[i].x));
          CHECK(found.share[i].x >= 0.0f);
          CHECK(std::isfinite(found.extent[0][size_t(i)]));
          CHECK(std::abs(found.y[1][size_t(i)]) <= farthest_coordinate);
          CHECK(std::isfinite(found.open[i].x));
          CHECK(found.share[i].x <= found.open[i].x);
          CHECK_FALSE(found.slope[size_t(i)] < 0.0f);
        }
      }
    }
  }
}

TEST_CASE("normals of either sign give the same shares", "[light]") {
  const LitScene scene(call("rectanglelight"));
  const auto xi = spread_places(8);
  const ShareSamples front = shares(scene, {0, 0, 4}, {0, 0, -1}, xi);
  const ShareSamples back = shares(scene, {0, 0, 4}, {0, 0, 1}, xi);
  for (int i = 0; i < 8; ++i) {
    CHECK(front.share[i].x == Approx(1.0f).epsilon(0.1));
    CHECK(back.share[i] == front.share[i]);
    CHECK(back.y[0][size_t(i)] == front.y[0][size_t(i)]);
  }
}
