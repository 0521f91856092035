// What frames may be rendered to, and what is said of those that are late.

#include <limits>

#include <catch2/catch.hpp>

#include "base/diagnostics.h"
#include "engine/accuracy_target.h"
#include "engine/settings.h"

using namespace tessera;
using Catch::Matchers::Contains;

TEST_CASE("targets that make no sense are errors") {
  const auto with = [](auto change) {
    Settings settings;
    change(settings);
    return accuracy_target(settings);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_WITH(with([&](Settings& s) { s.error = bad; }), Contains("above 0"));
    CHECK_THROWS_WITH(with([&](Settings& s) { s.time_s = bad; }), Contains("above 0"));
    CHECK_THROWS_WITH(with([&](Settings& s) { s.rounds = {4, bad}; }), Contains("above 0"));
  }
  CHECK_THROWS_AS(with([](Settings& s) { s.max_samples = 64; }), Error);
  CHECK_THROWS_AS(with([](Settings& s) { s.error = 0.1, s.max_samples = 1; }), Error);
  CHECK_THROWS_AS(with([](Settings& s) { s.error = 0.1, s.samples_per_pixel = 4; }), Error);
  CHECK_THROWS_AS(with([](Settings& s) { s.rounds = {4}, s.error = 0.1; }), Error);
  CHECK_FALSE(with([](Settings&) {}).several_passes());
  CHECK(with([](Settings& s) { s.error = 0.1; }).max_samples == 1024);
}

TEST_CASE("a frame is late beyond a tenth of its time") {
  const auto said = [](std::optional<double> time_s, double elapsed_s) {
    AccuracyTarget target;
    target.time_s = time_s;
    Diagnostics diagnostics;
    warn_if_late(target, elapsed_s, 12.5, diagnostics);
    return diagnostics.lines();
  };
  CHECK(said(20.0, 21.9).empty());
  CHECK(said({}, 1e9).empty());
  REQUIRE(said(20.0, 22.1).size() == 1);
  CHECK_THAT(said(20.0, 22.1).front(), Contains("22.1 s rather than 20 s, with 12.5 samples"));
}
