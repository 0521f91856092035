#pragma once
/// The stage with a given method, for methods that no registry lists.

#include <memory>
#include <span>
#include <string_view>

#include "reconstruct/method.h"
#include "reconstruct/reconstruct.h"

namespace tessera {

/// As make_reconstruction() with `method` in place of settings.method; null: the film alone.
std::unique_ptr<Reconstruction> make_reconstruction(const ReconstructionSettings& settings,
                                                    std::unique_ptr<ReconstructionMethod> method);

/// As reconstruction_reach(std::string_view).
int reconstruction_reach(const ReconstructionMethod& method);

/// The method that "name" or "name:arguments" asks for; null for "filter". Throws Error that lists
/// the choices when unknown.
std::unique_ptr<ReconstructionMethod> make_method(
    std::string_view spec, std::span<const ReconstructionMethodDefinition> methods);

}  // namespace tessera
