#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "reconstruct/stack_filter.h"
#include "reconstruct/weighted_taps.h"

using namespace tessera;

namespace {

/// Weights that have no symmetry to hide behind.
class SkewMethod : public ReconstructionMethod {
 public:
  int basis_count() const override { return 3; }
  void basis(const BasisPoint& at, float* out) const override {
    out[0] = 1, out[1] = at.y, out[2] = at.y * at.y;
  }
  int degree(int k) const override { return k; }
  int max_degree() const override { return 2; }
  int reach() const override { return 4; }
  void weights(const AxisWedge& wedge, float samples, float* out) const override {
    for (int k = 0; k < 3; ++k)
      for (int d = -4; d <= 4; ++d)
        out[k * 9 + 4 + d] =
            std::sin(float(k) + 0.3f * float(d) + wedge.low - 2 * wedge.high + 0.1f * samples);
  }
};

struct RandomStack {
  SkewMethod method;
  DistributionFeatures features;
  MomentLayout layout;
  PixelFacts facts;
  Planes planes;
  std::vector<float> shared;
  const MomentStack* stack;

  RandomStack(Blur blur, const PixelRect& rect)
      : features{blur == Blur::lens, blur == Blur::motion, blur == Blur::shadow, false},
        layout(features, method),
        facts(rect, features),
        planes(layout.plane_count()),
        stack(layout.stack(blur)) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const size_t pixels = size_t(rect.pixel_count());
    for (auto& plane : planes) {
      for (size_t p = 0; p < pixels; ++p) plane.push_back(uniform(random));
      plane.resize(pixels + tap_run, 1e30f);
    }
    for (size_t p = 0; p < pixels; ++p) {
      shared.push_back(uniform(random) < -0.8f ? 0.0f : 1.0f);
      facts.surface[p] = uniform(random) < 0 ? 1 : 2;
      const float tilt = uniform(random) < 0 ? 0.0f : 0.5f;  // radians: 29 degrees
      facts.N[0][p] = std::sin(tilt), facts.N[2][p] = std::cos(tilt);
      facts.samples[p] = 4 + uniform(random);
      WedgePlanes& wedges = facts.wedges[size_t(blur)];
      if (uniform(random) < -0.8f) continue;  // not known
      for (size_t a = 0; a < 2; ++a) {
        wedges.low[a][p] = uniform(random);
        wedges.high[a][p] = wedges.low[a][p] + 1 + uniform(random);
      }
    }
  }

  StackFilterInput input() const {
    StackFilterInput in;
    in.stack = stack, in.planes = &planes, in.facts = &facts;
    in.shared = &shared;
    return in;
  }
  bool same_surface(size_t p, size_t q) const {
    return facts.surface[p] == facts.surface[q] && std::abs(facts.N[0][p] - facts.N[0][q]) < 0.1f;
  }
  /// A_k(d) of pixel p along an axis, by the definition.
  double weight(size_t p, size_t axis, int k, int d) const {
    const WedgePlanes& wedges = facts.wedges[size_t(stack->blur)];
    if (std::isnan(wedges.low[axis][p])) return k == 0 && d == 0;
    std::vector<float> all(27);
    method.weights({wedges.low[axis][p], wedges.high[axis][p]}, facts.samples[p], all.data());
    return double(all[size_t(k * 9 + 4 + d)]);
  }
};

}  // namespace

TEST_CASE("Two passes sum what one sum over both axes does", "[stack_filter]") {
  const Blur blur = GENERATE(Blur::shadow, Blur::lens);
  // Runs, bands and the last of both, partly filled.
  const PixelRect rect{-5, 7, 66, 26};
  const RandomStack random(blur, rect);
  const PixelFacts& facts = random.facts;
  REQUIRE(random.stack->pairs.size() == 6);
  const StackFilterOutput out = filter_stack(random.input());
  REQUIRE(out.values.size() == random.stack->value_count);
  for (int y = rect.y0; y < rect.y1; y += 2) {
    for (int x = rect.x0; x < rect.x1; x += 5) {
      const size_t at = facts.index(x, y);
      const size_t v = (at / 3) % random.stack->value_count;
      double sum = 0;
      for (int dx = -4; dx <= 4; ++dx) {
        if (!rect.contains(x + dx, y)) continue;
        const size_t column = facts.index(x + dx, y);
        if (blur == Blur::shadow && !random.same_surface(at, column)) continue;
        for (int dy = -4; dy <= 4; ++dy) {
          if (!rect.contains(x + dx, y + dy)) continue;
          const size_t tap = facts.index(x + dx, y + dy);
          if (blur == Blur::shadow && !random.same_surface(column, tap)) continue;
          if (random.shared[tap] == 0.0f) continue;
          for (size_t p = 0; p < 6; ++p) {
            const BasisPair pair = random.stack->pairs[p];
            sum += random.weight(at, 0, pair.j, dx) * random.weight(column, 1, pair.k, dy) *
                   double(random.planes[random.stack->plane(p, v)][tap]);
          }
        }
      }
      REQUIRE(out.values[v][at] == Approx(sum).margin(2e-4));
    }
  }
}

TEST_CASE("Motion is summed along its line", "[stack_filter]") {
  const PixelRect rect{3, 4, 33, 30};
  const RandomStack random(Blur::motion, rect);
  const PixelFacts& facts = random.facts;
  REQUIRE(random.stack->pairs.size() == 3);
  std::vector<uint8_t> wanted(size_t(rect.pixel_count()));
  for (size_t p = 0; p < wanted.size(); ++p) wanted[p] = p % 3 == 0;
  const StackFilterOutput out = filter_lines(random.input(), wanted);
  const WedgePlanes& wedges = facts.wedges[size_t(Blur::motion)];
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      const size_t at = facts.index(x, y);
      if (!wanted[at]) {
        REQUIRE(out.values[0][at] == 0);
        continue;
      }
      if (std::isnan(wedges.low[0][at])) continue;
      const double mx = 0.5 * (double(wedges.low[0][at]) + wedges.high[0][at]);
      const double my = 0.5 * (double(wedges.low[1][at]) + wedges.high[1][at]);
      const double length = std::hypot(mx, my), ux = mx / length, uy = my / length;
      AxisWedge line{1e9f, -1e9f};  // over the corners of the box of displacements
      for (const float bx : {wedges.low[0][at], wedges.high[0][at]})
        for (const float by : {wedges.low[1][at], wedges.high[1][at]}) {
          line.low = std::min(line.low, float(bx * ux + by * uy));
          line.high = std::max(line.high, float(bx * ux + by * uy));
        }
      std::vector<float> weights(27);
      random.method.weights(line, facts.samples[at], weights.data());
      double sum = 0;
      bool close_call = false;  // rounding could go either way
      for (int d = -4; d <= 4; ++d) {
        for (const double place : {d * ux, d * uy})
          close_call |= std::abs(std::abs(place - std::floor(place)) - 0.5) < 1e-4;
        const int qx = x + int(std::lround(d * ux)), qy = y + int(std::lround(d * uy));
        if (!rect.contains(qx, qy) || random.shared[facts.index(qx, qy)] == 0.0f) continue;
        for (size_t p = 0; p < 3; ++p)
          sum += double(weights[p * 9 + size_t(4 + d)]) *
                 double(random.planes[random.stack->plane(p, 1)][facts.index(qx, qy)]);
      }
      if (!close_call) REQUIRE(out.values[1][at] == Approx(sum).margin(2e-4));
    }
  }
}

TEST_CASE("The share of a pixel's own noise counts neighbours that share samples",
          "[stack_filter]") {
  const PixelRect rect{0, 0, 20, 20};
  RandomStack random(Blur::lens, rect);
  std::fill(random.shared.begin(), random.shared.end(), 1.0f);
  StackFilterInput input = random.input();
  input.correlation.x = {1, 0.3f, 0.1f, 0}, input.correlation.y = {1, 0.2f, 0, 0};
  const StackFilterOutput out = filter_stack(input);
  const size_t at = random.facts.index(10, 9);
  REQUIRE(random.facts.wedges[size_t(Blur::lens)].known(at));
  const auto w = [&](size_t axis, int d) { return random.weight(at, axis, 0, d); };
  const double x = w(0, 0) + 0.3 * (w(0, 1) + w(0, -1)) + 0.1 * (w(0, 2) + w(0, -2));
  const double y = w(1, 0) + 0.2 * (w(1, 1) + w(1, -1));
  CHECK(out.own_weight[at] == Approx(x * y).margin(1e-5));
}

TEST_CASE("Narrowed wedges keep the least shift and a share of the way to the largest",
          "[stack_filter]") {
  const auto is = [](const AxisWedge& wedge, float low, float high) {
    return wedge.low == low && wedge.high == high;
  };
  CHECK(is(narrowed({2, 6}, 0.25f), 2, 3));
  CHECK(is(narrowed({-6, -2}, 0.25f), -3, -2));
  CHECK(is(narrowed({-4, 8}, 0.25f), -1, 2));
  CHECK(is(narrowed({0, 8}, 0.25f), 0, 2));
  CHECK(is(narrowed({-8, 0}, 0.25f), -2, 0));
  CHECK(is(narrowed({5, 5}, 0.25f), 5, 5));
  for (const AxisWedge wedge : {AxisWedge{2, 6}, {-6, -2}, {-4, 8}, {0, 0}}) {
    CHECK(is(narrowed(wedge, 1), wedge.low, wedge.high));
    // Mirrored wedges narrow to mirrored ones.
    const AxisWedge one = narrowed(wedge, 0.5f), other = narrowed({-wedge.high, -wedge.low}, 0.5f);
    CHECK(is(other, -one.high, -one.low));
  }
}

TEST_CASE("A stack filtered with a narrower wedge is one with narrower facts", "[stack_filter]") {
  const PixelRect rect{0, 0, 24, 18};
  const Blur blur = GENERATE(Blur::lens, Blur::motion);
  RandomStack random(blur, rect);
  WedgePlanes& wedges = random.facts.wedges[size_t(blur)];
  const std::vector<uint8_t> all(size_t(rect.pixel_count()), 1);
  if (blur == Blur::motion)  // towards +x, so that the line's wedge is that of x
    for (size_t p = 0; p < all.size(); ++p) {
      wedges.low[1][p] = wedges.high[1][p] = 0;
      wedges.low[0][p] = -0.1f * float(p % 7), wedges.high[0][p] = 1 + 0.1f * float(p % 5);
    }
  const auto filter = [&](float width) {
    StackFilterInput input = random.input();
    input.wedge_width = width;
    return blur == Blur::motion ? filter_lines(input, all) : filter_stack(input);
  };
  const StackFilterOutput narrow = filter(0.25f), wide = filter(1);
  for (size_t p = 0; p < all.size(); ++p) {
    for (size_t a = 0; a < 2; ++a) {
      float &low = wedges.low[a][p], &high = wedges.high[a][p];
      const float three_quarters = 0.75f * (high - low);
      if (low >= 0) {
        high -= three_quarters;
      } else if (high <= 0) {
        low += three_quarters;
      } else {
        low *= 0.25f, high *= 0.25f;
      }
    }
  }
  const StackFilterOutput expected = filter(1);
  size_t changed = 0;
  for (size_t p = 0; p < all.size(); ++p) {
    REQUIRE(narrow.values[1][p] == Approx(expected.values[1][p]).margin(1e-4));
    changed += narrow.values[1][p] != wide.values[1][p];
  }
  CHECK(changed > all.size() / 2);
}
