#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include "hide/samples.h"

using namespace tessera;

namespace {

const std::unique_ptr<LensProfile> disc = make_lens_profile("disc", 6, 0);
const std::unique_ptr<ShutterProfile> box = make_shutter_profile("box");

SamplePattern pattern_of(int spp, bool lens, bool time, SampleTuples tuples = {},
                         SampleExtras extras = {true, true}, uint32_t seed = 7) {
  return SamplePattern(spp, seed, lens ? disc.get() : nullptr, time ? box.get() : nullptr, tuples,
                       extras);
}

/// Whether `count` points, a power of two, lie one in each elementary interval of every shape.
bool is_net(const float* a, const float* b, int count) {
  for (int columns = 1; columns <= count; columns *= 2) {
    const int rows = count / columns;
    std::set<int> cells;
    for (int k = 0; k < count; ++k)
      cells.insert(int(double(a[k]) * columns) * rows + int(double(b[k]) * rows));
    if (int(cells.size()) != count) return false;
  }
  return true;
}

struct KindCase {
  SampleTuples tuples;
  bool lens, time;
};
const KindCase kinds[] = {{{}, false, false},
                          {{}, true, false},
                          {{}, true, true},
                          {{SampleTuples::Kind::interleaved, 64}, true, true},
                          {{SampleTuples::Kind::accumulated, 16}, true, true},
                          {{SampleTuples::Kind::lens_lines, 8}, true, true}};

}  // namespace

TEST_CASE("pairs for rays are nets in every pixel, whatever kind of tuples") {
  for (const KindCase& kind : kinds) {
    for (const int spp : {16, 64}) {
      SampleBlock block;
      pattern_of(spp, kind.lens, kind.time, kind.tuples).fill({-2, 3, 4, 7}, block);
      REQUIRE(block.light_x.size() == block.x.size());
      for (size_t first = 0; first < block.size(); first += size_t(spp)) {
        REQUIRE(is_net(&block.light_x[first], &block.light_y[first], spp));
        REQUIRE(is_net(&block.bounce_x[first], &block.bounce_y[first], spp));
      }
    }
  }
}

TEST_CASE("runs of samples in time are nets of their own") {
  SampleBlock block;
  pattern_of(64, true, true).fill({0, 0, 4, 4}, block);
  for (size_t first = 0; first < block.size(); first += 16) {
    REQUIRE(std::is_sorted(&block.t[first], &block.t[first] + 16));
    REQUIRE(is_net(&block.light_x[first], &block.light_y[first], 16));
    REQUIRE(is_net(&block.bounce_x[first], &block.bounce_y[first], 16));
  }
}

TEST_CASE("nothing is made that was not asked for, and asking changes nothing else") {
  SampleBlock plain, light, both;
  pattern_of(16, true, true, {}, {}).fill({0, 0, 5, 3}, plain);
  pattern_of(16, true, true, {}, {true, false}).fill({0, 0, 5, 3}, light);
  pattern_of(16, true, true, {}, {true, true}).fill({0, 0, 5, 3}, both);
  CHECK(plain.light_x.empty());
  CHECK(plain.bounce_y.empty());
  CHECK(light.bounce_x.empty());
  for (size_t i = 0; i < plain.size(); ++i) {
    REQUIRE(plain.x[i] == both.x[i]);
    REQUIRE(plain.v[i] == both.v[i]);
    REQUIRE(plain.t[i] == both.t[i]);
    REQUIRE(light.light_x[i] == both.light_x[i]);
    REQUIRE(light.light_y[i] == both.light_y[i]);
  }
  for (size_t i = both.size(); i < both.x.size(); ++i) {
    REQUIRE(std::isnan(both.light_x[i]));
    REQUIRE(std::isnan(both.bounce_y[i]));
  }
  // A block that held some before.
  pattern_of(16, true, true, {}, {}).fill({0, 0, 5, 3}, both);
  CHECK(both.light_x.empty());
}

TEST_CASE("pairs for rays are a function of pixel and seed, whatever the block") {
  for (const int spp : {1, 3, 16, 17}) {
    const SamplePattern pattern = pattern_of(spp, true, true);
    SampleBlock whole, part;
    pattern.fill({-2, 0, 14, 9}, whole);
    pattern.fill({5, 4, 8, 7}, part);
    for (int y = 4; y < 7; ++y)
      for (int x = 5; x < 8; ++x)
        for (int k = 0; k < spp; ++k) {
          const size_t a = size_t(y * 16 + x + 2) * size_t(spp) + size_t(k);
          const size_t b = size_t((y - 4) * 3 + x - 5) * size_t(spp) + size_t(k);
          REQUIRE(whole.light_x[a] == part.light_x[b]);
          REQUIRE(whole.light_y[a] == part.light_y[b]);
          REQUIRE(whole.bounce_x[a] == part.bounce_x[b]);
          REQUIRE(whole.bounce_y[a] == part.bounce_y[b]);
          REQUIRE((part.light_x[b] >= 0.0f && part.light_x[b] < 1.0f));
          REQUIRE((part.bounce_y[b] >= 0.0f && part.bounce_y[b] < 1.0f));
        }
  }
}

TEST_CASE("pairs for rays tell nothing of place, lens, time, neighbours or each other") {
  constexpr int size = 64, spp = 16;
  SampleBlock block;
  pattern_of(spp, true, true).fill({0, 0, size, size}, block);
  const size_t n = block.size();
  const auto fraction = [](float v) { return double(v) - std::floor(double(v)); };
  /// Of uniform values, or of the lens coordinates with their own spread.
  const auto correlation = [&](const auto& a, const auto& b, size_t lag) {
    double ab = 0, aa = 0, bb = 0, ma = 0, mb = 0;
    for (size_t i = 0; i + lag < n; ++i) {
      const double p = fraction(a[i]), q = fraction(b[i + lag]);
      ab += p * q, aa += p * p, bb += q * q, ma += p, mb += q;
    }
    const double m = double(n - lag);
    return (ab / m - ma * mb / m / m) /
           std::sqrt((aa / m - ma * ma / m / m) * (bb / m - mb * mb / m / m));
  };
  // Independent: 1 / sqrt(65536) = 0.004 a deviation; five deviations.
  const auto& pairs = {&block.light_x, &block.light_y, &block.bounce_x, &block.bounce_y};
  for (const auto* pair : pairs) {
    for (const auto* other : {&block.x, &block.y, &block.t})
      CHECK(std::abs(correlation(*pair, *other, 0)) < 0.02);
    double by_side = 0;
    for (size_t i = 0; i < n; ++i) by_side += (double((*pair)[i]) - 0.5) * double(block.u[i]);
    CHECK(std::abs(by_side / double(n)) < 5 * 0.5 * 0.29 / std::sqrt(double(n)));
    CHECK(std::abs(correlation(*pair, *pair, spp)) < 0.02);
    CHECK(std::abs(correlation(*pair, *pair, size_t(size) * spp)) < 0.02);
  }
  CHECK(std::abs(correlation(block.light_x, block.light_y, 0)) < 0.02);
  CHECK(std::abs(correlation(block.light_x, block.bounce_x, 0)) < 0.02);
  CHECK(std::abs(correlation(block.light_y, block.bounce_y, 0)) < 0.02);
  // The order within a pixel: sample k sees every part of the square.
  for (const auto* pair : pairs)
    for (size_t k = 0; k < spp; ++k) {
      double mean = 0;
      for (size_t i = k; i < n; i += spp) mean += double((*pair)[i]) / (size * size);
      CHECK(mean == Approx(0.5).margin(5 * 0.29 / size));
    }
}
