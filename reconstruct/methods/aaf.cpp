/// Axis-aligned filtering (S. Mehta et al., "Axis-aligned filtering for interactive sampled soft
/// shadows", 2012; L. Wu et al., "Multiple axis-aligned filters for rendering of combined
/// distribution effects", EGSR 2017, equations 2 and 3): one Gaussian over the image.

#include "reconstruct/axis_window.h"
#include "reconstruct/light_band.h"
#include "reconstruct/method_arguments.h"
#include "reconstruct/wedge.h"

namespace tessera {
namespace {

class AxisAligned : public ReconstructionMethod {
 public:
  int basis_count() const override { return 1; }
  void basis(const BasisPoint&, float* out) const override { out[0] = 1.0f; }
  int degree(int) const override { return 0; }
  int max_degree() const override { return 0; }
  int reach() const override { return 24; }

  /// Along x the spectrum ends at W / s_min: its Gaussian has deviation s_min / W in the image, and
  /// is no wider than the reach can hold.
  void weights(const AxisWedge& wedge, float, float* out) const override {
    const AxisWedge bounded = bounded_wedge(wedge, float(light_band * reach() / 3.0));
    const AxisGaussian gaussian(smallest_shift(bounded) / light_band, reach());
    double sum = 0.0;
    for (int dx = -reach(); dx <= reach(); ++dx) sum += gaussian(dx);
    for (int dx = -reach(); dx <= reach(); ++dx) out[reach() + dx] = float(gaussian(dx) / sum);
  }
};

std::unique_ptr<ReconstructionMethod> make(std::string_view arguments) {
  check_no_arguments("aaf", arguments);
  return std::make_unique<AxisAligned>();
}

}  // namespace

ReconstructionMethodDefinition reconstruction_method_aaf() {
  return {"aaf", "one Gaussian a pixel, as wide as the nearest blocker's shift allows", make};
}

}  // namespace tessera
