#pragma once
/// The method wiener where there is one image axis only, for flatland.

#include "reconstruct/legendre.h"
#include "reconstruct/wiener_table.h"

namespace tessera {

class OneAxisWiener : public ReconstructionMethod {
 public:
  explicit OneAxisWiener(int components) : components_(components), table_(components, 1) {}
  int basis_count() const override { return components_; }
  void basis(const BasisPoint& at, float* out) const override { legendre(at.y, components_, out); }
  int degree(int k) const override { return k; }
  int max_degree() const override { return 2 * components_; }
  int reach() const override { return WienerTable::reach; }
  void weights(const AxisWedge& wedge, float samples, float* out) const override {
    table_.weights(wedge, samples, out);
  }

 private:
  int components_;
  WienerTable table_;
};

}  // namespace tessera
