#include "engine/frame.h"

#include <tbb/global_control.h>

#include "engine/accuracy_target.h"
#include "engine/accurate_frame.h"
#include "engine/frame_passes.h"
#include "engine/frame_setup.h"
#include "engine/overrides.h"
#include "engine/qualities.h"
#include "engine/timed_frame.h"

namespace tessera {

FrameResult render_frame(const Scene& scene, const Settings& asked, Diagnostics& diagnostics,
                         const FrameControl& control) {
  const Settings settings = with_quality(asked);
  const AccuracyTarget target = accuracy_target(settings);
  const bool several = target.several_passes();
  // More than there are cores only come if they are allowed.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    size_t(thread_count(settings)));
  FramePasses passes(scene, settings, diagnostics, control, several);
  if (target.even_passes()) return render_within_time(passes, settings, diagnostics);
  if (several) return render_accurate(passes, settings, diagnostics);
  return passes.finish(passes.render());
}

FramePlan plan_frame(const Scene& original, const Settings& asked, Diagnostics& diagnostics) {
  const Settings settings = with_quality(asked);
  const Scene scene = apply_overrides(original, settings);
  const Camera camera(scene.camera);
  return make_plan(scene, scene.camera, settings,
                   *bind_shaders(shade_setup(scene, camera, settings, diagnostics)));
}

}  // namespace tessera
