#include <catch2/catch.hpp>

#include "engine/strips.h"

using namespace tessera;

TEST_CASE("strips make every pixel once and have the samples that it needs", "[strips]") {
  const PixelRect frame{0, 0, 50, 200}, crop{5, 30, 45, 160};
  for (const int size : {7, 32, 500}) {
    for (const int reach : {0, 3, 40}) {
      const PixelRect sampled =
          PixelRect{5 - reach, 30 - reach, 45 + reach, 160 + reach}.intersect(frame);
      const BucketLayout buckets{sampled, size};
      for (const int count : {1, 2, 5, 130, 1000}) {
        CAPTURE(size, reach, count);
        const std::vector<Strip> strips = cut_into_strips(buckets, crop, reach, count);
        REQUIRE(strips.size() == size_t(std::min(count, 130)));
        int next = crop.y0, seen_rows = 0, released_rows = 0;
        for (const Strip& strip : strips) {
          CHECK(strip.crop.y0 == next);
          CHECK(strip.crop.x0 == crop.x0);
          CHECK(strip.crop.x1 == crop.x1);
          next = strip.crop.y1;
          const PixelRect rows = strip.sampled(buckets);
          CHECK(rows.y0 <= std::max(strip.crop.y0 - reach, sampled.y0));
          CHECK(rows.y1 >= std::min(strip.crop.y1 + reach, sampled.y1));
          CHECK(rows.y0 >= strip.crop.y0 - reach - size);
          CHECK(rows.y1 <= strip.crop.y1 + reach + size);
          // Each row is new once and given back once, not before it is new.
          CHECK(strip.first_new_row == seen_rows);
          seen_rows = strip.end_row;
          CHECK(strip.end_last_row <= strip.end_row);
          CHECK(strip.first_row <= released_rows);
          released_rows = std::max(released_rows, strip.end_last_row);
        }
        CHECK(next == crop.y1);
        CHECK(seen_rows == buckets.rows());
        CHECK(released_rows == buckets.rows());
      }
    }
  }
}
