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

void require_agreement_with_rays(const ExtremeRun& run) {
  for (const ExtremeCase& extreme : extreme_cases()) {
    const std::vector<ExtremeTally> tallies = tally_extremes(extreme, run);
    for (size_t h = 0; h < tallies.size(); ++h) {
      const ExtremeTally& t = tallies[h];
      if (t.samples == 0) continue;  // no variant has what the run needs
      INFO(run.hiders[h] << " on " << extreme.name << ": " << t.oracle_hits << " hits and "
                         << t.doubtful << " doubtful of " << t.samples
                         << "; worst relative depth error " << t.worst_depth_error
                         << "; first disagreement in variant " << t.first_disagreement);
      CHECK(t.oracle_hits > 0);
      CHECK(t.disagreements == 0);
      // A case that is all doubt tests nothing.
      CHECK(t.doubtful < t.samples / 10);
    }
  }
}

}  // namespace

TEST_CASE("Hiders see at the extremes what long double rays see, but for rounding") {
  require_agreement_with_rays({{"shear", "tct"}, nullptr, {}, 1});
}

TEST_CASE("Samples on lens lines see at the extremes what long double rays see") {
  require_agreement_with_rays({{"tct:4"}, nullptr, {SampleTuples::Kind::lens_lines, 4}, 1});
}

TEST_CASE("Hiders that share the coverage test agree bit for bit at the extremes") {
  for (const ExtremeCase& extreme : extreme_cases())
    for (int k = 0; k < extreme.count; ++k) {
      const TestBucket bucket = extreme.make(k);
      const FragmentList expected = bucket.hide("bbox");
      for (const std::string spec : {"auto", "shear", "shear:1", "dual", "pixar"}) {
        if (!is_registered(spec.substr(0, spec.find(':')))) continue;
        INFO(spec << " on " << extreme.name << ", variant " << k);
        CHECK(count_differences(expected, bucket.hide(spec)) == 0);
      }
    }
}
