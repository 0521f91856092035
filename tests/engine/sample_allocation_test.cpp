// Where samples go, against brute force and closed forms.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "engine/sample_allocation.h"

using namespace tessera;

namespace {

PixelNoise noise_of(int width, std::vector<double> variance) {
  return {{0, 0, width, int(variance.size()) / width}, std::move(variance)};
}

constexpr int side = 1 << SampleAllocation::tile_bits;

// A row of tiles of the same variance all over.
PixelNoise tiles_of(const std::vector<double>& variance) {
  PixelNoise noise{{0, 0, side * int(variance.size()), side}, {}};
  for (int y = 0; y < side; ++y)
    for (const double v : variance) noise.variance.insert(noise.variance.end(), side, v);
  return noise;
}

// The levels of a row of tiles, which all their pixels must have.
std::vector<uint8_t> tile_levels(const SampleAllocation& allocation) {
  std::vector<uint8_t> levels;
  for (int x = allocation.rect.x0; x < allocation.rect.x1; x += side)
    levels.push_back(allocation.level[allocation.index(x, allocation.rect.y0)]);
  for (int y = allocation.rect.y0; y < allocation.rect.y1; ++y)
    for (int x = allocation.rect.x0; x < allocation.rect.x1; ++x)
      if (allocation.level[allocation.index(x, y)] != levels[size_t(x - allocation.rect.x0) / side])
        levels.clear();
  return levels;
}

// The least mean of powers of two whose expected error is no larger, by trying all.
double least_mean_by_brute_force(const std::vector<double>& variance, double error_squared,
                                 int levels) {
  double best = std::numeric_limits<double>::infinity();
  size_t count = 1;
  for (size_t p = 0; p < variance.size(); ++p) count *= size_t(levels);
  for (size_t code = 0; code < count; ++code) {
    size_t rest = code;
    double error = 0, samples = 0;
    for (const double v : variance) {
      const double n = double(1 << (rest % size_t(levels)));
      rest /= size_t(levels);
      error += v / n, samples += n;
    }
    if (error / double(variance.size()) <= error_squared)
      best = std::min(best, samples / double(variance.size()));
  }
  return best;
}

constexpr AllocationLimits no_limits{0, 0, 1e9, true};

}  // namespace

TEST_CASE("samples reach the error that is wanted, with hardly more than brute force needs") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-2, 2);
  double ours = 0, least = 0;
  for (int k = 0; k < 12; ++k) {
    std::vector<double> variance(6);
    for (double& v : variance) v = std::pow(10.0, exponent(random));
    double mean = 0;
    for (const double v : variance) mean += v / 6;
    const double wanted = mean / 6;
    const PixelNoise noise = tiles_of(variance);
    const SampleAllocation found = allocate(noise, noise.rect, wanted, no_limits);
    CHECK(expected_error_squared(noise, found) <= wanted);
    const double best = least_mean_by_brute_force(variance, wanted, 7);
    CHECK(found.mean_samples() >= best);
    ours += found.mean_samples(), least += best;
  }
  // Six tiles move in coarse steps, and all that round alike move at once.
  CHECK(ours < 1.25 * least);
}

TEST_CASE("samples are proportional to the root of the variance") {
  // Lagrange: n_p = c sqrt(v_p), error = mean of sqrt(v) / c. Roots 1, 2, 4, 8: no rounding.
  const PixelNoise noise = tiles_of({1, 4, 16, 64});
  const SampleAllocation found = allocate(noise, noise.rect, 3.75 / 4, no_limits);
  CHECK(tile_levels(found) == std::vector<uint8_t>{2, 3, 4, 5});
  CHECK(found.mean_samples() == 15.0);
  CHECK(expected_error_squared(noise, found) == 0.9375);
  CHECK(found.least_samples() == 4);
  CHECK(found.most_samples() == 32);
}

TEST_CASE("tiles in which nothing was noticed get their share") {
  const PixelNoise noise = tiles_of({0, 0, 1, 1});
  const SampleAllocation found = allocate(noise, noise.rect, 0.5 / 64, no_limits);
  // An eighth of the mean root, 1/2.
  CHECK(tile_levels(found) == std::vector<uint8_t>{2, 2, 6, 6});
}

TEST_CASE("a tile goes by the mean variance of its pixels, wherever the rectangle cuts it") {
  // A row of pixels from the middle of one tile into the next: the first has 8 pixels of mean
  // variance 16, the second 4 of variance 4.
  PixelNoise noise{{8, 3, 20, 4}, {}};
  for (int k = 0; k < 8; ++k) noise.variance.push_back(k % 2 == 0 ? 32.0 : 0.0);
  for (int k = 0; k < 4; ++k) noise.variance.push_back(4.0);
  const SampleAllocation found = allocate(noise, noise.rect, 1.0 + 1e-9, no_limits);
  const std::vector<uint8_t> first(8, found.level[0]), second(4, found.level[11]);
  CHECK(std::equal(first.begin(), first.end(), found.level.begin()));
  CHECK(std::equal(second.begin(), second.end(), found.level.begin() + 8));
  CHECK(found.samples(8, 3) == 2 * found.samples(19, 3));
}

TEST_CASE("limits of an allocation hold") {
  const PixelNoise noise = tiles_of({1, 4, 16, 64});
  const SampleAllocation few = allocate(noise, noise.rect, 0, {0, 0, 9.0, true});
  CHECK(few.mean_samples() <= 9.0);
  CHECK(few.mean_samples() > 4.5);  // all of them one step up would be beyond
  // More than the error asks for.
  CHECK(allocate(noise, noise.rect, 1e9, {0, 6.0, 100.0, true}).mean_samples() >= 6.0);
  CHECK(allocate(noise, noise.rect, 1e9, {1, 0.0, 100.0, true}).level ==
        std::vector<uint8_t>(noise.variance.size(), 1));
  // All alike: the mean variance is 85 / 4, and 32 samples bring it below 1.
  CHECK(tile_levels(allocate(noise, noise.rect, 1.0, {0, 0, 1e9, false})) ==
        std::vector<uint8_t>(4, 5));
  CHECK(tile_levels(allocate(noise, noise.rect, 1.0, {0, 0, 12, false})) ==
        std::vector<uint8_t>(4, 3));
}

TEST_CASE("frames without noise, and with noise beyond measure, are allocated") {
  const PixelNoise black = tiles_of({0, 0, 0, 0});
  CHECK(allocate(black, black.rect, 1e-9, no_limits).mean_samples() == 1.0);
  CHECK(allocate(black, black.rect, 0, no_limits).mean_samples() == 1.0);
  const PixelNoise huge = tiles_of({1e60, 1e-60, 0, 1});
  CHECK(allocate(huge, huge.rect, 1e-12, {0, 0, 100, true}).mean_samples() <= 100);
}

TEST_CASE("pixels beyond the crop go by the nearest within") {
  const PixelNoise noise{{15, 2, 17, 3}, {1, 64}};  // two tiles meet between its two pixels
  const SampleAllocation found = allocate(noise, {0, 0, 40, 5}, 0.5, no_limits);
  CHECK(found.samples(0, 0) == found.samples(15, 2));
  CHECK(found.samples(39, 4) == found.samples(16, 2));
  CHECK(found.samples(39, 4) == 8 * found.samples(0, 0));
  CHECK(found.choices({16, 2, 40, 3}) ==
        std::vector<uint8_t>(24, uint8_t(1 + found.level[found.index(16, 2)])));
}

TEST_CASE("smoothing spreads the noise of a pixel by binomial weights") {
  std::vector<double> variance(81, 0.0);
  variance[40] = 256;
  const PixelNoise smooth = smoothed(noise_of(9, variance));
  const double row[] = {0, 0, 1, 4, 6, 4, 1, 0, 0};
  for (size_t y = 0; y < 9; ++y)
    for (size_t x = 0; x < 9; ++x) CHECK(smooth.variance[y * 9 + x] == row[y] * row[x]);
  const PixelNoise flat = smoothed(noise_of(3, std::vector<double>(6, 2.0)));
  CHECK(flat.variance == std::vector<double>(6, 2.0));
}
