#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "reconstruct/guard.h"
#include "reconstruct/outliers.h"

using namespace tessera;

namespace {

/// Noise of a given deviation around 0, filtered to `bias` with no noise left.
Component noisy(float deviation, float bias, uint32_t seed = 3) {
  Component component(40, 30);
  Candidate& candidate = component.candidates.emplace_back(
      Candidate{component.plain, std::vector<float>(component.pixels())});
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, 1);
  for (size_t p = 0; p < component.pixels(); ++p)
    for (size_t c = 0; c < 3; ++c) {
      component.plain[c][p] = deviation * normal(random);
      // What two halves would say: a square with one degree of freedom.
      component.deviation[c][p] = deviation * std::abs(normal(random));
      candidate.filtered[c][p] = bias;
    }
  return component;
}

std::vector<float> shares_of(const Component& component,
                             const std::vector<float>* shared = nullptr) {
  return filtered_shares(component, {}, shared).at(0);
}

double mean_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return sum / double(values.size());
}

/// Mean squared error of the blend; the truth is 0.
double blend_error(const Component& component) {
  const std::vector<float> shares = shares_of(component);
  double sum = 0;
  for (size_t p = 0; p < shares.size(); ++p)
    for (size_t c = 0; c < 3; ++c) {
      const double y = component.plain[c][p];
      sum += std::pow(y + shares[p] * (component.candidates[0].filtered[c][p] - y), 2);
    }
  return sum / double(3 * shares.size());
}

}  // namespace

TEST_CASE("The guard takes a filter without bias nearly whole", "[guard]") {
  CHECK(mean_of(shares_of(noisy(0.5f, 0))) > 0.97);
}

TEST_CASE("A blend is never much worse than the better of its two", "[guard]") {
  for (const float bias : {0.0f, 0.1f, 0.3f, 0.5f, 1.0f, 3.0f, 100.0f}) {
    const double error = blend_error(noisy(0.5f, bias));
    INFO("bias " << bias << ": error " << error);
    CHECK(error < 1.15 * std::min(0.25, double(bias) * bias) + 0.01);
  }
}

TEST_CASE("As noise falls, the share of a biased filter falls with its square", "[guard]") {
  const double at_1 = mean_of(shares_of(noisy(0.1f, 1)));
  const double at_2 = mean_of(shares_of(noisy(0.05f, 1)));
  CHECK(at_1 == Approx(0.01).epsilon(0.3));
  CHECK(at_2 == Approx(at_1 / 4).epsilon(0.1));
  CHECK(mean_of(shares_of(noisy(0, 1))) == 0);
}

TEST_CASE("A filter that keeps a pixel's own noise is no gain", "[guard]") {
  Component component = noisy(0.5f, 2);
  const double before = mean_of(shares_of(component));
  std::ranges::fill(component.candidates[0].own_weight, 0.75f);
  CHECK(mean_of(shares_of(component)) == Approx(before / 4).epsilon(0.1));
  std::ranges::fill(component.candidates[0].own_weight, 1.0f);
  CHECK(mean_of(shares_of(component)) == 0);
}

TEST_CASE("Where halves tell nothing, neighbours tell the noise", "[guard]") {
  for (const float bias : {0.0f, 0.5f, 2.0f}) {
    Component component = noisy(0.5f, bias);
    const double known = mean_of(shares_of(component));
    for (auto& plane : component.deviation) std::fill(plane.begin(), plane.end(), -1.0f);
    CAPTURE(bias);
    CHECK(mean_of(shares_of(component)) == Approx(known).margin(0.04));
  }
}

TEST_CASE("The brightest and the darkest light are filtered alike", "[guard]") {
  const Component component = noisy(0.5f, 0.4f);
  for (const int exponent : {-90, 90}) {
    Component scaled = component;
    for (Planes* planes : {&scaled.plain, &scaled.deviation, &scaled.candidates[0].filtered})
      for (auto& plane : *planes)
        for (float& value : plane) value = std::ldexp(value, exponent);
    CHECK(shares_of(scaled) == shares_of(component));
  }
}

TEST_CASE("Halves of stratified samples that differ too much are not believed", "[guard]") {
  Component component = noisy(0.5f, 2);
  const double share = mean_of(shares_of(component));
  for (auto& plane : component.deviation)
    for (float& deviation : plane) deviation *= 3;
  CHECK(mean_of(shares_of(component)) == Approx(share).epsilon(0.2));
  // Noise that neighbours share by a half is twice what steps show.
  NoiseCorrelation half;
  half.x[1] = half.y[1] = 0.5f;
  CHECK(mean_of(filtered_shares(component, half, nullptr).at(0)) == Approx(2 * share).epsilon(0.3));
}

TEST_CASE("Outliers say nothing to their neighbours", "[guard]") {
  const Component calm = noisy(0.5f, 0.2f);
  const std::vector<float> expected = shares_of(calm);
  Component wild = calm;
  const size_t at = 15 * 40 + 20;
  std::vector<float> shared(calm.pixels(), 1.0f);
  wild.plain[1][at] = 1e6f, shared[at] = 0;
  const std::vector<float> shares = shares_of(wild, &shared);
  CHECK(shares[at] == 0);
  for (size_t p = 0; p < shares.size(); ++p)
    if (p != at) REQUIRE(shares[p] == Approx(expected[p]).margin(0.06));
}

TEST_CASE("Near a filtered value that nothing explains nothing is filtered", "[guard]") {
  const Component calm = noisy(0.5f, 0.2f);
  const std::vector<float> expected = shares_of(calm);
  Component wild = calm;
  const int x = 20, y = 15;
  wild.candidates[0].filtered[1][size_t(y * wild.width + x)] =
      GENERATE(1e10f, 3e38f, std::numeric_limits<float>::infinity(), std::nanf(""));
  const std::vector<float> shares = shares_of(wild);
  for (int j = 0; j < wild.height; ++j)
    for (int i = 0; i < wild.width; ++i) {
      const size_t p = size_t(j * wild.width + i);
      const int far = std::max(std::abs(i - x), std::abs(j - y));
      CAPTURE(i, j);
      if (far < guard_reach) REQUIRE(shares[p] < 1e-6f);
      if (far > guard_reach) REQUIRE(shares[p] == expected[p]);
    }
}

TEST_CASE("Of two filters the one without bias is taken, in any order", "[guard]") {
  for (const bool unbiased_first : {true, false}) {
    CAPTURE(unbiased_first);
    // Off by 2 at noise of 0.5, next to one that is right but has a tenth of the noise left.
    Component component = noisy(0.5f, 2);
    component.candidates.push_back(component.candidates[0]);
    Candidate& unbiased = component.candidates[unbiased_first ? 0 : 1];
    std::mt19937 random(9);
    std::normal_distribution<float> normal(0, 0.05f);
    for (auto& plane : unbiased.filtered)
      for (float& value : plane) value = normal(random);
    const auto shares = filtered_shares(component, {}, nullptr);
    REQUIRE(shares.size() == 2);
    CHECK(mean_of(shares[unbiased_first ? 0 : 1]) > 0.9);
    CHECK(mean_of(shares[unbiased_first ? 1 : 0]) < 0.01);
  }
}

TEST_CASE("Filters that agree share what one of them would have", "[guard]") {
  for (const float bias : {0.0f, 0.5f, 2.0f}) {
    CAPTURE(bias);
    Component component = noisy(0.5f, bias);
    const std::vector<float> alone = shares_of(component);
    component.candidates.push_back(component.candidates[0]);
    const auto shares = filtered_shares(component, {}, nullptr);
    REQUIRE(shares.size() == 2);
    CHECK(mean_of(alone) > 0.01);
    for (size_t p = 0; p < alone.size(); ++p)
      for (const auto& share : shares) REQUIRE(share[p] == Approx(0.5 * alone[p]).margin(1e-6));
  }
}

TEST_CASE("With two filters the shares are never more than a whole", "[guard]") {
  for (const float bias : {0.0f, 0.3f, 1.0f}) {
    Component component = noisy(0.5f, 0);
    component.candidates.push_back(component.candidates[0]);
    for (auto& plane : component.candidates[1].filtered) std::ranges::fill(plane, bias);
    const auto shares = filtered_shares(component, {}, nullptr);
    for (size_t p = 0; p < component.pixels(); ++p) {
      REQUIRE((shares[0][p] >= 0 && shares[1][p] >= 0));
      REQUIRE(shares[0][p] + shares[1][p] <= 1.00001f);
    }
    std::vector<float> outliers(component.pixels(), 1.0f);
    outliers[7] = 0;
    for (const auto& share : filtered_shares(component, {}, &outliers)) CHECK(share[7] == 0);
  }
}

TEST_CASE("Halves tell the variance of a quotient's noise", "[guard]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (const int even_count : {1, 4, 6}) {
    // Eight samples of value 0 or 1 and divisor 2: variance 1/4 / 8 / 4.
    double told = 0;
    constexpr int runs = 20000;
    for (int run = 0; run < runs; ++run) {
      float sum = 0, even = 0;
      for (int k = 0; k < 8; ++k) {
        const float value = uniform(random) < 0.5f ? 1.0f : 0.0f;
        sum += value / 8, even += k < even_count ? value / 8 : 0;
      }
      const Quotient q = halves_quotient(sum, even, 2, 2 * float(even_count) / 8);
      REQUIRE(q.value == sum / 2);
      told += q.deviation * q.deviation / runs;
    }
    CHECK(told == Approx(0.25 / 8 / 4).epsilon(0.05));
  }
}

TEST_CASE("Quotients are sane at the extremes", "[guard]") {
  CHECK(halves_quotient(1, 0.5f, 0, 0).value == 0);
  CHECK(halves_quotient(1, 1, 1, 1).deviation < 0);  // one half has everything
  CHECK(halves_quotient(1, 0, 1, 0).deviation < 0);
  for (const float huge : {1e30f, 3e38f})
    for (const float divisor : {1e-20f, 1e-19f, 1.0f, 1e30f}) {
      const Quotient q = halves_quotient(huge, 0, divisor, 0.5f * divisor);
      CHECK(std::isfinite(q.value));
      CHECK(std::isfinite(q.deviation));
    }
}

TEST_CASE("Only lone pixels far beyond those around are outliers", "[guard]") {
  const int width = 30, height = 20;
  std::vector<float> value(size_t(width * height), 1.0f), even(value.size(), 0.5f);
  const auto put = [&](int x, int y, float v, float share) {
    value[size_t(y * width + x)] = v, even[size_t(y * width + x)] = v * share;
  };
  const auto is_shared = [&](int x, int y, int spread = 1) {
    return shared_pixels(value, even, width, height, spread)[size_t(y * width + x)];
  };
  put(10, 10, 1e4f, 1);
  CHECK(is_shared(10, 10) == 0);
  CHECK(is_shared(9, 10) == 1);
  put(11, 10, 5e3f, 1);  // the same sample, a pixel further
  CHECK(is_shared(10, 10) == 0);
  CHECK(is_shared(11, 10) == 0);
  CHECK(is_shared(10, 10, 0) == 1);
  put(10, 10, 1e4f, 0);
  CHECK(is_shared(10, 10) == 0);
  put(10, 10, 1e4f, 0.5f);  // both halves see it: no chance
  CHECK(is_shared(10, 10) == 1);
  put(10, 10, 500, 1);
  CHECK(is_shared(10, 10) == 1);
  put(10, 10, 1e4f, 1), put(14, 10, 1e4f, 1);  // not alone
  CHECK(is_shared(10, 10) == 1);
  put(0, 0, 1e30f, 1);
  CHECK(is_shared(0, 0) == 0);
}

TEST_CASE("A few pixels a million times brighter than most around are outliers together",
          "[guard]") {
  const int width = 30, height = 20;
  std::vector<float> value(size_t(width * height), 1.0f), even(value.size(), 0.5f);
  const auto shared_of_lattice = [&](float bright, int step, float dark) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        value[size_t(y * width + x)] = x % step == 0 && y % step == 0 ? bright : dark;
    for (size_t p = 0; p < value.size(); ++p) even[p] = 0.5f * value[p];
    const std::vector<float> shared = shared_pixels(value, even, width, height, 1);
    if (step > 1) CHECK(shared[1] == 1);  // a dark one
    return shared[0];
  };
  CHECK(shared_of_lattice(1e7f, 3, 1.0f) == 0);
  CHECK(shared_of_lattice(1e30f, 2, 1.0f) == 0);
  CHECK(shared_of_lattice(1e5f, 3, 1.0f) == 1);  // not that bright
  CHECK(shared_of_lattice(1e7f, 3, 0.0f) == 1);  // rare light in the dark
  CHECK(shared_of_lattice(1e7f, 1, 1.0f) == 1);  // all of them
}
