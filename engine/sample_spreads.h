#pragma once
/// How far samples spread over the lens and the shutter, as filters for distribution effects count
/// it (SampleSpreads of reconstruct/reconstruct.h).

#include "cameras/lens_profile.h"
#include "cameras/shutter_profile.h"

namespace tessera {

/// sqrt(3) times the root mean square of a lens coordinate over its two axes, in lens radii: half
/// the width of an even distribution of the same variance. By midpoints of 64 x 64 strata.
float lens_spread(const LensProfile& lens);

/// The same of the time from the middle of the shutter. By midpoints of 1024 strata.
float time_spread(const ShutterProfile& shutter);

}  // namespace tessera
