#include <catch2/catch.hpp>

#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "shade/hemisphere.h"
#include "tests/shade/bounce_fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr double exact_pi = 3.14159265358979323846;

}  // namespace

TEST_CASE("directions over a surface have the density of the cosine") {
  const glm::vec3 normals[] = {{0, 0, 1},
                               {0, 0, -1},
                               glm::normalize(glm::vec3(1, -2, -1e-4f)),
                               glm::normalize(glm::vec3(-3, 1, 2))};
  for (const glm::vec3& N : normals) {
    // Moments of the density cos / pi: E cos = 2/3, E cos^2 = 1/2, E of each tangential part
    // squared 1/4.
    double cosine = 0, square = 0;
    glm::dvec3 sum(0.0);
    const auto places = spread_over_square(64);
    for (const glm::vec2& xi : places) {
      const glm::dvec3 d(cosine_direction(N, xi));
      REQUIRE(glm::length(d) == Approx(1.0).epsilon(1e-6));
      const double c = glm::dot(d, glm::dvec3(N));
      REQUIRE(c >= -1e-6);
      cosine += c, square += c * c, sum += d;
    }
    const double n = double(places.size());
    CHECK(cosine / n == Approx(2.0 / 3.0).epsilon(1e-3));
    CHECK(square / n == Approx(0.5).epsilon(1e-3));
    CHECK(glm::length(sum / n - 2.0 / 3.0 * glm::dvec3(N)) < 1e-3);
  }
  CHECK(cosine_direction(glm::vec3(0.0f), {0.3f, 0.4f}) == glm::vec3(0.0f));
  CHECK(cosine_direction(glm::vec3(std::nanf("")), {0.3f, 0.4f}) == glm::vec3(0.0f));
}

TEST_CASE("occlusion beside a wall is what the configuration factor leaves open") {
  BounceScene scene;
  const Surface& wall = scene.add_surface("matte");
  scene.trace({make_wall(wall, 1, 1.5f, 2.0f)});
  const BoundLight light = bound("occlusionlight", {}, scene.diagnostics);
  const float distances[] = {0.1f, 0.5f, 1.0f, 4.0f};
  const LightPoints at({{0.1f, 0, 0}, {0.5f, 0, 0}, {1, 0, 0}, {4, 0, 0}}, {0, 0, -1});
  Vec3Array mean;
  mean_share(light, at.points, spread_over_square(80), scene.services(), mean);
  for (int i = 0; i < 4; ++i) {
    const double covered = 2.0 * upright_rectangle(double(distances[i]), 1.5, 2.0);
    CHECK(double(mean[i].x) == Approx(1.0 - covered).margin(0.004));
    CHECK(mean[i].x == mean[i].z);
  }
  CHECK(scene.counters.rays == 4u * 80 * 80);
}

TEST_CASE("occlusion ends at maxdistance and is thinned by transparency") {
  BounceScene scene;
  Attributes glass;
  glass.opacity = {0.25f, 0.5f, 0.75f};
  const Surface& lid = scene.add_surface(glass);
  // Far wider than high over the point, which lies at the origin and looks along -z.
  const auto grid = make_grid(lid, 1, 1, [](float u, float v) {
    return glm::vec3(2e3f * u - 1e3f, 2e3f * v - 1e3f, -1.0f);
  });
  scene.trace({grid});
  const LightPoints at({{0, 0, 0}}, {0, 0, -1});
  const auto mean_within = [&](float distance) {
    const BoundLight light =
        bound("occlusionlight", {number("maxdistance", distance)}, scene.diagnostics);
    Vec3Array mean;
    mean_share(light, at.points, spread_over_square(64), scene.services(), mean);
    return double(mean[0].y);
  };
  CHECK(mean_within(1e30f) == Approx(0.5).margin(1e-3));
  CHECK(mean_within(std::nanf("")) == Approx(0.5).margin(1e-3));
  CHECK(mean_within(0.99f) == 1.0);
  CHECK(mean_within(0.0f) == 1.0);
  CHECK(mean_within(-1.0f) == 1.0);
  // Met within r where cos > 1 / r; with density cos / pi that is a share of 1 - 1 / r^2.
  CHECK(mean_within(2.0f) == Approx(1.0 - 0.5 * (1.0 - 0.25)).margin(0.003));
  // Without shadows all of it is open, and no ray is cast.
  const uint64_t cast = scene.counters.rays;
  BoundLight open = bound("occlusionlight", {}, scene.diagnostics);
  open.ray_traced = false;
  CHECK(shares_at(open, at, {{0.5f, 0.5f}}, scene.services()).share[0] == glm::vec3(1.0f));
  CHECK(scene.counters.rays == cast);
}

TEST_CASE("inside a ball the indirect light of a point light is the same wherever both are") {
  // Every patch of a ball sees every other with the same configuration factor, so what arrives is
  // the mean radiosity: of a point light within, albedo * intensity * 4 pi / (4 pi r^2).
  for (const glm::vec3 lamp : {glm::vec3(0, 0, 4), glm::vec3(0.5f, -0.6f, 4.2f)}) {
    BounceScene scene;
    scene.add_light(
        call("pointlight", {triple("from", ValueType::point, lamp), number("intensity", 3.0f)}));
    scene.add_light(call("indirectlight"));  // does not bounce again
    Attributes white;
    white.color = {0.5f, 0.25f, 1.0f};
    white.surface = call("matte");
    const Surface& room = scene.add_surface(white);
    const glm::vec3 centre(0, 0, 4);
    const auto ball = make_ball(room, centre, 2.0f);
    scene.trace({ball}, 0.02);
    const BoundLight light = bound("indirectlight", {}, scene.diagnostics);
    for (const glm::vec3 n : {glm::vec3(0, 1, 0), glm::normalize(glm::vec3(1, 2, -3))}) {
      const LightPoints at({centre - 1.99f * n}, n, room.id);
      Vec3Array mean;
      mean_share(light, at.points, spread_over_square(24), scene.services(), mean);
      const double expected = 3.0 / 4.0;
      CHECK(double(mean[0].x) == Approx(0.5 * expected).epsilon(0.02));
      CHECK(double(mean[0].y) == Approx(0.25 * expected).epsilon(0.02));
      CHECK(double(mean[0].z) == Approx(1.0 * expected).epsilon(0.02));
    }
    // One side of one grid, once, every second vertex along u and v.
    CHECK(scene.counters.bounce_points_shaded ==
          uint64_t((ball->u_count / 2 + 1) * (ball->v_count / 2 + 1)));
    CHECK(scene.counters.points_shaded == 0);
    CHECK(scene.bounce->memory_bytes() >= sizeof(glm::vec3) * size_t(ball->vertex_count()));
  }
}

TEST_CASE("light from a lit wall is the integral over the wall") {
  BounceScene scene;
  const glm::vec3 lamp(1.0f, 0.3f, -1.5f);
  scene.add_light(call("pointlight", {triple("from", ValueType::point, lamp)}));
  Attributes red;
  red.color = {0.8f, 0.1f, 0.0f};
  red.surface = call("matte");
  const Surface& surface = scene.add_surface(red);
  const double half_width = 1.5, height = 2.0;
  scene.trace({make_wall(surface, 24, float(half_width), float(height))});
  const BoundLight light = bound("indirectlight", {}, scene.diagnostics);
  const std::vector<glm::vec3> receivers = {{0.3f, 0, 0}, {1, 0.5f, 0}, {2, -1, 0}};
  const LightPoints at(receivers, {0, 0, -1});
  Vec3Array mean;
  mean_share(light, at.points, spread_over_square(40), scene.services(), mean);
  for (int r = 0; r < 3; ++r) {
    double sum = 0;
    constexpr int n = 300;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const glm::dvec3 Q(0, (2 * (i + 0.5) / n - 1) * half_width, -(j + 0.5) / n * height);
        const glm::dvec3 to_lamp = glm::dvec3(lamp) - Q, d = Q - glm::dvec3(receivers[size_t(r)]);
        const double l2 = glm::dot(to_lamp, to_lamp), d2 = glm::dot(d, d);
        const double radiosity = std::max(0.0, to_lamp.x / std::sqrt(l2)) / l2;
        sum += radiosity * (-d.z) * (-d.x) / (d2 * d2) / exact_pi;
      }
    sum *= 2 * half_width * height / (n * n);
    CHECK(double(mean[r].x) == Approx(0.8 * sum).epsilon(0.02));
    CHECK(double(mean[r].y) == Approx(0.1 * sum).epsilon(0.02));
    CHECK(mean[r].z == 0.0f);
  }
}

TEST_CASE("rays go on behind transparent surfaces") {
  BounceScene scene;
  scene.add_light(call("ambientlight"));
  Attributes sheet, wall;
  sheet.surface = wall.surface = call("matte");
  sheet.color = {0.0f, 0.0f, 1.0f};
  sheet.opacity = {0.25f, 0.5f, 1.0f};
  const Surface& front = scene.add_surface(sheet);
  const Surface& behind = scene.add_surface(wall);
  scene.trace({make_square(front, 1, 2.0f), make_square(behind, 1, 3.0f)});
  const auto reaching = [&](float distance) {
    return bound("indirectlight", {number("maxdistance", distance)}, scene.diagnostics);
  };
  const LightPoints at({{0.1f, 0.2f, 1}}, {0, 0, 1});
  // The direction of the normal.
  const ShareSamples seen = shares_at(reaching(2.5f), at, {{0.5f, 0.5f}}, scene.services());
  CHECK(seen.share[0].x == Approx(0.75));
  CHECK(seen.share[0].y == Approx(0.5));
  CHECK(seen.share[0].z == Approx(1.0));
  CHECK(seen.slope[0] == Approx(1.0));
  CHECK(scene.counters.rays == 2);
  CHECK(shares_at(reaching(1.5f), at, {{0.5f, 0.5f}}, scene.services()).share[0].x == 0.0f);
}

TEST_CASE("rays go through sixteen transparent surfaces, and no further") {
  // Sheets with opacity 1/4 in a row; sheet k sends back its opacity times white, seen through
  // those before it: in all 1 - (3/4)^16 of the sixteen that count.
  Attributes sheet;
  sheet.surface = call("matte");
  sheet.opacity = glm::vec3(0.25f);
  const auto brought_by = [&](int sheets) {
    BounceScene row;
    row.add_light(call("ambientlight"));
    row.scene.surfaces.reserve(size_t(sheets));
    std::vector<std::shared_ptr<const Grid>> grids;
    for (int k = 0; k < sheets; ++k)
      grids.push_back(make_square(row.add_surface(sheet), 1, 2.0f + 0.1f * float(k)));
    row.trace(std::move(grids));
    const BoundLight light = bound("indirectlight", {}, row.diagnostics);
    const LightPoints at({{0.1f, 0.2f, 1}}, {0, 0, 1});
    return double(shares_at(light, at, {{0.5f, 0.5f}}, row.services()).share[0].x);
  };
  for (const int sheets : {1, 2, 3, 8, 15, 16, 17, 20})
    CHECK(brought_by(sheets) == Approx(1.0 - std::pow(0.75, std::min(sheets, 16))).epsilon(1e-5));
}

TEST_CASE("maxdistance is measured in the world, however large the camera shows it") {
  for (const double scale : {1.0, 4.0, 1e-6, 1e7}) {
    BounceScene scene;
    scene.scene.camera.camera_from_world =
        MovingTransform(glm::scale(glm::dmat4(1.0), glm::dvec3(scale)));
    scene.add_light(call("ambientlight"));
    const Surface& surface = scene.add_surface("matte");
    // One world unit ahead.
    const auto s = float(scale);
    scene.trace({make_grid(surface, 1, 1, [s](float u, float v) {
      return s * glm::vec3(2.0f * u - 1.0f, 2.0f * v - 1.0f, 2.0f);
    })});
    const LightPoints at({s * glm::vec3(0.1f, 0.2f, 1.0f)}, {0, 0, 1});
    for (const char* name : {"indirectlight", "occlusionlight"}) {
      const auto share_within = [&](float distance) {
        const BoundLight light = bound(name, {number("maxdistance", distance)}, scene.diagnostics);
        return shares_at(light, at, {{0.5f, 0.5f}}, scene.services()).share[0].x;
      };
      CAPTURE(name, scale);
      CHECK(share_within(0.99f) != share_within(1.01f));
      CHECK(share_within(0.01f) == share_within(0.99f));
      CHECK(share_within(1.01f) == share_within(100.0f));
    }
  }
}

TEST_CASE("a ray's coordinate says where on the picture, beside its start, it meets something") {
  BounceScene scene;
  scene.add_light(call("ambientlight"));
  // A surface parallel to the receiver, for a receiver that is tilted to the view.
  const glm::vec3 N = glm::normalize(glm::vec3(0.3f, -0.5f, -1.0f)), P(0.4f, 0.2f, 5.0f);
  const glm::vec3 x = glm::normalize(glm::cross(N, glm::vec3(0, 1, 0))), y = glm::cross(N, x);
  const float height = 0.01f;  // little, so that the picture changes linearly
  const Surface& surface = scene.add_surface("matte");
  const auto grid = make_grid(surface, 1, 1, [&](float u, float v) {
    return P + height * N + (2 * u - 1) * x + (2 * v - 1) * y;
  });
  scene.trace({grid});
  const LightPoints at({P}, N);
  for (const char* name : {"indirectlight", "occlusionlight"}) {
    const BoundLight light = bound(name, {}, scene.diagnostics);
    for (const glm::vec2 xi : {glm::vec2(0.7f, 0.4f), glm::vec2(0.2f, 0.3f)}) {
      const ShareSamples seen = shares_at(light, at, {xi}, scene.services());
      // The foot of the hit on the receiver, by hand.
      const glm::dvec3 d(cosine_direction(N, xi));
      const double distance = double(height) / glm::dot(d, glm::dvec3(N));
      const glm::dvec3 foot =
          glm::dvec3(P) + distance * (d - glm::dvec3(N) * glm::dot(d, glm::dvec3(N)));
      CHECK(double(seen.slope[0]) == Approx(distance).epsilon(1e-4));
      for (int axis = 0; axis < 2; ++axis) {
        // 100 pixels over 2 units at depth 1, y downwards.
        const double sign = axis == 0 ? 50.0 : -50.0;
        const double shift = sign * (foot[axis] / foot.z - double(P[axis]) / double(P.z));
        const double told = double(seen.slope[0]) * double(seen.extent[size_t(axis)][0]) *
                            double(seen.y[size_t(axis)][0]);
        CHECK(told == Approx(shift).epsilon(0.02).margin(1e-4));
        CHECK(std::abs(seen.y[size_t(axis)][0]) <= 1.1548f);  // 1 / 0.866
      }
    }
  }
}

TEST_CASE("coordinates of bounces have the mean square of a uniform distribution") {
  BounceScene scene;
  const Surface& surface = scene.add_surface("matte");
  scene.trace({make_square(surface, 1, 2.0f)});
  const auto xi = spread_over_square(64);
  for (const char* name : {"indirectlight", "occlusionlight"}) {
    const BoundLight light = bound(name, {}, scene.diagnostics);
    for (const glm::vec3& n : {glm::vec3(0, 0, -1), {0.4f, -0.3f, -1}, {-1, 0.2f, -0.3f}}) {
      const LightPoints at(std::vector<glm::vec3>(xi.size(), {0.4f, 0.2f, 5}), glm::normalize(n));
      const ShareSamples seen = shares_at(light, at, xi, scene.services());
      for (size_t axis = 0; axis < 2; ++axis) {
        double squares = 0;
        for (size_t i = 0; i < xi.size(); ++i)
          squares += double(seen.y[axis][i]) * double(seen.y[axis][i]) / double(xi.size());
        CAPTURE(name, axis, n.x);
        CHECK(squares == Approx(1.0 / 3.0).epsilon(2e-3));
      }
    }
  }
}

TEST_CASE("nothing is known of rays that meet nothing, start nowhere, or have nobody to ask") {
  BounceScene scene;
  const Surface& surface = scene.add_surface("matte");
  scene.trace({make_square(surface, 1, 2.0f)});
  const LightServices all = scene.services();
  const LightServices no_rays{all.camera, nullptr, nullptr, all.counters};
  const BoundLight indirect = bound("indirectlight", {}, scene.diagnostics);
  const BoundLight occlusion = bound("occlusionlight", {}, scene.diagnostics);
  const std::vector<glm::vec2> xi = {{0.5f, 0.5f}};
  const auto check = [&](const LightPoints& at, const LightServices& services) {
    const ShareSamples a = shares_at(indirect, at, xi, services);
    const ShareSamples b = shares_at(occlusion, at, xi, services);
    CHECK(a.share[0] == glm::vec3(0.0f));
    CHECK(b.share[0] == glm::vec3(1.0f));
    for (const ShareSamples* s : {&a, &b}) {
      CHECK(std::isnan(s->slope[0]));
      for (size_t axis = 0; axis < 2; ++axis) {
        CHECK(std::isfinite(s->y[axis][0]));
        CHECK(std::isfinite(s->extent[axis][0]));
      }
    }
    return a;
  };
  check(LightPoints({{0, 0, 1}}, {0, 0, -1}), all);     // away from the square
  check(LightPoints({{0, 0, 1}}, {0, 0, 1}), no_rays);  // towards it
  check(LightPoints({{0, 0, 1}}, {0, 0, 0}), all);      // no normal
  check(LightPoints({{0, 0, 1}}, glm::vec3(std::nanf(""))), all);
  check(LightPoints({{1e30f, 1e30f, 1e30f}}, {0, 0, 1}), all);
  check(LightPoints({{0, 0, 1e-30f}}, {0, 0, -1}), all);
  CHECK(check(LightPoints({{0, 0, 0}}, {0, 0, -1}), all).extent[0][0] == 0.0f);   // in the eye
  CHECK(check(LightPoints({{0, 0, -1}}, {0, 0, -1}), all).extent[1][0] == 0.0f);  // behind it
}
