#include <catch2/catch.hpp>

#include "base/error.h"
#include "engine/frame_numbers.h"

using namespace tessera;

TEST_CASE("frame ranges hold what they say") {
  CHECK(parse_frame_range("7") == std::vector{7});
  CHECK(parse_frame_range("0-3") == std::vector{0, 1, 2, 3});
  CHECK(parse_frame_range("1-10x4") == std::vector{1, 5, 9});
  CHECK(parse_frame_range("5-5x100") == std::vector{5});
  CHECK(parse_frame_range("2147483646-2147483647").size() == 2);
}

TEST_CASE("anything else is no frame range") {
  for (const char* text : {"", "-", "a", "1-", "-1", "1--3", "3-1", "1-5x", "1-5x0", "1-5x-2",
                           "1-5 ", "1,5", "1-5x2x3", "99999999999", "0-2000000000", "1.5"}) {
    INFO(text);
    CHECK_THROWS_AS(parse_frame_range(text), Error);
  }
}

TEST_CASE("numbers fill patterns and go before extensions") {
  CHECK(has_number_pattern("shot.####.rib"));
  CHECK_FALSE(has_number_pattern("shot.rib"));
  CHECK(with_number("shot.####.rib", 7) == "shot.0007.rib");
  CHECK(with_number("#", 123) == "123");
  CHECK(with_number("f##/s.###.rib", 5) == "f05/s.005.rib");
  CHECK(with_number("end###", 1) == "end001");
  CHECK(insert_number("out.exr", 7) == "out.0007.exr");
  CHECK(insert_number("a.b/out", 12345) == "a.b/out.12345");
  CHECK(insert_number("a/b.c.exr", 0) == "a/b.c.0000.exr");
}
