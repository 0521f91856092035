/// Sheared filtering (L.-Q. Yan et al., "Fast 4D sheared filtering for interactive rendering of
/// distribution effects", 2015; L. Wu et al., "Multiple axis-aligned filters for rendering of
/// combined distribution effects", EGSR 2017, equations 4 and 5): a Gaussian sheared along the
/// wedge, as sums over the image of Legendre polynomials of y.

#include <array>
#include <numeric>

#include "reconstruct/axis_window.h"
#include "reconstruct/legendre.h"
#include "reconstruct/light_band.h"
#include "reconstruct/method_arguments.h"
#include "reconstruct/quadrature.h"
#include "reconstruct/wedge.h"

namespace tessera {
namespace {

constexpr int components = 9;

/// The filter g(dx; beta_x) g(y + dx eta; beta_y): with f(x, y) = g(x + d y), what a pixel dx away
/// sees at y is what pixel 0 sees at y + dx / d.
struct ShearedGaussian {
  double beta_x, eta;
  /// As even over the light as a Gaussian that ends with it can be without losing the shear: of the
  /// deviations tried it errs least (docs/reconstruction.md).
  static constexpr double beta_y = 1.0;

  /// The spectrum sheared upright lies within W (1 / s_min - 1 / s_max) / 2 of the axis: half the
  /// width that equation 4 prints, which is that of the whole parallelogram. `wedge`: low > 0. eta
  /// is 1 / s_avg, the mean of the inverse slopes.
  explicit ShearedGaussian(const TurnedWedge& wedge) {
    const double near = 1.0 / wedge.low, far = 1.0 / wedge.high;
    beta_x = 1.0 / std::max(0.5 * light_band * (near - far), 1e-6);
    eta = 0.5 * (near + far);
  }
};

class Sheared : public ReconstructionMethod {
 public:
  int basis_count() const override { return components; }
  void basis(const BasisPoint& at, float* out) const override { legendre(at.y, components, out); }
  int degree(int k) const override { return k; }
  int max_degree() const override { return components - 1; }
  int reach() const override { return 24; }

  /// A wedge that holds 0 is a box, which no shear helps: the pixel alone, every y alike.
  void weights(const AxisWedge& wedge, float, float* out) const override {
    const TurnedWedge turned = turned_wedge(bounded_wedge(wedge, 1e4f));
    const int row = 2 * reach() + 1;
    std::fill(out, out + components * row, 0.0f);
    out[reach()] = 1.0f;
    if (turned.low < 1e-3) return;
    const ShearedGaussian filter(turned);
    const AxisGaussian gaussian(std::min(filter.beta_x, reach() / 3.0), reach());
    for (int dx = 0; dx <= reach(); ++dx) {
      const double height = gaussian(dx);
      if (height < 1e-5) break;
      const auto expansion = expand(dx * filter.eta);
      for (int k = 0; k < components; ++k) {
        const double turn = k % 2 ? -1.0 : 1.0;
        const double value = height * expansion[size_t(k)];
        float* middle = out + k * row + reach();
        middle[-dx] = float(turned.mirrored ? value : turn * value);
        middle[dx] = float(turned.mirrored ? turn * value : value);
      }
    }
    const float sum = std::accumulate(out, out + row, 0.0f);
    for (int i = 0; i < components * row; ++i) out[i] /= sum;
  }

 private:
  /// c[k] with sum of c[k] P_k(y) near g(y + offset; beta_y) over [-1, 1].
  static std::array<double, components> expand(double offset) {
    std::array<double, components> c{}, p{};
    for (size_t half = 0; half < 2; ++half) {
      for (size_t q = 0; q < gauss_points.size(); ++q) {
        const double y = 0.5 * gauss_points[q] + (half ? 0.5 : -0.5);
        const double r = (y + offset) / ShearedGaussian::beta_y;
        const double value = 0.5 * gauss_weights[q] * std::exp(-0.5 * r * r);
        legendre(y, components, p.data());
        for (int k = 0; k < components; ++k)
          c[size_t(k)] += 0.5 * (2 * k + 1) * value * p[size_t(k)];
      }
    }
    return c;
  }
};

std::unique_ptr<ReconstructionMethod> make(std::string_view arguments) {
  check_no_arguments("fsf", arguments);
  return std::make_unique<Sheared>();
}

}  // namespace

ReconstructionMethodDefinition reconstruction_method_fsf() {
  return {"fsf", "one Gaussian a pixel, sheared along the wedge of shifts", make};
}

}  // namespace tessera
