/// The extremes table: where formulas of each stage break, and what it makes of that, held against
/// closed forms, long double arithmetic and brute force.

#include "bench/extremes_cameras.h"
#include "bench/extremes_dice.h"
#include "bench/extremes_frames.h"
#include "bench/extremes_hide.h"
#include "bench/extremes_lights.h"
#include "bench/extremes_rays.h"
#include "bench/extremes_reconstruct.h"
#include "bench/extremes_shade.h"

namespace tessera {
namespace {

struct Stage {
  const char* name;
  void (*add)(ExtremesTable&);
};

/// In the order of a frame's way through them.
constexpr Stage stages[] = {{"cameras", add_camera_extremes},
                            {"dice", add_dice_extremes},
                            {"hide", add_hide_extremes},
                            {"shade", add_shade_extremes},
                            {"rays", add_ray_extremes},
                            {"lights", add_light_extremes},
                            {"reconstruct", add_reconstruction_extremes},
                            {"frame", add_extreme_frames}};

void run(BenchmarkContext& context) {
  ExtremesTable table(context);
  bool found = false;
  for (const Stage& stage : stages) {
    if (!context.arguments.empty() && context.arguments[0] != stage.name) continue;
    stage.add(table);
    found = true;
  }
  if (!found) throw Error(fmt::format("no stage '{}' in the extremes table", context.arguments[0]));
}

}  // namespace

BenchmarkDefinition benchmark_extremes() {
  return {"extremes",
          "every stage where its formulas break, against oracles that share no code with it "
          "(fails when an error is beyond what the stage claims)",
          run,
          {"STAGE"}};
}

}  // namespace tessera
