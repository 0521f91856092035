#include <catch2/catch.hpp>

#include <cmath>

#include "shade/thinned_grid.h"
#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

glm::vec3 position(const Grid& grid, int k) {
  return {grid.P(0, 0)[k], grid.P(0, 1)[k], grid.P(0, 2)[k]};
}

}  // namespace

TEST_CASE("a thinned grid keeps its outline and whatever belongs to the vertices it keeps") {
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  for (const int step : {1, 2, 3, 100}) {
    const auto grid = make_grid(surface, 7, 4,
                                [](float u, float v) { return glm::vec3(u, v * v, 2.0f + u * v); });
    const auto source = add_primvar(*grid, "Cs", ValueType::color, [](float u, float v) {
      return std::vector<float>{u, v, 10.0f * u + v};
    });
    const ThinnedGrid thinned(*grid, step);
    const Grid& thin = thinned.grid();
    REQUIRE(thin.u_count == (7 + step - 1) / step);
    REQUIRE(thin.v_count == (4 + step - 1) / step);
    for (int j = 0; j <= thin.v_count; ++j) {
      for (int i = 0; i <= thin.u_count; ++i) {
        const int from = std::min(j * step, 4) * 8 + std::min(i * step, 7);
        const int to = j * (thin.u_count + 1) + i;
        CAPTURE(step, i, j);
        CHECK(position(thin, to) == position(*grid, from));
        CHECK(thin.N(2)[to] == grid->N(2)[from]);
        for (size_t c = 0; c < 2; ++c) {
          CHECK(thin.uv[c * thin.stride() + size_t(to)] ==
                grid->uv[c * grid->stride() + size_t(from)]);
          CHECK(thin.st[c * thin.stride() + size_t(to)] ==
                grid->st[c * grid->stride() + size_t(from)]);
        }
        for (int c = 0; c < 3; ++c)
          CHECK(thin.primvars[0].component(c, thin.stride())[to] ==
                grid->primvars[0].component(c, grid->stride())[from]);
      }
    }
  }
}

TEST_CASE("values spread from a thinned grid are exact at its vertices and bilinear in between") {
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  const auto grid = make_grid(surface, 5, 3,
                              [](float u, float v) { return glm::vec3(5.0f * u, 3.0f * v, 1.0f); });
  for (const int step : {1, 2, 4}) {
    const ThinnedGrid thinned(*grid, step);
    const Grid& thin = thinned.grid();
    const auto field = [](const glm::vec3& P) {
      return glm::vec3(1.0f + P.x * P.y, 0.1f * P.x, std::sqrt(P.x + P.y));
    };
    std::vector<glm::vec3> values;
    for (int k = 0; k < thin.vertex_count(); ++k) values.push_back(field(position(thin, k)));
    const std::vector<glm::vec3> all = thinned.spread(values);
    REQUIRE(all.size() == size_t(grid->vertex_count()));
    for (int k = 0; k < grid->vertex_count(); ++k) {
      const glm::vec3 expected = field(position(*grid, k));
      const int i = k % 6, j = k / 6;
      CAPTURE(step, i, j);
      CHECK(all[size_t(k)].x == Approx(expected.x));  // is bilinear itself
      CHECK(all[size_t(k)].y == Approx(expected.y).margin(1e-6));
      const bool kept = (i % step == 0 || i == 5) && (j % step == 0 || j == 3);
      if (kept) CHECK(all[size_t(k)] == expected);
    }
  }
}
