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
    in.stack = stack, in.method = &method, in.planes = &planes, in.facts = &facts;
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
