#include <catch2/catch.hpp>

#include <filesystem>
#include <random>

#include "base/error.h"
#include "images/exr.h"
#include "shade/shadow_source.h"
#include "tests/images/temporary_folder.h"
#include "tests/shade/fixtures.h"
#include "tests/shade/shadow_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

struct Place {
  glm::dvec3 P, N;
};

/// Shares at places, with the same footprint axes everywhere or none. `camera_from_world` says
/// which space the points are handed over in.
std::vector<float> shares(const ShadowMap& map, const std::vector<Place>& places,
                          const ShadowFilter& filter = {}, const glm::dvec3& dPdx = {},
                          const glm::dvec3& dPdy = {},
                          const glm::dmat4& camera_from_world = glm::dmat4(1.0)) {
  const int count = int(places.size());
  Vec3Array P(count), N(count), x(count), y(count);
  for (int i = 0; i < count; ++i) {
    const Place& place = places[size_t(i)];
    P.set(i, glm::vec3(camera_from_world * glm::dvec4(place.P, 1.0)));
    N.set(i, glm::vec3(camera_from_world * glm::dvec4(place.N, 0.0)));
    x.set(i, glm::vec3(camera_from_world * glm::dvec4(dPdx, 0.0)));
    y.set(i, glm::vec3(camera_from_world * glm::dvec4(dPdy, 0.0)));
  }
  ShadingPoints points;
  points.count = count;
  points.P = P, points.N = N;
  if (dPdx != glm::dvec3(0.0) || dPdy != glm::dvec3(0.0)) points.dPdx = x, points.dPdy = y;
  std::vector<float> share(places.size(), -1.0f);
  map.light_share(points, glm::inverse(camera_from_world), filter, share);
  return share;
}

/// Makes a folder the working folder for as long as it lives.
class WorkingFolder {
 public:
  explicit WorkingFolder(const std::string& folder) : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  ~WorkingFolder() { std::filesystem::current_path(before_); }

 private:
  std::filesystem::path before_;
};

/// A map whose every texel holds one depth.
Image map_of_depth(double depth) {
  return depth_image({}, [depth](const auto&, const auto&) { return depth; });
}

/// What the map of that name lets through to a point two units ahead that faces the camera.
float share_ahead(FrameShadows& shadows, const std::string& name) {
  const float P[] = {0.0f, 0.0f, 2.0f}, N[] = {0.0f, 0.0f, -1.0f};
  ShadingPoints points;
  points.count = 1;
  points.P = Vec3Input::uniform(P), points.N = Vec3Input::uniform(N);
  float share = -1.0f;
  shadows.source(name, {"scene.rib", 7}).light_share(points, {}, {&share, 1});
  return share;
}

const glm::dvec3 ball_centre(0.4, -0.2, 3.0);
constexpr double ball_radius = 0.7;

/// A floor at a slant behind a ball, both seen by the map's camera.
struct BallScene {
  MapCamera camera;
  glm::dvec3 floor_point, floor_normal;

  explicit BallScene(bool perspective)
      : camera{{0.3, 0.1, -1.0}, perspective, perspective ? 0.8 : 3.0, 256},
        floor_point(0.0, 0.0, 6.0),
        floor_normal(glm::normalize(glm::dvec3(0.5, 0.6, -1.0))) {}

  double trace(const glm::dvec3& o, const glm::dvec3& d) const {
    return std::min(hit_sphere(o, d, ball_centre, ball_radius),
                    hit_plane(o, d, floor_point, floor_normal));
  }
  Image map() const {
    return depth_image(camera, [&](const auto& o, const auto& d) { return trace(o, d); });
  }
  /// How far inside (negative) or outside the ball's outline the light ray to `P` passes, in radii.
  double miss(const glm::dvec3& P) const {
    const glm::dvec3 d =
        glm::normalize(camera.perspective ? P - camera.eye : glm::dvec3(0.0, 0.0, 1.0));
    const glm::dvec3 m = ball_centre - P;
    return glm::length(m - glm::dot(m, d) * d) / ball_radius - 1.0;
  }
};

std::vector<Place> places_on_floor(const BallScene& scene, int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> raster(1.0, scene.camera.size - 1.0);
  std::vector<Place> places;
  while (int(places.size()) < count) {
    const double x = raster(random), y = raster(random);
    const glm::dvec3 o = scene.camera.origin(x, y), d = scene.camera.direction(x, y);
    places.push_back(
        {o + hit_plane(o, d, scene.floor_point, scene.floor_normal) * d, scene.floor_normal});
  }
  return places;
}

/// A map at depth 1 covering the half plane x < 0 of a floor at depth 2.
ShadowMap half_plane_map(bool perspective, int size) {
  const MapCamera camera{{0.0, 0.0, 0.0}, perspective, 1.0, size};
  return ShadowMap(depth_image(camera, [](const glm::dvec3& o, const glm::dvec3& d) {
    return o.x + d.x < 0.0 ? 1.0 : 2.0;
  }));
}

const glm::dvec3 towards_light(0.0, 0.0, -1.0);

}  // namespace

TEST_CASE("the shadow of a ball agrees with ray casting, away from its outline") {
  // A turn and a shift between world and camera space, to tell the two apart.
  glm::dmat4 camera_from_world(1.0);
  camera_from_world[0] = {0, 0.6, 0.8, 0};
  camera_from_world[1] = {-1, 0, 0, 0};
  camera_from_world[2] = {0, -0.8, 0.6, 0};
  camera_from_world[3] = {7, -3, 5, 1};
  for (const bool perspective : {true, false}) {
    const BallScene scene(perspective);
    const ShadowMap map(scene.map());
    const auto places = places_on_floor(scene, 4000);
    const auto share = shares(map, places, {}, {}, {}, camera_from_world);
    int shadowed = 0, near_outline = 0;
    for (size_t i = 0; i < places.size(); ++i) {
      // A texel and a half of the map at the ball, in radii: what texel centres can be off by, and
      // the interpolation between four of them.
      const double texel = (perspective ? 0.8 * 4.0 : 3.0) * 2.0 / 256 / ball_radius;
      const double miss = scene.miss(places[i].P);
      if (std::abs(miss) < 1.5 * texel) {
        ++near_outline;
        continue;
      }
      CHECK(share[i] == (miss < 0.0 ? 0.0f : 1.0f));
      shadowed += miss < 0.0;
    }
    CHECK(shadowed > 100);
    CHECK(near_outline < 200);
  }
}

TEST_CASE("what the light sees is lit, at any slant, without a bias") {
  for (const bool perspective : {true, false}) {
    const BallScene scene(perspective);
    const ShadowMap map(scene.map());
    std::mt19937 random(9);
    std::normal_distribution<double> normal;
    std::vector<Place> places;
    while (places.size() < 4000) {
      const glm::dvec3 N =
          glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
      const glm::dvec3 P = ball_centre + ball_radius * N;
      const glm::dvec3 L = perspective ? glm::normalize(scene.camera.eye - P) : towards_light;
      if (glm::dot(N, L) > 0.03) places.push_back({P, N});
    }
    for (const float share : shares(map, places)) CHECK(share == 1.0f);
    // The back of the ball lies in its own shadow, further than two texels from its outline.
    std::vector<Place> back;
    for (const Place& place : places) {
      const glm::dvec3 P = 2.0 * ball_centre - place.P, N = -place.N;
      const glm::dvec3 L = perspective ? glm::normalize(scene.camera.eye - P) : towards_light;
      if (glm::dot(N, L) < -0.4) back.push_back({P, N});
    }
    REQUIRE(back.size() > 1000);
    for (const float share : shares(map, back)) CHECK(share == 0.0f);
  }
}

TEST_CASE("floors at grazing angles do not shadow themselves") {
  for (const double slant : {0.0, 1.0, 5.0, 20.0}) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(slant, 0.3 * slant, -1.0));
    const MapCamera camera{{0, 0, 0}, true, 0.5, 64};
    const ShadowMap map(depth_image(camera, [&](const glm::dvec3& o, const glm::dvec3& d) {
      return hit_plane(o, d, {0, 0, 100}, normal);
    }));
    std::vector<Place> places;
    for (double x = 0.3; x < 64.0; x += 1.7) {
      for (double y = 0.1; y < 64.0; y += 2.3) {
        const glm::dvec3 d = camera.direction(x, y);
        const double t = hit_plane({0, 0, 0}, d, {0, 0, 100}, normal);
        if (t < 1e6) places.push_back({t * d, normal});
      }
    }
    REQUIRE(places.size() > 100);
    for (const float share : shares(map, places, {16, 1.0f, 0.02f, 0.0f})) CHECK(share == 1.0f);
  }
}

TEST_CASE("a blocker must be nearer by the bias and a texel") {
  // Orthographic, texels 2 / 64 wide; the blocker stands 1 before the floor.
  const ShadowMap map = half_plane_map(false, 64);
  const std::vector<Place> place{{{-0.5, 0.0, 2.0}, towards_light}};
  CHECK(shares(map, place, {1, 1.0f, 0.0f, 0.0f})[0] == 0.0f);
  CHECK(shares(map, place, {1, 1.0f, 0.0f, 0.96f})[0] == 0.0f);
  CHECK(shares(map, place, {1, 1.0f, 0.0f, 0.98f})[0] == 1.0f);
}

TEST_CASE("percentages over a footprint or a blur are the covered share of a box") {
  const int size = 512;
  for (const bool perspective : {true, false}) {
    const ShadowMap map = half_plane_map(perspective, size);
    const double depth = 2.0, unit = perspective ? depth : 1.0;  // floor units per unit of screen
    std::vector<Place> places;
    for (double x = -0.3; x < 0.3; x += 0.01)
      places.push_back({{unit * x, 0.1, depth}, towards_light});
    // The box is 0.2 wide on the screen: 0.2 of 2, a tenth of the map.
    const auto expect = [&](const std::vector<float>& share) {
      for (size_t i = 0; i < places.size(); ++i) {
        const double x = places[i].P.x / unit;
        const double expected = std::clamp(0.5 + x / 0.2, 0.0, 1.0);
        // 256 samples in the strata of a lattice, plus half a texel of 51 across the box.
        CHECK(double(share[i]) == Approx(expected).margin(0.02));
      }
    };
    expect(shares(map, places, {256, 1.0f, 0.0f, 0.0f}, {0.2 * unit, 0, 0}, {0, 0.05 * unit, 0}));
    expect(shares(map, places, {256, 0.5f, 0.0f, 0.0f}, {0, 0.05 * unit, 0}, {0.4 * unit, 0, 0}));
    expect(shares(map, places, {256, 1.0f, 0.1f, 0.0f}));
    // A hard edge without either: a ramp one texel wide.
    const auto hard = shares(map, places);
    for (size_t i = 0; i < places.size(); ++i) {
      const double texels = places[i].P.x / unit * size / 2.0;
      CHECK(double(hard[i]) == Approx(std::clamp(0.5 + texels, 0.0, 1.0)).margin(1e-3));
    }
  }
}

TEST_CASE("points behind the light, beside the map or not finite are lit") {
  const ShadowMap map = half_plane_map(true, 64);
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const auto share = shares(map, {{{-0.5, 0, -2}, towards_light},
                                  {{0, 0, 0}, towards_light},
                                  {{-5, 0, 2}, towards_light},
                                  {{-1e30, 1e30, 1e-30}, towards_light},
                                  {{nan, 0, 2}, towards_light},
                                  {{0, 0, inf}, towards_light},
                                  {{-1, 0, 2}, {0, 0, 0}}});
  for (size_t i = 0; i + 1 < share.size(); ++i) CHECK(share[i] == 1.0f);
  CHECK(share.back() == 0.0f);  // a point without a normal has its shadow all the same
}

TEST_CASE("a cropped map leaves the rest of its picture lit") {
  Image whole =
      depth_image({{0, 0, 0}, false, 1.0, 8}, [](const auto&, const auto&) { return 1.0; });
  Image part(whole.display_window, {4, 0, 8, 8});
  part.matrices = whole.matrices;
  part.add_channel("Z", PixelType::float32, 1.0f);
  const auto share =
      shares(ShadowMap(part), {{{-0.5, 0, 2}, towards_light}, {{0.5, 0, 2}, towards_light}});
  CHECK(share[0] == 1.0f);
  CHECK(share[1] == 0.0f);
}

TEST_CASE("a share depends on its point alone") {
  const ShadowMap map = half_plane_map(true, 64);
  std::vector<Place> places;
  for (double x = -0.2; x < 0.2; x += 0.003) places.push_back({{x, 3 * x, 2.0}, towards_light});
  const ShadowFilter filter{7, 1.0f, 0.1f, 0.0f};
  const auto together = shares(map, places, filter);
  for (size_t i = 0; i < places.size(); ++i) {
    CHECK(shares(map, {places[i]}, filter)[0] == together[i]);
  }
}

TEST_CASE("what is no depth map is refused with what is missing") {
  const Image good = depth_image({}, [](const auto&, const auto&) { return 1.0; });
  CHECK_NOTHROW(ShadowMap(good));
  Image image = good;
  image.channels[0].name = "depth";
  CHECK_NOTHROW(ShadowMap(image));
  image.add_channel("A");
  CHECK_THROWS_WITH(ShadowMap(image), Catch::Contains("channel Z"));
  image = good;
  image.matrices.erase("worldToNDC");
  CHECK_THROWS_WITH(ShadowMap(image), Catch::Contains("worldToNDC"));
  image = good;
  image.matrices["worldToCamera"] = {1, 0, 0.9f, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  CHECK_THROWS_WITH(ShadowMap(image), Catch::Contains("one camera"));
  image = good;
  image.matrices["worldToNDC"] = {};
  CHECK_THROWS_AS(ShadowMap(image), Error);
  image = good;
  image.matrices["worldToNDC"][5] = std::nanf("");
  CHECK_THROWS_WITH(ShadowMap(image), Catch::Contains("not finite"));
}

TEST_CASE("a map is found on the search path, and a missing one is said once and shadows nothing") {
  const TemporaryFolder folder;
  write_exr(folder.file("half.z"), map_of_depth(1.0));
  Diagnostics diagnostics;
  FrameShadows shadows({"/nowhere", folder.file("")}, glm::dmat4(1.0), diagnostics);
  const ShadowSource& found = shadows.source("half.z", {"scene.rib", 7});
  shadows.source("none.z", {"scene.rib", 9});
  CHECK(&found == &shadows.source("half.z", {}));
  CHECK(diagnostics.lines().empty());  // nothing is read before it is needed

  CHECK(share_ahead(shadows, "half.z") == 0.0f);
  for (int round = 0; round < 2; ++round) CHECK(share_ahead(shadows, "none.z") == 1.0f);
  REQUIRE(diagnostics.lines().size() == 1);
  CHECK_THAT(diagnostics.lines()[0],
             Catch::StartsWith("scene.rib:9:") && Catch::Contains("none.z"));
}

TEST_CASE("a map in the working folder, where frames write theirs, goes before one elsewhere") {
  const TemporaryFolder beside_scene, working;
  write_exr(beside_scene.file("light.z"), map_of_depth(1.0));
  write_exr(working.file("light.z"), map_of_depth(3.0));
  Diagnostics diagnostics;
  FrameShadows from_elsewhere({beside_scene.file("")}, glm::dmat4(1.0), diagnostics);
  CHECK(share_ahead(from_elsewhere, "light.z") == 0.0f);

  const WorkingFolder now(working.file(""));
  FrameShadows shadows({beside_scene.file("")}, glm::dmat4(1.0), diagnostics);
  CHECK(share_ahead(shadows, "light.z") == 1.0f);
  CHECK(share_ahead(shadows, beside_scene.file("light.z")) == 0.0f);
  CHECK(diagnostics.lines().empty());
}
