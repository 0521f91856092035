#pragma once
/// Statistics: a stage declares a plain struct of counters and one table naming them; each thread
/// increments its own copy, and copies are merged at the end.
///
///   struct HideCounters {
///     uint64_t samples_tested = 0;
///     static constexpr auto fields() {
///       return std::array{CounterField<HideCounters>{"samples_tested", &HideCounters::samples_tested}};
///     }
///   };

#include <array>
#include <cstdint>

namespace tessera {

template <class Counters>
struct CounterField {
  const char* name;  ///< lower_snake_case, unit as suffix
  uint64_t Counters::*member;
};

/// Adds every field of `from` to `into`.
template <class Counters>
void merge_counters(Counters& into, const Counters& from) {
  for (const auto& field : Counters::fields()) into.*field.member += from.*field.member;
}

}  // namespace tessera
