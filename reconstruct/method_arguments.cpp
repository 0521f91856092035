#include "reconstruct/method_arguments.h"

#include <charconv>

#include <fmt/format.h>

#include "base/error.h"

namespace tessera {

void check_no_arguments(std::string_view method, std::string_view arguments) {
  if (!arguments.empty())
    throw Error(fmt::format("reconstruction '{}:{}': expected no arguments", method, arguments));
}

int odd_components(std::string_view method, std::string_view arguments, int low, int high,
                   int otherwise) {
  if (arguments.empty()) return otherwise;
  int count = 0;
  const char* end = arguments.data() + arguments.size();
  const auto [stop, error] = std::from_chars(arguments.data(), end, count);
  if (error != std::errc() || stop != end || count < low || count > high || count % 2 == 0)
    throw Error(
        fmt::format("reconstruction '{}:{}': expected an odd number of components from {} to {}",
                    method, arguments, low, high));
  return count;
}

}  // namespace tessera
