/// Table 1 of the benchmark maaf against closed forms.

#include <catch2/catch.hpp>

#include "bench/maaf_boxes.h"

using namespace tessera;

TEST_CASE("boxes summed over rows cover what closed forms say", "[wedge]") {
  for (const DoubleWedge& wedge : {DoubleWedge{0.5, 0.8}, {1.5, 2.0}, {0.01, 9.0}}) {
    CHECK(summed_box_coverage(wedge, aaf_spectrum(wedge)) ==
          Approx(0.25 * (1 - wedge.s_min / wedge.s_max)).epsilon(1e-9));
    CHECK(summed_box_coverage(wedge, fsf_spectrum(wedge)) == Approx(0.5).epsilon(1e-9));
    for (const int components : {3, 5, 7, 25, 75, 125}) {
      CAPTURE(wedge.s_min, components);
      CHECK(summed_box_coverage(wedge, maaf_spectrum(wedge, components)) ==
            Approx(box_coverage(wedge, components)).epsilon(1e-9));
    }
  }
}
