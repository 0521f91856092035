#include <catch2/catch.hpp>

#include <bit>
#include <limits>
#include <thread>

#include "base/aligned.h"
#include "base/counters.h"
#include "base/diagnostics.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/raster.h"

using namespace tessera;

namespace {

struct TestCounters {
  uint64_t apples = 0, pears = 0;
  static constexpr auto fields() {
    return std::array{CounterField<TestCounters>{"apples", &TestCounters::apples},
                      CounterField<TestCounters>{"pears", &TestCounters::pears}};
  }
};

}  // namespace

TEST_CASE("each warning is said once and counted every time, from all threads") {
  std::vector<std::string> heard;
  Diagnostics diagnostics([&](const std::string& line) { heard.push_back(line); });
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&] {
      for (int i = 0; i < 100; ++i)
        diagnostics.warn_once("key " + std::to_string(i % 5), {"a.rib", i % 5 + 1}, "odd");
    });
  for (auto& thread : threads) thread.join();
  CHECK(diagnostics.warning_count() == 400);
  CHECK(heard == diagnostics.lines());
  std::sort(heard.begin(), heard.end());
  CHECK(heard == std::vector<std::string>{"a.rib:1: warning: odd", "a.rib:2: warning: odd",
                                          "a.rib:3: warning: odd", "a.rib:4: warning: odd",
                                          "a.rib:5: warning: odd"});
}

TEST_CASE("warnings and errors without a place name none") {
  Diagnostics diagnostics;
  diagnostics.warn_once("k", "odd");
  CHECK(diagnostics.lines() == std::vector<std::string>{"warning: odd"});
  CHECK(std::string(Error({}, "bad").what()) == "bad");
  CHECK(std::string(Error({"a.rib", 0}, "bad").what()) == "a.rib: bad");
  CHECK(std::string(Error({"a.rib", 7}, "bad").what()) == "a.rib:7: bad");
}

TEST_CASE("counters of two threads add up field by field") {
  TestCounters a{1, 20}, b{300, 4000};
  merge_counters(a, b);
  CHECK(a.apples == 301);
  CHECK(a.pears == 4020);
  CHECK(b.pears == 4000);
}

TEST_CASE("pixel rectangles") {
  const PixelRect r{2, 3, 7, 5};
  CHECK(r.pixel_count() == 10);
  CHECK(r.contains(2, 3));
  CHECK_FALSE(r.contains(7, 4));
  CHECK_FALSE(r.contains(6, 5));
  CHECK(r.grown(1) == PixelRect{1, 2, 8, 6});
  CHECK(r.intersect({5, 0, 9, 4}) == PixelRect{5, 3, 7, 4});
  const PixelRect apart = r.intersect({8, 0, 9, 1});
  CHECK(apart.empty());
  CHECK(apart.pixel_count() == 0);
}

TEST_CASE("raster bounds touch the pixels they share an edge with") {
  RasterBounds bounds;
  CHECK(bounds.empty());
  CHECK_FALSE(bounds.overlaps({0, 0, 10, 10}));
  bounds.add(4.0f, 1.0f);
  CHECK_FALSE(bounds.empty());
  CHECK(bounds.overlaps({4, 1, 5, 2}));
  CHECK(bounds.overlaps({3, 0, 4, 1}));
  CHECK_FALSE(bounds.overlaps({5, 1, 6, 2}));
  RasterBounds other;
  other.add(6.5f, -2.0f);
  bounds.add(other);
  CHECK(bounds.overlaps({5, 0, 6, 1}));
  bounds.add(RasterBounds{});  // nothing
  CHECK(bounds.x_max == 6.5f);
  CHECK(RasterBounds::everything().overlaps({-5, -5, -4, -4}));
}

TEST_CASE("padding and alignment of vectors") {
  CHECK(padded(0) == 0);
  CHECK(padded(1) == simd_padding);
  CHECK(padded(simd_padding) == simd_padding);
  CHECK(padded(simd_padding + 1) == 2 * simd_padding);
  for (size_t n : {1u, 3u, 1000u}) {
    const AlignedVector<float> v(n);
    CHECK(reinterpret_cast<uintptr_t>(v.data()) % 64 == 0);
  }
}

TEST_CASE("the hash changes half of its bits for each bit of its input") {
  for (int bit = 0; bit < 32; ++bit) {
    int flips = 0;
    for (uint32_t x = 0; x < 1000; ++x)
      flips += std::popcount(mix32(x * 2654435761u) ^ mix32(x * 2654435761u ^ (1u << bit)));
    // 1000 trials of 32 fair coins: mean 16, deviation of the mean 0.09.
    CHECK(flips / 1000.0 == Approx(16.0).margin(0.5));
  }
  CHECK(hash_combine(1, 2) != hash_combine(2, 1));
}
