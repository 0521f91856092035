/// Every hider at the extremes (tests/hide/extreme_cases.h; `tessera bench extremes` prints them).

#include <catch2/catch.hpp>

#include <string_view>

#include "tests/hide/extreme_tally.h"

using namespace tessera;

namespace {

bool is_registered(std::string_view name) {
  for (const HiderDefinition& definition : hider_registry())
    if (name == definition.name) return true;
  return false;
}

}  // namespace

TEST_CASE("Hiders see at the extremes what long double rays see, but for rounding") {
  for (const char* hider : {"shear", "tct"})
    for (const ExtremeCase& extreme : extreme_cases()) {
      const ExtremeTally t = tally_extremes(extreme, hider, nullptr);
      INFO(hider << " on " << extreme.name << ": " << t.oracle_hits << " hits and " << t.doubtful
                 << " doubtful of " << t.samples << "; worst relative depth error "
                 << t.worst_depth_error << "; first disagreement in variant "
                 << t.first_disagreement);
      CHECK(t.oracle_hits > 0);
      CHECK(t.disagreements == 0);
      // A case that is all doubt tests nothing.
      CHECK(t.doubtful < t.samples / 10);
    }
}

TEST_CASE("Hiders that share the coverage test agree bit for bit at the extremes") {
  for (const ExtremeCase& extreme : extreme_cases())
    for (int k = 0; k < extreme.count; ++k) {
      const TestBucket bucket = extreme.make(k);
      const FragmentList expected = bucket.hide("bbox");
      for (const std::string spec : {"shear", "shear:1", "dual", "pixar"}) {
        if (!is_registered(spec.substr(0, spec.find(':')))) continue;
        INFO(spec << " on " << extreme.name << ", variant " << k);
        CHECK(count_differences(expected, bucket.hide(spec)) == 0);
      }
    }
}
