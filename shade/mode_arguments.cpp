#include "shade/mode_arguments.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include "base/error.h"

namespace tessera {
namespace {

double read_number(const char* mode, const ModeArgument& known, std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > known.above) ||
      !(value <= known.at_most)) {
    throw Error(fmt::format(
        "shading mode \"{}\": {} ({}): expected a number above {} and at most {}, found \"{}\"",
        mode, known.key, known.what, known.above, known.at_most, text));
  }
  return value;
}

const ModeArgument& find(const char* mode, std::string_view argument, std::string_view key,
                         std::initializer_list<ModeArgument> known) {
  std::string keys;
  for (const ModeArgument& k : known) {
    if (key == k.key) return k;
    keys += fmt::format("{}{}=NUMBER", keys.empty() ? "" : ", ", k.key);
  }
  throw Error(fmt::format("shading mode \"{}\": unknown argument \"{}\"; expected {}", mode,
                          argument, keys.empty() ? "none" : keys));
}

}  // namespace

void read_mode_arguments(const char* mode, std::string_view arguments,
                         std::initializer_list<ModeArgument> known) {
  std::vector<const ModeArgument*> given;
  for (size_t first = 0; !arguments.empty() && first <= arguments.size();) {
    const std::string_view argument = arguments.substr(first, arguments.find(',', first) - first);
    first += argument.size() + 1;
    const size_t equals = std::min(argument.find('='), argument.size());
    const ModeArgument& k = find(mode, argument, argument.substr(0, equals), known);
    if (std::ranges::find(given, &k) != given.end())
      throw Error(fmt::format("shading mode \"{}\": {} is given more than once", mode, k.key));
    given.push_back(&k);
    *k.value = read_number(mode, k, argument.substr(std::min(equals + 1, argument.size())));
  }
}

}  // namespace tessera
