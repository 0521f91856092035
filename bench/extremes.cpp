/// The extremes table: where formulas break, what the sheared hider sees there, and what long
/// double rays and the brute-force hider see.

#include "bench/extremes_frames.h"
#include "bench/extremes_reconstruct.h"
#include "bench/harness/benchmark.h"
#include "tests/hide/extreme_tally.h"

namespace tessera {
namespace {

void run(BenchmarkContext& context) {
  for (const ExtremeCase& extreme : extreme_cases()) {
    const ExtremeRun what{
        .hiders = {"shear"}, .other = "bbox", .tuples = {}, .rounds = context.scaled(10, 1)};
    const ExtremeTally t = tally_extremes(extreme, what).front();
    context.add_row(extreme.name, {{"samples", double(t.samples)},
                                   {"oracle_hits", double(t.oracle_hits)},
                                   {"doubtful", double(t.doubtful)},
                                   {"disagreements", double(t.disagreements)},
                                   {"hider_differences", double(t.hider_differences)},
                                   {"worst_depth_error", t.worst_depth_error}});
  }
  add_reconstruction_extremes(context);
  add_extreme_frames(context);
}

}  // namespace

BenchmarkDefinition benchmark_extremes() {
  return {"extremes",
          "hider shear at the extremes against long double rays and against brute force (expected: "
          "no disagreements, no differences), the weights of methods of reconstruction, and whole "
          "frames with lights of extent against many samples",
          run};
}

}  // namespace tessera
