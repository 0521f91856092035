// Memo caches against a list that is searched from end to end.

#include <catch2/catch.hpp>

#include <algorithm>
#include <list>
#include <random>

#include "base/error.h"
#include "bench/memo_cache.h"

using namespace tessera;
using Catch::Matchers::Contains;

namespace {

class NaiveCache {
 public:
  explicit NaiveCache(size_t entries) : entries_(entries) {}
  bool request(uint64_t name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    const bool shaded = found == names_.end();
    if (!shaded) names_.erase(found);
    names_.push_front(name);
    if (names_.size() > entries_) names_.pop_back();
    return shaded;
  }

 private:
  size_t entries_;
  std::list<uint64_t> names_;
};

/// Names that come again soon, later, or never; near each other, far apart, and 0.
std::vector<uint64_t> stream(uint32_t seed, size_t count, uint64_t stride) {
  std::mt19937 random(seed);
  std::geometric_distribution<int> near(0.05);
  std::uniform_int_distribution<int> anywhere(0, 300);
  std::vector<uint64_t> names;
  for (size_t i = 0; i < count; ++i)
    names.push_back(stride *
                    uint64_t(random() % 4 == 0 ? anywhere(random) : int(i / 20) + near(random)));
  return names;
}

}  // namespace

TEST_CASE("a memo cache keeps the most recently used names") {
  MemoCache cache(2);
  CHECK(cache.request(7));
  CHECK_FALSE(cache.request(7));
  CHECK(cache.request(8));
  CHECK_FALSE(cache.request(7));  // 8 is now the older one
  CHECK(cache.request(9));        // and goes
  CHECK_FALSE(cache.request(7));
  CHECK(cache.request(8));
  CHECK(cache.request(9));
}

TEST_CASE("memo caches of every size agree with a naive one") {
  // Strides that fill the low bits, the high bits, or neither evenly.
  for (const uint64_t stride : {uint64_t(1), uint64_t(1) << 40, uint64_t(0x9e3779b97f4a7c15u)}) {
    for (const size_t entries : {1, 2, 3, 16, 64, 257}) {
      INFO("stride " << stride << ", entries " << entries);
      MemoCache cache(entries);
      NaiveCache naive(entries);
      const auto names = stream(uint32_t(entries), 6000, stride);
      size_t differing = 0, misses = 0;
      for (const uint64_t name : names) {
        const bool expected = naive.request(name);
        differing += cache.request(name) != expected;
        misses += expected;
      }
      CHECK(differing == 0);
      // Neither all nor none: the streams do test replacement.
      CHECK(misses > 300);
      CHECK(misses < names.size());
    }
  }
}

TEST_CASE("a memo cache without entries is refused") {
  CHECK_THROWS_WITH(MemoCache(0), Contains("between 1 and 2^30") && Contains("found 0"));
  CHECK_THROWS_AS(MemoCache(size_t(1) << 40), Error);
}

TEST_CASE("names leave a table without a trace") {
  NameTable table(64);
  std::mt19937 random(3);
  std::vector<uint64_t> held;
  for (int step = 0; step < 4000; ++step) {
    if (held.size() < 60) {
      held.push_back(random());
      table.insert(held.back(), uint32_t(step));
    } else {
      const size_t k = random() % held.size();
      table.erase(held[k]);
      REQUIRE(table.find(held[k]) == NameTable::absent);
      held.erase(held.begin() + long(k));
    }
    for (const uint64_t name : held) REQUIRE(table.find(name) != NameTable::absent);
    REQUIRE(table.size() == held.size());
  }
}
