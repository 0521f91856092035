#include "reconstruct/reconstruction.h"

// Apart from the rest, so that nothing else depends on which methods there are.

namespace tessera {

std::shared_ptr<const ReconstructionMethod> make_reconstruction_method(std::string_view spec) {
  return make_method(spec, reconstruction_method_registry());
}

int reconstruction_reach(std::string_view spec) {
  const auto method = make_reconstruction_method(spec);
  return method ? reconstruction_reach(*method) : 0;
}

}  // namespace tessera
