#include "reconstruct/reconstruction.h"

// Apart from the rest, so that nothing else depends on which methods there are.

namespace tessera {

std::unique_ptr<Reconstruction> make_reconstruction(const ReconstructionSettings& settings) {
  return make_reconstruction(settings,
                             make_method(settings.method, reconstruction_method_registry()));
}

int reconstruction_reach(std::string_view spec) {
  const auto method = make_method(spec, reconstruction_method_registry());
  return method ? reconstruction_reach(*method) : 0;
}

}  // namespace tessera
