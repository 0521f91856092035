/// The method wiener over two image axes: how many samples an axis should count on.

#include <catch2/catch.hpp>

#include "tests/reconstruct/flatland.h"

using namespace tessera;
using flatland::make_method;

namespace {

/// A rectangle that blocks (y0, y1) at (x0, x1) where x + shift * y lies in it, along both axes.
struct Plate {
  double shift, first[2], last[2];
};

constexpr int size = 24;  ///< pixels of the image, each way

class PlateScene {
 public:
  PlateScene(const AxisWedge& wedge, uint32_t seed) : random_(seed) {
    const double margin = std::max(std::abs(wedge.low), std::abs(wedge.high)) + 24.0;
    const double side = size + 2 * margin;
    for (int i = 0, count = int(side * side / 500); i < count; ++i) {
      Plate plate{between(wedge.low, wedge.high), {}, {}};
      for (int axis = 0; axis < 2; ++axis) {
        plate.first[axis] = between(-margin, size + margin);
        plate.last[axis] = plate.first[axis] + between(4, 24);
      }
      plates_.push_back(plate);
    }
  }

  double between(double low, double high) {
    return low + (high - low) * (random_() + 0.5) / 4294967296.0;
  }

  double visible(double x0, double x1, double y0, double y1) const {
    for (const Plate& p : plates_) {
      const double a = x0 + p.shift * y0, b = x1 + p.shift * y1;
      if (a >= p.first[0] && a <= p.last[0] && b >= p.first[1] && b <= p.last[1]) return 0.0;
    }
    return 1.0;
  }

  /// By a stratified sum over y.
  double pixel(int x0, int x1) {
    constexpr int steps = 24;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j)
        sum += visible(x0 + between(-0.5, 0.5), x1 + between(-0.5, 0.5),
                       (i + between(0, 1)) / steps * 2 - 1, (j + between(0, 1)) / steps * 2 - 1);
    return sum / (steps * steps);
  }

 private:
  std::mt19937 random_;
  std::vector<Plate> plates_;
};

/// Moments [x1][x0][j][k] of what is seen and of 1, over the image and a margin around it.
struct PlateMoments {
  int margin, components;
  std::vector<double> seen, one;
  size_t at(int x0, int x1) const {
    return size_t(((x1 + margin) * (size + 2 * margin) + x0 + margin) * components * components);
  }
};

PlateMoments take_moments(PlateScene& scene, const ReconstructionMethod& method, int samples) {
  const int count = method.basis_count(), margin = method.reach(), side = size + 2 * margin;
  PlateMoments moments{margin, count, std::vector<double>(size_t(side * side * count * count)), {}};
  moments.one = moments.seen;
  std::vector<float> basis[2] = {std::vector<float>(size_t(count)),
                                 std::vector<float>(size_t(count))};
  for (int x1 = -margin; x1 < size + margin; ++x1) {
    for (int x0 = -margin; x0 < size + margin; ++x0) {
      for (int s = 0; s < samples; ++s) {
        BasisPoint points[2];
        for (int axis = 0; axis < 2; ++axis) {
          points[axis].y = float(scene.between(-1, 1));
          method.basis(points[axis], basis[axis].data());
        }
        const double f = scene.visible(x0 + scene.between(-0.5, 0.5), x1 + scene.between(-0.5, 0.5),
                                       points[0].y, points[1].y);
        size_t n = moments.at(x0, x1);
        for (int j = 0; j < count; ++j) {
          for (int k = 0; k < count; ++k, ++n) {
            const double b = double(basis[0][size_t(j)]) * basis[1][size_t(k)] / samples;
            moments.seen[n] += b * f;
            moments.one[n] += b;
          }
        }
      }
    }
  }
  return moments;
}

/// One pixel of the product of two filters, over pairs of functions within the total degree.
double filtered(const PlateMoments& moments, const ReconstructionMethod& method,
                const std::vector<float>& weights, int x0, int x1) {
  const int reach = method.reach(), row = 2 * reach + 1, count = method.basis_count();
  double sum = 0.0, one = 0.0;
  for (int d1 = -reach; d1 <= reach; ++d1) {
    for (int d0 = -reach; d0 <= reach; ++d0) {
      size_t n = moments.at(x0 + d0, x1 + d1);
      for (int j = 0; j < count; ++j) {
        for (int k = 0; k < count; ++k, ++n) {
          if (method.degree(j) + method.degree(k) > method.max_degree()) continue;
          const double a =
              double(weights[size_t(j * row + reach + d0)]) * weights[size_t(k * row + reach + d1)];
          sum += a * moments.seen[n];
          one += a * moments.one[n];
        }
      }
    }
  }
  return sum / one;
}

}  // namespace

TEST_CASE("over two axes wiener counts on the right number of samples", "[method][planes]") {
  const auto method = make_method("wiener");
  // Products over the cases of the mean square errors when told of an eighth of the samples, of all
  // and of eight times as many.
  double products[3] = {1, 1, 1};
  constexpr int samples = 8;
  for (const AxisWedge& wedge : {AxisWedge{1, 3}, {4, 8}, {-4, 4}}) {
    double bare = 0.0, errors[3] = {};
    PlateScene scene(wedge, 5);
    const PlateMoments moments = take_moments(scene, *method, samples);
    std::vector<double> exact;
    for (int i = 0; i < size * size; ++i) exact.push_back(scene.pixel(i % size, i / size));
    for (int choice = 0; choice < 3; ++choice) {
      std::vector<float> weights(size_t(method->basis_count() * (2 * method->reach() + 1)));
      method->weights(wedge, float(samples * std::pow(8.0, choice - 1)), weights.data());
      for (int i = 0; i < size * size; ++i) {
        const double error =
            filtered(moments, *method, weights, i % size, i / size) - exact[size_t(i)];
        errors[choice] += error * error;
      }
      products[choice] *= errors[choice];
    }
    for (int i = 0; i < size * size; ++i) {
      const double error = moments.seen[moments.at(i % size, i / size)] - exact[size_t(i)];
      bare += error * error;
    }
    INFO(wedge.low << " " << wedge.high << ", " << samples << " samples, errors " << bare << " "
                   << errors[0] << " " << errors[1] << " " << errors[2]);
    CHECK(errors[1] < 0.5 * bare);
    // One image of 576 pixels tells a case to a quarter or so.
    CHECK(errors[1] < 1.25 * errors[0]);
    CHECK(errors[1] < 1.25 * errors[2]);
  }
  CHECK(products[1] < 0.5 * products[0]);
  CHECK(products[1] < 0.5 * products[2]);
}
