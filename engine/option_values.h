#pragma once
/// What the values of options may be.

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace tessera {

/// Accepts "NAME" and "NAME:arguments" of an entry of `registry`; the arguments are checked by
/// whoever makes it.
template <class Registry>
CLI::Validator one_of(Registry registry, const char* kind) {
  return CLI::Validator(
      [registry, kind](std::string& spec) -> std::string {
        const std::string_view name = std::string_view(spec).substr(0, spec.find(':'));
        std::string choices;
        for (const auto& entry : registry) {
          if (name == entry.name) return "";
          choices += fmt::format(" {}", entry.name);
        }
        return fmt::format("no {} '{}'; there is{}", kind, name, choices);
      },
      "NAME");
}

/// As CLI::Range, which lets what is not a number pass.
CLI::Validator number_between(float low, float high);

/// A number above 0 and up to `high`.
CLI::Validator number_above_0(double high);

/// "a,b" -> a and b.
std::vector<std::string> split_list(const std::string& text);

/// The numbers of a list: above 0 and up to `high`, or whole from 1 to `high`. Throw
/// CLI::ValidationError about `option` when one is none.
std::vector<double> positive_numbers(const char* option, const std::string& list, double high);
std::vector<int> whole_numbers(const char* option, const std::string& list, int high);

}  // namespace tessera
