#pragma once
/// Look-ups in tables whose entries have a `name`.

#include <string>
#include <string_view>

#include "base/error.h"

namespace tessera {

/// The entry of `table` called `name`. Throws Error that says what `kind` of thing is unknown and
/// lists the choices.
template <class Table>
const auto& find_named(const Table& table, std::string_view kind, std::string_view name) {
  std::string choices;
  for (const auto& entry : table) {
    if (name == entry.name) return entry;
    choices += fmt::format("{}{}", choices.empty() ? "" : ", ", entry.name);
  }
  throw Error(fmt::format("{} '{}' is unknown; expected one of {}", kind, name, choices));
}

}  // namespace tessera
