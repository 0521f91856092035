#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include "base/error.h"
#include "hide/samples.h"
#include "hide/sobol.h"

using namespace tessera;

namespace {

struct Profiles {
  std::unique_ptr<LensProfile> lens = make_lens_profile("disc", 6, 0);
  std::unique_ptr<ShutterProfile> shutter = make_shutter_profile("box");
};

/// Number of distinct cells that `a`, `b` in [0, 1) fall into on a grid of columns x rows.
size_t cells_hit(const std::vector<double>& a, const std::vector<double>& b, int columns,
                 int rows) {
  std::set<int> cells;
  for (size_t k = 0; k < a.size(); ++k) cells.insert(int(a[k] * columns) * rows + int(b[k] * rows));
  return cells.size();
}

std::vector<double> fractions(const AlignedVector<float>& values, size_t first, int count,
                              int origin) {
  std::vector<double> result;
  for (int k = 0; k < count; ++k) result.push_back(double(values[first + size_t(k)]) - origin);
  return result;
}

}  // namespace

TEST_CASE(
    "Sobol points form (0, m, 2)-nets in the first two dimensions, before and after scrambling") {
  for (const uint32_t seed : {0u, 1u, 0xdeadbeefu})
    for (int m = 0; m <= 10; ++m) {
      std::vector<double> a, b;
      for (uint32_t k = 0; k < 1u << m; ++k) {
        const auto fraction = [&](int dimension) {
          uint32_t x = sobol_reversed(dimension, k);
          if (seed) x = owen_scramble_reversed(x, seed + uint32_t(dimension));
          double value = 0;
          for (int i = 0; i < 32; ++i) value += (x >> i & 1) * std::ldexp(1.0, -1 - i);
          return value;
        };
        a.push_back(fraction(0)), b.push_back(fraction(1));
      }
      for (int split = 0; split <= m; ++split)
        REQUIRE(cells_hit(a, b, 1 << split, 1 << (m - split)) == size_t(1) << m);
    }
}

TEST_CASE("Known values of the Sobol sequence") {
  // Worked out by hand from the direction integers: index 2 selects the second direction number,
  // 3 the exclusive or of the first two, and 4 the third.
  const double expected[5][5] = {{0, 0, 0, 0, 0},
                                 {0.5, 0.5, 0.5, 0.5, 0.5},
                                 {0.25, 0.75, 0.75, 0.75, 0.25},
                                 {0.75, 0.25, 0.25, 0.25, 0.75},
                                 {0.125, 0.625, 0.375, 0.125, 0.125}};
  for (uint32_t k = 0; k < 5; ++k)
    for (int d = 0; d < 5; ++d) {
      double value = 0;
      for (int i = 0; i < 32; ++i)
        value += (sobol_reversed(d, k) >> i & 1) * std::ldexp(1.0, -1 - i);
      INFO("point " << k << " dimension " << d);
      CHECK(value == expected[k][d]);
    }
}

TEST_CASE("Each dimension of each pixel is stratified for powers of two") {
  const Profiles p;
  for (const int spp : {1, 2, 4, 16, 64}) {
    const SamplePattern pattern(spp, 7, nullptr, p.shutter.get());
    SampleBlock block;
    pattern.fill({3, 5, 9, 8}, block);
    REQUIRE(block.u.empty());
    for (int y = 5; y < 8; ++y)
      for (int x = 3; x < 9; ++x) {
        const size_t first = size_t((y - 5) * 6 + x - 3) * size_t(spp);
        const auto xs = fractions(block.x, first, spp, x), ys = fractions(block.y, first, spp, y);
        const auto ts = fractions(block.t, first, spp, 0);
        const std::vector<double> zeros(xs.size(), 0.0);
        REQUIRE(cells_hit(xs, zeros, spp, 1) == size_t(spp));
        REQUIRE(cells_hit(ys, zeros, spp, 1) == size_t(spp));
        REQUIRE(cells_hit(ts, zeros, spp, 1) == size_t(spp));
        REQUIRE(std::is_sorted(ts.begin(), ts.end()));
        if (spp == 16) REQUIRE(cells_hit(xs, ys, 4, 4) == 16);
      }
  }
}

TEST_CASE("Samples are a function of pixel and seed, whatever the block") {
  const Profiles p;
  for (const int spp : {1, 3, 16, 17}) {
    const SamplePattern pattern(spp, 42, p.lens.get(), p.shutter.get());
    SampleBlock whole, part;
    pattern.fill({-2, 0, 14, 9}, whole);
    pattern.fill({5, 4, 8, 7}, part);
    for (int y = 4; y < 7; ++y)
      for (int x = 5; x < 8; ++x)
        for (int k = 0; k < spp; ++k) {
          const size_t a = size_t(y * 16 + x + 2) * size_t(spp) + size_t(k);
          const size_t b = size_t((y - 4) * 3 + x - 5) * size_t(spp) + size_t(k);
          REQUIRE(whole.x[a] == part.x[b]);
          REQUIRE(whole.y[a] == part.y[b]);
          REQUIRE(whole.u[a] == part.u[b]);
          REQUIRE(whole.v[a] == part.v[b]);
          REQUIRE(whole.t[a] == part.t[b]);
          REQUIRE((part.x[b] >= float(x) && part.x[b] < float(x + 1)));
        }
    for (size_t i = whole.size(); i < whole.x.size(); ++i) REQUIRE(std::isnan(whole.x[i]));
  }
}

TEST_CASE("Samples stay in their pixel far from the origin") {
  const SamplePattern pattern(64, 3, nullptr, nullptr);
  SampleBlock block;
  pattern.fill({32000, 32000, 32004, 32004}, block);
  for (size_t i = 0; i < block.size(); ++i)
    REQUIRE(std::floor(block.x[i]) == float(32000 + int(i / 64 % 4)));
}

TEST_CASE("Coordinates are uniform, and neighbouring pixels and dimensions are not correlated") {
  const Profiles p;
  const SamplePattern pattern(1, 9, nullptr, p.shutter.get());
  SampleBlock block;
  constexpr int size = 256;
  pattern.fill({0, 0, size, size}, block);
  const size_t n = block.size();
  std::vector<double> x(n), y(n), t(n);
  for (size_t i = 0; i < n; ++i)
    x[i] = block.x[i] - double(i % size), y[i] = block.y[i] - double(i / size), t[i] = block.t[i];
  const auto correlation = [&](const std::vector<double>& a, const std::vector<double>& b,
                               size_t lag) {
    double sum = 0;
    for (size_t i = 0; i + lag < n; ++i) sum += (a[i] - 0.5) * (b[i + lag] - 0.5);
    return sum * 12 / double(n - lag);
  };
  // The correlation of n independent pairs deviates by 1 / sqrt(n) = 0.004; five deviations.
  for (const size_t lag : {size_t(1), size_t(2), size_t(size), size_t(size + 1)}) {
    CHECK(std::abs(correlation(x, x, lag)) < 0.02);
    CHECK(std::abs(correlation(t, t, lag)) < 0.02);
  }
  CHECK(std::abs(correlation(x, y, 0)) < 0.02);
  CHECK(std::abs(correlation(x, t, 0)) < 0.02);
  // Standard deviation of the mean of n uniforms: sqrt(1 / 12 / n) = 0.0011; five deviations.
  CHECK(std::accumulate(x.begin(), x.end(), 0.0) / double(n) == Approx(0.5).margin(0.006));
  CHECK(correlation(x, x, 0) == Approx(1.0).margin(0.02));
}

TEST_CASE("The fast disc lens is the disc profile") {
  const Profiles p;
  const SamplePattern with_lens(16, 5, p.lens.get(), nullptr);
  SampleBlock block;
  with_lens.fill({0, 0, 16, 16}, block);
  // A profile that is not recognised by name goes through the virtual call.
  class Renamed final : public LensProfile {
   public:
    explicit Renamed(const LensProfile& inner) : inner_(inner) {}
    const char* name() const override { return "other"; }
    glm::vec2 sample(float a, float b) const override { return inner_.sample(a, b); }
    float extent() const override { return inner_.extent(); }
    double band_limit(double share) const override { return inner_.band_limit(share); }

   private:
    const LensProfile& inner_;
  } renamed(*p.lens);
  const SamplePattern slow(16, 5, &renamed, nullptr);
  SampleBlock expected;
  slow.fill({0, 0, 16, 16}, expected);
  for (size_t i = 0; i < block.size(); ++i) {
    REQUIRE(block.u[i] == Approx(expected.u[i]).margin(1e-6));
    REQUIRE(block.v[i] == Approx(expected.v[i]).margin(1e-6));
    REQUIRE(block.u[i] * block.u[i] + block.v[i] * block.v[i] < 1.000001f);
  }
}

TEST_CASE("Sample counts out of range are refused") {
  CHECK_THROWS_AS(SamplePattern(0, 0, nullptr, nullptr), Error);
  CHECK_THROWS_AS(SamplePattern(65537, 0, nullptr, nullptr), Error);
}

TEST_CASE("Samples of still pixels lie one in each strip of y, in order") {
  for (const int spp : {1, 2, 16, 64}) {
    SampleBlock block;
    SamplePattern(spp, 5, nullptr, nullptr).fill({1000, 2000, 1009, 2007}, block);
    REQUIRE(block.y_stratified);
    for (size_t i = 0; i < block.size(); ++i) {
      const size_t pixel = i / size_t(spp), k = i % size_t(spp);
      const double from = 2000 + double(pixel / 9) + double(k) / spp;
      // The sum of a pixel and an offset may round up to the end of its strip.
      REQUIRE((block.y[i] >= from && block.y[i] <= from + 1.0 / spp));
    }
  }
  const Profiles p;
  for (const auto& [spp, lens, shutter] :
       {std::tuple{3, false, false}, {16, true, false}, {16, false, true}}) {
    SampleBlock block;
    SamplePattern(spp, 5, lens ? p.lens.get() : nullptr, shutter ? p.shutter.get() : nullptr)
        .fill({0, 0, 4, 4}, block);
    REQUIRE(!block.y_stratified);
  }
}
