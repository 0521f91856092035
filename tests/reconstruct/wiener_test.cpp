/// The best linear filter against a dense solution by other means, and its table.

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <thread>

#include "reconstruct/cholesky.h"
#include "reconstruct/wedge.h"
#include "reconstruct/wiener_model.h"
#include "reconstruct/wiener_table.h"

using namespace tessera;

namespace {

using Matrix = std::vector<std::vector<long double>>;

/// x with a x = b, by elimination with pivots.
std::vector<long double> eliminate(Matrix a, std::vector<long double> b) {
  const size_t n = b.size();
  for (size_t i = 0; i < n; ++i) {
    size_t best = i;
    for (size_t r = i; r < n; ++r)
      if (std::abs(a[r][i]) > std::abs(a[best][i])) best = r;
    std::swap(a[i], a[best]);
    std::swap(b[i], b[best]);
    for (size_t r = i + 1; r < n; ++r) {
      const long double f = a[r][i] / a[i][i];
      for (size_t c = i; c < n; ++c) a[r][c] -= f * a[i][c];
      b[r] -= f * b[i];
    }
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t c = i + 1; c < n; ++c) b[i] -= a[i][c] * b[c];
    b[i] /= a[i][i];
  }
  return b;
}

/// A point that a sample may take: where it sees the pattern for each shift, and its polynomials.
struct Point {
  int pixel;
  double place, y;
};

/// The model, point by point: samples of pixels -reach to reach on a fine grid over (xi, y).
class DenseModel {
 public:
  static constexpr int y_steps = 20, place_steps = 6, shift_steps = 12;

  DenseModel(double low, double high, int components, int reach)
      : low_(low), high_(high), components_(components), reach_(reach) {
    for (int pixel = -reach; pixel <= reach; ++pixel)
      for (int i = 0; i < place_steps; ++i)
        for (int j = 0; j < y_steps; ++j)
          points_.push_back(
              {pixel, pixel + (i + 0.5) / place_steps - 0.5, (j + 0.5) / y_steps * 2.0 - 1.0});
  }

  /// Weights [k][dx] of least mean square error with those of P_0 summing to 1: the covariance of
  /// all the moments, bordered by the constraint.
  std::vector<long double> solve(double samples) const {
    const size_t count = size_t(components_ * (2 * reach_ + 1));
    Matrix a(count + 1, std::vector<long double>(count + 1));
    add_pairs(a);
    add_noise(a, samples);
    std::vector<long double> b(count + 1);
    b[count] = 1.0L;
    for (int dx = 0; dx <= 2 * reach_; ++dx) a[count][size_t(dx)] = a[size_t(dx)][count] = 1.0L;
    std::vector<long double> x = eliminate(a, b);
    x.pop_back();
    return x;
  }

 private:
  static double gamma(double r) {
    return wiener_pattern_length * (1.0 - std::exp(-std::abs(r) / wiener_pattern_length));
  }
  static double polynomial(int k, double y) {
    return k == 0 ? 1.0 : k == 1 ? y : 1.5 * y * y - 0.5;
  }
  size_t index(int k, int pixel) const { return size_t(k * (2 * reach_ + 1) + pixel + reach_); }
  double mean_gamma(const Point& a, const Point& b) const {
    double sum = 0.0;
    for (int i = 0; i < shift_steps; ++i) {
      const double d = low_ + (high_ - low_) * (i + 0.5) / shift_steps;
      sum += gamma(a.place - b.place + d * (a.y - b.y)) / shift_steps;
    }
    return sum;
  }
  static constexpr double per_pixel = 1.0 / (y_steps * place_steps);
  bool wanted(const Point& p) const { return p.pixel == 0; }

  /// cov(f(a) - t, f(b) - t) of independent samples, from means of gamma over pairs of points.
  void add_pairs(Matrix& a) const {
    // Means of gamma between each point and t, and between t and itself.
    std::vector<double> to_wanted(points_.size());
    double wanted_to_wanted = 0.0;
    for (size_t i = 0; i < points_.size(); ++i) {
      for (const Point& q : points_)
        if (wanted(q)) to_wanted[i] += mean_gamma(points_[i], q) * per_pixel;
      if (wanted(points_[i])) wanted_to_wanted += to_wanted[i] * per_pixel;
    }
    for (size_t i = 0; i < points_.size(); ++i) {
      for (size_t j = 0; j < points_.size(); ++j) {
        const Point &p = points_[i], &q = points_[j];
        const double covariance = to_wanted[i] + to_wanted[j] - wanted_to_wanted - mean_gamma(p, q);
        for (int k = 0; k < components_; ++k)
          for (int l = 0; l < components_; ++l)
            a[index(k, p.pixel)][index(l, q.pixel)] +=
                polynomial(k, p.y) * polynomial(l, q.y) * covariance * per_pixel * per_pixel;
      }
    }
    to_wanted_ = to_wanted;
    wanted_to_wanted_ = wanted_to_wanted;
  }

  /// A sample with itself, in place of two samples, in 1 of `samples` pairs.
  void add_noise(Matrix& a, double samples) const {
    for (int pixel = -reach_; pixel <= reach_; ++pixel) {
      for (int k = 0; k < components_; ++k) {
        for (int l = 0; l < components_; ++l) {
          long double& entry = a[index(k, pixel)][index(l, pixel)];
          entry -= entry / samples;
        }
      }
    }
    for (size_t i = 0; i < points_.size(); ++i) {
      const Point& p = points_[i];
      const double variance = 2.0 * to_wanted_[i] - wanted_to_wanted_;
      for (int k = 0; k < components_; ++k)
        for (int l = 0; l < components_; ++l)
          a[index(k, p.pixel)][index(l, p.pixel)] +=
              polynomial(k, p.y) * polynomial(l, p.y) * variance * per_pixel / samples;
    }
  }

  double low_, high_;
  int components_, reach_;
  std::vector<Point> points_;
  mutable std::vector<double> to_wanted_;
  mutable double wanted_to_wanted_ = 0.0;
};

}  // namespace

TEST_CASE("the best filter is that of a dense solution", "[wiener]") {
  struct Case {
    double low, high, samples;
    int components;
  };
  for (const Case& c : {Case{1.0, 2.5, 4, 3},
                        {-1.5, 2.0, 1, 2},
                        {2.0, 2.0, 16, 2},
                        {0.0, 0.0, 4, 1},
                        {-3.0, -1.0, 8, 2}}) {
    constexpr int reach = 2;
    const PairStatistics pairs(c.low, c.high, c.components, reach);
    const std::vector<double> ours = WienerSolver(pairs).weights(c.samples);
    const auto dense = DenseModel(c.low, c.high, c.components, reach).solve(c.samples);
    REQUIRE(ours.size() == dense.size());
    for (size_t i = 0; i < ours.size(); ++i) {
      INFO(c.low << " " << c.high << " " << c.samples << " entry " << i);
      // The dense model's grids over y, places and shifts err by their steps squared.
      CHECK(ours[i] == Approx(double(dense[i])).margin(0.01));
    }
  }
}

TEST_CASE("linear systems are solved", "[wiener]") {
  std::mt19937 random(3);
  constexpr size_t size = 23;
  std::vector<double> root(size * size), matrix(size * size), b(size), x(size);
  for (double& r : root) r = random() / 4294967296.0 - 0.5;
  Matrix same(size, std::vector<long double>(size));
  std::vector<long double> right(size);
  for (size_t i = 0; i < size; ++i) {
    b[i] = random() / 4294967296.0;
    right[i] = b[i];
    for (size_t j = 0; j < size; ++j) {
      for (size_t k = 0; k < size; ++k)
        matrix[i * size + j] += root[i * size + k] * root[j * size + k];
      if (i == j) matrix[i * size + j] += 0.1;
      same[i][j] = matrix[i * size + j];
    }
  }
  solve_positive(matrix, b, x);
  const auto expected = eliminate(same, right);
  for (size_t i = 0; i < size; ++i) CHECK(x[i] == Approx(double(expected[i])).epsilon(1e-9));
}

TEST_CASE("systems stay definite for equal slopes, many samples and seven components", "[wiener]") {
  struct Case {
    double low, high;
  };
  for (const Case& c :
       {Case{0, 0}, {0.5, 0.5}, {4, 4}, {11.3, 11.3}, {64, 64}, {-5, 5}, {63, 64}}) {
    const PairStatistics pairs(c.low, c.high, 7, 16);
    const WienerSolver solver(pairs);
    for (double samples : {1.0, 1024.0, 65536.0, 1e6}) {
      const std::vector<double> filter = solver.weights(samples);
      double sum = 0.0, largest = 0.0;
      for (size_t i = 0; i < filter.size(); ++i) {
        if (i < 33) sum += filter[i];
        largest = std::max(largest, std::abs(filter[i]));
      }
      INFO(c.low << " " << c.high << " " << samples);
      CHECK(sum == Approx(1.0));
      CHECK((largest > 0.02 && largest < 2.0));
      CHECK(solver.equivalent_pixels(filter) > 0.9);
    }
  }
}

TEST_CASE("many samples leave the pixel alone where the shift is small", "[wiener]") {
  const PairStatistics pairs(0.1, 0.3, 3, 16);
  const WienerSolver solver(pairs);
  const std::vector<double> filter = solver.weights(1e5);
  CHECK(filter[16] == Approx(1.0).margin(0.01));
  CHECK(solver.equivalent_pixels(filter) == Approx(1.0).margin(0.02));
  // Few samples of a place that is the same for all y: the more, the narrower.
  double last = 1e9;
  for (double samples : {1.0, 4.0, 16.0, 64.0, 1024.0}) {
    const double pixels = solver.equivalent_pixels(solver.weights(samples));
    CHECK(pixels < last);
    last = pixels;
  }
}

TEST_CASE("the equivalent pixels of a box are its width", "[wiener]") {
  const PairStatistics pairs(1.0, 2.0, 1, 4);
  std::vector<double> box(9, 0.0);
  for (int i = 2; i < 7; ++i) box[size_t(i)] = 0.2;
  CHECK(WienerSolver(pairs).equivalent_pixels(box) == Approx(5.0));
}

TEST_CASE("the table holds the solutions on its grid and stays near them between", "[wiener]") {
  const WienerTable table(3, 1);
  struct Case {
    double low, high, samples, margin;
  };
  // 8 and 4 pixels, ratios of 0, 0.5 and 1 and powers of 4 are lines of the grid.
  for (const Case& c : {Case{4, 8, 16, 1e-6},
                        {0, 4, 4, 1e-6},
                        {8, 8, 64, 1e-6},
                        {-8, 8, 1, 1e-6},
                        {5, 9.3, 11, 0.02},
                        {-3, 20, 40, 0.04},
                        {0.2, 0.3, 2, 0.05}}) {
    const PairStatistics pairs(c.low, c.high, 3, WienerTable::reach);
    const std::vector<double> exact = WienerSolver(pairs).weights(c.samples);
    std::vector<float> found(exact.size());
    table.weights({float(c.low), float(c.high)}, c.samples, found.data());
    for (size_t i = 0; i < exact.size(); ++i) {
      INFO(c.low << " " << c.high << " " << c.samples << " entry " << i);
      CHECK(found[i] == Approx(exact[i]).margin(c.margin));
    }
  }
}

TEST_CASE("whichever thread first asks for a filter, all get the same", "[wiener]") {
  const WienerTable alone(1, 2), shared(1, 2);
  constexpr size_t size = 2 * WienerTable::reach + 1;
  const auto weights = [](const WienerTable& table, size_t k) {
    std::vector<float> out(size);
    table.weights({float(k % 5) - 2.0f, float(k)}, double(1 + k), out.data());
    return out;
  };
  std::array<std::array<std::vector<float>, 8>, 4> found;
  std::vector<std::thread> threads;
  for (size_t t = 0; t < found.size(); ++t)
    threads.emplace_back([&, t] {
      for (size_t k = 0; k < 8; ++k) found[t][(k + 2 * t) % 8] = weights(shared, (k + 2 * t) % 8);
    });
  for (std::thread& thread : threads) thread.join();
  for (size_t k = 0; k < 8; ++k) {
    const std::vector<float> expected = weights(alone, k);
    CHECK(std::accumulate(expected.begin(), expected.end(), 0.0) == Approx(1.0));
    for (const auto& of_thread : found) CHECK(of_thread[k] == expected);
  }
}

TEST_CASE("wedges are ordered, bounded and turned", "[wiener]") {
  CHECK(bounded_wedge({3, -2}, 10).low == -2.0f);
  CHECK(bounded_wedge({3, -2}, 10).high == 3.0f);
  CHECK(bounded_wedge({std::nanf(""), 1e30f}, 10).low == 0.0f);
  CHECK(bounded_wedge({std::nanf(""), 1e30f}, 10).high == 10.0f);
  CHECK(smallest_shift({-7, -3}) == 3.0);
  CHECK(smallest_shift({2, 9}) == 2.0);
  CHECK(smallest_shift({-2, 9}) == 0.0);
  const TurnedWedge turned = turned_wedge({-9, 2});
  CHECK(turned.low == -2.0);
  CHECK(turned.high == 9.0);
  CHECK(turned.mirrored);
  CHECK(!turned_wedge({-2, 9}).mirrored);
  CHECK(!turned_wedge({-2, 2}).mirrored);
}
