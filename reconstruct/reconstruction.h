#pragma once
/// What the stage says of a given method and of a given list of them.

#include <memory>
#include <span>
#include <string_view>

#include "reconstruct/method.h"
#include "reconstruct/reconstruct.h"

namespace tessera {

/// As reconstruction_reach(std::string_view).
int reconstruction_reach(const ReconstructionMethod& method);

/// The method that "name" or "name:arguments" asks for; null for "filter". Throws Error that lists
/// the choices when unknown.
std::unique_ptr<ReconstructionMethod> make_method(
    std::string_view spec, std::span<const ReconstructionMethodDefinition> methods);

}  // namespace tessera
