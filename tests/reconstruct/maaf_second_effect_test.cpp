/// MAAF where a lens is open too: what a ray met must not decide what its sample counts for.

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "tests/reconstruct/flatland.h"

using namespace tessera;
using flatland::make_method;

namespace {

class Random {
 public:
  double operator()(double low, double high) {
    return low + (high - low) * (bits_() + 0.5) / 4294967296.0;
  }

 private:
  std::mt19937 bits_{11};
};

/// Pixels in a row, each with one sample that meets something with probability `share`, wherever it
/// is. Only those that do know their slope. What the filter of `wedge` makes of that share.
struct FilteredRow {
  double mean = 0;           ///< over pixels of the filtered share
  double least_divisor = 0;  ///< least filtered sum over f = 1
};
FilteredRow filter_row(const ReconstructionMethod& method, const AxisWedge& wedge,
                       const AxisWedge& lens, double share) {
  constexpr int pixels = 4000;
  const int reach = method.reach(), row = 2 * reach + 1, count = method.basis_count();
  Random random;
  std::vector<float> functions(size_t((pixels + 2 * reach) * count));
  std::vector<float> met(size_t(pixels + 2 * reach));
  for (size_t x = 0; x < met.size(); ++x) {
    met[x] = random(0, 1) < share;
    BasisPoint at;
    at.y = float(random(-1, 1)), at.second_y = float(random(-1, 1));
    at.second_wedge = lens;
    const float slope = float(random(wedge.low, wedge.high));
    if (met[x] > 0) at.wedge = {slope, slope};
    method.basis(at, &functions[x * size_t(count)]);
  }
  std::vector<float> weights(size_t(count * row));
  method.weights(wedge, 1, weights.data());
  FilteredRow out{0, 1e30};
  for (int x = 0; x < pixels; ++x) {
    double sum = 0, one = 0;
    for (int i = 0; i < row; ++i)
      for (int k = 0; k < count; ++k) {
        const double w =
            double(weights[size_t(k * row + i)]) * functions[size_t((x + i) * count + k)];
        one += w, sum += w * met[size_t(x + i)];
      }
    out.mean += sum / one / pixels;
    out.least_divisor = std::min(out.least_divisor, one);
  }
  return out;
}

}  // namespace

TEST_CASE("samples count alike whether their rays met anything or not", "[method][second]") {
  for (const char* components : {"3", "5", "7"}) {
    const auto method = make_method("maaf", components);
    for (const AxisWedge& wedge : {AxisWedge{6, 9}, {12, 30}, {-9, -6}}) {
      for (const AxisWedge& lens : {AxisWedge{0, 0}, {1, 2}, {4, 6}, {-3, -2}, {-1, 2}}) {
        const FilteredRow row = filter_row(*method, wedge, lens, 0.3);
        INFO(components << " " << wedge.low << " " << wedge.high << ", lens " << lens.low << " "
                        << lens.high << ", least divisor " << row.least_divisor);
        // 4000 pixels that share samples tell the share to a hundredth. With a lens nearly as
        // strong as the light, the outer components weigh pixels a little less whose slopes are
        // known.
        CHECK(row.mean == Approx(0.3).margin(0.03));
      }
    }
  }
}

TEST_CASE("maaf's central function has the same mean whatever the second effect",
          "[method][second]") {
  const auto method = make_method("maaf");
  const auto mean_of = [&](const AxisWedge& wedge, const AxisWedge& lens) {
    constexpr int steps = 400;
    double sum = 0;
    std::vector<float> values(5);
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        BasisPoint at;
        at.y = float((2.0 * i + 1) / steps - 1), at.second_y = float((2.0 * j + 1) / steps - 1);
        at.wedge = wedge, at.second_wedge = lens;
        method->basis(at, values.data());
        sum += double(values[0]) / (steps * steps);
      }
    return sum;
  };
  const double alone = mean_of({4, 8}, {0, 0});
  for (const AxisWedge& wedge : {AxisWedge{0, 0}, {0, 5}, {4, 8}, {-8, 3}, {1e7f, 1e30f}})
    for (const AxisWedge& lens : {AxisWedge{1, 2}, {20, 30}, {-6, 1}, {1e-30f, 1e30f}})
      CHECK(mean_of(wedge, lens) == Approx(alone).epsilon(1e-4));
}
