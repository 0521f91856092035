#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "reconstruct/legendre.h"
#include "tests/reconstruct/flatland.h"

using namespace tessera;
using flatland::make_method;

namespace {

struct Named {
  const char *name, *arguments;
};
constexpr Named all_methods[] = {{"aaf", ""},    {"fsf", ""},     {"maaf", ""},   {"maaf", "3"},
                                 {"maaf", "25"}, {"wiener", "1"}, {"wiener", "3"}};

std::vector<float> weights_of(const ReconstructionMethod& method, const AxisWedge& wedge,
                              float samples) {
  std::vector<float> out(size_t(method.basis_count() * (2 * method.reach() + 1)), -7.0f);
  method.weights(wedge, samples, out.data());
  return out;
}

/// Means of the basis functions over y, by midpoints.
std::vector<double> basis_means(const ReconstructionMethod& method) {
  constexpr int steps = 2000;
  std::vector<double> means(size_t(method.basis_count()));
  std::vector<float> values(means.size());
  for (int i = 0; i < steps; ++i) {
    BasisPoint at;
    at.y = float((i + 0.5) / steps * 2.0 - 1.0);
    method.basis(at, values.data());
    for (size_t k = 0; k < means.size(); ++k) means[k] += values[k] / double(steps);
  }
  return means;
}

/// What the filter makes of f = 1 seen by samples without number.
double response_to_one(const std::vector<float>& weights, const std::vector<double>& means) {
  const size_t row = weights.size() / means.size();
  double sum = 0.0;
  for (size_t i = 0; i < weights.size(); ++i) sum += weights[i] * means[i / row];
  return sum;
}

const float infinity = std::numeric_limits<float>::infinity();
const float nan_value = std::numeric_limits<float>::quiet_NaN();
const AxisWedge extreme_wedges[] = {{0, 0},
                                    {1e-30f, 1e-30f},
                                    {-1e-30f, 1e-30f},
                                    {0, 1e-6f},
                                    {5, 5},
                                    {-5, -5},
                                    {-5, 5},
                                    {0, 30},
                                    {-30, 0},
                                    {1e30f, 1e30f},
                                    {-1e30f, 1e30f},
                                    {1e-30f, 1e30f},
                                    {3, 1e7f},
                                    {1e7f, 1.1e7f},
                                    {-1e30f, -1e-30f},
                                    {12, 12.00001f},
                                    {4, -4},
                                    {nan_value, 3},
                                    {-infinity, infinity},
                                    {0.499f, 0.501f},
                                    {1e-3f, 1e-3f},
                                    {-1e38f, 3e38f},
                                    {24, 24},
                                    {63.9f, 64.1f},
                                    {7, infinity}};

}  // namespace

TEST_CASE("the registry holds the methods, with components where they take any", "[method]") {
  CHECK(make_method("aaf")->basis_count() == 1);
  CHECK(make_method("fsf")->basis_count() == 9);
  CHECK(make_method("maaf")->basis_count() == 5);
  CHECK(make_method("maaf", "3")->basis_count() == 3);
  CHECK(make_method("maaf", "125")->basis_count() == 125);
  CHECK(make_method("wiener")->basis_count() == 3);
  CHECK(make_method("wiener", "7")->basis_count() == 7);
  for (const Named& named : all_methods) {
    const auto method = make_method(named.name, named.arguments);
    CHECK(method->basis_count() <= ReconstructionMethod::max_basis);
    CHECK((method->reach() >= 16 && method->reach() <= 24));
    bool any = false;
    for (int k = 0; k < method->basis_count(); ++k)
      any = any || 2 * method->degree(k) <= method->max_degree();
    CHECK(any);
  }
}

TEST_CASE("other arguments are refused by name", "[method]") {
  for (const char* arguments : {"4", "1", "127", "-3", "five", "5x", " 5", "3.0", "99999999999"}) {
    INFO(arguments);
    CHECK_THROWS_WITH(make_method("maaf", arguments),
                      Catch::Contains(std::string("maaf:") + arguments) &&
                          Catch::Contains("odd number of components from 3 to 125"));
  }
  CHECK_THROWS_WITH(make_method("wiener", "9"),
                    Catch::Contains("wiener:9") && Catch::Contains("from 1 to 7"));
  CHECK_THROWS_AS(make_method("wiener", "2"), Error);
  CHECK_THROWS_WITH(make_method("aaf", "5"),
                    Catch::Contains("aaf:5") && Catch::Contains("no arguments"));
  CHECK_THROWS_AS(make_method("fsf", "x"), Error);
}

TEST_CASE("bounces are filtered with one component by wiener, as all else by others", "[method]") {
  for (const Named& named : all_methods) {
    CAPTURE(named.name, named.arguments);
    const auto method = make_method(named.name, named.arguments);
    const ReconstructionMethod& bounces = method->for_bounces();
    CHECK(bounces.reach() <= method->reach());
    if (named.name != std::string("wiener")) {
      CHECK(&bounces == method.get());
      continue;
    }
    REQUIRE(bounces.basis_count() == 1);
    CHECK(bounces.guarded());
    float value = 0;
    bounces.basis({0.7f, {1, 2}, 0.3f, {}}, &value);
    CHECK(value == 1.0f);
    for (const AxisWedge& wedge : extreme_wedges) {
      double sum = 0;
      for (const float w : weights_of(bounces, wedge, 4)) sum += double(w);
      CHECK(sum == Approx(1.0).margin(1e-5));
    }
    CHECK(weights_of(bounces, {2, 9}, 4) == weights_of(*make_method("wiener", "1"), {2, 9}, 4));
  }
}

TEST_CASE("weights of any wedge are finite, bounded and keep a constant", "[method]") {
  for (const Named& named : all_methods) {
    const auto method = make_method(named.name, named.arguments);
    const std::vector<double> means = basis_means(*method);
    for (const AxisWedge& wedge : extreme_wedges) {
      for (float samples : {0.0f, 1.0f, 1.5f, 16.0f, 65536.0f, 1e30f, nan_value}) {
        INFO(named.name << ":" << named.arguments << " " << wedge.low << " " << wedge.high << " "
                        << samples);
        const std::vector<float> weights = weights_of(*method, wedge, samples);
        float largest = 0.0f;
        bool finite = true;
        for (float w : weights) {
          finite = finite && std::isfinite(w);
          largest = std::max(largest, std::abs(w));
        }
        REQUIRE(finite);
        CHECK(largest < 8.0f);
        CHECK(response_to_one(weights, means) == Approx(1.0).margin(2e-4));
      }
    }
  }
}

TEST_CASE("a mirrored wedge has mirrored weights", "[method]") {
  for (const Named& named : all_methods) {
    const auto method = make_method(named.name, named.arguments);
    const int count = method->basis_count(), reach = method->reach(), row = 2 * reach + 1;
    for (const AxisWedge& wedge :
         {AxisWedge{1, 2}, {3, 17}, {-2, 9}, {0, 5}, {-6, 6}, {40, 90}, {0.1f, 0.3f}}) {
      for (float samples : {1.0f, 23.0f}) {
        const auto a = weights_of(*method, wedge, samples);
        const auto b = weights_of(*method, {-wedge.high, -wedge.low}, samples);
        for (int k = 0; k < count; ++k) {
          for (int dx = -reach; dx <= reach; ++dx) {
            INFO(named.name << ":" << named.arguments << " " << wedge.low << " " << wedge.high
                            << " k " << k << " dx " << dx);
            CHECK(a[size_t(k * row + reach + dx)] ==
                  Approx(b[size_t(k * row + reach - dx)]).margin(1e-6));
          }
        }
      }
    }
  }
}

TEST_CASE("a mirrored wedge filters a mirrored scene alike", "[method]") {
  // f(x, y) = g(x + d y): with -d and -y nothing has changed, so that the filter's function over
  // (dx, y) is mirrored in y.
  for (const Named& named : all_methods) {
    const auto method = make_method(named.name, named.arguments);
    const int count = method->basis_count(), row = 2 * method->reach() + 1;
    const auto a = weights_of(*method, {3, 8}, 8.0f), b = weights_of(*method, {-8, -3}, 8.0f);
    std::vector<float> ahead(size_t(count), 0.0f), behind(size_t(count), 0.0f);
    for (float y : {-0.9f, -0.31f, 0.0f, 0.5f, 1.0f}) {
      BasisPoint at;
      at.y = y;
      at.wedge = {3, 8};
      method->basis(at, ahead.data());
      at.y = -y;
      at.wedge = {-8, -3};
      method->basis(at, behind.data());
      for (int i = 0; i < row; ++i) {
        double one = 0.0, other = 0.0;
        for (int k = 0; k < count; ++k) {
          one += a[size_t(k * row + i)] * ahead[size_t(k)];
          other += b[size_t(k * row + i)] * behind[size_t(k)];
        }
        INFO(named.name << ":" << named.arguments << " y " << y << " i " << i);
        CHECK(one == Approx(other).margin(1e-6));
      }
    }
  }
}

TEST_CASE("a wedge without shift leaves the pixel alone", "[method]") {
  for (const Named& named : all_methods) {
    const auto method = make_method(named.name, named.arguments);
    const auto weights = weights_of(*method, {0, 0}, 65536.0f);
    const int count = method->basis_count(), reach = method->reach(), row = 2 * reach + 1;
    double elsewhere = 0.0;
    for (int i = 0; i < count * row; ++i)
      if (i % row != reach) elsewhere += std::abs(weights[size_t(i)]);
    INFO(named.name << ":" << named.arguments);
    CHECK(elsewhere < 1e-3);
  }
}

TEST_CASE("weights follow wedges without jumps", "[method]") {
  // The steepest part is where a filter one pixel wide turns into the pixel alone.
  for (const Named& named : {Named{"aaf", ""}, Named{"wiener", ""}, Named{"wiener", "5"}}) {
    const auto method = make_method(named.name, named.arguments);
    double worst = 0.0;
    const auto follow = [&](const auto& wedge_at, const auto& samples_at) {
      std::vector<float> last = weights_of(*method, wedge_at(0.0f), samples_at(0.0f));
      for (int i = 1; i <= 4000; ++i) {
        const float s = float(i) / 4000.0f;
        const std::vector<float> now = weights_of(*method, wedge_at(s), samples_at(s));
        for (size_t k = 0; k < now.size(); ++k)
          worst = std::max(worst, double(std::abs(now[k] - last[k])));
        last = now;
      }
    };
    const auto eight = [](float) { return 8.0f; };
    for (float ratio : {-0.95f, -0.3f, 0.0f, 0.4f, 0.93f, 1.0f}) {
      follow([&](float s) { return AxisWedge{ratio * 40.0f * s, 40.0f * s}; }, eight);
    }
    for (float high : {0.3f, 3.0f, 29.0f, 70.0f}) {
      follow([&](float s) { return AxisWedge{high * (2 * s - 1), high}; }, eight);
      follow([&](float s) { return AxisWedge{-high, high * (2 * s - 1)}; }, eight);
      follow(
          [&](float) {
            return AxisWedge{0.5f * high, high};
          },
          [](float s) { return std::exp2(16.0f * s); });
    }
    INFO(named.name << ":" << named.arguments);
    CHECK(worst > 0.0);
    CHECK(worst < 0.02);
  }
}

TEST_CASE("MAAF's functions are finite with any second effect", "[method]") {
  const auto method = make_method("maaf", "7");
  std::vector<float> values(7);
  for (const AxisWedge& first : extreme_wedges) {
    for (const AxisWedge& second : extreme_wedges) {
      BasisPoint at;
      at.y = 0.7f;
      at.second_y = -0.4f;
      at.wedge = first;
      at.second_wedge = second;
      method->basis(at, values.data());
      INFO(first.low << " " << first.high << " / " << second.low << " " << second.high);
      // Over u the narrowest window, of deviation 1/4, has mean 1: it is 3.2 high.
      for (float value : values) CHECK((std::isfinite(value) && std::abs(value) <= 3.2f));
    }
  }
}

TEST_CASE("Legendre polynomials agree with their closed forms", "[method]") {
  for (double y : {-1.0, -0.6, 0.0, 0.25, 1.0}) {
    double p[5];
    legendre(y, 5, p);
    CHECK(p[0] == 1.0);
    CHECK(p[1] == y);
    CHECK(p[2] == Approx((3 * y * y - 1) / 2).margin(1e-15));
    CHECK(p[3] == Approx((5 * y * y * y - 3 * y) / 2).margin(1e-15));
    CHECK(p[4] == Approx((35 * std::pow(y, 4) - 30 * y * y + 3) / 8).margin(1e-15));
  }
}
