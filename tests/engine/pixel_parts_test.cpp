// Pixels of one choice as rectangles, against counting.

#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/extra_samples.h"

using namespace tessera;

TEST_CASE("parts cover the pixels of a choice once each, and no others") {
  std::mt19937 random(11);
  const PixelRect rect{-3, 7, 14, 18};
  for (const int choices : {1, 2, 3}) {
    std::vector<uint8_t> chosen(size_t(rect.pixel_count()));
    for (uint8_t& choice : chosen) choice = uint8_t(1 + random() % unsigned(choices));
    for (int choice = 1; choice <= choices; ++choice) {
      std::vector<int> covered(chosen.size(), 0);
      for (const PixelRect& part : parts_of(chosen, rect, uint8_t(choice)))
        for (int y = part.y0; y < part.y1; ++y)
          for (int x = part.x0; x < part.x1; ++x)
            ++covered.at(size_t((y - rect.y0) * rect.width() + x - rect.x0));
      for (size_t p = 0; p < chosen.size(); ++p) CHECK(covered[p] == (chosen[p] == choice ? 1 : 0));
    }
  }
}

TEST_CASE("tiles of equal pixels are single parts") {
  const PixelRect rect{0, 0, 32, 32};
  std::vector<uint8_t> chosen(size_t(rect.pixel_count()), 1);
  for (int y = 16; y < 32; ++y)
    for (int x = 0; x < 16; ++x) chosen[size_t(y * 32 + x)] = 2;
  CHECK(parts_of(chosen, rect, 2).size() == 1);
  CHECK(parts_of(chosen, rect, 1).size() == 2);
  CHECK(parts_of(chosen, rect, 3).empty());
}
