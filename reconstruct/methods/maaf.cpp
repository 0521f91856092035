/// Multiple axis-aligned filters (L. Wu et al., "Multiple axis-aligned filters for rendering of
/// combined distribution effects", EGSR 2017): the wedge as a sum of Gaussians in frequency space,
/// each pair of which is two products of a function over the image and one over y (equations 9 to
/// 13 and 19 to 23), as printed but for the corrections that docs/reconstruction.md lists.

#include <cmath>
#include <numbers>
#include <vector>

#include "reconstruct/axis_window.h"
#include "reconstruct/light_band.h"
#include "reconstruct/maaf_components.h"
#include "reconstruct/method_arguments.h"
#include "reconstruct/quadrature.h"
#include "reconstruct/wedge.h"

namespace tessera {
namespace {

/// Slopes in the formulas, pixels.
constexpr double least_slope = 1e-3;
constexpr float greatest_slope = 1e4f;

struct Slopes {
  double least, greatest;
  bool mirrored;
  explicit Slopes(const AxisWedge& wedge) {
    const TurnedWedge turned = turned_wedge(bounded_wedge(wedge, greatest_slope));
    least = std::max(0.0, turned.low);
    greatest = turned.high;
    mirrored = turned.mirrored;
  }
};

/// The spectrum of light spread evenly over [-1, 1].
double light_spectrum(double frequency) {
  return frequency == 0.0 ? 1.0 : std::sin(frequency) / frequency;
}

/// exp(-(deviation y)^2 / 2): a Gaussian in frequency, seen in the primal domain with height 1.
double primal(double deviation, double y) {
  return std::exp(-0.5 * (deviation * y) * (deviation * y));
}

/// Its mean over [-1, 1].
double mean_of_primal(double deviation) {
  if (deviation < 1e-3) return 1.0;
  constexpr double half = std::numbers::sqrt2 / 2;
  return std::sqrt(std::numbers::pi) * half / deviation * std::erf(half * deviation);
}

/// A component's factor of the second effect at u, without the phase. The Gaussian has height 1 in
/// frequency, as those over x have: its mean over u is 1 whatever its width, so that slopes, which
/// are known only where rays met something, do not make such samples count for more or less. The
/// weight is the spectrum of even light at the centre, as it is along y.
double second_window(const Band& along_u, double u) {
  if (along_u.centre == 0.0 && along_u.deviation == 0.0) return 1.0;
  return light_spectrum(along_u.centre) * primal(along_u.deviation, u) /
         mean_of_primal(along_u.deviation);
}

class MultipleAxisAligned : public ReconstructionMethod {
 public:
  explicit MultipleAxisAligned(int count) : count_(count), shares_(size_t(count)) {
    for (int k = 0; k < count; ++k) {
      shares_[size_t(k)] = 0.5 * gauss_integral(-1.0, 1.0, count, [&](double y) {
                             std::vector<float> values(static_cast<size_t>(count));
                             BasisPoint at;
                             at.y = float(y);
                             basis(at, values.data());
                             return double(values[size_t(k)]);
                           });
    }
  }

  /// Functions 2 p - 1 and 2 p are the cosine and the sine of component p.
  int basis_count() const override { return count_; }
  int degree(int) const override { return 0; }
  int max_degree() const override { return 0; }
  int reach() const override { return 24; }

  void basis(const BasisPoint& at, float* out) const override {
    const Slopes first(at.wedge), second(at.second_wedge);
    const double s_min = std::max(first.least, least_slope);
    const double s_max = std::max(first.greatest, least_slope);
    // A first effect without shifts, or whose shifts nobody saw, says nothing of the second's
    // frequencies: all u count alike.
    const bool has_second = first.greatest >= least_slope;
    const double u = first.mirrored == second.mirrored ? at.second_y : -at.second_y;
    for (int p = 0; 2 * p < count_; ++p) {
      const MaafComponent component = component_of(p);
      const Band along_y = component.along_y();
      const Band along_u =
          has_second ? component.along_u(s_min, s_max, second.least, second.greatest) : Band{};
      const double window = primal(along_y.deviation, at.y) * second_window(along_u, u);
      const double phase = along_y.centre * at.y + along_u.centre * u;
      out[p == 0 ? 0 : 2 * p - 1] = float(window * std::cos(phase));
      if (p > 0) out[2 * p] = float(window * std::sin(phase));
    }
  }

  void weights(const AxisWedge& wedge, float, float* out) const override {
    const Slopes slopes(wedge);
    const int row = 2 * reach() + 1;
    double sum = 0.0;
    for (int p = 0; 2 * p < count_; ++p) {
      const MaafComponent component = component_of(p);
      const double weight = (p == 0 ? 1.0 : 2.0) * light_spectrum(component.along_y().centre);
      const Band along_x = component.along_x(std::max(slopes.least, least_slope),
                                             std::max(slopes.greatest, least_slope));
      float* cosines = out + (p == 0 ? 0 : 2 * p - 1) * row;
      float* sines = p == 0 ? nullptr : cosines + row;
      const double cosine_sum = write_component(along_x, weight, slopes.mirrored, cosines, sines);
      sum += cosine_sum * shares_[size_t(p == 0 ? 0 : 2 * p - 1)];
    }
    for (int i = 0; i < count_ * row; ++i) out[i] = float(out[i] / sum);
  }

 private:
  MaafComponent component_of(int p) const { return {p, count_, light_band}; }

  /// Equation 21: the Gaussian over the image with its cosine, and less its sine. Returns the sum
  /// of the cosines. Seen through y -> -y the sines change sign.
  double write_component(const Band& along_x, double weight, bool mirrored, float* cosines,
                         float* sines) const {
    const AxisGaussian gaussian(std::min(1.0 / along_x.deviation, reach() / 3.0), reach());
    double gaussian_sum = 0.0, cosine_sum = 0.0;
    for (int dx = 0; dx <= reach(); ++dx) {
      const double height = weight * gaussian(dx), phase = along_x.centre * dx;
      const double cosine = height * std::cos(phase), sine = height * std::sin(phase);
      cosines[reach() - dx] = cosines[reach() + dx] = float(cosine);
      if (sines) {
        sines[reach() - dx] = float(mirrored ? -sine : sine);
        sines[reach() + dx] = float(mirrored ? sine : -sine);
      }
      gaussian_sum += (dx > 0 ? 2.0 : 1.0) * gaussian(dx);
      cosine_sum += (dx > 0 ? 2.0 : 1.0) * cosine;
    }
    const float scale = float(1.0 / gaussian_sum);
    for (int i = 0; i <= 2 * reach(); ++i) {
      cosines[i] *= scale;
      if (sines) sines[i] *= scale;
    }
    return cosine_sum / gaussian_sum;
  }

  int count_;
  /// Means of the functions over y without a second effect; that of the central one is the same
  /// with any.
  std::vector<double> shares_;
};

std::unique_ptr<ReconstructionMethod> make(std::string_view arguments) {
  return std::make_unique<MultipleAxisAligned>(odd_components("maaf", arguments, 3, 125, 5));
}

}  // namespace

ReconstructionMethodDefinition reconstruction_method_maaf() {
  return {"maaf", "the wedge as a sum of Gaussians; maaf:COMPONENTS, odd, 3 to 125, 5 if not given",
          make};
}

}  // namespace tessera
