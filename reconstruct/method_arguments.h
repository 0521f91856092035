#pragma once
/// What follows the colon in `--reconstruct name:arguments`.

#include <string_view>

namespace tessera {

/// Throws Error if there are any.
void check_no_arguments(std::string_view method, std::string_view arguments);

/// An odd number in [low, high], `otherwise` if there is none. Throws Error for anything else.
int odd_components(std::string_view method, std::string_view arguments, int low, int high,
                   int otherwise);

}  // namespace tessera
