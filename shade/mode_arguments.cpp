#include "shade/mode_arguments.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "base/error.h"

namespace tessera {
namespace {

void read_one(const char* mode, std::string_view argument,
              std::initializer_list<ModeArgument> known) {
  const size_t equals = std::min(argument.find('='), argument.size());
  const std::string_view key = argument.substr(0, equals);
  std::string keys;
  for (const ModeArgument& k : known) {
    keys += fmt::format("{}{}=NUMBER", keys.empty() ? "" : ", ", k.key);
    if (key != k.key) continue;
    const std::string_view text = argument.substr(std::min(equals + 1, argument.size()));
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value > k.above) ||
        !(value < k.below)) {
      throw Error(
          fmt::format("shading mode \"{}\": {} ({}): expected a number above {} and below "
                      "{}, found \"{}\"",
                      mode, k.key, k.what, k.above, k.below, text));
    }
    *k.value = value;
    return;
  }
  throw Error(fmt::format("shading mode \"{}\": unknown argument \"{}\"; expected {}", mode,
                          argument, keys.empty() ? "none" : keys));
}

}  // namespace

void read_mode_arguments(const char* mode, std::string_view arguments,
                         std::initializer_list<ModeArgument> known) {
  while (!arguments.empty()) {
    const size_t comma = std::min(arguments.find(','), arguments.size());
    read_one(mode, arguments.substr(0, comma), known);
    arguments.remove_prefix(std::min(comma + 1, arguments.size()));
  }
}

}  // namespace tessera
