/// The best linear filter of the samples near a pixel, for the wedge and the number of samples, as
/// a sum of products of a function over the image and a polynomial over y: the form that MAAF has,
/// at the same cost. docs/reconstruction.md derives it.

#include "reconstruct/legendre.h"
#include "reconstruct/method_arguments.h"
#include "reconstruct/wiener_model.h"
#include "reconstruct/wiener_table.h"

namespace tessera {
namespace {

class Wiener : public ReconstructionMethod {
 public:
  explicit Wiener(int components) : components_(components), table_(components, 2) {
    if (components > 1) for_bounces_ = std::make_unique<Wiener>(1);
  }

  int basis_count() const override { return components_; }
  void basis(const BasisPoint& at, float* out) const override { legendre(at.y, components_, out); }
  int degree(int k) const override { return k; }
  int max_degree() const override { return components_ - 1; }
  int reach() const override { return WienerTable::reach; }
  bool guarded() const override { return true; }
  /// Light from all around varies slowly over directions, and not as edges do: what the further
  /// components add there is less than their noise (docs/reconstruction.md).
  const ReconstructionMethod& for_bounces() const override {
    return for_bounces_ ? *for_bounces_ : *this;
  }

  void weights(const AxisWedge& wedge, float samples, float* out) const override {
    table_.weights(wedge, samples, out);
  }

 private:
  int components_;
  std::unique_ptr<Wiener> for_bounces_;
  WienerTable table_;
};

std::unique_ptr<ReconstructionMethod> make(std::string_view arguments) {
  return std::make_unique<Wiener>(odd_components("wiener", arguments, 1, max_wiener_components, 3));
}

}  // namespace

ReconstructionMethodDefinition reconstruction_method_wiener() {
  return {"wiener",
          "the best linear filter for the shifts and samples of a pixel; wiener:COMPONENTS, odd, "
          "1 to 7, 3 if not given",
          make};
}

}  // namespace tessera
