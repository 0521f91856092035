#pragma once
/// The lens profiles there are; make_lens_profile() chooses among them.

#include <memory>

#include "cameras/lens_profile.h"

namespace tessera {

/// The unit disc, evenly lit, with a sharp edge.
std::unique_ptr<LensProfile> make_disc_lens();

/// Evenly lit up to radius 0.9, then falling as a smoothstep to nothing at radius 1.1.
std::unique_ptr<LensProfile> make_smooth_lens();

/// A regular polygon inscribed in the unit circle, evenly lit. The first corner lies at
/// `rotation_degrees` from +u towards +v. Throws Error unless 3 <= blades <= 64.
std::unique_ptr<LensProfile> make_polygon_lens(int blades, double rotation_degrees);

}  // namespace tessera
