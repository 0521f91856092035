#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "reconstruct/filter_table.h"
#include "reconstruct/pixel_filter.h"

using namespace tessera;

namespace {

/// Integral over the whole width, by Simpson's rule.
double integral(const PixelFilterDefinition& filter, double width) {
  constexpr int panels = 2000;
  double sum = 0.0;
  for (int i = 0; i <= 2 * panels; ++i) {
    const double x = width * (i / (2.0 * panels) - 0.5);
    sum += (i == 0 || i == 2 * panels ? 1.0 : i % 2 ? 4.0 : 2.0) * filter.weight(x, width);
  }
  return sum * width / (6.0 * panels);
}

}  // namespace

TEST_CASE("every filter of the RenderMan interface is there, and others are refused with a list") {
  for (const char* name :
       {"box", "triangle", "gaussian", "catmull-rom", "sinc", "mitchell", "blackman-harris"})
    CHECK(std::string(find_pixel_filter(name).name) == name);
  CHECK_THROWS_WITH(find_pixel_filter("lanczos"), Catch::Contains("lanczos") &&
                                                      Catch::Contains("catmull-rom") &&
                                                      Catch::Contains("blackman-harris"));
}

TEST_CASE("filters are symmetric and peak at the centre") {
  for (const auto& filter : pixel_filter_registry()) {
    INFO(filter.name);
    for (double width : {1.0, 2.0, 3.5, 8.0}) {
      const double peak = filter.weight(0.0, width);
      CHECK(peak > 0.0);
      for (double x = 0.0; x <= width / 2; x += 0.01) {
        // Cosines of angles about pi, not 0, round differently.
        CHECK(filter.weight(x, width) == Approx(filter.weight(-x, width)).margin(1e-15));
        CHECK(filter.weight(x, width) <= peak);
      }
    }
  }
}

TEST_CASE("filters without lobes are nowhere negative") {
  for (const char* name : {"box", "triangle", "gaussian", "blackman-harris"}) {
    INFO(name);
    // The Blackman-Harris window ends at 6e-5, up to rounding of its coefficients.
    for (double x = 0.0; x <= 1.5; x += 0.01) CHECK(find_pixel_filter(name).weight(x, 3.0) >= 0.0);
  }
}

TEST_CASE("integrals of the filters agree with closed forms") {
  const double pi = std::numbers::pi;
  for (double width : {1.0, 2.0, 4.0}) {
    INFO(width);
    CHECK(integral(find_pixel_filter("box"), width) == Approx(width));
    CHECK(integral(find_pixel_filter("triangle"), width) == Approx(width / 2));
    // exp(-2 (2x/w)^2) over |x| < w/2 is w/2 sqrt(pi/2) erf(sqrt 2).
    CHECK(integral(find_pixel_filter("gaussian"), width) ==
          Approx(width / 2 * std::sqrt(pi / 2) * std::erf(std::sqrt(2.0))));
    // The cosines run over whole periods: only the constant is left.
    CHECK(integral(find_pixel_filter("blackman-harris"), width) == Approx(0.35875 * width));
    CHECK(integral(find_pixel_filter("mitchell"), width) == Approx(width / 4));
  }
  CHECK(integral(find_pixel_filter("catmull-rom"), 4.0) == Approx(1.0));
  // 2 Si(2 pi) / pi, with Si(2 pi) = 1.418151576.
  CHECK(integral(find_pixel_filter("sinc"), 4.0) == Approx(2 * 1.4181515761326 / pi));
}

TEST_CASE("cubics are partitions of unity, and Catmull-Rom interpolates") {
  for (double x = 0.0; x <= 1.0; x += 0.0625) {
    for (const char* name : {"catmull-rom", "mitchell"}) {
      INFO(name << " " << x);
      double sum = 0.0;
      for (int k = -2; k <= 2; ++k)
        if (std::abs(x + k) <= 2.0) sum += find_pixel_filter(name).weight(x + k, 4.0);
      CHECK(sum == Approx(1.0));
    }
  }
  const auto& catmull_rom = find_pixel_filter("catmull-rom");
  CHECK(catmull_rom.weight(0.0, 4.0) == 1.0);
  CHECK(catmull_rom.weight(1.0, 4.0) == Approx(0.0).margin(1e-15));
  CHECK(find_pixel_filter("mitchell").weight(0.0, 4.0) == Approx(8.0 / 9.0));
}

TEST_CASE("tables of filters follow them") {
  for (const auto& filter : pixel_filter_registry()) {
    for (float width : {1.0f, 2.0f, 4.0f, 7.3f}) {
      INFO(filter.name << " " << width);
      const FilterTable table(filter, width);
      double worst = 0.0;
      for (int i = 0; i < 5000; ++i) {
        const double x = 0.5 * width * (i + 0.37) / 5000;
        worst = std::max(worst, std::abs(double(table(float(x))) - filter.weight(x, width)));
      }
      // Linear interpolation errs by h^2 / 8 |f''| at most, h = width / 2048. |f''| is at most
      // 64 / width^2 for the filters that scale with the width (mitchell, at its peak), and at most
      // 5 for sinc and catmull-rom, which do not.
      const double curvature = 64.0 + 5.0 * width * width;
      CHECK(worst <= curvature / (8.0 * 2048.0 * 2048.0) + 1e-7);
      CHECK(table(0.5001f * width) == 0.0f);
      CHECK(table(std::nanf("")) == 0.0f);
    }
  }
}

TEST_CASE("a filter reaches as many pixels as hold samples it weighs") {
  const auto& box = find_pixel_filter("box");
  CHECK(FilterTable(box, 0.5f).reach_pixels() == 0);
  CHECK(FilterTable(box, 1.0f).reach_pixels() == 0);
  CHECK(FilterTable(box, 1.01f).reach_pixels() == 1);
  CHECK(FilterTable(box, 2.0f).reach_pixels() == 1);
  CHECK(FilterTable(box, 3.0f).reach_pixels() == 1);
  CHECK(FilterTable(box, 4.0f).reach_pixels() == 2);
}
