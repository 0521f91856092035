// FlatIndex against std::unordered_map.

#include <catch2/catch.hpp>

#include <random>
#include <unordered_map>

#include "base/flat_index.h"

using namespace tessera;

namespace {

/// Numbers `names` and compares every answer with those of a map.
void check_against_map(FlatIndex& index, const std::vector<uint64_t>& names) {
  std::unordered_map<uint64_t, uint32_t> expected;
  size_t wrong = 0;
  for (const uint64_t name : names) {
    const auto [place, was_new] = expected.try_emplace(name, uint32_t(expected.size()));
    const auto [number, is_new] = index.insert(name);
    wrong += number != place->second || is_new != was_new || index.name(number) != name;
  }
  CHECK(wrong == 0);
  CHECK(index.size() == expected.size());
  // Nothing moves afterwards.
  for (const auto& [name, number] : expected)
    wrong += index.insert(name) != std::pair{number, false};
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("names are numbered in the order in which they come") {
  FlatIndex index;
  CHECK(index.size() == 0);
  CHECK(index.insert(7) == std::pair{0u, true});
  CHECK(index.insert(0) == std::pair{1u, true});
  CHECK(index.insert(~uint64_t(0)) == std::pair{2u, true});
  CHECK(index.insert(7) == std::pair{0u, false});
  CHECK(index.insert(0) == std::pair{1u, false});
  CHECK(index.name(2) == ~uint64_t(0));
  CHECK(index.size() == 3);
}

TEST_CASE("an index agrees with a map, whatever was expected of it") {
  std::mt19937_64 random(3);
  std::vector<uint64_t> names;
  for (int k = 0; k < 20000; ++k) names.push_back(random() % 7000 * 0x9e3779b97f4a7c15u);
  for (const size_t expected : {0, 1, 16, 6999, 7000, 50000}) {
    FlatIndex index(expected);
    check_against_map(index, names);
  }
}

TEST_CASE("names that all want one slot are told apart") {
  std::vector<uint64_t> names;
  for (uint64_t k = 0; k < 300; ++k) names.push_back(k << 40), names.push_back((k / 2) << 40);
  FlatIndex index;
  check_against_map(index, names);
}
