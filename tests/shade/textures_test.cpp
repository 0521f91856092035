#include <catch2/catch.hpp>

#include <cmath>

#include "shade/mathematics.h"
#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Colour (s, t, filter width along x) for "st.tex"; nothing else exists.
struct StSampler : TextureSampler {
  TextureResult sample(const TextureRequest& request, const TexturePoints& points,
                       std::span<float> out) override {
    if (request.file != "st.tex") return {false, "no such file"};
    const size_t n = points.s.size();
    for (size_t i = 0; i < n; ++i) {
      out[i] = points.s[i], out[n + i] = points.t[i], out[2 * n + i] = points.dsdx[i];
    }
    return {};
  }
};

struct TexturedScene : TestScene {
  int loads = 0;
  TexturedScene() {
    add_light(call("ambientlight"));
    texture_sampler = [this] {
      ++loads;
      return std::make_shared<StSampler>();
    };
  }
};

}  // namespace

TEST_CASE("paintedplastic looks its texture up at st with the cell's footprint") {
  TexturedScene test;
  Attributes attributes;
  attributes.surface = call("paintedplastic", {text("texturename", "st.tex")});
  attributes.color = {1.0f, 0.5f, 1.0f};
  const auto grid = make_square(test.add_surface(attributes), 4, 3.0f);
  const auto bindings = test.bind();
  CHECK(test.loads == 0);  // nothing is loaded before the first look-up
  const SurfaceColors colors = run_surface(*bindings, *grid);
  run_surface(*bindings, *grid);
  CHECK(test.loads == 1);
  CHECK(colors.Ci[7] == glm::vec3(0.5f, 0.5f * 0.25f, 0.25f));  // s = 1/2, t = 1/4, ds = 1/4
  CHECK(test.diagnostics.lines().empty());
}

TEST_CASE("a missing texture is magenta and named once") {
  TexturedScene test;
  const Surface& surface = test.add_surface("paintedplastic", {text("texturename", "gone.tif")});
  const auto grid = make_square(surface, 2, 3.0f);
  const auto bindings = test.bind();
  run_surface(*bindings, *grid);
  CHECK(run_surface(*bindings, *grid).Ci[0] == glm::vec3(1.0f, 0.0f, 1.0f));
  REQUIRE(test.diagnostics.lines().size() == 1);
  CHECK(test.warned("scene.rib:7: warning: cannot read texture \"gone.tif\" (no such file)"));
}

TEST_CASE("without an image library textures are missing, not fatal") {
  TestScene test;
  test.add_light(call("ambientlight"));
  const Surface& surface = test.add_surface("paintedplastic", {text("texturename", "st.tex")});
  const auto grid = make_square(surface, 2, 3.0f);
  const auto bindings = test.bind();
  CHECK(run_surface(*bindings, *grid).Ci[0] == glm::vec3(1.0f, 0.0f, 1.0f));
}

TEST_CASE("shinymetal sees the environment in the world's mirror direction") {
  TexturedScene test;
  const Surface& surface = test.add_surface(
      "shinymetal", {text("texturename", "st.tex"), number("Ka", 0.0f), number("roughness", 0.2f)});
  // On the axis the view (0, 0, 1) comes straight back as (0, 0, -1): straight down, t = 1.
  const auto grid = make_grid(surface, 2, 2, [](float u, float v) {
    return glm::vec3(2.0f * u - 1.0f, 2.0f * v - 1.0f, 1.0f);
  });
  const auto bindings = test.bind();
  const SurfaceColors colors = run_surface(*bindings, *grid);
  CHECK(colors.Ci[4].y == Approx(1.0));
  // At (1, 0, 1) it is (1, 0, -1) / sqrt(2): longitude 0 is s = 1/2, 135 degrees from the pole.
  CHECK(colors.Ci[5].x == Approx(0.5));
  CHECK(colors.Ci[5].y == Approx(0.75));
  // One cell on along y the view turns by 1 / sqrt(2) in longitude's direction; the blur adds in
  // squares; the circle of longitude is sqrt(1/2) of the equator.
  CHECK(colors.Ci[5].z == Approx(std::sqrt(0.5 + 0.2 * 0.2) / (2.0 * pi) * std::sqrt(2.0)));
  // At (0, 1, 1): a quarter turn on.
  CHECK(colors.Ci[7].x == Approx(0.25));
}
