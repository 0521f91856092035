#include "hide/hide.h"

#include "base/error.h"

namespace tessera {

void FragmentList::clear() {
  sample.clear(), grid.clear(), triangle.clear();
  b1.clear(), b2.clear(), z.clear(), weight.clear();
  first_of_sample.clear();
}

std::unique_ptr<Hider> make_hider(std::string_view spec) {
  const size_t colon = spec.find(':');
  const std::string_view name = spec.substr(0, colon);
  const std::string_view arguments =
      colon == std::string_view::npos ? std::string_view() : spec.substr(colon + 1);
  std::string choices;
  for (const HiderDefinition& definition : hider_registry()) {
    if (name == definition.name) return definition.make(arguments);
    choices += (choices.empty() ? "" : ", ") + std::string(definition.name);
  }
  throw Error(fmt::format("hider \"{}\" is unknown; expected one of {}", name, choices));
}

}  // namespace tessera
